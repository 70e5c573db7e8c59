// Measures the quality of a mesh, and checks independently that the mesh is correct.
//
// Example:
//   mesher::CheckOptions<2> options;
//   options.graph = &lake;  // a GraphFile<2>
//   options.rho = 1.4142;
//   for (const auto& f : mesher::check_mesh(mesh, options)) ... f.property, f.holds, f.detail ...
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "mesher/graph.hpp"
#include "mesher/mesh.hpp"
#include "mesher/read.hpp"
#include "mesher/write.hpp"

namespace mesher {

// Triangle meshes. `check_mesh` shares no code with the mesher except the exact predicates. It
// checks these properties in this order, and skips a property if one that it relies on does not
// hold:
//   (1) coordinates: every coordinate of a vertex is 0 or of magnitude 2^-160 to 2^101, and all are
//       multiples of one power of two, at most 253 bits below the largest;
//   (2) vertices: no two coincide, and each is a corner of a triangle;
//   (3) orientation: the corners of every triangle are in counterclockwise order;
//   (4) edges: each edge borders one triangle, or two on opposite sides;
//   then, if the mesh has to fill a box,
//   (5) hull: the edges with one triangle go around the bounding box once;
//   (6) euler: vertices - edges + triangles = 1. With (1) to (5), the triangles then tile the box;
//   otherwise
//   (5') overlap: no two triangles overlap. The edges with one triangle, each with its triangle on
//        the left, wind around every point of the plane once or not at all, and meet only at
//        vertices. With (1) to (4) this test is exact: the number of triangles that cover a point
//        of the plane is the number of times that those edges wind around it. A mesh of an input
//        with holes may have no triangles, since all that the lines enclose may be holes;
//   (6') boundary, if requested: the edges with one triangle are on lines or on sides of the
//        bounding box;
//   (7) delaunay: for no edge is the opposite corner of one triangle inside the circumcircle of the
//       other. If the mesh has lines, (c) checks the edges on lines instead;
//   (8) input, if requested: every input point is a vertex, bit for bit, or, unless the mesh has to
//       fill a box, in no triangle;
//   (9) quality, if requested: no triangle has a circumradius above rho times its shortest edge (by
//       more than rounding, 10^-9 of it), except at small angles between lines. The lines are those
//       of the input if it is given, else those of MeshFeatures;
//   and for meshes with lines
//   (a) lines: every edge of MeshFeatures is an edge of a triangle;
//   (b) segments: every segment, and every piece of a polyline, is a union of edges: a path from
//       end to end whose vertices are on it up to rounding (2^-48 of the largest coordinate). Edges
//       of MeshFeatures that name the line are tried first, and an edge that names a line is on
//       that line. Unless the mesh has to fill a box, the parts of a line outside the mesh may be
//       missing;
//   (c) conforming: (7) for the edges on lines;
//   (d) regions: triangles on both sides of an edge that is on no line have the same region; if
//       seeds are given, it is the region of a seed inside; no triangle contains the seed of a
//       hole, unless the mesh has to fill a box. A seed on a line has no effect, and neither has a
//       region's seed in the same region as a hole's seed;
//   (e) area, if requested: no triangle is larger than a limit;
//   (f) markers, if both the input and the mesh have some: a vertex that is an input point with a
//       marker has that marker; every other vertex, and every edge, has the marker of one of the
//       lines with a marker that it is on, whether that part of the line is in the mesh or outside.
//       If it is on no such line, the marker is 0, or 1 on the boundary of the mesh. Markers of
//       edges are checked only if some edge has one.

/// Measures of the worst triangles of a mesh.
struct Quality {
  double min_angle_deg = 0;    ///< NaN if there are no triangles
  double max_radius_edge = 0;  ///< circumradius over shortest edge; NaN likewise
};

/// Measures the triangles of a mesh. Cost: O(m).
[[nodiscard]] Quality quality(const Mesh<2>& mesh);

/// Circumradius over shortest edge of the triangle abc. Requires: a, b, c not collinear.
[[nodiscard]] double radius_edge(const Point<2>& a, const Point<2>& b, const Point<2>& c);
/// The smallest angle of the triangle abc.
[[nodiscard]] double smallest_angle_deg(const Point<2>& a, const Point<2>& b, const Point<2>& c);

/// One property of a mesh as `check_mesh` found it.
struct Finding {
  std::string property;  ///< "coordinates", "vertices", ... as above
  bool holds = false;
  std::string detail;  ///< the first violation, or what was checked
};

/// Where the edges with one triangle must be (in space, the faces with one tetrahedron).
enum class BoundaryRule : std::uint8_t {
  box,    ///< the sides of the bounding box
  lines,  ///< edges on lines, or sides of the bounding box
  any,    ///< along any polygons; in space, on the boundary of any convex body
};

/// The boundary rule for a mesh whose extent is not given: `box` if there are no lines, or if the
/// mesh fills its bounding box and a corner of the box is no point of `graph`, so that lines do not
/// enclose the box; else `lines`.
/// Cost: O(m log m).
[[nodiscard]] BoundaryRule boundary_rule(const MeshData<2>& mesh, const GraphFile<2>* graph);

namespace detail {
template <int D>
struct CheckOptionsOf;
template <>
struct CheckOptionsOf<2> {
  bool constrained = false;  ///< skips (c)
};
template <>
struct CheckOptionsOf<3> {
  bool ties = false;           ///< checks (8)
  bool near_delaunay = false;  ///< checks (7) with the tolerance kNearSphere, as for
                               ///< without_flat_tetrahedra (improve.hpp)
};
}  // namespace detail

/// What to check a mesh against. The plane also has `constrained`, space `ties` and
/// `near_delaunay`. Numbers refer to the list above (in the plane), then to the list below (in
/// space).
template <int D>
struct CheckOptions : detail::CheckOptionsOf<D> {
  /// The input. Needed for (8), (b), (f) and seeds in (d); in space for (9), (10), (b), (c), (d)
  /// and seeds in (e).
  const GraphFile<D>* graph = nullptr;
  std::optional<double> rho{};  ///< needed for (9); in space for (11)
  BoundaryRule boundary = BoundaryRule::box;
  /// The features of the mesh. Needed for (a), (d), (f); tells which edges are on lines. In space
  /// needed for (a), (c) to (e); gives the origins for (10).
  const MeshFeatures* features = nullptr;
  std::optional<double> max_measure{};  ///< needed for (e); in space for (12)
};

/// Checks a mesh and returns one finding for each property, in order. The list ends early if a
/// property fails that the next ones need. Findings name vertices and triangles by their number in
/// the mesh, from 1. Cost: O(m log m).
[[nodiscard]] std::vector<Finding> check_mesh(const Mesh<2>& mesh, const CheckOptions<2>& options);

// Tetrahedron meshes. `check_mesh` shares no code with the mesher except the exact predicates, and
// circumcentres computed as exact quotients where doubles are too coarse. It checks these
// properties in this order, and skips a property if one that it relies on does not hold:
//   (1) coordinates: every coordinate of a vertex is 0 or of magnitude 2^-160 to 2^101, and all are
//       multiples of one power of two, at most 253 bits below the largest;
//   (2) vertices: no two coincide, and each is a corner of a tetrahedron;
//   (3) orientation: every tetrahedron is positively oriented (predicates.hpp);
//   (4) faces: each face belongs to one tetrahedron, or to two on opposite sides;
//   (5) hull: the faces with one tetrahedron are on the sides of the bounding box or, if the mesh
//       may be any convex body, on planes with all vertices on one side;
//   (6) cover: a position inside the first tetrahedron with enough room is in no other. With (1) to
//       (5), the tetrahedra then fill the box, or the convex hull, without gap or overlap: by (3)
//       and (4), equally many tetrahedra cover both sides of an inner face, so that number changes
//       only at faces with one tetrahedron, and by (5) these are on the hull;
//   (7) delaunay: for no face is the opposite corner of one tetrahedron inside the circumsphere of
//       the other; or, with near_delaunay, farther inside than kNearSphere times the radius;
//   (8) ties, if requested: an opposite corner on that sphere counts as outside by the rule of
//       predicates::insphere_perturbed; the mesh is then the only one of its vertices;
//   (9) input, if requested: every input point is a vertex, bit for bit;
//  (10) kinds, if a vertex has another kind than `steiner`: vertices of kind `boundary` are on the
//       bounding box; with an input, vertices of kind `input` are its points, with their ids if the
//       mesh gives origins;
//  (11) quality, if requested: no tetrahedron, those outside the domain included, has a
//       circumradius above rho times its shortest edge (by more than its rounding and 10^-9 of it),
//       except at small angles of the complex. Those are tetrahedra whose shortest edge joins two
//       features that share an edge or a point which is farther from both ends than the ends are
//       from each other, or two features at a point from which both ends are equally far. For rho
//       below kGuarded, tetrahedra whose shortest edge is isolated beside a segment or polygon are
//       excepted too (reports.hpp);
//  (12) volume, if requested: no tetrahedron is larger than a limit (by more than 10^-9 of it);
//   and for meshes with features
//   (a) parts: every edge and face of MeshFeatures belongs to a tetrahedron;
//   (b) segments, if a complex is given: every segment, and every edge of a polygon, is a union of
//       edges: a path from end to end whose vertices are on it up to rounding (2^-48 of the largest
//       coordinate). If the mesh holds only what polygons enclose, the parts outside may be
//       missing;
//   (c) polygons, if a complex is given: every polygon is a union of faces. They are the faces that
//       MeshFeatures assign to it, or, if MeshFeatures name no polygon, the faces with corners on
//       its plane whose Voronoi edge crosses the polygon (on the boundary: whose middle is in the
//       polygon). Their corners are on the polygon, up to rounding and the deviation of the
//       polygon's own corners; each of their edges belongs to two of them, or to one and lies on an
//       edge of the polygon; and their areas add up to the polygon's, up to 10^-9 and the rounding
//       of vertices on its border. If the mesh holds only what polygons enclose, parts of a polygon
//       between edges that it declares may be outside: beside such an edge there is then a face, or
//       no tetrahedron;
//   (d) markers, if both complex and mesh have some: a vertex has the marker of its point, or else
//       of a segment or polygon that it is on, whether that part is in the mesh or outside; an edge
//       has the marker of its segment, or else of a polygon that it is on; a face has the marker of
//       its polygon; anything on no feature has no marker, or possibly 1 on the boundary;
//   (e) regions: tetrahedra on both sides of a face in no polygon have the same region; if seeds
//       are given, it is the region of a seed inside; no tetrahedron contains the seed of a hole,
//       unless the mesh has to fill a box. A seed on a polygon has no effect, and neither has a
//       region's seed in the same region as a hole's seed.
// If the mesh need not be convex, (5) says that faces with one tetrahedron are on the box or in
// polygons, and there may be no tetrahedra if the complex has holes; (6) then tests a position in
// each connected part, and beside each part of the boundary: by (c), and since polygons do not
// cross, the boundary does not cross itself.

/// Tetrahedra with a dihedral angle below this are slivers.
inline constexpr double kSliverDegrees = 5;

/// A vertex inside a sphere by less than this fraction of its radius may be there by rounding.
inline constexpr double kNearSphere = 0x1p-20;

/// Measures of the worst tetrahedra of a mesh; angles and ratio are NaN if there are none.
struct SpaceQuality {
  double min_dihedral_deg = 0;
  double max_dihedral_deg = 0;
  double max_radius_edge = 0;  ///< circumradius over shortest edge
  std::size_t slivers = 0;
};

/// Measures the tetrahedra of a mesh. Requires: tetrahedra are positively oriented. Cost: O(m).
[[nodiscard]] SpaceQuality quality(const Mesh<3>& mesh);

/// Counts the tetrahedra whose circumradius exceeds rho times their shortest edge by more than its
/// rounding and 10^-9 of it. Cost: O(m).
[[nodiscard]] std::size_t count_above(const Mesh<3>& mesh, double rho);

/// The boundary rule for a mesh whose extent is not given: as in the plane, with polygons in place
/// of lines.
[[nodiscard]] BoundaryRule boundary_rule(const MeshData<3>& mesh, const GraphFile<3>* complex);

/// Checks a mesh and returns one finding for each property, in order. The list ends early if a
/// property fails that the next ones need. Findings name vertices and tetrahedra by their number in
/// the mesh, from 1.
/// Cost: O(m log m), and O(h n) for a hull of h faces that is no box.
[[nodiscard]] std::vector<Finding> check_mesh(const Mesh<3>& mesh, const CheckOptions<3>& options);

}  // namespace mesher
