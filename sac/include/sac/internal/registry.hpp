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
    for (std::size_t i = home(&item);; ++i) {
      const std::uint16_t slot = slots_[i & (slots_.size() - 1)];
      if (slot == kEmpty) return add(item);
      if (items_[slot] == &item) return slot;
    }
  }
  [[nodiscard]] const T& operator[](std::uint16_t number) const noexcept { return *items_[number]; }
  [[nodiscard]] const T* const* data() const noexcept { return items_.data(); }
  [[nodiscard]] std::size_t size() const noexcept { return items_.size(); }

 private:
  static constexpr std::uint16_t kEmpty = 0xffff;

  // The table only finds numbers; nothing is ordered by it.
  [[nodiscard]] static std::size_t home(const T* item) noexcept {
    return reinterpret_cast<std::uintptr_t>(item) * 0x9e3779b97f4a7c15u >> 40;
  }
  std::uint16_t add(const T& item) {
    SAC_EXPECTS(items_.size() < kEmpty);
    if (2 * items_.size() + 2 > slots_.size()) grow();
    items_.push_back(&item);
    enter(static_cast<std::uint16_t>(items_.size() - 1));
    return static_cast<std::uint16_t>(items_.size() - 1);
  }
  void grow() {
    std::vector<std::uint16_t> wider(2 * slots_.size(), kEmpty);
    slots_.swap(wider);
    for (std::size_t i = 0; i < items_.size(); ++i) enter(static_cast<std::uint16_t>(i));
  }
  void enter(std::uint16_t number) noexcept {
    std::size_t i = home(items_[number]);
    while (slots_[i & (slots_.size() - 1)] != kEmpty) ++i;
    slots_[i & (slots_.size() - 1)] = number;
  }

  std::vector<const T*> items_;
  std::vector<std::uint16_t> slots_ = std::vector<std::uint16_t>(64, kEmpty);
};

}  // namespace sac
