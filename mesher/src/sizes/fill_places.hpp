// Where the lattices will have vertices, roughly: for who cuts the box into parts of as much work.
#pragma once

#include <type_traits>
#include <vector>

#include "geometry/grid.hpp"
#include "sizes/limits.hpp"

namespace mesher::detail {

/// A vertex of a lattice takes about this part of the work that a point of the input does: most are
/// never completed.
inline constexpr double kWorkOfFill = 1.0 / 8;

/// `points`, and one place for as many vertices of lattices as take the work of a point, spread as
/// these are; if that is a lot, a part of both. `domain`: beyond which there are no limits.
/// A function of its arguments. Cost: O(places).
template <int D>
[[nodiscard]] std::vector<Point<D>> places_of_work(
    std::vector<std::type_identity_t<Point<D>>> points, const Limits<D>& limits,
    const MeshBox<D>& box, const std::type_identity_t<Box<D>>& domain);

}  // namespace mesher::detail
