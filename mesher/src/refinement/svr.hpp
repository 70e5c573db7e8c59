// Sparse Voronoi refinement [Hudson, Ch 2, 3]: a quality mesh of points, from scratch and fast.
//
// Refinement that starts from the Delaunay triangulation of all points is slow where that is large,
// quadratic for points on a line and a circle around it. Here the mesh begins with the box and one
// point, and has good quality all the time; other points are brought in as it becomes fine enough
// for them.
//
//   const auto mesh = mesher::svr<3>(points, {.domain = mesher::snapped_domain<3>(points)});
//
// Guarantees:
//  (1) every point is a vertex, bit for bit;
//  (2) it is the Delaunay triangulation of its vertices, ties decided by coordinates alone;
//  (3) no simplex has circumradius / shortest edge > rho;
//  (4) it is a function of the set of points and the options alone: not of their order, the ids, or
//      the machine.
// It is another mesh than that of mesh_statically, in space with fewer vertices, and a point more
// or less may change all of it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "mesher/graph.hpp"
#include "mesher/mesh.hpp"
#include "mesher/meshing.hpp"
#include "refinement/refine.hpp"

namespace mesher {

/// Where points wait that are no vertices yet [3.1]. The meshes are different ones, by the points
/// that are found first. For complexes it is voronoi.
enum class PointLocation : std::uint8_t {
  voronoi,         ///< at the vertex of the Voronoi cell, in a list
  voronoi_shells,  ///< the same, in concentric shells
  simplex,         ///< at the simplex that they are in
  circumball,      ///< at all simplices in whose circumballs they are
};

/// How SVR refines.
struct SvrSettings {
  /// The k of B(c, k r): instead of a new vertex at c, a point that is so near to it is inserted, r
  /// from c to the nearest vertices. In (0, 1).
  double k = 0.9;
  PointLocation location = PointLocation::voronoi;
};

/// The mesh. `options`: all count but extent and region_areas; `ids`: as many as points, for
/// errors (empty: 1..n).
/// Requires: ids.empty() || ids.size() == points.size().
/// Throws: Error (bad_option: as mesh_statically, and for another rule, or k out of range;
///         not_finite, magnitude, outside_domain, duplicate_point, too_close; too_many: beyond
///         options.max_vertices; cancelled), std::bad_alloc, what control.progress throws.
/// Cost: O(n log(spread) + m) for m vertices, where spread is the largest over the smallest
/// distance
///       of points. `stats` costs some 10%.
template <int D>
[[nodiscard]] Mesh<D> svr(const std::vector<Point<D>>& points, const Options<D>& options,
                          const SvrSettings& settings = {}, const std::vector<PointId>& ids = {},
                          SvrStats* stats = nullptr, const RunControl& control = {});

/// The same with segments. Same guarantees as the matching refine().
[[nodiscard]] Mesh<2> svr(const std::vector<Point<2>>& points, const std::vector<Segment>& segments,
                          const Options<2>& options, const RefinedExtent<2>& extent = {},
                          const SvrSettings& settings = {}, const std::vector<PointId>& ids = {},
                          SvrStats* stats = nullptr, const RunControl& control = {});

/// The same of a complex. Same guarantees as the matching refine().
[[nodiscard]] Mesh<3> svr(const std::vector<Point<3>>& points, const std::vector<Segment>& segments,
                          const std::vector<Polygon>& polygons, const Options<3>& options,
                          const RefinedExtent<3>& extent = {}, const SvrSettings& settings = {},
                          const std::vector<PointId>& ids = {}, SvrStats* stats = nullptr,
                          const RunControl& control = {});

}  // namespace mesher
