// Reports on the parts of a mesh where the bounds on its simplices cannot hold: at small angles,
// and in space where tetrahedra stay poor so that refinement terminates.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "mesher/graph.hpp"
#include "mesher/mesh.hpp"

namespace mesher {

// Effects of small angles of the input on a mesh, and the bounds for the rest of it.
//
// Example:
//   const mesher::AngleReport report = mesher::angle_report(m.mesh(), m.options());
//   for (const auto& angle : report.angles) ... angle.at, angle.lines, angle.forced ...
//
// Two segments that meet at under 60 degrees force triangles between them that no refinement can
// improve, since it would need ever shorter edges [Miller, Pav, Walkington]. So a triangle is left
// poor if its shortest edge joins the two segments at equal distances from their common end (paper
// map). Everywhere else the bound on angles holds.
//
// A Change (mesher.hpp) reports the effects of its update, at a cost proportional to the change.
//
// A report is a function of the mesh alone, and so of the input: a mesh that has followed edits has
// the report of a fresh one.

/// Two segments that leave a point at under 60 degrees without a third between them, or between
/// which poor triangles stay.
struct SmallAngle {
  Point<2> at{};
  std::array<LineId, 2> lines{};  ///< the smaller id first; equal within a polyline
  double degrees = 0;             ///< > 0
  std::size_t forced = 0;         ///< poor triangles that it forces
  double smallest_deg = 0;        ///< the smallest angle of these; 0 if there are none
  friend bool operator==(const SmallAngle&, const SmallAngle&) = default;
};

/// A vertex whose nearest neighbour is closer than lfs / kShrinks. Its lfs is the radius of the
/// smallest disc around it that meets two features without a common point, or the spacing that
/// limits of size ask for. Neighbours across a small angle, at the same distance from its apex, do
/// not count.
struct ShrunkVertex {
  Point<2> at{};
  double nearest = 0;         ///< distance to its nearest neighbour that counts
  double feature_size = 0;    ///< its lfs
  std::vector<LineId> lines;  ///< lines that meet the interior of that disc, by id
  double degrees = 180;       ///< the smallest angle at an end of one of these segments
  friend bool operator==(const ShrunkVertex&, const ShrunkVertex&) = default;
};

/// Effects of small angles in an update of a mesh with lines.
struct AngleNews {
  /// The angles that force new poor triangles, by position, then by degrees; `forced` and
  /// `smallest_deg` count only the new triangles.
  std::vector<SmallAngle> forced;
  /// The shrunk vertices among corners of new triangles, in lexicographic order.
  std::vector<ShrunkVertex> shrunk;
  friend bool operator==(const AngleNews&, const AngleNews&) = default;
};

/// Effects of small angles in a whole mesh.
struct AngleReport {
  std::vector<SmallAngle> angles;     ///< by position, then by degrees
  std::size_t forced = 0;             ///< number of forced poor triangles
  double smallest_forced_deg = 0;     ///< of the forced ones; 0 if there are none
  double smallest_elsewhere_deg = 0;  ///< of all others; 0 if there are none
  double promised_deg = 0;            ///< lower bound for the others: arcsin(1 / (2 rho))
  /// Vertices at which refinement has shrunk lengths by more than kShrinks. Empty unless small
  /// angles interact in a way that the rules do not foresee. Not looked for if regions limit sizes
  /// (without Options::region_limits), or growth does.
  std::vector<ShrunkVertex> shrunk;

  /// A summary for people, one sentence per line; empty if no angle is small.
  [[nodiscard]] std::string text() const;
};

/// The factor by which a nearest neighbour may be closer than the local feature size. Without small
/// angles, factors up to 5.1 were measured; near the small angles of coasts, up to 7.9 (10^5
/// vertices of each).
inline constexpr double kShrinks = 10;

/// Reports the effects of small angles in a mesh. Requires: a mesh of a Mesher, of mesh() or of
/// box_mesh(), with these options. Cost: O(m log m), about 5 us per vertex; more at ends of very
/// many segments.
[[nodiscard]] AngleReport angle_report(const Mesh<2>& mesh, const Options<2>& options);

/// Reports the effects of small angles for some triangles (in order) of a mesh: equal to
/// Change::angles of an update that added them, but computed from the whole mesh. Requires: as
/// angle_report.
[[nodiscard]] AngleNews angle_news(const Mesh<2>& mesh, const Options<2>& options,
                                   const std::vector<std::array<Point<2>, 3>>& triangles);

// In space: tetrahedra left poor so that refinement terminates.
//
// Example:
//   const mesher::GuardReport report = mesher::guard_report(mesh, complex, options.rho);
//   for (const auto& place : report.places) ... place.feature, place.at, place.tetrahedra ...
//
// A new vertex for a poor tetrahedron yields to features near it. If rho is below kGuarded, it may
// then be nearer to other vertices than the length of the tetrahedron's shortest edge. So for such
// rho a tetrahedron may stay poor beside a feature if its shortest edge is *isolated* there: within
// kIsolated times its length, every part of the input has a point in common with the feature, and
// so have any two parts of the feature (corners, ends, edges) with each other. This is a function
// of the input. Edges that are not isolated have a least length, so refinement terminates (except
// for the effects of features on each other at small angles).

/// For bounds of the radius-edge ratio below this one, tetrahedra may stay poor beside features.
inline constexpr double kGuarded = 2;

/// An edge is isolated if other features are farther from its middle than this times its length. In
/// meshes whose refinement terminates without this rule, edges are hardly ever that short.
inline constexpr double kIsolated = 16;

/// An edge is beside a feature that is within this times its length of its middle.
inline constexpr double kBesideEdge = 8;

/// A feature beside which tetrahedra stay poor.
struct PoorBeside {
  Feature feature{};  ///< a line, or a polygon (also for its edges)
  Point<3> at{};      ///< the middle of a shortest edge, the first in lexicographic order
  std::size_t tetrahedra = 0;
  double max_radius_edge = 0;  ///< of these
  friend bool operator==(const PoorBeside&, const PoorBeside&) = default;
};

/// The tetrahedra that stay poor beside features.
struct GuardReport {
  std::vector<PoorBeside> places;  ///< segments by id, then polygons by id
  std::size_t tetrahedra = 0;      ///< in all places

  /// One line of text for each place; empty if there is none.
  [[nodiscard]] std::string text() const;
  friend bool operator==(const GuardReport&, const GuardReport&) = default;
};

/// Reports the poor tetrahedra of a mesh that are not at a small angle of the complex. Empty if rho
/// is at least kGuarded. Requires: the mesh of the whole box, of a complex without faults. Cost:
/// O(m log m), and for each poor tetrahedron a search for the features within kIsolated times its
/// shortest edge.
[[nodiscard]] GuardReport guard_report(const Mesh<3>& mesh, const Graph<3>& complex, double rho);

/// Reports the same for some tetrahedra (in order) of a mesh: equal to Change::guard of an update
/// that added them. (Change::guard finds small angles by labels, this function by coordinates,
/// which excuses a few more tetrahedra.) Requires, Cost: as guard_report.
[[nodiscard]] GuardReport guard_news(const Mesh<3>& mesh, const Graph<3>& complex, double rho,
                                     const std::vector<std::array<Point<3>, 4>>& tetrahedra);

}  // namespace mesher
