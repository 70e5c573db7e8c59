// Where the points are that are no vertices yet: what the four structures of [3.1] have in common.
//
// A structure has, of points by their places in an order of their own, vertices from 1 on, and a
// kernel with balls:
//
//   left(), place(point)            how many points are no vertices; where one is
//   add_vertex(), drop_vertex()     the next vertex has no points; the last one, which has none,
//                                   goes
//   start(kernel, v, except, visit) v is the last vertex, and a point; the others wait from now
//                                   on; visit as in give()
//   is_crowded(v)                   whether points wait at v
//   any(kernel, v), farthest(...)   one of these. Requires: is_crowded(v)
//   find_early(kernel, s, c, r, takes)  a point in the ball around c that takes(point): a look at
//                                   s, before anything is dug
//   find_late(...)                  the same once a hole is dug at c: the rest of the ball
//   take(kernel, v)                 v is dug: takes up the points of what goes. Returns: a point at
//                                   v's place, which is left no more, or kNone
//   give(kernel, v, visit)          it is filled: puts them down; visit(w): w is crowded now
//   drop(kernel, found)             a point is a vertex
//   looked_at()                     how many points were looked at, see LookedAt
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "delaunay/kernel.hpp"

namespace mesher::detail {

/// A point, and where it waits: a vertex, or a simplex; or none.
struct Found {
  std::uint32_t point = kNone, owner = kNone;
};

/// How often a distance, or a side, of a point was computed.
struct LookedAt {
  std::uint64_t to_find = 0, to_move = 0;
};

template <int D>
using RefinedKernel = DelaunayKernel<D, BallLayout<D>>;

/// What all structures have of the points.
template <int D>
class WaitingPoints {
 public:
  [[nodiscard]] std::size_t left() const noexcept { return left_; }
  [[nodiscard]] const Point<D>& place(std::uint32_t point) const noexcept { return places_[point]; }
  [[nodiscard]] const LookedAt& looked_at() const noexcept { return looked_at_; }

 protected:
  explicit WaitingPoints(std::span<const Point<D>> points)
      : places_(points.begin(), points.end()), left_(points.size()) {}
  ~WaitingPoints() = default;

  std::vector<Point<D>> places_;
  std::size_t left_;
  mutable LookedAt looked_at_;
};

}  // namespace mesher::detail
