// Numbers for constant objects (functions, types of values), given in the order of first use.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "sac/check.hpp"

namespace sac {

template <class T>
class Registry {
 public:
  /// The number of `item`, which is never destroyed. Throws: std::bad_alloc; UsageError above 65535
  /// items.  Cost: O(1).
  [[nodiscard]] std::uint16_t number(const T& item) {
    const Slot& slot = slots_[home(&item) & mask_];
    return slot.item == &item ? slot.number : search(item);
  }
  [[nodiscard]] const T& operator[](std::uint16_t number) const noexcept { return *items_[number]; }
  [[nodiscard]] const T* const* data() const noexcept { return items_.data(); }
  [[nodiscard]] std::size_t size() const noexcept { return items_.size(); }

 private:
  struct Slot {
    const T* item = nullptr;
    std::uint16_t number = 0;
  };
  static constexpr std::size_t kFirst = 128;
  static constexpr std::size_t kMost = 0xffff;

  // The table only finds numbers; nothing is ordered by it.
  [[nodiscard]] static std::size_t home(const T* item) noexcept {
    return reinterpret_cast<std::uintptr_t>(item) * 0x9e3779b97f4a7c15u >> 40;
  }
  [[gnu::noinline]] std::uint16_t search(const T& item) {
    for (std::size_t i = home(&item);; ++i) {
      const Slot& slot = slots_[i & mask_];
      if (slot.item == nullptr) return add(item);
      if (slot.item == &item) return slot.number;
    }
  }
  std::uint16_t add(const T& item) {
    SAC_EXPECTS(items_.size() < kMost);
    if (2 * items_.size() + 2 > slots_.size()) grow();
    items_.push_back(&item);
    enter(static_cast<std::uint16_t>(items_.size() - 1));
    return static_cast<std::uint16_t>(items_.size() - 1);
  }
  void grow() {
    std::vector<Slot> wider(2 * slots_.size());
    slots_.swap(wider);
    mask_ = slots_.size() - 1;
    for (std::size_t i = 0; i < items_.size(); ++i) enter(static_cast<std::uint16_t>(i));
  }
  void enter(std::uint16_t number) noexcept {
    std::size_t i = home(items_[number]);
    while (slots_[i & mask_].item != nullptr) ++i;
    slots_[i & mask_] = {items_[number], number};
  }

  std::vector<const T*> items_;
  std::vector<Slot> slots_ = std::vector<Slot>(kFirst);
  std::size_t mask_ = kFirst - 1;
};

}  // namespace sac
