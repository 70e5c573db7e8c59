// Graphs that do not fit together, made to fit: in the plane and in space.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "mesher/graph.hpp"

namespace mesher {

// Repairs a graph that is no planar one: after it, lines meet at common points only.
//
// Example:
//   const mesher::GraphFile<2> read = mesher::read<2>("roads.poly");
//   const mesher::Repaired<2> repaired = mesher::repair(read);
//   for (const auto& note : repaired.notes) std::puts(note.text().c_str());
//   ... repaired.file.graph ...
//
// What is closer than a tolerance is made to touch: 2^-44 of the side of the meshing box (of a map
// of the Earth in degrees: 10^-10 of a degree), and at least 16 units in the last place of the
// largest coordinate. The box is that of Options::domain.
//
// Guarantees:
//   (1) two pieces of lines meet at most in a common end, exactly; none is there twice; a point is
//       on no piece that it is no end of. Two points are farther apart than half the tolerance, a
//       point and such a piece than all of it, where that is not less than a unit of rounding. So a
//       Mesher finds no fault in it, but for angles that are too small for doubles;
//   (2) points that stay are where they were, bit for bit, with their ids, markers and attributes;
//   (3) what lines cover, they still do, but for `deviation`, a few tolerances; holes and regions
//       stay;
//   (4) a graph without faults comes back as it is, so repair(repair(x)) is repair(x);
//   (5) the result depends on places and ids alone, not on the order of the input's elements, but
//       for the order of what is returned.
//
// Rules:
//   merging      Of points that are as close to each other as twice the tolerance one stays: going
//                through them in lexicographic order (equal places by id), whoever has one that
//                stays that close is the nearest such from now on. That takes the marker of those
//                that go, by id, if it has none.
//   splitting    A point within the tolerance of a line's piece becomes a point of the line. Where
//                two pieces cross, both get a point: one that is there within twice the tolerance,
//                or a new one at the crossing, rounded to doubles. The pieces bend by that much;
//                so it is done again, until there is nothing to be done.
//   ids          A line keeps its id and marker for all its pieces; a segment of several pieces
//                becomes a polyline. New points are numbered on from the highest id of a point, in
//                the order of places within each round; they have the marker of the line of the
//                smallest id through them, and attributes that are linear along it.
//   overlaps     A piece that several lines cover belongs to that of the smallest id. The others
//                lose it. What such a line has behind a gap becomes a line of its own, with its
//                marker, numbered on from the highest id of a line.
//   dropping     Pieces from a point to itself, and lines that have no piece left.

enum class RepairKind : std::uint8_t {
  merged_points,      ///< points: the one that goes, the one that stays
  zero_length,        ///< lines: of a piece that has no length; points: its end
  split_at_point,     ///< lines, or polygons: one that leads through a point now; points: that
  split_at_crossing,  ///< lines, polygons: those that lead through a new point; points: that
  overlap,            ///< lines, or polygons: one that has lost some of it, and whose that is
  renamed,            ///< lines: one that has a gap, or is split, and what its rest is now
  dropped_line,       ///< lines: one that has no piece left
  bent_polygon,       ///< polygons: one that is not flat, and the other triangles that it is now
  cut_polygon,        ///< polygons: one that is several now, and the others
  dropped_polygon,    ///< polygons: one that has no area left
};

/// What a repair has done. D is 2 or 3.
template <int D>
struct RepairNote {
  RepairKind kind{};
  std::vector<LineId> lines;
  std::vector<PointId> points;
  Point<D> at{};          ///< where, or where it begins
  FileLocation location;  ///< of the first line or polygon, if there is one, or of the first point
  std::vector<PolygonId> polygons{};
  double deviation = 0;  ///< of a bent polygon: how far the farthest corner is off its plane

