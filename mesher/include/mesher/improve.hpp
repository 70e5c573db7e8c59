// Removes flat tetrahedra from a mesh.
//
// Example:
//   const mesher::Unflattened all = mesher::without_flat_tetrahedra(m.mesh());
//   if (all.left > 0) ...
//
// Four vertices that would be on one circle without rounding can form a tetrahedron of almost no
// volume: it is Delaunay, its circumradius is no larger than that of the circle, and it is of no
// use. Two of its edges cross; removing one of them removes the tetrahedron. Usually two other
// tetrahedra share that edge, and two replace them; if more share it, the replacements are chosen
// whose thinnest tetrahedron is thickest.
//
// Guarantees:
//   (1) vertices, edges on lines, and the parts covered by each polygon stay the same; if a flat
//       tetrahedron lies in a polygon, two of the polygon's faces are replaced by two others;
//   (2) all tetrahedra are positively oriented, and fill the same space;
//   (3) a new tetrahedron is Delaunay up to rounding (kNearSphere, check.hpp), and none has a
//       circumradius above a bound times its shortest edge; if that is impossible, the flat one
//       stays;
//   (4) the result is a function of the mesh.
#pragma once

#include <cstddef>
#include <limits>

#include "mesher/mesh.hpp"

namespace mesher {

/// A tetrahedron is flat if its volume is below this fraction of a sixth of its cubed longest edge.
inline constexpr double kFlatVolume = 0x1p-30;

/// A mesh whose flat tetrahedra were removed where possible.
struct Unflattened {
  Mesh<3> mesh;
  std::size_t removed = 0;  ///< flat tetrahedra
  std::size_t left = 0;     ///< flat tetrahedra that could not be removed
};

/// Removes the flat tetrahedra of a mesh. `rho`: the bound of (3), that of the mesh.
/// Requires: a mesh of an update or a static run, or one like it: canonical, with positively
/// oriented tetrahedra.
/// Cost: O(m), and O(m log m) for each round if there are flat tetrahedra; there is one round for
/// each that lies on another.
[[nodiscard]] Unflattened without_flat_tetrahedra(
    Mesh<3> mesh, double rho = std::numeric_limits<double>::infinity());

}  // namespace mesher
