// Which edges and faces of a mesh are parts of the input's edges and polygons.
//
// Labels tell what lies on a feature. A face with its three corners and its middle on a polygon is
// a part of it if the tetrahedron above it, on the normal's side, is not flat on the polygon: of
// one with four corners on it, flat but for rounding, the faces on its upper side are parts. So
// these make up the polygon, whatever is flat. Sides are by exact signs.
#pragma once

#include <array>
#include <vector>

#include "mesh/canonical.hpp"
#include "records/roles.hpp"
#include "records/vertex.hpp"
#include "space/polygons_at.hpp"
#include "space/validity.hpp"

namespace mesher::detail {

/// What tells which vertex lies on which feature.
struct Labelled {
  const VertexPool<3>& vertices;
  const Roles& roles;
  const FeatureStore& features;
  const SpaceNames& names;
  std::vector<const PolygonsAt*> polygons;  // together they have all polygons that are there

  [[nodiscard]] Role role(VertexHandle v) const noexcept {
    return vertices[v].on_segment ? roles[v] : Role();
  }
};

/// The parts of all features, of the mesh with these tetrahedra; corners ascend. An edge is called
/// by its segment, or else by the least polygon that has it. If the tetrahedra are only those at
/// some vertices: all parts at these, and some others.
/// Cost: O(m + f log f) for f simplices at features.
[[nodiscard]] OnFeatures on_features(const std::vector<std::array<VertexHandle, 4>>& simplices,
                                     const Labelled& labelled);

}  // namespace mesher::detail
