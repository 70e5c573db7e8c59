// Segments and points in the plane: whether they meet (exactly), and how far apart they are.
//
// Distances are squared and rounded, each a function of the coordinates given. Use segments_meet or
// on_segment where the result must be exact.
#pragma once

#include <algorithm>
#include <cmath>

#include "mesher/predicates.hpp"

namespace mesher::detail {

/// Squared distance of p from the closed segment ab.
[[nodiscard]] inline double distance2(const Point<2>& p, const Point<2>& a, const Point<2>& b) {
  const double vx = b[0] - a[0], vy = b[1] - a[1];
  const double wx = p[0] - a[0], wy = p[1] - a[1];
  const double length2 = vx * vx + vy * vy;
  const double t = length2 > 0 ? std::clamp((wx * vx + wy * vy) / length2, 0.0, 1.0) : 0;
  const double dx = wx - t * vx, dy = wy - t * vy;
  return dx * dx + dy * dy;
}

/// Whether p, which is on the line ab, is on the closed segment.
[[nodiscard]] inline bool within(const Point<2>& p, const Point<2>& a, const Point<2>& b) {
  for (int i = 0; i < 2; ++i) {
    if (p[i] < std::min(a[i], b[i]) || p[i] > std::max(a[i], b[i])) return false;
  }
  return true;
}

/// Whether p is on the closed segment ab. Exact.
[[nodiscard]] inline bool on_segment(const Point<2>& p, const Point<2>& a, const Point<2>& b) {
  return within(p, a, b) && predicates::orient2d(a, b, p) == 0;
}

/// Whether the closed segments ab and cd have a point in common. Exact.
[[nodiscard]] inline bool segments_meet(const Point<2>& a, const Point<2>& b, const Point<2>& c,
                                        const Point<2>& d) {
  for (int i = 0; i < 2; ++i) {
    if (std::max(a[i], b[i]) < std::min(c[i], d[i])) return false;
    if (std::max(c[i], d[i]) < std::min(a[i], b[i])) return false;
  }
  return predicates::orient2d(a, b, c) * predicates::orient2d(a, b, d) <= 0 &&
         predicates::orient2d(c, d, a) * predicates::orient2d(c, d, b) <= 0;
}

/// Squared distance of the closed segments ab and cd.
[[nodiscard]] inline double distance2(const Point<2>& a, const Point<2>& b, const Point<2>& c,
                                      const Point<2>& d) {
  if (segments_meet(a, b, c, d)) return 0;
  return std::min(std::min(distance2(a, c, d), distance2(b, c, d)),
                  std::min(distance2(c, a, b), distance2(d, a, b)));
}

/// Whether the angle between the directions u and w is less than one whose tangent is given (of
/// less than 90 degrees).
[[nodiscard]] inline bool is_narrower(const Point<2>& u, const Point<2>& w, double tangent) {
  const double across = u[0] * w[1] - u[1] * w[0];
  const double along = u[0] * w[0] + u[1] * w[1];
  return std::abs(across) < tangent * along;
}

}  // namespace mesher::detail
