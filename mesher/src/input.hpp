// Checking input points at the boundary, and putting them into spatial order.
#pragma once

#include <string>
#include <vector>

#include "geometry/grid.hpp"
#include "mesher/error.hpp"
#include "mesher/mesh.hpp"

namespace mesher::detail {

/// "(x, y)", digits that read back to the same doubles.
[[nodiscard]] std::string place_text(const Point<2>& p);

/// Throws: Error (not_finite, magnitude, outside_domain).
void check_point(const Point<2>& p, const Box<2>& domain, FeatureId id);

/// Throws: Error(duplicate_point) for equal points, else Error(too_close).
[[noreturn]] void fail_too_near(const Point<2>& p, FeatureId id, const Point<2>& other,
                                FeatureId other_id);

/// The indices of `points` in Morton order, equal places in the order given.
[[nodiscard]] std::vector<std::size_t> morton_order(const std::vector<Point<2>>& points,
                                                    const MeshBox<2>& box);

}  // namespace mesher::detail
