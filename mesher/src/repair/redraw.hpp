// What a drawing that fits together makes of what was drawn.
#pragma once

#include "mesher/repair.hpp"
#include "repair/drawing.hpp"
#include "repair/drawn.hpp"
#include "repair/space_drawing.hpp"

namespace mesher::detail {

/// The graph of `file` as it is in the drawing, with notes of what is not as it was. In space paths
/// are of segments, and sheets of polygons, by rank of ids.
[[nodiscard]] Repaired<2> redraw(const GraphFile<2>& file, const Drawing<2>& drawing,
                                 const Drawn<2>& drawn);
[[nodiscard]] Repaired<3> redraw(const GraphFile<3>& file, const Drawing<3>& drawing,
                                 const Drawn<3>& drawn);

/// The loops and what lies inside of a polygon, by handles. Requires: its points were drawn.
[[nodiscard]] PolygonParts drawn_parts(const mesher::Polygon& polygon, const Drawn<3>& drawn);

}  // namespace mesher::detail
