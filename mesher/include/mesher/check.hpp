// How good a mesh is, and an independent verification that it is what it should be.
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

// Of triangles. `check_mesh` shares nothing with the mesher but the exact predicates. Its
// properties, in order; each is looked at only if those it needs hold:
//   (1) coordinates: every vertex is 0 or of magnitude 2^-160 to 2^101 in each coordinate, and all
//       are multiples of one power of two, not more than 253 bits below the largest;
//   (2) vertices: no two coincide, and each is a corner of a triangle;
//   (3) orientation: every triangle's corners go round counterclockwise;
//   (4) edges: each borders one triangle, or two on opposite sides;
//   then, if the mesh is to fill a box,
//   (5) hull: the edges with one triangle go round the bounding box once;
//   (6) euler: vertices - edges + triangles = 1. With (1) to (5) the triangles tile the box;
//   or else
//   (5') overlap: no two triangles overlap. The edges with one triangle, each with its triangle on
//       the left, wind round every place once or not at all, and meet at vertices alone. With (1)
//       to (4) this is exact: as many triangles cover a place as those edges wind round it. A mesh
//       may have no triangles if the input has holes, as all that lines enclose may be in them;
//   (6') boundary, if asked: the edges with one triangle are on lines or sides of the bounding box;
//   (7) delaunay: no edge has the opposite corner of one triangle inside the other's circumcircle;
//       edges on lines are left to conforming, if there are lines;
//   (8) input, if asked: every input point is a vertex, bit for bit, or, unless the mesh is to fill
//       a box, in no triangle;
//   (9) quality, if asked: no triangle has a circumradius above rho times its shortest edge (by
//       more than a rounding, 10^-9 of it), those of small angles between lines aside: lines of the
//       input, if it is given, else of MeshFeatures;
//   and for meshes with lines
//   (a) lines: every edge of MeshFeatures is an edge of a triangle;
//   (b) segments: every segment, and every piece of a polyline, is a union of edges: a path from
//       end to end, each vertex of which is on it but for rounding (2^-48 of the largest
//       coordinate), those of MeshFeatures that name the line first; and an edge that names a line
//       is on it. Unless the mesh is to fill a box, what of it is outside need not be there;
//   (c) conforming: (7) of the edges on lines;
//   (d) regions: triangles on both sides of an edge that is on no line have the same region; where
//       seeds are given, that of one of the seeds inside; no triangle holds the seed of a hole,
//       unless the mesh is to fill a box. A seed on a line stands for nothing, and so does one of a
//       region beside that of a hole;
//   (e) area, if asked: no triangle is larger than a limit;
//   (f) markers, if the input has some and the mesh does: a vertex that is a point with a marker
//       has that one; every other, and every edge, has the marker of one of the lines with a marker
//       that it is on, be the line in the mesh or outside, or, on none, 0, or 1 on the mesh's
//       boundary. Those of edges are looked at where any edge has one.

/// The worst triangles of a mesh.
struct Quality {
  double min_angle_deg = 0;    ///< NaN if there are no triangles
  double max_radius_edge = 0;  ///< circumradius over shortest edge; NaN likewise
};

/// Cost: O(m).
[[nodiscard]] Quality quality(const Mesh<2>& mesh);

/// Circumradius over shortest edge of the triangle abc. Requires: a, b, c not collinear.
[[nodiscard]] double radius_edge(const Point<2>& a, const Point<2>& b, const Point<2>& c);
/// The smallest angle of the triangle abc.
[[nodiscard]] double smallest_angle_deg(const Point<2>& a, const Point<2>& b, const Point<2>& c);

/// One property of a mesh as `check_mesh` found it.
struct Finding {
  std::string property;  ///< "coordinates", "vertices", ... as above
  bool holds = false;
  std::string detail;  ///< the first violation, or what was looked at
};

/// What the edges with one triangle must be.
enum class BoundaryRule : std::uint8_t {
  box,    ///< the sides of the bounding box
  lines,  ///< edges on lines, or sides of the bounding box
  any,    ///< any polygons; in space the boundary of any convex body
};

/// The rule for a mesh of which nobody says how far it should go. `box` if there are no lines, or
/// if it fills its bounding box and a corner of that is no point of `graph`, so that lines do not
/// enclose it; else `lines`.
/// Cost: O(m log m).
[[nodiscard]] BoundaryRule boundary_rule(const MeshData<2>& mesh, const GraphFile<2>* graph);

namespace detail {
template <int D>
struct CheckOptionsOf;
template <>
struct CheckOptionsOf<2> {
  bool constrained = false;  ///< (c) is not asked for
};
template <>
struct CheckOptionsOf<3> {
  bool ties = false;           ///< checks (8)
  bool near_delaunay = false;  ///< (7) as for without_flat_tetrahedra (improve.hpp)
};
}  // namespace detail

/// What to hold a mesh against. In the plane also `constrained`, in space `ties` and
/// `near_delaunay`. Numbers are those of the lists above and below, in the plane; in space.
template <int D>
struct CheckOptions : detail::CheckOptionsOf<D> {
  /// Checks (8), (b), (f) and seeds in (d); in space (9), (10), (b), (c), (d) and seeds in (e).
  const GraphFile<D>* graph = nullptr;
  std::optional<double> rho{};  ///< checks (9); (11)
  BoundaryRule boundary = BoundaryRule::box;
  const MeshFeatures* features = nullptr;  ///< checks (a), (d), (f), says which edges are on lines;
                                           ///< checks (a), (c) to (e), tells origins for (10)
  std::optional<double> max_measure{};     ///< checks (e); (12)
};

