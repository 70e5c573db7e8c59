// What all processes call the features of an input that each of them has.
//
// Handles may differ between processes, after an update for which one of them had no memory. A
// number is given where a feature comes, in an order that says nothing of handles.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

namespace mesher::detail {

class FeatureNumbers {
 public:
  using Handle = std::uint32_t;
  using Number = std::uint32_t;

  /// Requires: it has a number, or is 0, which is no feature, and has the number 0.
  [[nodiscard]] Number of(Handle h) const { return h == 0 ? 0 : numbers_.at(h); }
  [[nodiscard]] Handle handle(Number n) const { return n == 0 ? 0 : handles_.at(n); }
  [[nodiscard]] bool has(Handle h) const { return numbers_.contains(h); }
  [[nodiscard]] std::size_t size() const noexcept { return numbers_.size(); }

  /// Numbers one more, unless it has a number. Throws: std::bad_alloc, and then has not.
  void add(Handle h) {
    if (has(h)) return;
    given_.reserve(given_.size() + 1);
    const Number n = last_ + 1;
    handles_.emplace(n, h);
    try {
      numbers_.emplace(h, n);
    } catch (...) {
      handles_.erase(n);
      throw;
    }
    given_.push_back(h);
    last_ = n;
  }
  /// Of a feature that has gone: the handle may become another's.
  void take(Handle h) noexcept {
    const auto it = numbers_.find(h);
    if (it == numbers_.end()) return;
    handles_.erase(it->second);
    numbers_.erase(it);
  }
  /// Ends an update, or takes back what it has numbered.
  void commit() noexcept { given_.clear(); }
  void take_back() noexcept {
    for (const Handle h : given_) take(h);
    last_ -= static_cast<Number>(given_.size());
    given_.clear();
  }
  /// Forgets all.
  void clear() noexcept { *this = FeatureNumbers(); }

 private:
  std::unordered_map<Handle, Number> numbers_;
  std::unordered_map<Number, Handle> handles_;
  std::vector<Handle> given_;  // since the last commit
  Number last_ = 0;
};

}  // namespace mesher::detail
