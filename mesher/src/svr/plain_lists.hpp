// The points in each Voronoi cell, and nothing else [3.1, "By Voronoi diagram"]: all of a list is
// looked at each time. For comparisons; VoronoiLists has the same verbs.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/plane.hpp"
#include "geometry/space.hpp"
#include "svr/location.hpp"

namespace mesher::detail {

template <int D>
class PlainLists : public WaitingPoints<D> {
  using Base = WaitingPoints<D>;
  using Base::places_, Base::left_, Base::looked_at_;

 public:
  PlainLists(std::span<const Point<D>> points, double /*side*/)
      : Base(points), next_(points.size(), kNone) {}

  [[nodiscard]] bool is_crowded(std::uint32_t v) const noexcept { return first_[v] != kNone; }
  [[nodiscard]] std::uint32_t any(std::uint32_t v) const noexcept { return first_[v]; }
  [[nodiscard]] std::uint32_t farthest(std::uint32_t v) const noexcept {
    std::uint32_t best = first_[v];
    double most = 0;
    for (std::uint32_t k = best; k != kNone; k = next_[k]) {
      ++looked_at_.to_find;
      const double d2 = squared_distance(places_[k], vertices_[v]);
      if (d2 > most) best = k, most = d2;
    }
    return best;
  }
  void drop(std::uint32_t v, std::uint32_t point) noexcept {
    std::uint32_t* link = &first_[v];
    while (*link != point) link = &next_[*link];
    *link = next_[point];
    --left_;
  }

  void add_vertex() {
    first_.push_back(kNone);
    vertices_.emplace_back();
  }
  void drop_vertex() noexcept {
    first_.pop_back();
    vertices_.pop_back();
  }
  void start(std::uint32_t v, const Point<D>& p, std::uint32_t except) noexcept {
    vertices_[v] = p;
    for (auto k = static_cast<std::uint32_t>(places_.size()); k-- > 0;) {
      if (k != except) put(v, k);
    }
    --left_;
  }
  std::uint32_t relocate(std::uint32_t v, const Point<D>& p, std::uint32_t w,
                         const Point<D>& q) noexcept {
    vertices_[v] = p;
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

  std::vector<Point<D>> vertices_{Point<D>{}};  // of vertices that had points
  std::vector<std::uint32_t> next_;             // by point
  std::vector<std::uint32_t> first_{kNone};     // by vertex
};

}  // namespace mesher::detail
