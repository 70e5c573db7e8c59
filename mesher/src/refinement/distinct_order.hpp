// Points in Morton order, if no two are too near to each other.
#pragma once

#include <vector>

#include "geometry/grid.hpp"
#include "mesher/mesh.hpp"

namespace mesher::detail {

/// Throws: Error (not_finite, magnitude, outside_domain; duplicate_point, too_close: for points
/// that
///         share a finest cell of the box) with `ids`, or places from 1 if there are none.
/// Cost: O(n log n).
template <int D>
[[nodiscard]] std::vector<Point<D>> in_distinct_order(const std::vector<Point<D>>& points,
                                                      const std::vector<PointId>& ids,
                                                      const Box<D>& domain, const MeshBox<D>& box);

}  // namespace mesher::detail
