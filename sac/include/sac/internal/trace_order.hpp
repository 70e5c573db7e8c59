// Versions of a modifiable, or readers of a version, in trace order: a sorted array while they are
// few, as they mostly are, and a two-level one beyond. O(log) a search; O(log), and the few entries
// behind, an edit. Four lie in place.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>

#include "sac/internal/ordered_calls.hpp"

namespace sac {

/// Handles in the order of `before(a, b)`, which must not throw and may be asked about handles that
/// are not there.
class TraceOrder {
 public:
  /// What an entry lies between; 0: nothing.
  struct Place {
    Handle before = 0;  // the last that does not come behind it
    Handle behind = 0;  // the first that does
  };

  TraceOrder() = default;
  TraceOrder(TraceOrder&& other) noexcept
      : size_(std::exchange(other.size_, 0)),
        capacity_(std::exchange(other.capacity_, kInPlace)),
        few_(other.few_),
        many_(std::move(other.many_)) {}
  TraceOrder& operator=(TraceOrder&& other) noexcept {
    std::swap(size_, other.size_);
    std::swap(capacity_, other.capacity_);
    std::swap(few_, other.few_);
    std::swap(many_, other.many_);
    return *this;
  }
  ~TraceOrder() {
    if (capacity_ > kInPlace) delete[] few_.apart;
  }

  [[nodiscard]] std::size_t size() const noexcept { return many_ ? many_->size() : size_; }
  [[nodiscard]] bool empty() const noexcept { return size() == 0; }
  /// Requires: not empty.
  [[nodiscard]] Handle first() const noexcept { return many_ ? many_->first() : *begin(); }
  [[nodiscard]] Handle last() const noexcept { return many_ ? many_->last() : end()[-1]; }

  /// Throws: std::bad_alloc, and then changes nothing.
  template <class Before>
  void insert(Handle h, Before&& before) {
    make_room();
    if (many_) return many_->insert({0, h}, before);
    Handle* const place = std::upper_bound(begin(), end(), h, before);
    std::copy_backward(place, end(), end() + 1);
    *place = h;
    ++size_;
  }
  /// Adds `h` behind all others. Requires: it belongs there. Throws: std::bad_alloc.
  void append(Handle h) {
    make_room();
    if (many_) return many_->append({0, h});
    *end() = h;
    ++size_;
  }
  /// Requires: `h` is there.
  template <class Before>
  void erase(Handle h, Before&& before) noexcept {
    if (!many_) {
      Handle* const place = std::lower_bound(begin(), end(), h, before);
      std::copy(place + 1, end(), place);
      --size_;
      return;
    }
    many_->erase({0, h}, before);
    if (many_->size() == kFew / 2) gather();
  }

  /// The last that comes before `h`; 0 if there is none.
  template <class Before>
  [[nodiscard]] Handle predecessor(Handle h, Before&& before) const noexcept {
    if (many_) return many_->predecessor({0, h}, before);
    const Handle* const place = std::lower_bound(begin(), end(), h, before);
    return place != begin() ? place[-1] : 0;
  }
  template <class Before>
  [[nodiscard]] Place place_of(Handle h, Before&& before) const noexcept {
    if (many_) return {many_->last_not_behind({0, h}, before), many_->successor({0, h}, before)};
    const Handle* const place = std::upper_bound(begin(), end(), h, before);
    return {place != begin() ? place[-1] : 0, place != end() ? *place : 0};
  }

  template <class Visit>
  void for_each(Visit&& visit) const {
    if (many_) return many_->for_each([&](const OrderedCalls::Entry& e) { visit(e.call); });
    std::for_each(begin(), end(), visit);
  }

  /// Beside the object itself.
  [[nodiscard]] std::size_t bytes() const noexcept {
    return (capacity_ > kInPlace ? capacity_ * sizeof(Handle) : 0) +
           (many_ ? sizeof(OrderedCalls) + many_->bytes() : 0);
  }

 private:
  static constexpr std::uint32_t kInPlace = 4;
  static constexpr std::uint32_t kFew = 32;  // a leaf of the two-level array

  union Few {
    Handle in_place[kInPlace] = {};
    Handle* apart;
  };

  [[nodiscard]] Handle* begin() noexcept {
    return capacity_ > kInPlace ? few_.apart : few_.in_place;
  }
  [[nodiscard]] const Handle* begin() const noexcept {
    return capacity_ > kInPlace ? few_.apart : few_.in_place;
  }
  [[nodiscard]] Handle* end() noexcept { return begin() + size_; }
  [[nodiscard]] const Handle* end() const noexcept { return begin() + size_; }

  // For one more.
  void make_room() {
    if (many_ || size_ < capacity_) return;
    if (size_ < kFew) {
      Handle* const larger = new Handle[2 * std::size_t{capacity_}];
      std::copy(begin(), end(), larger);
      if (capacity_ > kInPlace) delete[] few_.apart;
      few_.apart = larger;
      capacity_ *= 2;
      return;
    }
    auto many = std::make_unique<OrderedCalls>();
    std::for_each(begin(), end(), [&](Handle h) { many->append({0, h}); });
    many_ = std::move(many);
    size_ = 0;
  }
  // The array has kept its capacity.
  void gather() noexcept {
    many_->for_each([&](const OrderedCalls::Entry& e) { begin()[size_++] = e.call; });
    many_.reset();
  }

  std::uint32_t size_ = 0;  // of the array
  std::uint32_t capacity_ = kInPlace;
  Few few_;
  std::unique_ptr<OrderedCalls> many_;
};

}  // namespace sac
