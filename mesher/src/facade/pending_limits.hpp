// The limits of size announced since the last update: what they shall be, and where they differ
// from those that were.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "sizes/all_limits.hpp"
#include "sizes/limits_of.hpp"

namespace mesher::detail {

/// Options with the limits that shall be.
template <int D>
struct LimitsEdit {
  Options<D> options;
  std::vector<Box<D>> where;
};

template <int D>
class PendingLimits {
 public:
  /// `now`: those of the last update.
  [[nodiscard]] AllLimits<D> as_pending(const Options<D>& now) const {
    return to_ ? *to_ : AllLimits<D>::of(now);
  }
  /// They shall be `to`, which differ in `where` from those announced before.
  /// Throws: Error(bad_option) for limits that make no sense, std::bad_alloc; then changes nothing.
  void set(AllLimits<D> to, const std::vector<Box<D>>& where, const Options<D>& now,
           const MeshBox<D>& box) {
    Options<D> all = now;
    AllLimits<D>(to).apply_to(all);
    static_cast<void>(LimitsOf<D>(all, box));
    if (to == AllLimits<D>::of(now)) return clear();
    where_.reserve(where_.size() + where.size());
    where_.insert(where_.end(), where.begin(), where.end());
    to_ = std::move(to);
  }
  /// Nothing if they stay.
  [[nodiscard]] std::optional<LimitsEdit<D>> edit(const Options<D>& now) const {
    if (!to_) return std::nullopt;
    return LimitsEdit<D>{applied_to(now), where_};
  }
  [[nodiscard]] Options<D> applied_to(Options<D> options) const {
    as_pending(options).apply_to(options);
    return options;
  }
  void commit(Options<D>& now) noexcept {
    if (to_) std::move(*to_).apply_to(now);
    clear();
  }
  void clear() noexcept {
    to_.reset();
    where_.clear();
  }

 private:
  std::optional<AllLimits<D>> to_;
  std::vector<Box<D>> where_;
};

}  // namespace mesher::detail
