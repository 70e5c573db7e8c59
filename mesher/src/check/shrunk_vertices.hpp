// The guard: vertices at which lengths have shrunk.
#pragma once

#include <vector>

#include "check/mesh_lines.hpp"
#include "mesher/reports.hpp"

namespace mesher::detail {

/// Vertices that are nearer to their nearest neighbours than `allowed` times less than the local
/// feature size, in the order of the mesh's vertices.
[[nodiscard]] std::vector<ShrunkVertex> shrunk_vertices(const Mesh<2>& mesh, const MeshLines& lines,
                                                        double allowed);

}  // namespace mesher::detail
