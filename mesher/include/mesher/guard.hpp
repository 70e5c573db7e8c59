// Where refinement in space has given in: tetrahedra that stay poor so that it ends.
//
// Example:
//   const mesher::GuardReport report = mesher::guard_report(mesh, complex, options.rho);
//   for (const auto& place : report.places) ... place.feature, place.at, place.tetrahedra ...
//
// A vertex asked for by a poor tetrahedron yields to features near it, and may then be nearer to
// others than the edge that asked for it is long, if rho is below kGuarded. So below that a
// tetrahedron may stay poor beside a feature if its shortest edge is *lonely* there: within kLonely
// times its length there is nothing of the input that has no point in common with the feature, and
// no two parts of the feature (corners, ends, edges) that have none in common with each other.
// That is a function of the input. Edges that are not lonely have a least length, so refinement
// ends (but for what features ask of each other at small angles).
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "mesher/mesh.hpp"

namespace mesher {

struct Plc;

/// Bounds of the radius-edge ratio below this one are guarded.
inline constexpr double kGuarded = 2;

/// An edge is lonely if other features are farther from its middle than this times its length.
/// Where meshes end without a guard, edges are hardly ever that short.
inline constexpr double kLonely = 16;

/// It is beside a feature that is not farther from its middle than this times its length.
inline constexpr double kBesideEdge = 8;

/// A feature beside which tetrahedra stay poor.
struct GaveIn {
  FeatureId feature{};      ///< a segment; or a polygon, for its edges, too
  bool is_polygon = false;  ///< which of the two
  Point<3> at{};            ///< the middle of a shortest edge: the first in lexicographic order
  std::size_t tetrahedra = 0;
  double max_radius_edge = 0;  ///< of these
  friend bool operator==(const GaveIn&, const GaveIn&) = default;
};

struct GuardReport {
  std::vector<GaveIn> places;  ///< segments by id, then polygons by id
  std::size_t tetrahedra = 0;  ///< of all of them

  /// A line for each place; nothing if there is none.
  [[nodiscard]] std::string text() const;
  friend bool operator==(const GuardReport&, const GuardReport&) = default;
};

/// What of a mesh is poor, and not at a small angle of the complex. Nothing if rho is not guarded.
/// Requires: a mesh in its box, of a complex without faults. Cost: O(m log m), and for each poor
/// tetrahedron a look at the features within kLonely times its shortest edge.
[[nodiscard]] GuardReport guard_report(const Mesh<3>& mesh, const Plc& complex, double rho);

/// The same of these tetrahedra (in order) of the mesh alone: what the Change says of the update
/// that brought them. (What is at a small angle is told by labels there, by places here, which
/// excuses some tetrahedra more.) Requires, Cost: likewise.
[[nodiscard]] GuardReport guard_news(const Mesh<3>& mesh, const Plc& complex, double rho,
                                     const std::vector<std::array<Point<3>, 4>>& tetrahedra);

}  // namespace mesher
