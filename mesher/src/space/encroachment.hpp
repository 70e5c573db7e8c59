// Where features meet a vertex's clipped Voronoi cell [Fig 6.2]: if v is not on them, balls around
// their pieces are not empty. That is asked of features that meet at small angles.
//
// Tests are closed with slack, so that other signs are clear of zero [C5].
#pragma once

#include <optional>

#include "cells/voronoi_cell3.hpp"
#include "space/dyadic.hpp"
#include "space/feature.hpp"

namespace mesher::detail {

/// The part of an edge in the cell; nothing if the cell misses it.
[[nodiscard]] std::optional<Span> part_in(const VoronoiCell3& cell, const Edge& e);

/// The place of a polygon in the cell where a vertex helps: the foot of the cell's vertex if that
/// is in both, else the farthest corner of what they share. Nothing if the cell misses the polygon,
/// or only its edges meet it.
[[nodiscard]] std::optional<Point<3>> place_in(const VoronoiCell3& cell, const Polygon& f);

}  // namespace mesher::detail
