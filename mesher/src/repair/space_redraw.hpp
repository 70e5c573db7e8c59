// What a drawing in space makes of the segments and polygons that were drawn.
#pragma once

#include <vector>

#include "mesher/repair.hpp"
#include "repair/space_drawing.hpp"

namespace mesher::detail {

/// What was drawn of a file.
struct Drawn {
  std::vector<VertexHandle> points;  // of each point of the file
  std::vector<std::size_t> keepers;  // of each of the first handles, from 1: the point that stays
  std::vector<std::size_t> facets, segments;  // in the order of ids: sheets and paths are by this
};

/// The loops and what lies inside of a polygon, by handles. Requires: they are known.
[[nodiscard]] PolygonParts drawn_parts(const mesher::Polygon& polygon,
                                       const std::unordered_map<PointId, VertexHandle>& handles);

/// The complex of `file` as it is in the drawing, with notes of what is not as it was.
[[nodiscard]] Repaired<3> redraw(const GraphFile<3>& file, const SpaceDrawing& drawing,
                                 const Drawn& drawn);

}  // namespace mesher::detail
