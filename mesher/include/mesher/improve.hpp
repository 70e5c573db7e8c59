// Takes flat tetrahedra out of a mesh.
//
// Example:
//   const mesher::Unflattened all = mesher::without_flat_tetrahedra(m.mesh());
//   if (all.left > 0) ...
//
// Four vertices that would be on one circle, were it not for rounding, can make a tetrahedron
// without volume: Delaunay, its circumradius no larger than that of the circle, and of no use. Two
// of its edges cross. One of them goes: mostly there are two more tetrahedra around it, and two do
// without it; where there are more, the ones are chosen whose thinnest is thickest.
//
// Guarantees:
//   (1) vertices, edges on lines, and what is in which polygon are the same; where a flat
//       tetrahedron lies in a polygon, two of the polygon's faces are exchanged for two others;
//   (2) all tetrahedra are positively oriented, and fill the same space;
//   (3) a new one is Delaunay but for rounding (kNearSphere, check.hpp), and none has a
//       circumradius above a bound times its shortest edge; where that cannot be had, the flat one
//       stays;
//   (4) the result is a function of the mesh.
#pragma once

#include <cstddef>
#include <limits>

#include "mesher/mesh.hpp"

namespace mesher {

/// A tetrahedron is flat if its volume is below this share of a sixth of its longest edge, cubed.
inline constexpr double kFlatVolume = 0x1p-30;

struct Unflattened {
  Mesh<3> mesh;
  std::size_t removed = 0;  ///< flat tetrahedra
  std::size_t left = 0;     ///< flat ones whose edges are all needed
};

/// Requires: a mesh of an update or a static run, or one like it: canonical, its tetrahedra
/// positively oriented. Cost: O(m), and O(m log m) a round if there are flat ones: one round for
/// each that lies on another. `rho`: the bound of (3), that of the mesh.
[[nodiscard]] Unflattened without_flat_tetrahedra(
    Mesh<3> mesh, double rho = std::numeric_limits<double>::infinity());

}  // namespace mesher
