// How good a mesh is, and an independent verification that it is what it should be.
//
// `check_mesh` shares nothing with the mesher but the exact predicates. Its properties, in order;
// each is looked at only if those it needs hold:
//   (1) coordinates: every vertex is 0 or of magnitude 2^-160 to 2^101 in each coordinate;
//   (2) vertices: no two coincide, and each is a corner of a triangle;
//   (3) orientation: every triangle's corners go round counterclockwise;
//   (4) edges: each borders one triangle, or two on opposite sides;
//   (5) hull: the edges with one triangle go round the bounding box once;
//   (6) euler: vertices - edges + triangles = 1. With (1) to (5) the triangles tile the box;
//   (7) delaunay: no edge has the opposite corner of one triangle inside the other's circumcircle;
//   (8) input, if asked: every input point is a vertex, bit for bit;
//   (9) quality, if asked: no triangle has a circumradius above rho times its shortest edge (by
//       more than a rounding, 10^-9 of it).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mesher/io.hpp"
#include "mesher/mesh.hpp"

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

/// One property of a mesh as `check_mesh` found it.
struct Finding {
  std::string property;  ///< "coordinates", "vertices", ... as above
  bool holds = false;
  std::string detail;  ///< the first violation, or what was looked at
};

/// What to hold a mesh against.
struct CheckOptions {
  const PointFile<2>* input = nullptr;  ///< checks (8) where given
  std::optional<double> rho{};          ///< checks (9) where given
};

/// The properties in order; the list ends early where a property fails that the next ones need.
/// Vertices and triangles are named by their number in the mesh, from 1. Cost: O(m log m).
[[nodiscard]] std::vector<Finding> check_mesh(const Mesh<2>& mesh, const CheckOptions& options);

}  // namespace mesher
