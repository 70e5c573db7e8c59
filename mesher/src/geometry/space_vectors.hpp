// Vectors in space: sums, products, lengths.
#pragma once

#include "mesher/mesh.hpp"

namespace mesher::detail {

[[nodiscard]] inline Point<3> plus(const Point<3>& a, const Point<3>& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
[[nodiscard]] inline Point<3> minus(const Point<3>& a, const Point<3>& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
[[nodiscard]] inline Point<3> scaled(double s, const Point<3>& a) {
  return {s * a[0], s * a[1], s * a[2]};
}
[[nodiscard]] inline double dot(const Point<3>& a, const Point<3>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
[[nodiscard]] inline Point<3> cross(const Point<3>& a, const Point<3>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
[[nodiscard]] inline double squared(const Point<3>& a) { return dot(a, a); }
[[nodiscard]] inline double squared_distance(const Point<3>& a, const Point<3>& b) {
  return squared(minus(a, b));
}

}  // namespace mesher::detail
