// Distances of points and segments in space.
//
// Distances are squared and rounded, each a function of the coordinates given.
#pragma once

#include <algorithm>

#include "geometry/space_vectors.hpp"

namespace mesher::detail {

/// How far features are apart that cannot be told to be: what rounding of places this far from 0
/// may do, and the finest cell of a mesh that holds them.
[[nodiscard]] inline double resolution(const Point<3>& place, double reach) {
  double most = reach;
  for (const double x : place) most = std::max(most, std::abs(x) + reach);
  return most * 0x1p-48;
}

/// Which part of ab lies before the place of the closed segment nearest to p; 0 if a = b.
[[nodiscard]] inline double nearest_fraction(const Point<3>& p, const Point<3>& a,
                                             const Point<3>& b) {
  const Point<3> along = minus(b, a);
  const double length2 = squared(along);
  return length2 > 0 ? std::clamp(dot(minus(p, a), along) / length2, 0.0, 1.0) : 0;
}

/// Squared distance of p from the closed segment ab.
[[nodiscard]] inline double distance2(const Point<3>& p, const Point<3>& a, const Point<3>& b) {
  const Point<3> from_a = minus(p, a);
  return squared(minus(from_a, scaled(nearest_fraction(p, a, b), minus(b, a))));
}

/// Squared distance of the closed segments ab and cd.
[[nodiscard]] double distance2(const Point<3>& a, const Point<3>& b, const Point<3>& c,
                               const Point<3>& d);

/// The place of the closed segment ab that is nearest to the closed segment cd; one of them.
[[nodiscard]] Point<3> nearest_place(const Point<3>& a, const Point<3>& b, const Point<3>& c,
                                     const Point<3>& d);

}  // namespace mesher::detail
