// The predicates of mesher/predicates.hpp for the corners of a simplex, in the plane and in space.
#pragma once

#include <array>

#include "mesher/predicates.hpp"

namespace mesher::detail {

/// insphere_perturbed and incircle_perturbed.
inline int in_ball(const std::array<const Point<2>*, 3>& q, const Point<2>& p) {
  return predicates::incircle_perturbed(*q[0], *q[1], *q[2], p);
}
inline int in_ball(const std::array<const Point<3>*, 4>& q, const Point<3>& p) {
  return predicates::insphere_perturbed(*q[0], *q[1], *q[2], *q[3], p);
}
inline int orientation(const std::array<const Point<2>*, 3>& q) {
  return predicates::orient2d(*q[0], *q[1], *q[2]);
}
inline int orientation(const std::array<const Point<3>*, 4>& q) {
  return predicates::orient3d(*q[0], *q[1], *q[2], *q[3]);
}

}  // namespace mesher::detail
