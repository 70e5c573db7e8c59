// Which edges and faces of a mesh are parts of the input's edges and polygons.
//
// Labels tell what lies on a feature. A face with its three corners on a polygon is a part of it if
// its Voronoi edge, which joins the centres on both of its sides, crosses the polygon [rules C3]: a
// plane's slice of a Voronoi diagram is the dual of a triangulation, so these faces are one,
// whatever the rest of the mesh is like there. On which side of the plane a centre is, is found
// once for a tetrahedron; so tetrahedra that are flat but for rounding are on one side, and do no
// harm.
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
