// Where the points are that are no vertices yet: a list for each vertex, of the points in its
// Voronoi cell [3.1, "By Voronoi diagram"; rules D11].
//
// A new vertex takes from the lists of its neighbours what is nearer to it: two distances a point,
// and rounding does no harm, since a point may be on the list of the second nearest.
//   All of a list is looked at each time. To keep the points' distances, or their greatest on each
// list, saves more than half of these looks and no time: they do not wait for each other, links are
// apart from places and mostly in the cache, and what is kept must be written.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/plane_vectors.hpp"
#include "geometry/space_vectors.hpp"
#include "refinement/location.hpp"

namespace mesher::detail {

/// Points are called by their place in an order of their own. Vertices are numbered from 1.
template <int D>
class VoronoiLists : public WaitingPoints<D> {
  using Base = WaitingPoints<D>;
  using Base::places_, Base::left_, Base::looked_at_;

 public:
  explicit VoronoiLists(std::span<const Point<D>> points)
      : Base(points), next_(points.size(), kNone) {}

  [[nodiscard]] bool is_crowded(std::uint32_t v) const noexcept { return first_[v] != kNone; }
  /// Requires (and below): is_crowded(v).
  [[nodiscard]] std::uint32_t any(std::uint32_t v) const noexcept { return first_[v]; }
  /// From p, v's place.
  [[nodiscard]] std::uint32_t farthest(std::uint32_t v, const Point<D>& p) const noexcept {
    std::uint32_t best = first_[v];
    double most = 0;
    for (std::uint32_t k = best; k != kNone; k = next_[k]) {
      ++looked_at_.to_find;
      const double d2 = squared_distance(places_[k], p);
      if (d2 > most) best = k, most = d2;
    }
    return best;
  }
  /// Takes a point off v's list. Requires: it is on it.
  void drop(std::uint32_t v, std::uint32_t point) noexcept {
    std::uint32_t* link = &first_[v];
    while (*link != point) link = &next_[*link];
    *link = next_[point];
    --left_;
  }

  /// There are no points on v's list, which is the next vertex.
  void add_vertex() { first_.push_back(kNone); }
  /// Takes the last vertex back, which has no points.
  void drop_vertex() noexcept { first_.pop_back(); }
  /// Puts all points but `except`, which is gone, on v's list.
  void start(std::uint32_t v, const Point<D>& /*p*/, std::uint32_t except) noexcept {
    for (auto k = static_cast<std::uint32_t>(places_.size()); k-- > 0;) {
      if (k != except) put(v, k);
    }
    --left_;
  }
  /// Gives the new vertex v at p what is nearer to it of the list of its neighbour w at q. A point
  /// at p is gone. Returns: that, or kNone.
  std::uint32_t relocate(std::uint32_t v, const Point<D>& p, std::uint32_t w,
                         const Point<D>& q) noexcept {
    std::uint32_t was_there = kNone;
    for (std::uint32_t* link = &first_[w]; *link != kNone;) {
      const std::uint32_t point = *link;
      ++looked_at_.to_move;
      const Point<D>& x = places_[point];
      if (!(squared_distance(x, p) < squared_distance(x, q))) {
        link = &next_[point];
        continue;
      }
      *link = next_[point];
      if (x == p) {
        was_there = point;
        --left_;
      } else {
        put(v, point);
      }
    }
    return was_there;
  }
  /// A point on the list of w in the ball around c. `r`: its radius.
  [[nodiscard]] std::uint32_t find(std::uint32_t w, const Point<D>& /*q*/, const Point<D>& c,
                                   double r) const noexcept {
    for (std::uint32_t point = first_[w]; point != kNone; point = next_[point]) {
      ++looked_at_.to_find;
      if (squared_distance(places_[point], c) <= r * r) return point;
    }
    return kNone;
  }

 private:
  void put(std::uint32_t v, std::uint32_t point) noexcept {
    next_[point] = first_[v];
    first_[v] = point;
  }

  std::vector<std::uint32_t> next_;          // by point
  std::vector<std::uint32_t> first_{kNone};  // by vertex
};

}  // namespace mesher::detail
