// Plain values: points, boxes, options, meshes.
//
// A `Mesh` is canonical: it depends only on the sets of vertices and simplices, so two meshes of
// the same input compare equal, whatever edits led to them.
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "mesher/error.hpp"
#include "mesher/ids.hpp"
#include "mesher/names.hpp"

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

/// The rule that chooses a new vertex where the mesh is poor.
enum class Rule : std::uint8_t {
  radius_edge,  ///< off-centre of a simplex whose circumradius exceeds rho times its shortest edge
  voronoi_aspect,  ///< the paper's rule [Def 4.2.3]: no gap ball larger than rho * NN(v)
};

/// The origin of a vertex.
enum class VertexKind : std::uint8_t {
  steiner = 0,   ///< added by the mesher
  boundary = 1,  ///< on the boundary grid
  input = 2,
  segment = 3,  ///< in the interior of a line of the input; in space also on a polygon
};

template <int D>
class SizeField;

/// Limits of size: areas of triangles, volumes of tetrahedra; in input units, squared or cubed.
template <int D>
struct SizeLimits {
  double max_measure = 0;  ///< of a simplex with its centroid where these limits hold; 0: no limit
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

/// Limits of size in boxes: at each position, the last box that contains it counts. (A class of its
/// own: g++ 12 fails on a vector in Options where these are the default of a member.)
template <int D>
struct AllBoxLimits : std::vector<BoxLimits<D>> {
  using std::vector<BoxLimits<D>>::vector;
  AllBoxLimits() noexcept {}
};

/// Where limits of size count, and the limits of regions: see Options::region_limits.
template <int D>
class RegionLimits;

/// The part of the mesh that is kept.
enum class Extent : std::uint8_t {
  enclosed,  ///< what lines (in space polygons) enclose, without the holes; everything if they
             ///< enclose nothing
  box,       ///< the whole box around the domain
};

/// The algorithm that makes a mesh. Each makes a different mesh.
enum class Algorithm : std::uint8_t {
  automatic,  ///< the fastest of the others that supports the options and the input
  refine,     ///< Delaunay refinement, from the triangulation of all points [Fig 2.1]
  svr,        ///< sparse Voronoi refinement [Ch 2, 3]
  gap_balls,  ///< the mesh that a Mesher keeps under edits [Ch 4]
};

/// Whether the max_measure of a region is a limit of size.
enum class RegionAreas : std::uint8_t { ignored, limits };

namespace detail {
/// The type of an option that only space has: in the plane nothing can be assigned to it.
struct InSpaceAlone {
  friend bool operator==(const InSpaceAlone&, const InSpaceAlone&) = default;
};
}  // namespace detail

/// Options of mesh() and Mesher.
template <int D>
struct Options {
  /// The box in which input points may lie. mesh() uses snapped_domain of the points if it is left
  /// out.
  Box<D> domain{};
  double rho = D == 2 ? 1.4142 : 2;  ///< bound of circumradius over shortest edge; in (1.01, 100]
  Rule rule = Rule::radius_edge;
  /// The largest area of a triangle, or volume of a tetrahedron, with its centroid in the domain;
  /// 0: no limit.
  double max_measure = 0;
  std::shared_ptr<const SizeField<D>> sizes{};  ///< limits that vary, see sizes.hpp; null: none
  /// Override the limits above in boxes; the last box that contains a position counts.
  AllBoxLimits<D> box_limits{};
  std::shared_ptr<const RegionLimits<D>> region_limits{};  ///< null: limits count everywhere
  std::size_t max_vertices = 0;  ///< more cause Error(too_many); 0: no limit
  bool record_weights = false;   ///< counts the steps inside calls, for studies of the trace
  Extent extent = Extent::enclosed;
  RegionAreas region_areas = RegionAreas::ignored;
  Algorithm algorithm = Algorithm::automatic;  ///< for mesh(); a Mesher always uses gap_balls
  /// In degrees, at most 29.6. A value above 0 replaces rho by 1 / (2 sin(min_angle)): no angle of
  /// a triangle (in space: of a face of a tetrahedron) is smaller.
  double min_angle = 0;
  /// By how much sizes grow from one simplex to the next, from 1.05 to 100; 0: by any factor. At a
  /// distance d from a vertex with edges of length e, simplices are at most about as large as
  /// regular ones with edges of e + (growth - 1) d. For refine and svr. Users ask for 1.2 to 1.5.
  double growth = 0;
  /// In degrees, at most 20, in space only; 0: no bound. Tetrahedra with a smaller dihedral angle
  /// are split where that makes it larger [Li, Teng 2001]: few remain, but where features meet at
  /// small angles; there refine and svr leave fewer than gap_balls. A Mesher keeps the bound as its
  /// mesh follows edits. For the rule radius_edge. Users of solvers ask for 10 to 12.
  std::conditional_t<D == 3, double, detail::InSpaceAlone> min_dihedral{};
  /// Of a Mesher: the box is cut into as many tiles, each with a thread. The mesh is that of one
  /// thread, to the last bit. The first update that brings a line or a polygon costs a first run.
  /// From 1 to 256.
  int threads = 1;
};

/// The bounds of threads.
inline constexpr int kMostThreads = 256;

/// The largest min_angle, in degrees, that bounds on the radius-edge ratio allow.
inline constexpr double kLargestMinAngle = 29.6;

/// The largest min_dihedral, in degrees: beyond it points need many vertices.
inline constexpr double kLargestMinDihedral = 20;

/// The bounds of growth.
inline constexpr double kLeastGrowth = 1.05, kMostGrowth = 100;

/// The bound on the radius-edge ratio: 1 / (2 sin(min_angle)) if min_angle is above 0, else rho.
template <int D>
[[nodiscard]] double radius_edge_bound(const Options<D>& options);

/// A triangulation of the meshing box.
/// Vertices are in lexicographic order of coordinates. A simplex lists D+1 vertex indices,
/// smallest first, positively oriented; simplices are in lexicographic order.
template <int D>
struct Mesh {
  using Simplex = std::array<std::uint32_t, D + 1>;
  /// An edge on a line of the input, or in space on an edge of its polygons; low < high.
  struct Edge {
    std::uint32_t low = 0, high = 0;
    Feature feature{};  ///< the line; if no line has the edge, the polygon with the least id
    friend auto operator<=>(const Edge&, const Edge&) = default;
  };
  /// A face in a polygon of the input; corners ascend.
  struct Face {
    std::array<std::uint32_t, 3> corners{};
    PolygonId polygon{};
    friend auto operator<=>(const Face&, const Face&) = default;
  };
  std::vector<Point<D>> vertices;
  std::vector<VertexKind> kinds;  ///< one per vertex
  std::vector<Simplex> simplices;
  std::vector<Edge> edges;  ///< edges on lines, in lexicographic order
  std::vector<Face> faces;  ///< faces in polygons, in lexicographic order; none in the plane
  friend bool operator==(const Mesh&, const Mesh&) = default;
};

/// The default domain: the bounding box of `points`, each side moved outward to a multiple of a
/// power of two (an eighth to a quarter of the longest side), so that meshes before and after most
/// edits share it. `points`: n x D, finite; n = 0 gives the unit box.
template <int D>
[[nodiscard]] Box<D> snapped_domain(const std::vector<Point<D>>& points);

/// An edge of a mesh that lies on a line of the input, or on the boundary; low < high.
struct MeshEdge {
  std::uint32_t low = 0, high = 0;  ///< vertices
  std::optional<LineId> line{};     ///< the segment or polyline; nothing if none or not known
  std::int64_t marker = 0;          ///< of the line, or of the boundary
  friend bool operator==(const MeshEdge&, const MeshEdge&) = default;
};

/// A face of a mesh of tetrahedra that lies in a polygon of the input, or on the boundary.
/// Corners: the smallest first; on the boundary counterclockwise seen from outside, else ascending.
struct MeshFace {
  std::array<std::uint32_t, 3> corners{};  ///< vertices
  std::optional<PolygonId> polygon{};      ///< nothing if none or not known
  std::int64_t marker = 0;                 ///< of the polygon, or of the boundary

