// The facets of a mesh as sides of its simplices, for formats that name them so.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "mesher/mesh.hpp"

namespace mesher {

/// An edge in the plane, a face in space. D is 2 or 3.
template <int D>
struct FacetSide {
  std::array<std::uint32_t, D> corners{};  ///< counterclockwise seen from outside of the simplex
  std::int64_t marker = 0;
  std::uint32_t simplex = 0;   ///< the first that has it
  std::uint32_t opposite = 0;  ///< its corner across from the facet: 0 to D
  bool is_boundary = false;    ///< there is no other
};

/// The edges (in space faces) of the features, in their order; without features the boundary, with
/// kBoundaryMarker. Throws: Error(bad_mesh) for one that no simplex has. Cost: O(m log m).
template <int D>
[[nodiscard]] std::vector<FacetSide<D>> facet_sides(const Mesh<D>& mesh,
                                                    const MeshFeatures& features);

/// As features have it, for visit_nodes.
[[nodiscard]] inline MeshEdge feature_of(const FacetSide<2>& side) {
  return {side.corners[0], side.corners[1], {}, side.marker};
}
[[nodiscard]] inline MeshFace feature_of(const FacetSide<3>& side) {
  return {side.corners, {}, side.marker};
}

}  // namespace mesher
