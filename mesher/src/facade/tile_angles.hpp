// What an update of tiles did at small angles: of each triangle the tile says it that outputs it,
// of each vertex the tile that owns it.
#pragma once

#include <array>
#include <vector>

#include "mesher/reports.hpp"
#include "program/world.hpp"
#include "tiles/feature_numbers.hpp"
#include "tiles/tiled_mesher.hpp"

namespace mesher::detail {

/// The whole input, as each process has it; nobody else may use it meanwhile.
struct WholeWorld {
  World<sac::Scope, 2>& world;
  const FeatureNumbers& numbers;  // of segments; empty, if there is one process
  Peers& peers;
};

/// Of all that there is, in all processes. Of all (peers.hpp). Requires: tiles agree.
/// Throws: std::bad_alloc.
[[nodiscard]] AngleNews all_angles(const WholeWorld& whole, const TiledMesher<2>& tiles,
                                   double rho);
/// Of new triangles, in all processes. Likewise. `triangles`: those that tiles of this process
/// output, by their places, smallest first.
[[nodiscard]] AngleNews new_angles(const WholeWorld& whole, const TiledMesher<2>& tiles, double rho,
                                   const std::vector<std::array<Point<2>, 3>>& triangles);

}  // namespace mesher::detail
