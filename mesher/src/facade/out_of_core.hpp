// The mesh of points, tile after tile, with a halo width to begin with.
#pragma once

#include <vector>

#include "mesher/out_of_core.hpp"

namespace mesher::detail {

/// In spacings: the side of a cell that has one point, if points lie as in the smallest cell around
/// them that has kTogether.
template <int D>
inline constexpr double kHaloWidth = D == 2 ? 8 : 12;
template <int D>
inline constexpr std::size_t kTogether = D == 2 ? 16 : 32;

/// As box_mesh_out_of_core. `width`: of halos, in spacings.
/// Requires: how.tiles > 0; two points or more; options.domain is not empty.
template <int D>
[[nodiscard]] Mesh<D> mesh_in_tiles(std::vector<Point<D>> points, const Options<D>& options,
                                    const OutOfCore& how, double width,
                                    const std::vector<PointId>& ids, OutOfCoreReport& report,
                                    const RunControl& control);

}  // namespace mesher::detail
