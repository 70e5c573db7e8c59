// Vectors in the plane: sums, products, lengths.
#pragma once

#include "mesher/mesh.hpp"

namespace mesher::detail {

[[nodiscard]] inline Point<2> plus(const Point<2>& a, const Point<2>& b) {
  return {a[0] + b[0], a[1] + b[1]};
}
[[nodiscard]] inline Point<2> minus(const Point<2>& a, const Point<2>& b) {
  return {a[0] - b[0], a[1] - b[1]};
}
[[nodiscard]] inline double dot(const Point<2>& a, const Point<2>& b) {
  return a[0] * b[0] + a[1] * b[1];
}
[[nodiscard]] inline double squared(const Point<2>& a) { return dot(a, a); }
[[nodiscard]] inline double squared_distance(const Point<2>& a, const Point<2>& b) {
  return squared(minus(a, b));
}

}  // namespace mesher::detail
