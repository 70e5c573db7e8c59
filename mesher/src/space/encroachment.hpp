// Where features meet a vertex's clipped Voronoi cell: then the mesh does not contain them yet.
//
// An edge of the input is a union of edges of the mesh iff V(v) meets it for no v that is not on
// it, and a polygon is a union of faces iff the same holds for it and its edges [rules C3]. Tests
// are closed with slack, so that other signs are clear of zero [C5].
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
