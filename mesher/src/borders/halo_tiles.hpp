// Tiles for runs that have a halo: those of a k-d tree of the points, within the points' bounding
// box, and one for what is outside of it, the rim. Far outside the mesh looks along the whole box;
// to a tile inside that does not matter.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "borders/territory.hpp"
#include "geometry/place_tree.hpp"

namespace mesher::detail {

template <int D>
class HaloTiles {
 public:
  /// `places`: of points, or of some of them; `tiles`: inside, as many or fewer. `box`: the points'
  /// bounding box. Cost: O(n log tiles). Requires: there are points.
  HaloTiles(const Box<D>& box, std::vector<Point<D>> places, std::size_t tiles)
      : box_(box), inner_(std::move(places), tiles) {}

  [[nodiscard]] std::size_t size() const noexcept { return inner_.size() + 1; }
  [[nodiscard]] std::size_t rim() const noexcept { return inner_.size(); }
  [[nodiscard]] std::size_t owner(const Point<D>& p) const noexcept {
    return is_inside(p) ? inner_.owner(p) : rim();
  }
  /// Of p from the tile; 0 in it, and perhaps beside it.
  [[nodiscard]] double distance(std::size_t tile, const Point<D>& p) const noexcept {
    if (tile == rim()) return std::max(depth(p), 0.0);
    const Box<D> box = box_of(tile);
    double distance2 = 0;
    for (std::size_t i = 0; i < D; ++i) {
      const double d = std::max({box.lo[i] - p[i], p[i] - box.hi[i], 0.0});
      distance2 += d * d;
    }
    return std::sqrt(distance2);
  }
  /// From p to where the tile ends, at least, but for rounding; below 0 outside. Two places differ
  /// in this by no more than they are apart.
  [[nodiscard]] double distance_to_end(std::size_t tile, const Point<D>& p) const noexcept {
    const Box<D> box = tile == rim() ? box_ : box_of(tile);
    double inside = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < D; ++i) {
      inside = std::min({inside, p[i] - box.lo[i], box.hi[i] - p[i]});
    }
    return tile == rim() ? -inside : inside;
  }
  /// Of two tiles from each other.
  [[nodiscard]] double distance_between(std::size_t a, std::size_t b) const noexcept;
  /// Whether the ball is surely in the tile.
  [[nodiscard]] bool holds(std::size_t tile, const RelativeBall<D>& ball) const noexcept {
    const Box<D> area = ball.box();
    const Box<D> box = tile == rim() ? box_ : box_of(tile);
    bool is_apart = false, is_within = true;
    for (std::size_t i = 0; i < D; ++i) {
      is_apart = is_apart || area.hi[i] < box.lo[i] || area.lo[i] > box.hi[i];
      is_within = is_within && area.lo[i] >= box.lo[i] && area.hi[i] < box.hi[i];
    }
    return tile == rim() ? is_apart || !meets(ball, box_) : is_within;
  }
  /// Calls visit(tile) for those that the ball meets, perhaps for others.
  template <class Visit>
  void for_each_met(const RelativeBall<D>& ball, Visit&& visit) const {
    const Box<D> area = ball.box();
    if (meets(ball, box_)) inner_.for_each_met(area, visit);
    if (!is_inside(area.lo) || !is_inside(area.hi)) visit(rim());
  }

 private:
  [[nodiscard]] bool is_inside(const Point<D>& p) const noexcept { return depth(p) >= 0; }
  // How far inside the points' box; negative outside.
  [[nodiscard]] double depth(const Point<D>& p) const noexcept {
    double depth = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < D; ++i) {
      depth = std::min({depth, p[i] - box_.lo[i], box_.hi[i] - p[i]});
    }
    return depth;
  }
  [[nodiscard]] Box<D> box_of(std::size_t tile) const noexcept {
    Box<D> box = inner_.box(tile);
    for (std::size_t i = 0; i < D; ++i) {
      box.lo[i] = std::max(box.lo[i], box_.lo[i]);
      box.hi[i] = std::min(box.hi[i], box_.hi[i]);
    }
    return box;
  }
  // Whether the ball may meet the box.
  [[nodiscard]] static bool meets(const RelativeBall<D>& ball, const Box<D>& box) noexcept {
    double distance2 = 0;
    for (std::size_t i = 0; i < D; ++i) {
      const double x = ball.at[i] + ball.center[i];
      const double slack = 0x1p-46 * (std::abs(ball.at[i]) + std::abs(ball.center[i]));
      const double d = std::max({box.lo[i] - x, x - box.hi[i], 0.0}) - slack;
      if (d > 0) distance2 += d * d;
    }
    return distance2 <= ball.radius * ball.radius * (1 + 0x1p-40);
  }

  Box<D> box_;
  Territories<D> inner_;
};

template <int D>
double HaloTiles<D>::distance_between(std::size_t a, std::size_t b) const noexcept {
  if (a == b) return 0;
  if (a == rim()) std::swap(a, b);
  const Box<D> box = box_of(a);
  if (b == rim()) return std::max(std::min(depth(box.lo), depth(box.hi)), 0.0);
  const Box<D> other = box_of(b);
  double distance2 = 0;
  for (std::size_t i = 0; i < D; ++i) {
    const double d = std::max({box.lo[i] - other.hi[i], other.lo[i] - box.hi[i], 0.0});
    distance2 += d * d;
  }
  return std::sqrt(distance2);
}

}  // namespace mesher::detail
