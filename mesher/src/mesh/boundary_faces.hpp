// The boundary of a mesh of tetrahedra.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mesher/mesh.hpp"

namespace mesher {

/// The faces of one tetrahedron only, by vertices, seen from outside counterclockwise, the smallest
/// first, in lexicographic order. Cost: O(m log m).
[[nodiscard]] std::vector<std::array<std::uint32_t, 3>> boundary_faces(const Mesh<3>& mesh);

}  // namespace mesher
