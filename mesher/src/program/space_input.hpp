// Segments and polygons of the input put into the program's world, traced or not, and judged there.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <unordered_set>
#include <vector>

#include "geometry/input_point.hpp"
#include "program/world.hpp"
#include "space/all_fit.hpp"
#include "space/validity.hpp"

namespace mesher::detail {

/// Where a point is, if it is known.
using PlaceOfPoint = std::function<std::optional<Point<3>>(PointId)>;

/// Throws: Error as Mesher::insert_polygon, of what can be told by the ids alone.
void require_loops(const mesher::Polygon& polygon, const PlaceOfPoint& place_of);

/// What a Mesher says of points, segments and polygons before it meshes them, by the ids of the
/// points. Throws: Error as it does. Cost: O(n log L/s).
void require_complex(const std::vector<Point<3>>& points,
                     const std::vector<mesher::Segment>& segments,
                     const std::vector<mesher::Polygon>& polygons, const Options<3>& options,
                     const std::vector<PointId>& ids);

/// Throws: Error(unknown_id). `what`: "an end of", of `user`.
[[noreturn]] void fail_unknown_point(PointId point, const std::string& what,
                                     const mesher::Feature& user);

/// What the polygon is by handles. `handle_of(id)`: 0 if there is no such point.
/// Throws: Error(unknown_id).
template <class HandleOf>
[[nodiscard]] PolygonParts parts_of(const mesher::Polygon& polygon, HandleOf&& handle_of) {
  const auto handle = [&](PointId id, const char* what) {
    const VertexHandle v = handle_of(id);
    if (v == 0) fail_unknown_point(id, what, mesher::Feature(polygon.id));
    return v;
  };
  PolygonParts parts;
  for (const auto& loop : polygon.loops) {
    auto& corners = parts.loops.emplace_back();
    for (const PointId id : loop) corners.push_back(handle(id, "a corner of"));
  }
  for (const auto& [a, b] : polygon.edges) {
    parts.edges.emplace_back(handle(a, "in"), handle(b, "in"));
  }
  for (const PointId id : polygon.points) parts.points.push_back(handle(id, "in"));
  return parts;
}

/// Throws: Error(repeated_segment), Error(repeated_polygon) if it is there under another id.
void require_new(const Edge* there, LineId segment, const SpaceNames& names);
void require_new(const Polygon& record, PolygonId polygon, const SpaceNames& names);

/// The segment `id` between the points a and b; likewise.
template <class S>
const Edge& add_segment(World<S, 3>& world, LineId id, VertexHandle a, VertexHandle b,
                        const SpaceNames& names) {
  require_new(world.plc.store().find_edge(a, b), id, names);
  return world.insert_edge(a, b);
}
inline void erase_segment(World<sac::Scope, 3>& world, const Edge& e) { world.erase_edge(e); }
/// Throws: Error(repeated_polygon), and as require_shape.
template <class S>
const Polygon& add_polygon(World<S, 3>& world, PolygonId id, PolygonParts parts,
                           const SpaceNames& names) {
  const Polygon& record = world.plc.store().record(parts);
  require_new(record, id, names);
  require_shape(record, id, world.plc.store());
  return world.insert_polygon(std::move(parts));
}

/// From so many on it is worth while to look at all at once.
inline constexpr std::size_t kMany = 32;

/// Segments and polygons that have come, in this order, fit to all that is there.
/// Throws: Error as of the first conflict; what `ask` throws, which is called in between.
template <class S>
void require_fit(World<S, 3>& world, const std::vector<EdgeHandle>& segments,
                 const std::vector<PolygonHandle>& polygons, const SpaceNames& names,
                 const std::function<void()>& ask) {
  FeatureStore& store = world.plc.store();
  // All have come, and many: most often they fit.
  if (polygons.size() > kMany && polygons.size() == store.live_polygons() && all_fit(store, ask)) {
    return;
  }
  const auto require_none = [&](const std::optional<SpaceConflict>& conflict) {
    if (conflict) fail(*conflict, names, store);
  };
  std::unordered_set<EdgeHandle> seen;  // edges are of several polygons
  const auto look_at = [&](EdgeHandle e) {
    if (!seen.insert(e).second) return;
    ask();
    require_none(conflict_of(store.edges()[e], store, world.features));
  };
  for (const EdgeHandle e : segments) look_at(e);
  for (const PolygonHandle h : polygons) {
    ask();
    const Polygon& f = store.polygons()[h];
    for (const EdgeHandle e : f.all_edges) look_at(e);
    require_none(conflict_of(f, store, world.features));
  }
}

}  // namespace mesher::detail
