// Cuts what loops go around an odd number of times into polygons.
#pragma once

#include <optional>
#include <vector>

#include "repair/space_drawing.hpp"

namespace mesher::detail {

/// If parts are a polygon's, and that is flat: they, without what does not lie in it.
[[nodiscard]] std::optional<PolygonParts> polygon_of(PolygonParts parts, FeatureStore& store);

/// Flat polygons, or triangles where they are not flat, or all is_cut_up: with what lies inside as
/// edges, if that can be; else it will be found to lie on them. Triangles that are not thinner than
/// the tolerance are preferred: an edge of those will be led through their third corner. Nothing if
/// edges cross from wherever they are seen, and loops are several, or of more than 256 corners.
[[nodiscard]] std::optional<std::vector<PolygonParts>> cut(const PolygonParts& parts,
                                                           bool is_cut_up, double tolerance,
                                                           FeatureStore& store);

}  // namespace mesher::detail
