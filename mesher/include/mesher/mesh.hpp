// The plain values that go into the mesher and come out of it: points, boxes, options, meshes.
//
// A `Mesh` is canonical: it depends on the set of vertices and simplices alone, so two meshes of
// the same input compare equal however they were reached.
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "mesher/ids.hpp"

namespace mesher {

/// Coordinates, input length units, finite.
template <int D>
using Point = std::array<double, D>;

/// A closed axis-aligned box: lo[i] <= hi[i].
template <int D>
struct Box {
  Point<D> lo{};
  Point<D> hi{};
  friend bool operator==(const Box&, const Box&) = default;
};

/// Which point to insert into a poor region.
enum class Rule : std::uint8_t {
  radius_edge,  ///< off-centre of a simplex whose circumradius exceeds rho times its shortest edge
  voronoi_aspect,  ///< the paper's rule [Def 4.2.3]: no gap ball larger than rho * NN(v)
};

/// Where a vertex comes from.
enum class VertexKind : std::uint8_t {
  steiner = 0,
  boundary = 1,  ///< on the boundary grid
  input = 2,
  segment = 3,  ///< between the ends of a line of the input; in space also on a polygon
};

/// A line of the input between two of its points. Several may share an id: a polyline.
struct Segment {
  FeatureId id{};
  FeatureId from{}, to{};  ///< points
  friend bool operator==(const Segment&, const Segment&) = default;
};

/// A flat piece of surface between loops of points. A place is in it if an odd number of loops go
/// around it; the first loop goes around all others.
struct Polygon {
  FeatureId id{};
  std::vector<std::vector<FeatureId>> loops;      ///< points, three or more, either way around
  std::vector<std::array<FeatureId, 2>> edges{};  ///< between points, declared to lie inside
  std::vector<FeatureId> points{};                ///< declared to lie inside
  friend bool operator==(const Polygon&, const Polygon&) = default;
};

template <int D>
class SizeField;

/// Limits of size: areas of triangles, volumes of tetrahedra; in input units, squared or cubed.
template <int D>
struct SizeLimits {
  double max_measure = 0;  ///< of a simplex with its centroid where this holds; 0: no limit
  std::shared_ptr<const SizeField<D>> sizes{};  ///< limits that vary, see sizes.hpp; null: none
  friend bool operator==(const SizeLimits&, const SizeLimits&) = default;
};

/// Limits of size in a closed box.
template <int D>
struct BoxLimits {
  Box<D> box{};
  SizeLimits<D> limits{};
  friend bool operator==(const BoxLimits&, const BoxLimits&) = default;
};

/// The last box with a place counts. (A class of its own: g++ 12 fails on a vector in Options where
/// these are the default of a member.)
template <int D>
struct AllBoxLimits : std::vector<BoxLimits<D>> {
  using std::vector<BoxLimits<D>>::vector;
  AllBoxLimits() noexcept {}
};

/// Where limits of size count, and those of regions: see region_limits in domain_mesh.hpp.
template <int D>
class RegionLimits;

/// What to mesh, and how well.
template <int D>
struct Options {
  Box<D> domain{};      ///< where input points may lie; must not be empty
  double rho = D == 2 ? 1.4142 : 2;  ///< bound of circumradius over shortest edge; in (1.01, 100]
  Rule rule = Rule::radius_edge;
  /// The largest area of a triangle, or volume of a tetrahedron, with its centroid in the domain;
  /// 0: no limit.
  double max_measure = 0;
  std::shared_ptr<const SizeField<D>> sizes{};  ///< limits that vary, see sizes.hpp; null: none
  AllBoxLimits<D> box_limits{};  ///< instead of these; the last box with a place counts
  std::shared_ptr<const RegionLimits<D>> region_limits{};  ///< null: limits count everywhere
  std::size_t max_vertices = 0;  ///< more are refused with Error(too_many); 0: no limit
  bool record_weights = false;  ///< keeps what calls do inside, for those who study the trace
};

/// A triangulation of the meshing box.
/// Vertices are in lexicographic order of coordinates. A simplex lists D+1 vertex indices,
/// smallest first, positively oriented; simplices are in lexicographic order.
template <int D>
struct Mesh {
  using Simplex = std::array<std::uint32_t, D + 1>;
  /// An edge on a line of the input, or in space on an edge of its polygons; low < high.
  struct Edge {
    std::uint32_t low = 0, high = 0;
    FeatureId line{};
    bool of_polygon = false;  ///< no segment has it: `line` is the least polygon that does
    friend auto operator<=>(const Edge&, const Edge&) = default;
  };
  /// A face in a polygon of the input; corners ascend.
  struct Face {
    std::array<std::uint32_t, 3> corners{};
    FeatureId polygon{};
    friend auto operator<=>(const Face&, const Face&) = default;
  };
  std::vector<Point<D>> vertices;
  std::vector<VertexKind> kinds;  ///< one per vertex
  std::vector<Simplex> simplices;
  std::vector<Edge> edges;  ///< those on lines, in lexicographic order
  std::vector<Face> faces;  ///< those in polygons, likewise; in the plane none
  friend bool operator==(const Mesh&, const Mesh&) = default;
};

/// The domain used when none is given: the bounding box of `points`, each side moved outward to a
/// multiple of a power of two (an eighth to a quarter of the longest side), so that meshes before
/// and after most edits share it. `points`: n x D, finite; n = 0 gives the unit box.
template <int D>
[[nodiscard]] Box<D> snapped_domain(const std::vector<Point<D>>& points);

}  // namespace mesher
