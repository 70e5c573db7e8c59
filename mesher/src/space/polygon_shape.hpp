// Properties of a polygon computed from its corners: its plane, inside tests, and distances to it.
//
// The plane is that of Newell's normal of the outer loop, taken from its smallest corner on; so it
// is a function of the corners alone [rules C2]. Corners may be off it by rounding, and somewhat
// more: functions that make polygons refuse those that are not is_flat.
//
// Ball tests are closed with a slack, so that objects not found to touch are clearly apart [rules
// C5].
#pragma once

#include <array>
#include <optional>
#include <span>

#include "geometry/space_distances.hpp"
#include "space/feature.hpp"

namespace mesher::detail {

/// How far the corners of a polygon may be off its plane, times its reach (and some rounding).
inline constexpr double kFlatness = 1e-8;

/// The squared radius of a ball, with its slack.
[[nodiscard]] inline double closed(double radius2) { return radius2 * (1 + 0x1p-30); }
/// Whether a squared distance is within a ball's squared radius.
[[nodiscard]] inline bool touches(double distance2, double radius2) {
  return distance2 <= closed(radius2);
}

/// Puts loops into the order of Polygon. `place_of(corner)`: lexicographic order is by these.
/// Requires: loops are not empty, and a corner is once in a loop.
template <class Corner, class PlaceOf>
void put_in_order(std::vector<std::vector<Corner>>& loops, PlaceOf&& place_of);

/// Twice the area that a loop goes around, across it [Newell]: a sum from the first corner on.
[[nodiscard]] Point<3> twice_area(std::span<const Point<3>> loop);

/// Fills in what follows from `places`, `loop_end` and `inside`: from plane to inside_left.
/// Returns whether there is a plane: whether the outer loop goes around an area.
/// Cost: O(n log n) for n corners and what lies inside. What is asked then is O(log n), and what is
/// near, where corners are not in each other's way (space/edge_tree.hpp).
[[nodiscard]] bool find_shape(Polygon& f);

/// Whether it did.
[[nodiscard]] inline bool has_area(const Polygon& f) { return f.plane.normal != Point<3>{}; }

/// How far the farthest of what should be in its plane is off, and that.
struct Deviation {
  double height = 0;  // >= 0
  Point<3> at{};
};
[[nodiscard]] Deviation deviation(const Polygon& f);
/// Whether that is no more than it may be.
[[nodiscard]] bool is_flat(const Polygon& f);

/// Whether the foot of x is in f: an odd number of loops goes around it.
[[nodiscard]] bool contains(const Polygon& f, const Point<3>& x);
/// The same for a place of the frame, and for one loop.
[[nodiscard]] bool contains(const Polygon& f, const Point<2>& uv);
[[nodiscard]] bool loop_contains(const Polygon& f, std::size_t loop, const Point<2>& uv);

/// Where in the frame it is as far from the feet of all three, in any order. Requires: these are
/// not on a line.
[[nodiscard]] Point<2> centre_in_frame(const Polygon& f, const std::array<Point<3>, 3>& places);

/// The direction, in the plane, of length 1, into f across its edge from the i-th corner on.
[[nodiscard]] Point<3> inward(const Polygon& f, std::uint32_t i);

/// The place of f that is nearest to x.
[[nodiscard]] Point<3> nearest_place(const Polygon& f, const Point<3>& x);
/// Squared distance of x from f.
[[nodiscard]] double distance2(const Point<3>& x, const Polygon& f);
/// Whether that is at most `most2`.
[[nodiscard]] bool is_within(const Point<3>& x, const Polygon& f, double most2);
/// Squared distance of the closed segment ab from f.
[[nodiscard]] double distance2(const Point<3>& a, const Point<3>& b, const Polygon& f);

/// x, as the trees of f are asked about it.
[[nodiscard]] EdgeTree::Place place_beside(const Polygon& f, const Point<3>& x);
/// Calls visit(edge) with the handles of the edges on f within `distance` of x, and some others,
/// until it returns true; returns whether it did.
template <class Visit>
bool visit_edges_near(const Polygon& f, const Point<3>& x, double distance, Visit&& visit);
/// The same with the points on f.
template <class Visit>
bool visit_points_near(const Polygon& f, const Point<3>& x, double distance, Visit&& visit);
/// The same with the points on f that are at this distance from x, but for rounding.
template <class Visit>
bool visit_points_at(const Polygon& f, const Point<3>& x, double distance, Visit&& visit);

/// Where the closed segment ab crosses the plane, if that is inside f.
[[nodiscard]] std::optional<Point<3>> crossing(const Point<3>& a, const Point<3>& b,
                                               const Polygon& f);

template <class Corner, class PlaceOf>
void put_in_order(std::vector<std::vector<Corner>>& loops, PlaceOf&& place_of) {
  const auto before = [&](const Corner& a, const Corner& b) { return place_of(a) < place_of(b); };
  for (auto& loop : loops) {
    std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end(), before), loop.end());
    if (loop.size() > 2 && before(loop.back(), loop[1])) {
      std::reverse(loop.begin() + 1, loop.end());
    }
  }
  std::sort(loops.begin() + 1, loops.end(), [&](const auto& a, const auto& b) {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(), before);
  });
}

template <class Visit>
bool visit_edges_near(const Polygon& f, const Point<3>& x, double distance, Visit&& visit) {
  const EdgeTree::Place place = place_beside(f, x);
  const double most2 = distance * distance;
  return f.outline_tree.visit_near(place, most2, [&](std::uint32_t i) {
    return visit(f.edges[f.previous(i)]);
  }) || f.inner_tree.visit_near(place, most2, [&](std::uint32_t i) {
    return i < f.inner_edges.size() && visit(f.inner_edges[i]);
  });
}

namespace polygon_shape {

// visit(handle) for points, by what the trees have found.
template <class Visit>
auto corners(const Polygon& f, Visit& visit) {
  return [&](std::uint32_t i) { return visit(f.corners[i]); };
}
template <class Visit>
auto inner_points(const Polygon& f, Visit& visit) {
  return [&, edges = f.inner_edges.size()](std::uint32_t i) {
    return i >= edges && visit(f.inner_points[i - edges]);
  };
}

}  // namespace polygon_shape

template <class Visit>
bool visit_points_near(const Polygon& f, const Point<3>& x, double distance, Visit&& visit) {
  const EdgeTree::Place place = place_beside(f, x);
  const double most2 = distance * distance;
  return f.outline_tree.visit_near(place, most2, polygon_shape::corners(f, visit)) ||
         f.inner_tree.visit_near(place, most2, polygon_shape::inner_points(f, visit));
}

template <class Visit>
bool visit_points_at(const Polygon& f, const Point<3>& x, double distance, Visit&& visit) {
  EdgeTree::Place place = place_beside(f, x);
  place.slack += distance * 0x1p-39 + 2 * resolution(x, 0);
  return f.outline_tree.visit_at(place, distance, polygon_shape::corners(f, visit)) ||
         f.inner_tree.visit_at(place, distance, polygon_shape::inner_points(f, visit));
}

}  // namespace mesher::detail
