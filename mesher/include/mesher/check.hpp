// How good a mesh is, and an independent verification that it is what it should be.
//
// `check_mesh` shares nothing with the mesher but the exact predicates. Its properties, in order;
// each is looked at only if those it needs hold:
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
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "mesher/io.hpp"
#include "mesher/mesh_data.hpp"
#include "mesher/pslg.hpp"

namespace mesher {

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
  any,    ///< any polygons
};

/// The rule for a mesh of which nobody says how far it should go. `box` if there are no lines, or if
/// it fills its bounding box and a corner of that is no point of `graph`, so that lines do not
/// enclose it; else `lines`.
/// Cost: O(m log m).
[[nodiscard]] BoundaryRule boundary_rule(const MeshData& mesh, const PslgFile* graph);

/// What to hold a mesh against.
struct CheckOptions {
  const PointFile<2>* input = nullptr;  ///< checks (8) where given
  std::optional<double> rho{};          ///< checks (9) where given
  BoundaryRule boundary = BoundaryRule::box;
  const PslgFile* graph = nullptr;         ///< checks (8), (b), (f) and seeds in (d) where given
  const MeshFeatures* features = nullptr;  ///< checks (a), (d), (f); says which edges are on lines
  bool constrained = false;                ///< (c) is not asked for
  std::optional<double> max_area{};        ///< checks (e) where given
};

/// The properties in order; the list ends early where a property fails that the next ones need.
/// Vertices and triangles are named by their number in the mesh, from 1. Cost: O(m log m).
[[nodiscard]] std::vector<Finding> check_mesh(const Mesh<2>& mesh, const CheckOptions& options);

}  // namespace mesher
