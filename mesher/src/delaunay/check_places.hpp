// Checks that points are allowed in a triangulation.
#pragma once

#include <cstddef>
#include <span>

#include "delaunay/simplex_store.hpp"
#include "geometry/input_point.hpp"

namespace mesher::detail {

/// Throws: Error (too_many: vertices are numbered from 1 and below kNone; not_finite, magnitude)
/// that calls a point by its place, from 1.
template <int D>
void check_places(std::span<const Point<D>> points) {
  if (points.size() >= kNone) throw Error(ErrorCode::too_many, "more than 2^32 - 2 points");
  for (std::size_t i = 0; i < points.size(); ++i) {
    check_coordinates(points[i], PointId{static_cast<std::int64_t>(i + 1)});
  }
}

}  // namespace mesher::detail
