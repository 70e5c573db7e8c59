// The input of a mesh: points, and in the plane the lines between them, in space also polygons.
//
// In the plane a graph is a planar straight-line graph (PSLG), in space a piecewise linear complex
// (PLC). A graph is plain data; a file reader (read.hpp) or a program fills it.
//
// Example: a triangle that is a region.
//   using mesher::PointId, mesher::LineId;
//   mesher::Graph<2> graph;
//   graph.points = {{PointId{1}, {0, 0}}, {PointId{2}, {1, 0}}, {PointId{3}, {1, 1}}};
//   graph.polylines = {{LineId{1}, {PointId{1}, PointId{2}, PointId{3}, PointId{1}}}};
//   graph.seeds = {mesher::region_seed<2>(1, {0.6, 0.3}, 7.0)};  // its triangles have attribute 7
//
// mesh() and Mesher judge the geometry; the types here do not. Coordinates are 0 or of magnitude
// 2^-100 to 2^100.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "mesher/error.hpp"
#include "mesher/ids.hpp"
#include "mesher/mesh.hpp"
#include "mesher/names.hpp"

namespace mesher {

/// A point of the input.
template <int D>
struct GraphPoint {
  PointId id{};
  Point<D> at{};
  std::int64_t marker = 0;  ///< 0: none
  friend bool operator==(const GraphPoint&, const GraphPoint&) = default;
};

/// A line of the input between two of its points.
struct Segment {
  LineId id{};
  PointId from{}, to{};
  std::int64_t marker = 0;
  friend bool operator==(const Segment&, const Segment&) = default;
};

/// Segments from point to point under one id; closed if the last point is the first.
struct Polyline {
  LineId id{};
  std::vector<PointId> points{};  ///< two or more
  std::int64_t marker = 0;
  friend bool operator==(const Polyline&, const Polyline&) = default;
};

/// A flat piece of surface bounded by loops of points. A position in its plane is inside if an odd
/// number of loops go around it; the first loop goes around all others.
struct Polygon {
  PolygonId id{};
  std::vector<std::vector<PointId>> loops{};    ///< three points or more, either way around
  std::vector<std::array<PointId, 2>> edges{};  ///< between points, declared to lie inside
  std::vector<PointId> points{};                ///< declared to lie inside
  std::int64_t marker = 0;
  friend bool operator==(const Polygon&, const Polygon&) = default;
};

/// A position that marks the region around it, either as a hole, which is not meshed, or to give it
/// an attribute and a limit.
template <int D>
struct Seed {
  SeedId id{};
  Point<D> at{};
  double attribute = 0;  ///< for a region; finite
  /// For a region: the largest area of a triangle, or volume of a tetrahedron; > 0.
  std::optional<double> max_measure{};
  friend bool operator==(const Seed&, const Seed&) = default;
};

template <int D>
[[nodiscard]] Seed<D> hole_seed(std::int64_t number, const Point<D>& at) {
  return {hole_id(number), at};
}
template <int D>
[[nodiscard]] Seed<D> region_seed(std::int64_t number, const Point<D>& at, double attribute = 0,
                                  std::optional<double> max_measure = {}) {
  return {region_id(number), at, attribute, max_measure};
}

namespace detail {
template <int D>
struct GraphSurfaces {};
template <>
struct GraphSurfaces<3> {
  std::vector<mesher::Polygon> polygons;
  friend bool operator==(const GraphSurfaces&, const GraphSurfaces&) = default;
};
template <>
struct GraphSurfaces<2> {
  friend bool operator==(const GraphSurfaces&, const GraphSurfaces&) = default;
};
}  // namespace detail

/// The input of a mesh; in space also with `polygons`. Ids are distinct among points, among lines
/// (segments and polylines share one numbering), among polygons, and among seeds. D is 2 or 3.
template <int D>
struct Graph : detail::GraphSurfaces<D> {
  std::vector<GraphPoint<D>> points;
  std::size_t attributes_per_point = 0;
  std::vector<double> attributes;  ///< points.size() * attributes_per_point, finite, point by point
  std::vector<Segment> segments;
  std::vector<Polyline> polylines;
  std::vector<Seed<D>> seeds;
  GroupNames names{};  ///< of markers of lines and polygons, and of attributes of regions
  friend bool operator==(const Graph&, const Graph&) = default;

  [[nodiscard]] std::vector<Seed<D>> holes() const { return seeds_of(SeedKind::hole); }
  [[nodiscard]] std::vector<Seed<D>> regions() const { return seeds_of(SeedKind::region); }

 private:
  [[nodiscard]] std::vector<Seed<D>> seeds_of(SeedKind kind) const {
    std::vector<Seed<D>> found;
    for (const auto& s : seeds) {
      if (s.id.kind == kind) found.push_back(s);
    }
    return found;
  }
};

/// A graph read from a file, with the positions of its parts in the file: one for each element of
/// the array with the same name, none if the graph is from no file.
template <int D>
struct GraphFile {
  Graph<D> graph;
  std::string file;
  std::string point_file;  ///< `file`, or the .node file beside it
  std::vector<FilePosition> points, segments, polylines, polygons, seeds;
  std::vector<Note> notes;  ///< data in the file that is not used

  [[nodiscard]] FileLocation location_of_point(std::size_t i) const {
    return at(point_file, points[i]);
  }
  [[nodiscard]] FileLocation location_of_segment(std::size_t i) const {
    return at(file, segments[i]);
  }
  [[nodiscard]] FileLocation location_of_polyline(std::size_t i) const {
    return at(file, polylines[i]);
  }
  [[nodiscard]] FileLocation location_of_polygon(std::size_t i) const {
    return at(file, polygons[i]);
  }
  [[nodiscard]] FileLocation location_of_seed(std::size_t i) const { return at(file, seeds[i]); }

 private:
  static FileLocation at(const std::string& file, FilePosition p) {
    return {file, p.line, p.column};
  }
};

/// The location of a feature in the file; without a line if the file does not contain it. Cost:
/// O(n).
template <int D>
[[nodiscard]] FileLocation location_of(const Feature& feature, const GraphFile<D>& file);

/// The error with the locations of its features in the file.
template <int D>
[[nodiscard]] Error located(const Error& error, const GraphFile<D>& file);

/// Whether the graph is points without lines, polygons, seeds and markers: its mesh has no
/// features.
template <int D>
[[nodiscard]] bool is_bare(const Graph<D>& graph);

/// The coordinates of the points, in their order.
template <int D>
[[nodiscard]] std::vector<Point<D>> places_of(const Graph<D>& graph);

/// The segments, then the pieces of polylines; each piece has the id of its polyline.
template <int D>
[[nodiscard]] std::vector<Segment> segments_of(const Graph<D>& graph);

/// The graph with each polyline split into segments, numbered after the last line.
template <int D>
[[nodiscard]] Graph<D> without_polylines(Graph<D> graph);

/// The complex with adjacent polygons of one plane and one marker merged, under the least of their
/// ids. An edge between merged polygons disappears if no other feature has it; otherwise it is
/// declared to lie inside, as are points that are then on no loop. Requires: polygons and segments
/// name existing points.
/// Cost: O(n log n).
[[nodiscard]] Graph<3> with_merged_polygons(const Graph<3>& graph);

}  // namespace mesher
