// The meshing box around the domain [§4.4].
#pragma once

#include "geometry/grid.hpp"
#include "mesher/mesh.hpp"

namespace mesher::detail {

/// The box of a mesh: four times the domain's longest side (rounded up to a power of two), with the
/// boundary grid that [L 4.4.1] asks for. Throws: Error(bad_option).
template <int D>
[[nodiscard]] MeshBox<D> mesh_box(const Options<D>& options);

}  // namespace mesher::detail
