// Dyadic numbers: chooses one in an interval.
//
// A coarse position is likely to be needed again, by other calls and after an edit, since it
// depends on little.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>

namespace mesher::detail {

/// A part of something, in fractions of it.
struct Span {
  double lo = 0, hi = 1;
  /// Its part in the middle; `share`: of all of it.
  [[nodiscard]] Span middle(double share) const noexcept {
    const double off = (hi - lo) * (1 - share) / 2;
    return {lo + off, hi - off};
  }
};

/// The multiple of the largest power of two in [lo, hi], not 0; nothing if that power would be
/// below 2^-50 of the one in `length`. Requires: hi <= length.
[[nodiscard]] inline std::optional<double> coarsest_dyadic(double lo, double hi,
                                                           double length) noexcept {
  const int unit = std::ilogb(length) - 50;
  const double first = std::ceil(std::ldexp(std::fmax(lo, 0), -unit));
  const double last = std::floor(std::ldexp(hi, -unit));
  if (!(first <= last) || last < 1) return std::nullopt;
  const auto below = static_cast<std::uint64_t>(std::fmax(first, 1)) - 1;
  const auto end = static_cast<std::uint64_t>(last);
  const auto differ = static_cast<int>(std::bit_width(below ^ end)) - 1;
  return std::ldexp(static_cast<double>(end >> differ << differ), unit);
}

}  // namespace mesher::detail
