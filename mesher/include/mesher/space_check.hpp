// How good a mesh of tetrahedra is.
#pragma once

#include <cstddef>

#include "mesher/mesh.hpp"

namespace mesher {

/// Tetrahedra with a dihedral angle below this are slivers.
inline constexpr double kSliverDegrees = 5;

/// The worst tetrahedra of a mesh; NaN if there are none.
struct SpaceQuality {
  double min_dihedral_deg = 0;
  double max_dihedral_deg = 0;
  double max_radius_edge = 0;  ///< circumradius over shortest edge
  std::size_t slivers = 0;
};

/// Requires: tetrahedra are positively oriented. Cost: O(m).
[[nodiscard]] SpaceQuality quality(const Mesh<3>& mesh);

}  // namespace mesher