  /// "FILE:LINE:COL: what was done", the place where it is known; `prefix` stands before the deed.
  [[nodiscard]] std::string text(const std::string& prefix = {}) const;
};

/// A graph without faults, and how it became so. D is 2 or 3.
template <int D>
struct Repaired {
  GraphFile<D> file;  ///< what is new has the position of what it comes from; new points have none
  std::vector<RepairNote<D>> notes;  ///< by kind, then by ids
  double tolerance = 0;              ///< input units
  double deviation = 0;  ///< of what is new from what was, and of these from those: the most
};

/// Repairs a graph. `domain`: of the Options that it will be meshed with, snapped_domain of its
/// points by default. Positions that `file` does not have are unknown.
/// Throws: Error (not_finite, magnitude, outside_domain, repeated_id, unknown_id, wrong_count: of
/// attributes) for what cannot be repaired; Error(bad_option) for a domain that cannot be meshed;
/// Error(too_close) if kRepairRounds rounds do not do.
/// Cost: O((n + c) log L/s) for n pieces of lines and c crossings, where lines are as long as they
/// are far apart or lie side by side (10^5 segments that cross 10^5 times: 3 s); more for long
/// lines in all directions. Many that cross in one place are worst: O(n^1.5 log L/s).
[[nodiscard]] Repaired<2> repair(const GraphFile<2>& file,
                                 const std::optional<Box<2>>& domain = {});
[[nodiscard]] Repaired<2> repair(const Graph<2>& pslg, const std::optional<Box<2>>& domain = {});

inline constexpr int kRepairRounds = 32;

// Repairs a complex whose parts do not fit together: after it, segments and polygons meet at common
// points and edges only, and polygons are flat.
//
// Example:
//   const mesher::GraphFile<3> read = mesher::read<3>("house.poly");
//   const mesher::Repaired<3> repaired = mesher::repair(read);
//   for (const auto& note : repaired.notes) std::puts(note.text().c_str());
//   ... repaired.file.graph ...
//
// What is closer than a tolerance is made to touch: 2^-42 of the side of the meshing box, and at
// least 64 units in the last place of the largest coordinate. The box is that of Options::domain.
//
// Guarantees:
//   (1) a Mesher finds no fault in the result, but for angles that are too small for doubles: that
//       is asked of its own tests, and if they did find one, it is an Error;
//   (2) points that stay are where they were, bit for bit, with their ids, markers and attributes;
//   (3) what segments and polygons cover, they still do, but for `deviation`, a few tolerances; a
//       polygon that is not flat covers what the triangles between its points do. Holes and regions
//       stay;
//   (4) a complex without faults comes back as it is, so repair(repair(x)) is repair(x);
//   (5) the result depends on places and ids alone, not on the order of the input's elements, but
//       for the order of what is returned.
//
// Rules, in this order, until there is nothing to be done:
//   merging      As in the plane: of points within twice the tolerance one stays.
//   edges        An edge within the tolerance of a point is led through it. Two edges that come as
//                close to each other get a common point: one that is there within twice the
//                tolerance, or a new one, rounded to doubles. An edge is a segment's, or one of a
//                polygon's loops, or declared to lie in it.
//   polygons     Inside is what an odd number of loops goes around; edges that two loops have, and
//                loops that go there and back, are no borders. What meets itself in a point is cut
//                there. What is not flat by the mesher's measure is cut into triangles, as near to
//                Delaunay in its plane as its loops and what lies inside allow.
//   on polygons  A point, or an edge, on a polygon is declared to lie in it. Where an edge goes
//                through one, it gets a point, which is declared as well.
//   crossings    Polygons that cross both get the edges along their line of intersection.
//   overlaps     What several polygons, or segments, cover belongs to that of the smallest id.
//   ids          The first part of a polygon, or segment, in the order of places (of segments:
//                from its first end on) keeps the id; others are numbered on from the highest, with
//                its marker. New points are numbered on likewise; they have the marker of the
//                segment of the smallest id through them, or of such a polygon, and attributes that
//                are linear along an edge.
//   dropping     Segments without length, polygons without area.

/// Repairs a complex. `domain`: of the Options that it will be meshed with, snapped_domain of its
/// points by default. Positions that `file` does not have are unknown.
/// Throws: Error (not_finite, magnitude, outside_domain, repeated_id, unknown_id, wrong_count: of
/// attributes) for what cannot be repaired; Error(bad_option) for a domain that cannot be meshed;
/// Error(not_flat) for a polygon that is so bent that its edges cross in every view, if it has
/// holes or more than 256 corners; Error(too_close) if twice kRepairRounds do not do, or what is
/// nearly parallel cannot be told apart.
/// Cost: O((n + c) log L/s) for n edges and c crossings, where polygons are about as large as they
/// are far apart.
[[nodiscard]] Repaired<3> repair(const GraphFile<3>& file,
                                 const std::optional<Box<3>>& domain = {});
[[nodiscard]] Repaired<3> repair(const Graph<3>& plc, const std::optional<Box<3>>& domain = {});

}  // namespace mesher
