// Where the points are that are no vertices yet: a list for each vertex, of the points in its
// Voronoi cell [3.1, rules D11].
//
// A new vertex takes from the lists of its neighbours what is nearer to it: two distances a point,
// and rounding does no harm, since a point may be on the list of the second nearest. A point keeps
// the square of its distance to its vertex, a vertex the greatest of these: most points need not be
// looked at, and most lists.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "delaunay/simplex_store.hpp"
#include "geometry/plane.hpp"
#include "geometry/space.hpp"
#include "mesher/mesh.hpp"
#include "svr/location.hpp"

namespace mesher::detail {

/// Points are called by their place in an order of their own. Vertices are numbered from 1.
template <int D>
class VoronoiLists : public WaitingPoints<D> {
  using Base = WaitingPoints<D>;
  using Base::places_, Base::left_, Base::looked_at_;

 public:
  /// `side`: of a box around everything.
  VoronoiLists(std::span<const Point<D>> points, double side)
      : Base(points), listed_(points.size()) {
    // A power of two that brings squared distances into the range of floats.
    int exponent;
    std::frexp(side, &exponent);
    unit2_ = std::ldexp(1.0, -2 * exponent);
  }

  [[nodiscard]] bool is_crowded(std::uint32_t v) const noexcept { return lists_[v].first != kNone; }
  /// Requires (and below): is_crowded(v).
  [[nodiscard]] std::uint32_t any(std::uint32_t v) const noexcept { return lists_[v].first; }
  [[nodiscard]] std::uint32_t farthest(std::uint32_t v) const noexcept;
  /// Takes a point off v's list. Requires: it is on it.
  void drop(std::uint32_t v, std::uint32_t point) noexcept {
    std::uint32_t* link = &lists_[v].first;
    while (*link != point) link = &listed_[*link].next;
    *link = listed_[point].next;
    --left_;
  }

  /// There are no points on v's list, which is the next vertex.
  void add_vertex() { lists_.push_back({}); }
  /// Takes the last vertex back, which has no points.
  void drop_vertex() noexcept { lists_.pop_back(); }
  /// Puts all points but `except`, which is gone, on v's list, whose place is p.
  void start(std::uint32_t v, const Point<D>& p, std::uint32_t except) noexcept;
  /// Gives the new vertex v at p what is nearer to it of the list of its neighbour w at q. A point
  /// at p is gone. Returns: that, or kNone.
  std::uint32_t relocate(std::uint32_t v, const Point<D>& p, std::uint32_t w,
                         const Point<D>& q) noexcept;

  /// A point on the list of w, at q, in the ball around c. `r`: its radius.
  [[nodiscard]] std::uint32_t find(std::uint32_t w, const Point<D>& q, const Point<D>& c,
                                   double r) const noexcept;

 private:
  // Most are only passed: they are apart from places, so that more of them are in the cache.
  struct Listed {
    float distance2 = 0;  // to the vertex, in units of unit2_, rounded up
    std::uint32_t next = kNone;
  };
  struct List {
    std::uint32_t first = kNone;
    float reach2 = 0;  // at least the greatest distance2 on the list
  };
  static constexpr double kUp = 1 + 0x1p-22, kDown = 1 - 0x1p-22;

  [[nodiscard]] double scaled2(const Point<D>& a, const Point<D>& b) const noexcept {
    return squared_distance(a, b) * unit2_;
  }
  void put(std::uint32_t v, std::uint32_t point, double d2) noexcept {
    listed_[point].distance2 = static_cast<float>(d2 * kUp);
    listed_[point].next = lists_[v].first;
    lists_[v].first = point;
    lists_[v].reach2 = std::max(lists_[v].reach2, listed_[point].distance2);
  }

  std::vector<Listed> listed_;       // by point
  std::vector<List> lists_{List{}};  // by vertex
  double unit2_;
};

template <int D>
std::uint32_t VoronoiLists<D>::farthest(std::uint32_t v) const noexcept {
  std::uint32_t best = lists_[v].first;
  for (std::uint32_t k = best; k != kNone; k = listed_[k].next) {
    if (listed_[k].distance2 > listed_[best].distance2) best = k;
  }
  return best;
}

template <int D>
void VoronoiLists<D>::start(std::uint32_t v, const Point<D>& p, std::uint32_t except) noexcept {
  for (auto k = static_cast<std::uint32_t>(places_.size()); k-- > 0;) {
    if (k != except) put(v, k, scaled2(places_[k], p));
  }
  --left_;
}

template <int D>
std::uint32_t VoronoiLists<D>::relocate(std::uint32_t v, const Point<D>& p, std::uint32_t w,
                                        const Point<D>& q) noexcept {
  List& list = lists_[w];
  if (list.first == kNone) return kNone;
  // A point within half of the way to v stays.
  const double stays2 = scaled2(p, q) / 4 * kDown;
  if (static_cast<double>(list.reach2) < stays2) return kNone;
  std::uint32_t was_there = kNone;
  float reach2 = 0;
  for (std::uint32_t* link = &list.first; *link != kNone;) {
    const std::uint32_t point = *link;
    Listed& listed = listed_[point];
    if (static_cast<double>(listed.distance2) >= stays2) {
      ++looked_at_.to_move;
      const double d2 = scaled2(places_[point], p);
      if (d2 < static_cast<double>(listed.distance2)) {
        *link = listed.next;
        if (places_[point] == p) {
          was_there = point;
          --left_;
        } else {
          put(v, point, d2);
        }
        continue;
      }
    }
    reach2 = std::max(reach2, listed.distance2);
    link = &listed.next;
  }
  list.reach2 = reach2;
  return was_there;
}

template <int D>
std::uint32_t VoronoiLists<D>::find(std::uint32_t w, const Point<D>& q, const Point<D>& c,
                                    double r) const noexcept {
  std::uint32_t point = lists_[w].first;
  if (point == kNone) return kNone;
  // The ball is farther from w than any point.
  const double gap = std::sqrt(squared_distance(c, q)) - r;
  if (gap > 0 && gap * gap * unit2_ > static_cast<double>(lists_[w].reach2)) return kNone;
  for (const double r2 = r * r; point != kNone; point = listed_[point].next) {
    ++looked_at_.to_find;
    if (squared_distance(places_[point], c) <= r2) return point;
  }
  return kNone;
}

}  // namespace mesher::detail
