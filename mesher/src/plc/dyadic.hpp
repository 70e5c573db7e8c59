// Dyadic places on an edge: which one to take of a part of it.
//
// A coarse place is likely to be asked for again, by others and after an edit: so it is a function
// of little.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>

namespace mesher::detail {

/// A part of an edge, in fractions of it.
struct Span {
  double lo = 0, hi = 1;
  [[nodiscard]] Span middle_half() const noexcept {
    const double quarter = (hi - lo) / 4;
    return {lo + quarter, hi - quarter};
  }
};

/// The multiple of the largest power of two in the span, and inside of (0, 1); nothing if there is
/// none of at least 2^-50, the finest cells' size.
[[nodiscard]] inline std::optional<double> coarsest_dyadic(const Span& span) noexcept {
  constexpr double kUnits = 0x1p50;
  const double lo = std::ceil(std::fmax(span.lo, 0x1p-50) * kUnits);
  const double hi = std::floor(std::fmin(span.hi, 1 - 0x1p-50) * kUnits);
  if (!(lo <= hi)) return std::nullopt;
  const auto below = static_cast<std::uint64_t>(lo) - 1, last = static_cast<std::uint64_t>(hi);
  const int differ = std::bit_width(below ^ last) - 1;
  return static_cast<double>(last >> differ << differ) / kUnits;
}

}  // namespace mesher::detail
