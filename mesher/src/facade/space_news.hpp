// What an update brings of the names of points, segments and polygons in space, until it is done.
#pragma once

#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "facade/pending_lines.hpp"
#include "space/known_parts.hpp"
#include "space/polygons_at.hpp"

namespace mesher::detail {

/// A polygon of the input, and its record.
struct NamedPolygon {
  mesher::Polygon polygon;
  PolygonHandle record = 0;
};

struct SpaceNews {
  using Lines = std::unordered_map<LineId, LinePoints>;
  using Polygons = std::unordered_map<PolygonId, NamedPolygon>;

  std::unordered_map<VertexHandle, PointId> points;
  std::unordered_map<EdgeHandle, LineId> segments;
  std::unordered_map<PolygonHandle, PolygonId> polygons;
  Lines line_points;
  Polygons named_polygons;
  std::vector<EdgeHandle> edges_come;  // of segments; in the order in which they came
  std::vector<PolygonHandle> polygons_come;
  std::unordered_set<EdgeHandle> segments_taken;  // some have come again
  std::vector<PolygonId> polygons_taken;
  PolygonsAt polygons_at;  // of those that come
  KnownParts::News parts;

  void clear() noexcept { *this = SpaceNews(); }
};

}  // namespace mesher::detail
