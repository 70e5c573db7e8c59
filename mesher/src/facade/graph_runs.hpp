// Each algorithm on a graph; what the mesh is given by features.
#pragma once

#include <memory>
#include <vector>

#include "facade/mesh_statically.hpp"
#include "graph/has_features.hpp"
#include "mesher/domain.hpp"
#include "mesher/graph.hpp"
#include "mesher/meshing.hpp"
#include "refinement/refine.hpp"
#include "refinement/svr.hpp"

namespace mesher {

/// The mesh of a graph's points and lines in the box. Throws: as mesh_statically of these.
template <int D>
[[nodiscard]] Mesh<D> mesh_statically(const Graph<D>& graph, const Options<D>& options,
                                      MeshStats* stats = nullptr, const RunControl& control = {});
/// The same by other algorithms, good in `extent`.
template <int D>
[[nodiscard]] Mesh<D> refine(const Graph<D>& graph, const Options<D>& options,
                             Extent extent = Extent::box, const RefineSettings& settings = {},
                             RefineStats* stats = nullptr, const RunControl& control = {});
template <int D>
[[nodiscard]] Mesh<D> svr(const Graph<D>& graph, const Options<D>& options,
                          Extent extent = Extent::box, const SvrSettings& settings = {},
                          SvrStats* stats = nullptr, const RunControl& control = {});

/// A mesh of `graph` with origins, edges on lines, and the markers of the graph's points and lines;
/// in space with faces in polygons: there an edge on no segment with a marker has the least of the
/// markers of polygons that it bounds or lies in.
/// Requires: `mesh` is that of its points and lines. Cost: O(m + n log n).
[[nodiscard]] MeshData<2> with_features(Mesh<2> mesh, const Graph<2>& graph);
[[nodiscard]] MeshData<3> with_features(Mesh<3> mesh, const Graph<3>& graph);

/// For Options::region_limits: limits of size count in the part of the domain that is wanted, and
/// those of regions there, if that is asked for. They are found in the mesh that `options` give the
/// graph without limits: lines are unions of its edges, and polygons of its faces, as of all
/// others'. Throws: as mesh_statically and find_domain. Cost: that of this mesh.
template <int D>
[[nodiscard]] std::shared_ptr<const RegionLimits<D>> region_limits(
    const Graph<D>& graph, const Options<D>& options, Extent extent,
    RegionAreas areas = RegionAreas::ignored);

/// Announces all of `graph` to a Mesher, or to what takes no seeds and markers.
/// Throws: Error as their functions do; what came before stays pending.
template <int D, class Target>
void announce(const Graph<D>& graph, Target& target) {
  if constexpr (requires { target.insert_seed(Seed<D>()); }) {
    for (const auto& p : graph.points) target.insert(p.id, p.at, p.marker);
    for (const auto& s : graph.segments) target.insert_segment(s.id, s.from, s.to, s.marker);
    for (const auto& l : graph.polylines) target.insert_polyline(l.id, l.points, l.marker);
    for (const auto& seed : graph.seeds) target.insert_seed(seed);
  } else {
    for (const auto& p : graph.points) target.insert(p.id, p.at);
    for (const auto& s : graph.segments) target.insert_segment(s.id, s.from, s.to);
    for (const auto& l : graph.polylines) target.insert_polyline(l.id, l.points);
  }
  if constexpr (D == 3) {
    for (const auto& f : graph.polygons) target.insert_polygon(f);
  }
}

}  // namespace mesher
