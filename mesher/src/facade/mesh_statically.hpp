// The algorithms of BoxMesher without the engine.
#pragma once

#include <vector>

#include "mesher/graph.hpp"
#include "mesher/mesher.hpp"

namespace mesher {

/// The same algorithms without the engine: the mesh that BoxMesher would have after inserting
/// `points`, bit for bit. `points`: n x D; `ids`: as many, only used in errors (empty: 1..n).
/// Requires: ids.empty() || ids.size() == points.size().
/// Throws: Error (bad_option, cancelled, and as BoxMesher::insert and update), std::bad_alloc, what
/// control.progress throws.
template <int D>
[[nodiscard]] Mesh<D> mesh_statically(const std::vector<Point<D>>& points,
                                      const Options<D>& options,
                                      const std::vector<PointId>& ids = {},
                                      MeshStats* stats = nullptr, const RunControl& control = {});

/// The same with segments between the points, named by their ids: every segment is a union of edges
/// of the mesh. Throws also: Error(bad_option) unless options.rule is radius_edge;
/// Error(unknown_id).
[[nodiscard]] Mesh<2> mesh_statically(const std::vector<Point<2>>& points,
                                      const std::vector<Segment>& segments,
                                      const Options<2>& options,
                                      const std::vector<PointId>& ids = {},
                                      MeshStats* stats = nullptr, const RunControl& control = {});

/// The same in space, with polygons.
[[nodiscard]] Mesh<3> mesh_statically(const std::vector<Point<3>>& points,
                                      const std::vector<Segment>& segments,
                                      const std::vector<Polygon>& polygons,
                                      const Options<3>& options,
                                      const std::vector<PointId>& ids = {},
                                      MeshStats* stats = nullptr, const RunControl& control = {});

}  // namespace mesher
