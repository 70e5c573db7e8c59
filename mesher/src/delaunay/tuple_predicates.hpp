// The predicates of mesher/predicates.hpp for the corners of a simplex, in the plane and in space.
#pragma once

#include <array>

#include "geometry/ties.hpp"
#include "mesher/predicates.hpp"

namespace mesher::detail {

/// insphere_perturbed and incircle_perturbed.
inline int in_ball(const std::array<const Point<2>*, 3>& q, const Point<2>& p) {
  return predicates::incircle_perturbed(*q[0], *q[1], *q[2], p);
}
inline int in_ball(const std::array<const Point<3>*, 4>& q, const Point<3>& p) {
  return predicates::insphere_perturbed(*q[0], *q[1], *q[2], *q[3], p);
}
/// The same of points on one ball, so near to each other on a grid that the determinant was not
/// rounded (ball_filter.hpp): then those of four points are not, either, as they are smaller.
inline int break_tie(const std::array<const Point<2>*, 3>& q, const Point<2>& p) {
  return predicates::detail::cocircular_tie(*q[0], *q[1], *q[2], p);
}
inline int break_tie(const std::array<const Point<3>*, 4>& q, const Point<3>& p) {
  const auto orient = [](const Point<3>& a, const Point<3>& b, const Point<3>& c,
                         const Point<3>& d) {
    const double ax = a[0] - d[0], ay = a[1] - d[1], az = a[2] - d[2];
    const double bx = b[0] - d[0], by = b[1] - d[1], bz = b[2] - d[2];
    const double cx = c[0] - d[0], cy = c[1] - d[1], cz = c[2] - d[2];
    return -predicates::detail::sign((az * (bx * cy - cx * by) + bz * (cx * ay - ax * cy)) +
                                     cz * (ax * by - bx * ay));
  };
  return predicates::detail::first_cofactor({q[0], q[1], q[2], q[3], &p}, orient);
}
inline int orientation(const std::array<const Point<2>*, 3>& q) {
  return predicates::orient2d(*q[0], *q[1], *q[2]);
}
inline int orientation(const std::array<const Point<3>*, 4>& q) {
  return predicates::orient3d(*q[0], *q[1], *q[2], *q[3]);
}

}  // namespace mesher::detail