/// The properties in order; the list ends early where a property fails that the next ones need.
/// Vertices and triangles are named by their number in the mesh, from 1. Cost: O(m log m).
[[nodiscard]] std::vector<Finding> check_mesh(const Mesh<2>& mesh, const CheckOptions<2>& options);

// Of tetrahedra. `check_mesh` shares nothing with the mesher but the exact predicates, and
// circumcentres that are exact quotients where doubles are not good for them. Its properties, in
// order; each is looked at only if those it needs hold:
//   (1) coordinates: every vertex is 0 or of magnitude 2^-160 to 2^101 in each coordinate, and all
//       are multiples of one power of two, not more than 253 bits below the largest;
//   (2) vertices: no two coincide, and each is a corner of a tetrahedron;
//   (3) orientation: every tetrahedron is positively oriented (predicates.hpp);
//   (4) faces: each is of one tetrahedron, or of two on opposite sides;
//   (5) hull: the faces of one tetrahedron are on the sides of the bounding box or, where it may be
//       any convex body, on planes with all vertices on one side;
//   (6) cover: a place inside the first tetrahedron with room for one is in no other. With (1) to
//       (5) the tetrahedra then fill the box, or the convex hull, without gap or overlap: by (3)
//       and (4) as many tetrahedra cover a place on one side of an inner face as on the other, so
//       that number changes at faces of one tetrahedron alone, and by (5) these are on the hull;
//   (7) delaunay: no face has the opposite corner of one tetrahedron inside the other's sphere; or,
//       if asked, farther inside than kNearSphere times the radius;
//   (8) ties, if asked: an opposite corner on that sphere counts as outside by the rule of
//       predicates::insphere_perturbed; the mesh is then the only one of its vertices;
//   (9) input, if asked: every input point is a vertex, bit for bit;
//  (10) kinds, where a vertex has one but `steiner`: vertices of the kind `boundary` are on the
//       bounding box, and, with an input, those of the kind `input` are its points, under their ids
//       where the mesh tells origins;
//  (11) quality, if asked: no tetrahedron, the box's included, has a circumradius above rho times
//       its shortest edge (by more than its rounding, and 10^-9 of it), those of small angles of
//       the complex aside: with a shortest edge that joins two of its features, which share an edge
//       or a point that is farther from both ends than they are from each other, or two features at
//       a point from which both ends are as far; and for rho below kGuarded those with a shortest
//       edge that is isolated beside a segment or polygon (reports.hpp);
//  (12) volume, if asked: no tetrahedron is larger than a limit (by more than 10^-9 of it);
//   and for meshes with features
//   (a) parts: every edge and face of MeshFeatures is one of a tetrahedron;
//   (b) segments, if a complex is given: every segment, and every edge of a polygon, is a union of
//       edges: a path from end to end, each vertex of which is on it but for rounding (2^-48 of the
//       largest coordinate). Where MESH has what polygons enclose, what of it is outside need not
//       be there;
//   (c) polygons, likewise: every polygon is a union of faces: of those that MeshFeatures say are
//       its, or if they name none, of those with corners on its plane whose Voronoi edge crosses
//       it (on the boundary, whose middle is in it). Their corners are on it, but for rounding and
//       its own corners' deviation; each of their edges is of two of them, or of one and on an edge
//       of the polygon; and their areas add up to its own, but for 10^-9 and the rounding of
//       vertices on its border. Where MESH has what polygons enclose, parts of a polygon, between
//       edges that it declares, may be outside: beside such an edge there is then a face, or no
//       tetrahedron;
//   (d) markers, where complex and mesh have some: vertices have that of their point, or else of a
//       segment or polygon that they are on, be it in the mesh or outside, edges that of their
//       segment, or else of such a polygon, faces that of their polygon; what is on none has none,
//       or on the boundary perhaps 1;
//   (e) regions: tetrahedra on both sides of a face in no polygon have the same region; where seeds
//       are given, that of one of the seeds inside; no tetrahedron holds the seed of a hole, unless
//       the mesh is to fill a box. A seed on a polygon stands for nothing, and so does one of a
//       region beside that of a hole.
// If the mesh need not be convex, (5) is that faces of one tetrahedron are on the box or in
// polygons, and there may be none if the complex has holes; then (6) looks at a place in each part
// that hangs together, and beside each part of the boundary: as (c) says, and as polygons do not
// cross, the boundary has no crossings.

/// Tetrahedra with a dihedral angle below this are slivers.
inline constexpr double kSliverDegrees = 5;

/// What is inside a sphere by less than this share of its radius may be there by rounding.
inline constexpr double kNearSphere = 0x1p-20;

/// The worst tetrahedra of a mesh; NaN if there are none.
struct SpaceQuality {
  double min_dihedral_deg = 0;
  double max_dihedral_deg = 0;
  double max_radius_edge = 0;  ///< circumradius over shortest edge
  std::size_t slivers = 0;
};

/// Requires: tetrahedra are positively oriented. Cost: O(m).
[[nodiscard]] SpaceQuality quality(const Mesh<3>& mesh);

/// How many tetrahedra have a circumradius above rho times their shortest edge, by more than its
/// rounding, and 10^-9 of it. Cost: O(m).
[[nodiscard]] std::size_t count_above(const Mesh<3>& mesh, double rho);

/// The rule for a mesh of which nobody says how far it should go, as that in the plane, by
/// polygons.
[[nodiscard]] BoundaryRule boundary_rule(const MeshData<3>& mesh, const GraphFile<3>* complex);

/// The properties in order; the list ends early where a property fails that the next ones need.
/// Vertices and tetrahedra are named by their number in the mesh, from 1.
/// Cost: O(m log m), and O(h n) for a hull of h faces that is no box.
[[nodiscard]] std::vector<Finding> check_mesh(const Mesh<3>& mesh, const CheckOptions<3>& options);

}  // namespace mesher
