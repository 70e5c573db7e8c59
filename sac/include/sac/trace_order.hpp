// Versions of a modifiable, or readers of a version, in trace order: a sorted array while they are
// few, as they mostly are, and a two-level one beyond. O(log) a search; O(log), and the few entries
// behind, an edit.
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <vector>

#include "sac/ordered_calls.hpp"

namespace sac {

/// Handles in the order of `before(a, b)`, which must not throw and may be asked about handles that
/// are not there.
class TraceOrder {
 public:
  [[nodiscard]] std::size_t size() const noexcept { return many_ ? many_->size() : few_.size(); }
  [[nodiscard]] bool empty() const noexcept { return size() == 0; }
  /// Requires: not empty.
  [[nodiscard]] Handle first() const noexcept { return many_ ? many_->first() : few_.front(); }
  [[nodiscard]] Handle last() const noexcept { return many_ ? many_->last() : few_.back(); }

  /// Throws: std::bad_alloc, and then changes nothing.
  template <class Before>
  void insert(Handle h, Before&& before) {
    if (!many_ && few_.size() == kFew) spread();
    if (many_) return many_->insert({0, h}, before);
    few_.insert(behind(h, before), h);
  }
  /// Adds `h` behind all others. Requires: it belongs there. Throws: std::bad_alloc.
  void append(Handle h) {
    if (!many_ && few_.size() == kFew) spread();
    many_ ? many_->append({0, h}) : few_.push_back(h);
  }
  /// Requires: `h` is there.
  template <class Before>
  void erase(Handle h, Before&& before) noexcept {
    if (!many_) {
      few_.erase(std::lower_bound(few_.begin(), few_.end(), h, before));
      return;
    }
    many_->erase({0, h}, before);
    if (many_->size() == kFew / 2) gather();
  }

  /// The last that comes before `h`; 0 if there is none.
  template <class Before>
  [[nodiscard]] Handle predecessor(Handle h, Before&& before) const noexcept {
    if (many_) return many_->predecessor({0, h}, before);
    const auto it = std::lower_bound(few_.begin(), few_.end(), h, before);
    return it != few_.begin() ? it[-1] : 0;
  }
  /// The last that does not come behind `h`; 0 if there is none.
  template <class Before>
  [[nodiscard]] Handle last_not_behind(Handle h, Before&& before) const noexcept {
    if (many_) return many_->last_not_behind({0, h}, before);
    const auto it = behind(h, before);
    return it != few_.begin() ? it[-1] : 0;
  }
  /// The first that comes behind `h`; 0 if there is none.
  template <class Before>
  [[nodiscard]] Handle successor(Handle h, Before&& before) const noexcept {
    if (many_) return many_->successor({0, h}, before);
    const auto it = behind(h, before);
    return it != few_.end() ? *it : 0;
  }

  template <class Visit>
  void for_each(Visit&& visit) const {
    if (many_) return many_->for_each([&](const OrderedCalls::Entry& e) { visit(e.call); });
    for (const Handle h : few_) visit(h);
  }

  [[nodiscard]] std::size_t bytes() const noexcept {
    return few_.capacity() * sizeof(Handle) + (many_ ? sizeof(OrderedCalls) + many_->bytes() : 0);
  }

 private:
  static constexpr std::size_t kFew = 32;  // a leaf of the two-level array

  template <class Before>
  [[nodiscard]] std::vector<Handle>::const_iterator behind(Handle h, Before&& before) const {
    return std::upper_bound(few_.begin(), few_.end(), h, before);
  }
  void spread() {
    auto many = std::make_unique<OrderedCalls>();
    for (const Handle h : few_) many->append({0, h});
    many_ = std::move(many);
    few_.clear();
  }
  // The array has kept its capacity.
  void gather() noexcept {
    many_->for_each([&](const OrderedCalls::Entry& e) { few_.push_back(e.call); });
    many_.reset();
  }

  std::vector<Handle> few_;
  std::unique_ptr<OrderedCalls> many_;
};

}  // namespace sac
