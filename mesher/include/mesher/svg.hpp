// Pictures of meshes as SVG: thin lines, input points as small dots, both finer where the
// mesh is; regions in light colours, edges on lines of the input thick and dark.
//
// The picture is 1000 units on its longer side, y upward in the mesh and downward in the file.
// Coordinates are rounded to a thousandth of a unit, and what lies outside the view is left out.
#pragma once

#include <array>
#include <vector>

#include "mesher/mesh_data.hpp"
#include "mesher/output_files.hpp"

namespace mesher {

/// What a picture shows.
struct SvgView {
  Box<2> window;                                  ///< in the mesh's coordinates
  std::vector<std::array<Point<2>, 3>> coloured;  ///< triangles to fill, above their regions:
                                                  ///< the change of an update
};

/// The input points of a mesh with an eighth of their longer side around them; the whole mesh if
/// it has fewer than two. Cost: O(vertices).
[[nodiscard]] SvgView svg_view(const Mesh<2>& mesh);

/// Throws: Error(cannot_write). Cost: O(m log m).
void write_svg(const Mesh<2>& mesh, const SvgView& view, TextFile& file);
void write_svg(const Mesh<2>& mesh, const MeshFeatures& features, const SvgView& view,
               TextFile& file);

}  // namespace mesher
