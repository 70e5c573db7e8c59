// A simplex as a set of positions: exact tests of what it contains.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "geometry/box.hpp"
#include "geometry/centroid.hpp"
#include "mesher/predicates.hpp"

namespace mesher::detail {

template <int D>
class Tile;

template <>
class Tile<2> {
 public:
  /// Counterclockwise.
  explicit Tile(const CornersOf<2>& at) : at_(at) {}

  [[nodiscard]] const CornersOf<2>& corners() const noexcept { return at_; }
  [[nodiscard]] Box<2> extent() const noexcept { return bounding_box<2>(at_); }
  [[nodiscard]] bool contains(const Point<2>& p) const {
    for (std::size_t i = 0; i < 3; ++i) {
      if (predicates::orient2d(at_[i], at_[(i + 1) % 3], p) < 0) return false;
    }
    return true;
  }
  /// Whether the closed triangle and the closed box have a place in common.
  [[nodiscard]] bool touches(const Box<2>& box) const {
    if (is_empty(common(extent(), box))) return false;
    for (std::size_t i = 0; i < 3; ++i) {
      const Point<2>&a = at_[i], &b = at_[(i + 1) % 3];
      if (predicates::orient2d(a, b, farthest_left(a, b, box)) < 0) return false;
    }
    return true;
  }

 protected:
  // The corner that is farthest to the left of ab.
  static Point<2> farthest_left(const Point<2>& a, const Point<2>& b, const Box<2>& box) {
    return {a[1] < b[1] ? box.lo[0] : box.hi[0], a[0] < b[0] ? box.hi[1] : box.lo[1]};
  }
  CornersOf<2> at_;
};

template <>
class Tile<3> {
 public:
  explicit Tile(const CornersOf<3>& at)
      : sign_(predicates::orient3d(at[0], at[1], at[2], at[3])), at_(at) {}

  [[nodiscard]] const CornersOf<3>& corners() const noexcept { return at_; }
  [[nodiscard]] Box<3> extent() const noexcept { return bounding_box<3>(at_); }
  [[nodiscard]] bool contains(const Point<3>& p) const {
    for (std::size_t i = 0; i < 4; ++i) {
      if (inside_of(i, p) < 0) return false;
    }
    return true;
  }
  /// Whether the closed tetrahedron and the closed box have a place in common: two convex bodies
  /// have none if a plane along a face of one, or along an edge of each, has them on its two sides.
  [[nodiscard]] bool touches(const Box<3>& box) const {
    if (is_empty(common(extent(), box))) return false;
    for (std::size_t i = 0; i < 4; ++i) {
      if (is_outside_of(i, box)) return false;
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (is_beside(axis, box)) return false;
    }
    return true;
  }

 private:
  // Positive inside of the plane of the face across from corner i.
  [[nodiscard]] int inside_of(std::size_t i, const Point<3>& p) const {
    CornersOf<3> all = at_;
    all[i] = p;
    return sign_ * predicates::orient3d(all[0], all[1], all[2], all[3]);
  }
  [[nodiscard]] bool is_outside_of(std::size_t i, const Box<3>& box) const {
    for (unsigned c = 0; c < 8; ++c) {
      const Point<3> corner{(c & 1) != 0 ? box.hi[0] : box.lo[0],
                            (c & 2) != 0 ? box.hi[1] : box.lo[1],
                            (c & 4) != 0 ? box.hi[2] : box.lo[2]};
      if (inside_of(i, corner) >= 0) return false;
    }
    return true;
  }
  // Seen along an axis: whether all of the box is beyond a side of what the corners span.
  [[nodiscard]] bool is_beside(std::size_t axis, const Box<3>& box) const {
    const std::size_t x = (axis + 1) % 3, y = (axis + 2) % 3;
    const auto seen = [&](const Point<3>& p) { return Point<2>{p[x], p[y]}; };
    const Point<2> lo = seen(box.lo), hi = seen(box.hi);
    const std::array<Point<2>, 4> rectangle{lo, {hi[0], lo[1]}, hi, {lo[0], hi[1]}};
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = 0; j < 4; ++j) {
        if (i == j) continue;
        const Point<2> a = seen(at_[i]), b = seen(at_[j]);
        const auto left = [&](const Point<2>& p) { return predicates::orient2d(a, b, p) >= 0; };
        if (std::all_of(at_.begin(), at_.end(), [&](const auto& p) { return left(seen(p)); }) &&
            std::none_of(rectangle.begin(), rectangle.end(), left)) {
          return true;
        }
      }
    }
    return false;
  }

  int sign_;

 protected:
  CornersOf<3> at_;
};

}  // namespace mesher::detail
