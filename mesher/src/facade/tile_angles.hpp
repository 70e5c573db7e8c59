// What an update of tiles did at small angles: of each triangle the tile says it that outputs it,
// of each vertex the tile that owns it.
#pragma once

#include <array>
#include <vector>

#include "mesher/reports.hpp"
#include "program/world.hpp"
#include "tiles/tiled_mesher.hpp"

namespace mesher::detail {

/// Of all that there is. `whole`: with the whole input; nobody else may use it meanwhile.
/// Requires: tiles agree. Throws: std::bad_alloc.
[[nodiscard]] AngleNews all_angles(World<sac::Scope, 2>& whole, const TiledMesher<2>& tiles,
                                   double rho);
/// Of new triangles, by their places, smallest first.
[[nodiscard]] AngleNews new_angles(World<sac::Scope, 2>& whole, const TiledMesher<2>& tiles,
                                   double rho,
                                   const std::vector<std::array<Point<2>, 3>>& triangles);

}  // namespace mesher::detail
