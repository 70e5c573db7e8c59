// The limits of size announced since the last update: what they shall be, and where they differ
// from those that were.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "sizes/all_limits.hpp"

namespace mesher::detail {

/// Options with the limits that shall be.
struct LimitsEdit {
  Options<2> options;
  std::vector<Box<2>> where;
};

class AnnouncedLimits {
 public:
  /// `now`: those of the last update.
  [[nodiscard]] AllLimits as_announced(const Options<2>& now) const {
    return to_ ? *to_ : AllLimits::of(now);
  }
  /// They shall be `to`, which differ in `where` from those announced before.
  /// Throws: bad_alloc, and then changes nothing.
  void set(AllLimits to, const std::vector<Box<2>>& where, const Options<2>& now) {
    if (to == AllLimits::of(now)) return clear();
    where_.reserve(where_.size() + where.size());
    where_.insert(where_.end(), where.begin(), where.end());
    to_ = std::move(to);
  }
  /// Nothing if they stay.
  [[nodiscard]] std::optional<LimitsEdit> edit(const Options<2>& now) const {
    if (!to_) return std::nullopt;
    return LimitsEdit{applied_to(now), where_};
  }
  [[nodiscard]] Options<2> applied_to(Options<2> options) const {
    as_announced(options).apply_to(options);
    return options;
  }
  void commit(Options<2>& now) noexcept {
    if (to_) std::move(*to_).apply_to(now);
    clear();
  }
  void clear() noexcept {
    to_.reset();
    where_.clear();
  }

 private:
  std::optional<AllLimits> to_;
  std::vector<Box<2>> where_;
};

}  // namespace mesher::detail
