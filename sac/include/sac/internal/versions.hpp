// The versions of a modifiable that several calls write, in trace order.
//
// Up to kFew lie in place, and are searched from the last one on; more in a sorted index. The
// caller gives their order, as for that: `before(a, b)`, in which 0 may stand for a place.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>

#include "sac/arena.hpp"
#include "sac/internal/sorted_index.hpp"

namespace sac::detail {

class Versions {
 public:
  [[nodiscard]] std::size_t size() const noexcept { return many_ ? many_->size() : count_; }
  [[nodiscard]] bool empty() const noexcept { return count_ == 0 && !many_; }
  /// Requires: not empty.
  [[nodiscard]] Handle first() const noexcept { return many_ ? many_->first() : few_[0]; }
  [[nodiscard]] Handle last() const noexcept { return many_ ? many_->last() : few_[count_ - 1]; }

  /// Throws: std::bad_alloc, and then changes nothing.
  template <class Before>
  void insert(Handle version, Before&& before) {
    if (!many_ && count_ == kFew) [[unlikely]]
      spill();
    if (many_) [[unlikely]]
      return many_->insert(version, before);
    std::uint32_t i = count_;
    for (; i > 0 && before(version, few_[i - 1]); --i) few_[i] = few_[i - 1];
    few_[i] = version;
    ++count_;
  }
  /// Requires: it is there.
  template <class Before>
  void erase(Handle version, Before&& before) noexcept {
    if (many_) [[unlikely]] {
      many_->erase(version, before);
      if (many_->size() == kFew / 2) gather();
      return;
    }
    std::copy(few_.begin() + index_of(version) + 1, few_.begin() + count_,
              few_.begin() + index_of(version));
    --count_;
  }

  /// What a version, which may be there or not, lies between; 0: nothing.
  struct Place {
    Handle before = 0;  // the last that does not come behind it
    Handle behind = 0;  // the first that does
  };
  template <class Before>
  [[nodiscard]] Place place_of(Handle version, Before&& before) const {
    if (many_) [[unlikely]] {
      const auto found = many_->place_of(version, before);
      return {found.before != nullptr ? *found.before : 0,
              found.behind != nullptr ? *found.behind : 0};
    }
    std::uint32_t i = count_;
    while (i > 0 && before(version, few_[i - 1])) --i;
    return {i > 0 ? few_[i - 1] : 0, i < count_ ? few_[i] : 0};
  }
  /// The one before a version that is there; 0: none.
  template <class Before>
  [[nodiscard]] Handle predecessor(Handle version, Before&& before) const noexcept {
    if (many_) [[unlikely]] {
      const Handle* found = many_->predecessor(version, before);
      return found != nullptr ? *found : 0;
    }
    const std::ptrdiff_t i = index_of(version);
    return i > 0 ? few_[static_cast<std::size_t>(i - 1)] : 0;
  }
  template <class Visit>
  void for_each(Visit&& visit) const {
    if (many_) return many_->for_each(visit);
    std::for_each(few_.begin(), few_.begin() + count_, visit);
  }
  /// Bytes that do not lie in place.
  [[nodiscard]] std::size_t bytes() const noexcept {
    return many_ ? sizeof(*many_) + many_->bytes() : 0;
  }

 private:
  static constexpr std::uint32_t kFew = 4;

  [[nodiscard]] std::ptrdiff_t index_of(Handle version) const noexcept {
    return std::find(few_.begin(), few_.begin() + count_, version) - few_.begin();
  }
  void spill() {
    auto many = std::make_unique<SortedIndex<Handle>>();
    for (std::uint32_t i = 0; i < count_; ++i) many->append(few_[i]);
    many_ = std::move(many);
    count_ = 0;
  }
  void gather() noexcept {
    many_->for_each([&](Handle version) { few_[count_++] = version; });
    many_.reset();
  }

  std::unique_ptr<SortedIndex<Handle>> many_;  // null: few
  std::array<Handle, kFew> few_{};
  std::uint32_t count_ = 0;  // of the few
};

}  // namespace sac::detail
