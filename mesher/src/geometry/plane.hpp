// Sums and squared lengths of points of the plane.
#pragma once

#include "mesher/mesh.hpp"

namespace mesher::detail {

[[nodiscard]] inline Point<2> plus(const Point<2>& a, const Point<2>& b) {
  return {a[0] + b[0], a[1] + b[1]};
}
[[nodiscard]] inline double squared(const Point<2>& a) { return a[0] * a[0] + a[1] * a[1]; }
[[nodiscard]] inline double squared_distance(const Point<2>& a, const Point<2>& b) {
  return squared(Point<2>{a[0] - b[0], a[1] - b[1]});
}

}  // namespace mesher::detail
