// Writing meshes of tetrahedra.
//
// Example: mesher::write_mesh(mesher::mesh_statically<3>(points, options), "cloud.vtu");
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "mesher/error.hpp"
#include "mesher/mesh.hpp"
#include "mesher/output_files.hpp"

namespace mesher {

/// The faces of the mesh's boundary: those of one tetrahedron only, by vertices, seen from outside
/// counterclockwise, the smallest first, in lexicographic order. Cost: O(m log m).
[[nodiscard]] std::vector<std::array<std::uint32_t, 3>> boundary_faces(const Mesh<3>& mesh);

/// Writes a mesh of tetrahedra by the extension of `path`: .node (with .ele and .face, TetGen's),
/// .vtu, .vtk (VTK's), .msh (Gmsh's, version 4.1) or .mesh (Medit's); all in text, coordinates as
/// decimals that read back bit for bit. The vertices' kinds go along where the format has room.
/// Nothing is written on failure. Throws: Error (unknown_format, cannot_write).
void write_mesh(const Mesh<3>& mesh, const std::string& path);

}  // namespace mesher
