// Where a new vertex is to go, and what on: its role says the lowest feature that it lies on.
//
// A vertex on an edge has the edge's handle and a label in its role, one on a polygon the polygon's
// handle, marked, and no label.
#pragma once

#include "plc/feature.hpp"
#include "segments/roles.hpp"

namespace mesher::detail {

/// Marks the handle of a polygon in a role.
inline constexpr SegmentHandle kOnPolygon = 0x80000000u;

[[nodiscard]] inline Role role_on(const Edge& e, double fraction) {
  return {dyadic(fraction), e.self};
}
[[nodiscard]] inline Role role_on(const Polygon& f) { return {Label(), f.self | kOnPolygon}; }
/// The edge that a role says, 0 if it says none; the same for polygons.
[[nodiscard]] inline EdgeHandle edge_of(const Role& role) {
  return (role.on & kOnPolygon) != 0 ? 0 : role.on;
}
[[nodiscard]] inline PolygonHandle polygon_of(const Role& role) {
  return (role.on & kOnPolygon) != 0 ? role.on & ~kOnPolygon : 0;
}

/// A place, and its role: none in space.
struct Placed {
  Point<3> p{};
  Role role;
};
[[nodiscard]] inline Placed placed_on(const Edge& e, double fraction) {
  const Role role = role_on(e, fraction);
  return {place_at(e, role.label), role};
}
[[nodiscard]] inline Placed placed_on(const Polygon& f, const Point<3>& p) {
  return {p, role_on(f)};
}

}  // namespace mesher::detail
