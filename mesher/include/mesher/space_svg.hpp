// Pictures of meshes of tetrahedra as SVG: cut open, seen from the front, above and left.
//
// Shown are the tetrahedra with their middle in the window and behind the plane that halves it in
// y. The worse the radius-edge ratio of a tetrahedron, the bluer it is (pale: 0.61, blue: 2 and
// more); faces are darker where they turn away from the light, and with depth. Faces in polygons of
// the input are green, edges on lines and on polygons' edges thick, input points are dots. What is
// behind is drawn first: the depth of circumcentres orders the tetrahedra of a Delaunay
// triangulation so (Edelsbrunner 1990).
//
// The picture is 1000 units on its longer side; coordinates are rounded to a thousandth of a unit.
#pragma once

#include <array>
#include <vector>

#include "mesher/mesh.hpp"
#include "mesher/mesh_data.hpp"
#include "mesher/output_files.hpp"

namespace mesher {

/// What a picture shows.
struct SpaceView {
  Box<3> window;                                  ///< in the mesh's coordinates
  std::vector<std::array<Point<3>, 4>> coloured;  ///< tetrahedra to show in another colour: the
                                                  ///< change of an update; each as Change has it
};

/// The input points of a mesh with an eighth of their longest side around them; all of the mesh if
/// it has fewer than two. Cost: O(vertices).
[[nodiscard]] SpaceView space_view(const Mesh<3>& mesh);

/// Requires: `mesh` is a Delaunay triangulation. Throws: Error(cannot_write). Cost: O(m log m).
void write_svg(const Mesh<3>& mesh, const SpaceView& view, TextFile& file);
/// With what `features` tell of faces in polygons and edges on lines; else as the mesh does.
void write_svg(const Mesh<3>& mesh, const MeshFeatures& features, const SpaceView& view,
               TextFile& file);

}  // namespace mesher
