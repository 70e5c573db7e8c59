// Where a new vertex is to go, and what on: its role says the lowest feature that it lies on.
//
// A vertex on an edge has the edge's handle and a label in its role; one on a polygon the polygon's
// handle, marked, and if it is a copy (space/small_angles.hpp) its distance from what it was turned
// about.
#pragma once

#include "records/roles.hpp"
#include "space/feature.hpp"

namespace mesher::detail {

/// Marks the handle of a polygon in a role.
inline constexpr SegmentHandle kOnPolygon = 0x80000000u;

[[nodiscard]] inline Role role_on(const Edge& e, const Label& at) { return {at, e.self}; }
[[nodiscard]] inline Role role_on(const Polygon& f, double copied_at = 0) {
  return {Label(copied_at, false), f.self | kOnPolygon};
}
/// The edge that a role says, 0 if it says none; the same for polygons.
[[nodiscard]] inline EdgeHandle edge_of(const Role& role) {
  return (role.on & kOnPolygon) != 0 ? 0 : role.on;
}
[[nodiscard]] inline PolygonHandle polygon_of(const Role& role) {
  return (role.on & kOnPolygon) != 0 ? role.on & ~kOnPolygon : 0;
}

/// A place, and its role: none off features.
template <int D>
struct PlacedIn {
  Point<D> p{};
  Role role;
};
using Placed = PlacedIn<3>;
[[nodiscard]] inline Placed placed_on(const Edge& e, const Label& at) {
  return {place_at(e, at), role_on(e, at)};
}
[[nodiscard]] inline Placed placed_on(const Polygon& f, const Point<3>& p, double copied_at = 0) {
  return {p, role_on(f, copied_at)};
}

}  // namespace mesher::detail
