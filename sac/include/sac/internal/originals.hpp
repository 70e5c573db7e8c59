// What values were before a propagation, for types of which the program keeps one value for
// another (a Same that is not ==).
//
// Undoing such a propagation by running it backwards would not bring the values back: a call that
// computes 0.9 again keeps the 1.5 that is there, if these are the same to it. So what was there is
// kept here until the propagation has succeeded, and a call that writes something that is the same
// as what its call had written puts that back.
#pragma once

#include <cstdint>
#include <memory>
#include <type_traits>
#include <unordered_map>
#include <utility>

#include "sac/trace.hpp"

namespace sac {

class Originals {
 public:
  /// Keeps what `call` had written to `place` (0: its result), unless that is known. If that fails,
  /// it is lost.
  template <class T>
  void keep(const Call& call, Handle place, T&& value) noexcept {
    try {
      if (find_item(call, place) != nullptr) return;
      items_.emplace(key(call, place),
                     Item{&call, std::make_shared<std::decay_t<T>>(std::forward<T>(value))});
    } catch (...) {
      lost_ = true;
    }
  }
  /// What a call of this label had written to `place`; null if not known.
  /// Throws: what comparing arguments throws.
  template <class T>
  [[nodiscard]] const T* find(const Call& call, Handle place) const {
    const Item* item = find_item(call, place);
    return item != nullptr ? static_cast<const T*>(item->value.get()) : nullptr;
  }
  /// Whether something could not be kept.
  [[nodiscard]] bool lost() const noexcept { return lost_; }
  void clear() noexcept {
    items_.clear();
    lost_ = false;
  }

 private:
  struct Item {
    const Call* call;  // it may be dead, but is not freed before the propagation has ended
    std::shared_ptr<void> value;
  };
  static std::uint64_t key(const Call& call, Handle place) {
    return std::uint64_t{call.function().hash(call)} << 32 | place;
  }
  // A call that was discarded may have been made anew: labels are compared.
  [[nodiscard]] const Item* find_item(const Call& call, Handle place) const {
    const Function& function = call.function();
    const auto [first, last] = items_.equal_range(key(call, place));
    for (auto it = first; it != last; ++it) {
      const Call& other = *it->second.call;
      if (other.function_number == call.function_number &&
          function.equal(other, function.arguments(call))) {
        return &it->second;
      }
    }
    return nullptr;
  }

  std::unordered_multimap<std::uint64_t, Item> items_;  // searched only, never walked
  bool lost_ = false;
};

}  // namespace sac
