// Where polygons get vertices.
#include <algorithm>
#include <cmath>

#include "refinement/conformity.hpp"
#include "refinement/conformity_balls.hpp"
#include "space/polygon_shape.hpp"
#include "space/small_angles.hpp"
#include "space/yielding.hpp"

namespace mesher::detail {

/// A place that takes the crossing: a copy of the vertex whose cell meets the polygon, or its foot,
/// or else where the crossing is; or on an edge that is near these.
Placed Conformity::place_for(const Crossings::Crossing& crossing) const {
  const Polygon& f = polygon(crossing.polygon);
  if (crossing.is_tile) {
    const auto foot = foot_in(f, crossing.from, crossing);
    return placed_on(f, foot ? *foot : crossing.at);
  }
  const double r2 = squared_distance(crossing.at, place(crossing.face[0]));
  for (const std::uint32_t w : crossing.face) {
    if (vertices_[w].role.on == 0 || is_on(w, crossing.polygon)) continue;
    const Vertex<3> v = record(w);
    const FeaturesBeside near(store_, crossing.at, kEverywhere);
    const auto copy = SmallAngles(near).copy({v, vertices_[w].role}, f);
    if (copy && detail::polygon_of(copy->role) != 0 &&
        detail::is_in_ball(crossing.at, r2, copy->p)) {
      return *copy;
    }
  }
  for (const std::uint32_t w : crossing.face) {
    if (is_on(w, crossing.polygon)) continue;
    const auto foot = foot_in(f, place(w), crossing);
    if (foot && is_nearest(w, *foot)) return place_near(f, *foot, w);
  }
  return place_near(f, crossing.at, crossing.face[0]);
}

/// The foot of x, if it is in f, takes the crossing, and x is nearer to it than the corners are.
std::optional<Point<3>> Conformity::foot_in(const Polygon& f, const Point<3>& x,
                                            const Crossings::Crossing& crossing) const {
  const Point<3> foot = f.plane.foot(x);
  const double r2 = squared_distance(crossing.at, place(crossing.face[0]));
  if (!detail::is_in_ball(crossing.at, r2, foot) || !contains(f, foot)) return std::nullopt;
  const double gap2 = squared_distance(foot, x);
  for (const std::uint32_t w : crossing.face) {
    if (squared_distance(foot, place(w)) < gap2) return std::nullopt;
  }
  return foot;
}

/// Whether no vertex is nearer to x than v: its neighbours are asked.
bool Conformity::is_nearest(std::uint32_t v, const Point<3>& x) const {
  const double d2 = squared_distance(place(v), x);
  std::vector<std::uint32_t> star;
  const auto has_nearer = [&](std::uint32_t s) {
    const auto& corners = kernel_.simplices().corners(s);
    return std::any_of(corners.begin(), corners.end(), [&](std::uint32_t w) {
      return w != kInfinite && squared_distance(place(w), x) < d2;
    });
  };
  return kernel_.find_in_star(v, star, has_nearer) == kNone;
}

/// On f at x, which is in v's cell, or on an edge near x instead, if that takes some of the cell.
Placed Conformity::place_near(const Polygon& f, const Point<3>& x, std::uint32_t v) const {
  const FeaturesBeside near(store_, x, kEverywhere);
  const auto on_edge = yield_to_edges(near, x, std::sqrt(squared_distance(x, place(v))));
  return on_edge && cuts_cell(v, on_edge->p) ? *on_edge : placed_on(f, x);
}

/// Whether a vertex at x would be a neighbour of v.
bool Conformity::cuts_cell(std::uint32_t v, const Point<3>& x) const {
  std::vector<std::uint32_t> star;
  const auto is_in_ball = [&](std::uint32_t s) {
    if (kernel_.is_ghost(s)) return false;
    const Point<3>& centre = kernel_.simplices().ball(s).centre;
    return detail::is_in_ball(centre, squared_distance(centre, place(v)), x);
  };
  return kernel_.find_in_star(v, star, is_in_ball) != kNone;
}

std::optional<Placed> Conformity::yield(const Point<3>& x, double radius) const {
  return detail::yield(FeaturesBeside(store_, x, kEverywhere), x, radius);
}

}  // namespace mesher::detail
