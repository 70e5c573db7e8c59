// Traditional Delaunay refinement [Hudson, Fig 2.1; Chew, Ruppert, Shewchuk]: the Delaunay
// triangulation of all points first, then new vertices in poor simplices until there is none.
//
//   const auto mesh = mesher::refine<2>(points, {.domain = mesher::snapped_domain<2>(points)});
//
// Same guarantees as svr(); a different mesh. Where the triangulation of the points is small, as of
// points that lie evenly (are_evenly_spread), it is made as soon or sooner; where that is large,
// much later, and it takes the memory of that triangulation.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "mesher/graph.hpp"
#include "mesher/mesh.hpp"
#include "mesher/meshing.hpp"

namespace mesher {

/// Which poor simplex is split first.
enum class RefineOrder : std::uint8_t {
  shortest_edge_first,  ///< mostly fewer vertices [Ungor]: 2% to 8% in the plane, to 4% in space
  largest_first,        ///< by the circumradius [Miller]: fewer simplices are made in bad inputs
};

struct RefineSettings {
  RefineOrder order = RefineOrder::shortest_edge_first;
  /// Whether the order is kept exactly, which is slow for some points in the plane [Fig 2.2]. Else
  /// only powers of two of squares are told apart [Fig 1.5]; of equals the last found goes first.
  bool strict = false;
};

/// Whether points lie so evenly that refine() is as fast as svr() or faster: their box, cut into up
/// to as many cubes, has points in at least 0.4 times as many, and in none more than 32.
/// Cost: O(n).
template <int D>
[[nodiscard]] bool are_evenly_spread(const std::vector<Point<D>>& points);

/// A region, by a place in it, with a limit of size of its own.
template <int D>
struct LimitedRegion {
  Point<D> at{};
  double max_measure = 0;
};

/// What of a graph or a complex is refined: all, or what segments (in space polygons) enclose, if
/// they enclose anything, less the holes at these places. Other simplices may be poor, and of any
/// size.
template <int D>
struct RefinedExtent {
  bool only_enclosed = false;
  std::vector<Point<D>> holes{};            ///< one on a segment, in space on a polygon, is none
  std::vector<LimitedRegion<D>> regions{};  ///< the same holds; of several in one the first counts
};

/// The mesh. `options`: all count but extent and region_areas; `ids`: as many as points, for
/// errors (empty: 1..n).
/// Requires: ids.empty() || ids.size() == points.size().
/// Throws: Error (bad_option: as mesh_statically, and for another rule;
///         not_finite, magnitude, outside_domain, duplicate_point, too_close; too_many: beyond
///         options.max_vertices; cancelled), std::bad_alloc, what control.progress throws.
/// Cost: that of the Delaunay triangulation of the points, and of the simplices that are made.
template <int D>
[[nodiscard]] Mesh<D> refine(const std::vector<Point<D>>& points, const Options<D>& options,
                             const RefineSettings& settings = {},
                             const std::vector<PointId>& ids = {}, RefineStats* stats = nullptr,
                             const RunControl& control = {});

/// The same with segments between the points, named by their ids: every segment is a union of edges
/// of the mesh. A triangle is poor only where segments meet at under 60 degrees, its shortest edge
/// from one to the other, at equal distances. Not for `strict`; rho is 1.4142 or more: there no
/// input was found that asks for vertices without end; max_vertices ends it if one does.
/// Throws: also Error as mesh_statically of these.
[[nodiscard]] Mesh<2> refine(const std::vector<Point<2>>& points,
                             const std::vector<Segment>& segments, const Options<2>& options,
                             const RefinedExtent<2>& extent = {},
                             const RefineSettings& settings = {},
                             const std::vector<PointId>& ids = {}, RefineStats* stats = nullptr,
                             const RunControl& control = {});

/// The same of a complex: its edges are unions of edges of the mesh, its polygons unions of faces.
/// A simplex is poor only where features meet at a small angle. Not for `strict`; rho is 2 or more.
/// Throws: also Error as mesh_statically of these.
[[nodiscard]] Mesh<3> refine(const std::vector<Point<3>>& points,
                             const std::vector<Segment>& segments,
                             const std::vector<Polygon>& polygons, const Options<3>& options,
                             const RefinedExtent<3>& extent = {},
                             const RefineSettings& settings = {},
                             const std::vector<PointId>& ids = {}, RefineStats* stats = nullptr,
                             const RunControl& control = {});

}  // namespace mesher
