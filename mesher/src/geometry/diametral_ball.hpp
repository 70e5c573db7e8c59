// Whether a point is in the closed ball that has a segment as its diameter.
#pragma once

#include "mesher/predicates.hpp"

namespace mesher::detail {

/// The sign of (a - x) . (b - x), exactly.
[[nodiscard]] int angle_sign_exact(const Point<2>& a, const Point<2>& x, const Point<2>& b);

/// +1 if axb is an acute angle, 0 a right one, -1 an obtuse one. Exact: the filter is that of
/// orient2d, whose monomials these are but for their pairing.
[[nodiscard]] inline int angle_sign(const Point<2>& a, const Point<2>& x, const Point<2>& b) {
  const double along_x = (a[0] - x[0]) * (b[0] - x[0]);
  const double along_y = (a[1] - x[1]) * (b[1] - x[1]);
  const double dot = along_x + along_y;
  const double size = std::abs(along_x) + std::abs(along_y);
  if (std::abs(dot) > predicates::detail::kOrientBound * size) {
    return predicates::detail::sign(dot);
  }
  return angle_sign_exact(a, x, b);
}

/// Whether x is in the closed ball on ab: its centre in their middle, a and b on its circle
/// [Thales].
[[nodiscard]] inline bool in_diametral_ball(const Point<2>& x, const Point<2>& a,
                                            const Point<2>& b) {
  return angle_sign(a, x, b) <= 0;
}

}  // namespace mesher::detail
