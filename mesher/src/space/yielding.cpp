// Chords of balls, and feet.
#include "space/yielding.hpp"

#include <algorithm>
#include <cmath>

#include "space/dyadic.hpp"
#include "space/polygon_shape.hpp"

namespace mesher::detail {

std::optional<Placed> place_in_ball(const Edge& e, const Point<3>& x, double radius) {
  const Point<3> along = minus(e.place_b, e.place_a), to = minus(x, e.place_a);
  const double length2 = squared(along);
  const double foot = dot(to, along) / length2;
  const double height2 = squared(minus(to, scaled(foot, along)));
  if (height2 >= radius * radius) return std::nullopt;
  const double half = std::sqrt((radius * radius - height2) / length2);
  const Span chord{std::max(foot - half, 0.0), std::min(foot + half, 1.0)};
  const auto at = roundest(e, chord.middle(0.5));
  if (!at) return std::nullopt;
  return placed_on(e, *at);
}

std::optional<Placed> yield_to_edges(const FeaturesBeside& near, const Point<3>& x, double radius) {
  const Edge* nearest = near.nearest_edge(x, kYields * radius);
  if (nearest == nullptr) return std::nullopt;
  return place_in_ball(*nearest, x, radius);
}

std::optional<Placed> yield(const FeaturesBeside& near, const Point<3>& x, double radius) {
  if (const auto on_edge = yield_to_edges(near, x, radius)) return on_edge;
  const Polygon* f = near.nearest_under(x, kYields * radius);
  if (f == nullptr) return std::nullopt;
  const Point<3> foot = f->plane.foot(x);
  if (const auto on_edge = yield_to_edges(near, foot, (1 - kYields) * radius)) return on_edge;
  return placed_on(*f, foot);
}

}  // namespace mesher::detail