  /// The corners in ascending order: the same key for both sides.
  [[nodiscard]] std::array<std::uint32_t, 3> key() const {
    const auto [a, b, c] = corners;
    return b < c ? corners : std::array<std::uint32_t, 3>{a, c, b};
  }
  friend bool operator==(const MeshFace&, const MeshFace&) = default;
};

/// Two sides of a mesh that fit together (periodic.hpp): lines of one marker, and the same lines,
/// moved.
struct PeriodicSides {
  std::int64_t from = 0, to = 0;                         ///< the markers
  Position translation{};                                ///< from `from` to `to`
  std::vector<std::array<std::uint32_t, 2>> vertices{};  ///< of `from`, of `to`; ascending
  friend bool operator==(const PeriodicSides&, const PeriodicSides&) = default;
};

/// Features of a mesh. An empty array means: not known.
struct MeshFeatures {
  /// One per vertex: its input point, or the line that it lies on, or in space the polygon if it is
  /// on no line; none for vertices of other kinds.
  std::vector<Feature> origins;
  std::vector<std::int64_t> markers;  ///< one per vertex; 0: none
  std::vector<double> regions;        ///< one per simplex: the attribute of its region, finite
  std::vector<MeshEdge> edges;        ///< ascending by (low, high), without duplicates
  std::vector<MeshFace> faces;        ///< in space; ascending by key(), without duplicates
  GroupNames names{};                 ///< of markers of edges and faces, and of regions
  std::vector<PeriodicSides> periodic{};

  /// Whether there are none; names alone are none.
  [[nodiscard]] bool empty() const {
    return origins.empty() && markers.empty() && regions.empty() && edges.empty() && faces.empty();
  }
  friend bool operator==(const MeshFeatures&, const MeshFeatures&) = default;
};

/// A mesh with its features, read from a file or made to be written to one.
template <int D>
struct MeshData : Mesh<D> {
  MeshFeatures features;
  std::vector<Note> notes;  ///< data in the file that is not used

  MeshData() = default;
  explicit MeshData(Mesh<D> mesh, MeshFeatures of = {})
      : Mesh<D>(std::move(mesh)), features(std::move(of)) {}
};

/// A mesh of a file with either dimension.
using AnyMesh = std::variant<MeshData<2>, MeshData<3>>;

/// No neighbour: the edge is on the boundary.
inline constexpr std::uint32_t kNoTriangle = UINT32_MAX;

/// For each triangle, the triangles across from its corners, or kNoTriangle.
/// Requires: no edge borders more than two triangles. Cost: O(m log d) for vertices of degree d.
[[nodiscard]] std::vector<std::array<std::uint32_t, 3>> neighbours(const Mesh<2>& mesh);

/// The edges of all triangles, (low, high) ascending. Cost: O(m log d).
[[nodiscard]] std::vector<std::array<std::uint32_t, 2>> edges(const Mesh<2>& mesh);

}  // namespace mesher
