// What a mesh has where the bounds on its simplices cannot hold: small angles, and in space places
// where refinement gave in.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "mesher/graph.hpp"
#include "mesher/mesh.hpp"

namespace mesher {

// What small angles of the input do to a mesh, and what is promised for the rest of it.
//
// Example:
//   const mesher::AngleReport report = mesher::angle_report(m.mesh(), m.options());
//   for (const auto& angle : report.angles) ... angle.at, angle.lines, angle.forced ...
//
// Two segments that meet at under 60 degrees force triangles between them that no refinement can
// make better, since it would ask for ever shorter edges [Miller, Pav, Walkington]. So a triangle
// stays as it is if its shortest edge joins the two segments at equal distances from their common
// end (paper map). Everywhere else the bound on angles holds.
//
// A Change (mesher.hpp) has the news of its update, at the cost of what has changed.
//
// A report is a function of the mesh alone, so of the input: that of a mesh that has followed edits
// is that of a fresh one.

/// Two segments that leave a point at under 60 degrees, no third between them; or between which
/// triangles stay.
struct SmallAngle {
  Point<2> at{};
  std::array<LineId, 2> lines{};  ///< that of the smaller id first; equal within a polyline
  double degrees = 0;             ///< > 0
  std::size_t forced = 0;         ///< poor triangles that stay for it
  double smallest_deg = 0;        ///< the smallest angle of these; that of none is 0
  friend bool operator==(const SmallAngle&, const SmallAngle&) = default;
};

/// A vertex whose nearest neighbour is closer than lfs / kShrinks. Its lfs is the radius of the
/// smallest disc around it that meets two features without a common point, or the spacing that
/// limits of size ask for. Neighbours across a small angle, at the same distance from its apex, do
/// not count.
struct ShrunkVertex {
  Point<2> at{};
  double nearest = 0;         ///< to its nearest neighbour that counts
  double feature_size = 0;    ///< there
  std::vector<LineId> lines;  ///< those in that disc's interior, by id
  double degrees = 180;       ///< the smallest angle at an end of one of these segments
  friend bool operator==(const ShrunkVertex&, const ShrunkVertex&) = default;
};

/// What an update of a mesh with lines did at small angles.
struct AngleNews {
  /// Those for which new triangles stay poor, by place, then by degrees: `forced` and
  /// `smallest_deg` are of the new triangles alone.
  std::vector<SmallAngle> forced;
  /// The guard, of corners of new triangles; in lexicographic order.
  std::vector<ShrunkVertex> shrunk;
  friend bool operator==(const AngleNews&, const AngleNews&) = default;
};

struct AngleReport {
  std::vector<SmallAngle> angles;     ///< by place, then by degrees
  std::size_t forced = 0;             ///< triangles that stay poor
  double smallest_forced_deg = 0;     ///< of those; of none, 0
  double smallest_elsewhere_deg = 0;  ///< of all others; of none, 0
  double promised_deg = 0;  ///< all angles of the others are as large: arcsin(1 / (2 rho))
  /// The guard: refinement has made lengths shrink more than the rules allow. Empty unless small
  /// angles act together in a way that they do not foresee.
  std::vector<ShrunkVertex> shrunk;

  /// What a person should know, a sentence a line: nothing if no angle is small.
  [[nodiscard]] std::string text() const;
};

/// What the guard allows. Where no angle is small, vertices have neighbours nearer than the local
/// feature size by up to 5.1; near the small angles of coasts, by 7.9 (10^5 vertices of each).
inline constexpr double kShrinks = 10;

/// Requires: a mesh of a Mesher or of mesh_statically with these options. Cost: O(m log m), some
/// 5 us a vertex; more at ends of very many segments.
[[nodiscard]] AngleReport angle_report(const Mesh<2>& mesh, const Options<2>& options);

/// What the Change of an update says that brought these triangles (in order) of the mesh; here from
/// the whole mesh. Requires: likewise.
[[nodiscard]] AngleNews angle_news(const Mesh<2>& mesh, const Options<2>& options,
                                   const std::vector<std::array<Point<2>, 3>>& triangles);

// In space: tetrahedra left poor so that refinement terminates.
//
// Example:
//   const mesher::GuardReport report = mesher::guard_report(mesh, complex, options.rho);
//   for (const auto& place : report.places) ... place.feature, place.at, place.tetrahedra ...
//
// A vertex asked for by a poor tetrahedron yields to features near it, and may then be nearer to
// others than the edge that asked for it is long, if rho is below kGuarded. So below that a
// tetrahedron may stay poor beside a feature if its shortest edge is *isolated* there: within
// kIsolated times its length there is nothing of the input that has no point in common with the
// feature, and no two parts of the feature (corners, ends, edges) that have none in common with
// each other. That is a function of the input. Edges that are not isolated have a least length, so
// refinement ends (but for what features ask of each other at small angles).

/// Bounds of the radius-edge ratio below this one are guarded.
inline constexpr double kGuarded = 2;

/// An edge is isolated if other features are farther from its middle than this times its length.
/// Where meshes end without a guard, edges are hardly ever that short.
inline constexpr double kIsolated = 16;

/// It is beside a feature that is not farther from its middle than this times its length.
inline constexpr double kBesideEdge = 8;

/// A feature beside which tetrahedra stay poor.
struct PoorBeside {
  Feature feature{};  ///< a line; or a polygon, for its edges, too
  Point<3> at{};      ///< the middle of a shortest edge: the first in lexicographic order
  std::size_t tetrahedra = 0;
  double max_radius_edge = 0;  ///< of these
  friend bool operator==(const PoorBeside&, const PoorBeside&) = default;
};

struct GuardReport {
  std::vector<PoorBeside> places;  ///< segments by id, then polygons by id
  std::size_t tetrahedra = 0;      ///< of all of them

  /// A line for each place; nothing if there is none.
  [[nodiscard]] std::string text() const;
  friend bool operator==(const GuardReport&, const GuardReport&) = default;
};

/// What of a mesh is poor, and not at a small angle of the complex. Nothing if rho is not guarded.
/// Requires: a mesh in its box, of a complex without faults. Cost: O(m log m), and for each poor
/// tetrahedron a look at the features within kIsolated times its shortest edge.
[[nodiscard]] GuardReport guard_report(const Mesh<3>& mesh, const Graph<3>& complex, double rho);

/// The same of these tetrahedra (in order) of the mesh alone: what the Change says of the update
/// that brought them. (What is at a small angle is told by labels there, by places here, which
/// excuses some tetrahedra more.) Requires, Cost: likewise.
[[nodiscard]] GuardReport guard_news(const Mesh<3>& mesh, const Graph<3>& complex, double rho,
                                     const std::vector<std::array<Point<3>, 4>>& tetrahedra);

}  // namespace mesher
