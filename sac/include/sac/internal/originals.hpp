// The values before a propagation, for types whose equality is coarser than == (a Same of their
// own).
//
// Undoing such a propagation by running it backwards would not bring the values back: a call that
// computes 0.9 again keeps the current 1.5 if the two are the same to it. So the original values
// are kept here until the propagation has succeeded, and a call that writes a value that is the
// same as its original restores the original.
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
  /// Keeps what `call` had written to `mod` (null: its result), unless that is known. If that
  /// fails, it is lost.
  template <class T>
  void keep(const Call& call, ModRef mod, T&& value) noexcept {
    try {
      if (find_item(call, mod) != nullptr) return;
      auto kept = std::make_shared<std::decay_t<T>>(std::forward<T>(value));
      items_.emplace(key(call, mod), Item{&call, ++count_, std::move(kept)});
    } catch (...) {
      lost_ = true;
    }
  }
  /// What `call`, or one that has been discarded and that it replaces, had written to `mod`; null
  /// if not known. Throws: what comparing arguments throws.
  template <class T>
  [[nodiscard]] const T* find(const Call& call, ModRef mod) {
    const Item* item = find_item(call, mod);
    return item != nullptr ? static_cast<const T*>(item->value.get()) : nullptr;
  }
  /// Whether something could not be kept.
  [[nodiscard]] bool lost() const noexcept { return lost_; }
  void clear() noexcept {
    if (!items_.empty()) items_.clear();
    lost_ = false;
    count_ = 0;
  }

 private:
  struct Item {
    const Call* call;      // it may be dead, but is not freed before the propagation has ended
    std::uint64_t number;  // in the order in which they were kept
    std::shared_ptr<void> value;
  };
  static std::uint64_t key(const Call& call, ModRef mod) {
    return std::uint64_t{call.function().hash(call)} << 32 | mod.handle();
  }
  // The call's own; else that of a discarded call of this label, which it replaces from now on. Of
  // several the first: what was discarded in some order is mostly made anew in that order.
  [[nodiscard]] Item* find_item(const Call& call, ModRef mod) {
    const auto [first, last] = items_.equal_range(key(call, mod));
    Item* replaced = nullptr;
    for (auto it = first; it != last; ++it) {
      Item& item = it->second;
      if (item.call == &call) return &item;
      const bool earlier = replaced == nullptr || item.number < replaced->number;
      if (item.call->dead() && earlier && equal(*item.call, call)) replaced = &item;
    }
    if (replaced != nullptr) replaced->call = &call;
    return replaced;
  }
  static bool equal(const Call& a, const Call& b) {
    const Function& function = a.function();
    return a.function_number == b.function_number && function.equal(a, function.arguments(b));
  }

  std::unordered_multimap<std::uint64_t, Item> items_;  // searched only, never walked
  std::uint64_t count_ = 0;
  bool lost_ = false;
};

}  // namespace sac
