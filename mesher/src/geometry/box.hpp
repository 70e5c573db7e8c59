// Boxes: around places, and what lies in them.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <type_traits>

#include "mesher/mesh.hpp"

namespace mesher::detail {

/// What is within r of p along each axis.
[[nodiscard]] inline Box<2> around(const Point<2>& p, double r) {
  return {{p[0] - r, p[1] - r}, {p[0] + r, p[1] + r}};
}
[[nodiscard]] inline Box<3> around(const Point<3>& p, double r) {
  return {{p[0] - r, p[1] - r, p[2] - r}, {p[0] + r, p[1] + r, p[2] + r}};
}
/// The sides belong to a box.
[[nodiscard]] inline bool contains(const Box<2>& box, const Point<2>& p) {
  return p[0] >= box.lo[0] && p[0] <= box.hi[0] && p[1] >= box.lo[1] && p[1] <= box.hi[1];
}
[[nodiscard]] inline bool contains(const Box<3>& box, const Point<3>& p) {
  return p[0] >= box.lo[0] && p[0] <= box.hi[0] && p[1] >= box.lo[1] && p[1] <= box.hi[1] &&
         p[2] >= box.lo[2] && p[2] <= box.hi[2];
}
/// What lies in both; may be empty.
template <int D>
[[nodiscard]] Box<D> common(const Box<D>& a, const Box<D>& b) {
  Box<D> both;
  for (std::size_t i = 0; i < D; ++i) {
    both.lo[i] = std::max(a.lo[i], b.lo[i]);
    both.hi[i] = std::min(a.hi[i], b.hi[i]);
  }
  return both;
}
template <int D>
[[nodiscard]] bool is_empty(const Box<D>& box) {
  for (std::size_t i = 0; i < D; ++i) {
    if (box.lo[i] > box.hi[i]) return true;
  }
  return false;
}
/// Whether all of `inner` is in `box`.
template <int D>
[[nodiscard]] bool contains(const Box<D>& box, const Box<D>& inner) {
  return contains(box, inner.lo) && contains(box, inner.hi);
}
template <int D>
[[nodiscard]] Point<D> middle_of(const Box<D>& box) {
  Point<D> middle;
  for (std::size_t i = 0; i < D; ++i) middle[i] = box.lo[i] + (box.hi[i] - box.lo[i]) / 2;
  return middle;
}
/// All of the box is within this of its middle.
[[nodiscard]] inline double reach_of(const Box<2>& box) {
  return std::hypot(box.hi[0] - box.lo[0], box.hi[1] - box.lo[1]) / 2 * (1 + 0x1p-40);
}
[[nodiscard]] inline double reach_of(const Box<3>& box) {
  return std::hypot(box.hi[0] - box.lo[0], box.hi[1] - box.lo[1], box.hi[2] - box.lo[2]) / 2 *
         (1 + 0x1p-40);
}
template <int D>
[[nodiscard]] double longest_side(const Box<D>& box) {
  double longest = 0;
  for (int i = 0; i < D; ++i) longest = std::max(longest, box.hi[i] - box.lo[i]);
  return longest;
}
/// Widens a box to hold p.
template <int D>
void grow(Box<D>& box, const std::type_identity_t<Point<D>>& p) {
  for (std::size_t i = 0; i < p.size(); ++i) {
    box.lo[i] = std::min(box.lo[i], p[i]);
    box.hi[i] = std::max(box.hi[i], p[i]);
  }
}
/// The least box that holds all points; Box() if there are none.
template <int D>
[[nodiscard]] Box<D> bounding_box(std::span<const Point<D>> points) {
  if (points.empty()) return {};
  Box<D> box{points.front(), points.front()};
  for (const Point<D>& p : points) grow(box, p);
  return box;
}

}  // namespace mesher::detail
