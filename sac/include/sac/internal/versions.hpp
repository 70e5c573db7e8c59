// The versions of a modifiable that several calls write, in trace order.
//
// Up to kFew lie in place, and are searched from the last one on; more in a sorted index. The
// caller gives their order, as for that: `before(a, b)`.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>

#include "sac/internal/sorted_index.hpp"
#include "sac/internal/timeline.hpp"

namespace sac::detail {

struct Version;

class Versions {
 public:
  [[nodiscard]] std::size_t size() const noexcept { return many_ ? many_->size() : count_; }
  [[nodiscard]] bool empty() const noexcept { return count_ == 0 && !many_; }
  /// Requires: not empty.
  [[nodiscard]] Ref<Version> first() const noexcept { return many_ ? many_->first() : few_[0]; }
  [[nodiscard]] Ref<Version> last() const noexcept {
    return many_ ? many_->last() : few_[count_ - 1];
  }

  /// Throws: std::bad_alloc, and then changes nothing.
  template <class Before>
  void insert(Ref<Version> version, Before&& before) {
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
  void erase(Ref<Version> version, Before&& before) noexcept {
    if (many_) [[unlikely]] {
      many_->erase(version, before);
      if (many_->size() == kFew / 2) gather();
      return;
    }
    std::copy(few_.begin() + index_of(version) + 1, few_.begin() + count_,
              few_.begin() + index_of(version));
    --count_;
  }

  /// What a place lies between, of which `before(place, version)` tells; null: nothing.
  struct Around {
    Ref<Version> before;  // the last that does not come behind it
    Ref<Version> behind;  // the first that does
  };
  template <class Before>
  [[nodiscard]] Around around(Place place, Before&& before) const {
    if (many_) [[unlikely]] {
      const auto found = many_->place_of(place, before);
      return {found.before != nullptr ? *found.before : nullptr,
              found.behind != nullptr ? *found.behind : nullptr};
    }
    std::uint32_t i = count_;
    while (i > 0 && before(place, few_[i - 1])) --i;
    return {i > 0 ? few_[i - 1] : nullptr, i < count_ ? few_[i] : nullptr};
  }
  /// The one before a version that is there; null: none.
  template <class Before>
  [[nodiscard]] Ref<Version> predecessor(Ref<Version> version, Before&& before) const noexcept {
    if (many_) [[unlikely]] {
      const Ref<Version>* found = many_->predecessor(version, before);
      return found != nullptr ? *found : nullptr;
    }
    const std::ptrdiff_t i = index_of(version);
    return i > 0 ? few_[static_cast<std::size_t>(i - 1)] : nullptr;
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

  [[nodiscard]] std::ptrdiff_t index_of(Ref<Version> version) const noexcept {
    return std::find(few_.begin(), few_.begin() + count_, version) - few_.begin();
  }
  void spill() {
    auto many = std::make_unique<SortedIndex<Ref<Version>>>();
    for (std::uint32_t i = 0; i < count_; ++i) many->append(few_[i]);
    many_ = std::move(many);
    count_ = 0;
  }
  void gather() noexcept {
    many_->for_each([&](Ref<Version> version) { few_[count_++] = version; });
    many_.reset();
  }

  std::unique_ptr<SortedIndex<Ref<Version>>> many_;  // null: few
  std::array<Ref<Version>, kFew> few_{};
  std::uint32_t count_ = 0;  // of the few
};

}  // namespace sac::detail
