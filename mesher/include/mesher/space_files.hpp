// Writing meshes of tetrahedra.
//
// Example: mesher::write_mesh(mesher::mesh_statically<3>(points, options), "cloud.vtu");
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "mesher/error.hpp"
#include "mesher/io.hpp"
#include "mesher/mesh.hpp"
#include "mesher/mesh_data.hpp"
#include "mesher/output_files.hpp"

namespace mesher {

/// The faces of the mesh's boundary: those of one tetrahedron only, by vertices, seen from outside
/// counterclockwise, the smallest first, in lexicographic order. Cost: O(m log m).
[[nodiscard]] std::vector<std::array<std::uint32_t, 3>> boundary_faces(const Mesh<3>& mesh);

/// Writes a mesh of tetrahedra into files that are already open.
using SpaceMeshWriter = MeshWriterOf<3>;

/// Opens the files of one output among `files`, by the extension of `path`:
///
/// - `.node`, and `.ele` and `.face` beside it (TetGen): numbered from 1. Vertices without origins
///   and markers have one attribute (1 for an input point, 0 otherwise) and one marker (1 on the
///   boundary grid, 0 otherwise); else two attributes, kind and origin, and their marker. A
///   tetrahedron's attribute is its region. Without features faces are those of the boundary, with
///   marker 1; else those of MeshFeatures (behind the marker the id of the polygon, where known).
///   With MeshFiles::features `.edge`: the edges of MeshFeatures (behind the marker the id of the
///   line, where known);
/// - `.vtu` and `.vtk` (VTK, ParaView): cells are the tetrahedra, then the faces and the edges of
///   MeshFeatures; point data kind, origin, marker; cell data region, marker, polygon and line with
///   has_polygon and has_line (1 where it is known);
/// - `.msh` (Gmsh 4.1): each region, and each marker of faces and of edges, is a physical group,
///   named and numbered as in the plane;
/// - `.mesh` (Medit): references are regions, and markers of vertices, faces and edges, as there;
/// - `.off` (Geomview), `.obj` (Wavefront) and `.stl`: the boundary alone, as triangles seen from
///   outside counterclockwise, with the vertices on it;
/// - `.svg`: a picture, cut open: see space_svg.hpp; its coordinates are rounded.
///
/// All in text, coordinates as decimals that read back bit for bit. `files` must outlive the
/// writer. Throws: Error (unknown_format, cannot_write, bad_option).
[[nodiscard]] SpaceMeshWriter open_space_mesh(OutputFiles& files, const std::string& path,
                                              MeshFiles content = MeshFiles::plain);

/// Writes a mesh to `path` (and beside it) as open_space_mesh describes, whole or not at all; the
/// files of a `.node` output are `features` if there are any.
/// Throws: Error (unknown_format, cannot_write).
void write_mesh(const Mesh<3>& mesh, const std::string& path);
void write_mesh(const MeshDataOf<3>& mesh, const std::string& path);

}  // namespace mesher
