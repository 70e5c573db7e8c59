// Repairs graphs whose parts do not fit together, in the plane and in space.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "mesher/graph.hpp"

namespace mesher {

// Repairs a graph that is not planar: afterwards, lines meet only at common points.
//
// Example:
//   const mesher::GraphFile<2> read = mesher::read<2>("roads.poly");
//   const mesher::Repaired<2> repaired = mesher::repair(read);
//   for (const auto& note : repaired.notes) std::puts(note.text().c_str());
//   ... repaired.file.graph ...
//
// Parts closer than a tolerance are made to touch. The least tolerance, taken if none is given, is
// 2^-44 of the side of the meshing box (for a map of the Earth in degrees: 10^-10 of a degree), and
// at least 16 units in the last place of the largest coordinate. The box is that of
// Options::domain.
//
// Guarantees:
//   (1) two pieces of lines meet at most in a common end, exactly; no piece occurs twice; a point
//       is on no piece of which it is not an end. Two points are farther apart than half the
//       tolerance, and a point is farther from such a piece than the tolerance, unless that is less
//       than a unit of rounding. So a Mesher accepts the graph, unless angles are too small for
//       doubles;
//   (2) points that are kept stay where they were, bit for bit, with their ids, markers and
//       attributes;
//   (3) lines cover the same set as before up to `deviation`, a few tolerances; holes and regions
//       stay;
//   (4) a graph without faults is returned as it is, so repair(repair(x)) is repair(x);
//   (5) the result depends only on coordinates and ids, not on the order of the input's elements,
//       except for the order of the returned elements.
//
// Rules:
//   merging      Of points within twice the tolerance of each other one is kept: going through the
//                points in lexicographic order (equal ones by id), a point with a kept point that
//                close is replaced by the nearest such. A kept point without a marker takes the
//                marker of the points it replaces, by id.
//   splitting    A point within the tolerance of a piece of a line becomes a point of the line.
//                Where two pieces cross, both get a point: an existing one within twice the
//                tolerance, or a new one at the crossing, rounded to doubles. The pieces bend by
//                that much, so splitting is repeated until nothing is left to split.
//   ids          A line keeps its id and marker for all its pieces; a segment of several pieces
//                becomes a polyline. New points are numbered after the highest id of a point,
//                ordered by coordinates within each round; they have the marker of the line with
//                the smallest id through them, and attributes interpolated linearly along it.
//   overlaps     A piece that several lines cover belongs to the line with the smallest id; the
//                others lose it. The part of such a line behind a gap becomes a line of its own,
//                with the same marker, numbered after the highest id of a line.
//   dropping     Pieces from a point to itself, and lines without any piece, are dropped.

/// The kind of a repair, with the ids that its note lists.
enum class RepairKind : std::uint8_t {
  merged_points,      ///< points: the removed one, the kept one
  zero_length,        ///< lines: the line of a piece without length; points: its end
  split_at_point,     ///< lines, or polygons: one that now has a further point; points: that point
  split_at_crossing,  ///< lines, polygons: those that now have a new point; points: that point
  overlap,            ///< lines, or polygons: one that lost a part, and the one that has it now
  renamed,            ///< lines: one that has a gap or is split, and the new line of the rest
  dropped_line,       ///< lines: one without any piece left
  bent_polygon,  ///< polygons: one that was not flat, and the new polygons of its other triangles
  cut_polygon,   ///< polygons: one that was cut into several, and the new ones
  dropped_polygon,  ///< polygons: one without any area left
};

/// One step of a repair. D is 2 or 3.
template <int D>
struct RepairNote {
  RepairKind kind{};
  std::vector<LineId> lines;
  std::vector<PointId> points;
  Point<D> at{};          ///< where it is, or begins
  FileLocation location;  ///< of the first line or polygon, if there is one, or of the first point
  std::vector<PolygonId> polygons{};
  double deviation = 0;  ///< of a bent polygon: how far the farthest corner is off its plane

  /// "FILE:LINE:COL: " and the repair, in words; without the location if it is not known. `prefix`
  /// is put before the words.
  [[nodiscard]] std::string text(const std::string& prefix = {}) const;
};

/// A repaired graph, and the steps of its repair. D is 2 or 3.
template <int D>
struct Repaired {
  GraphFile<D> file;  ///< new elements have the file position of the element that they come from;
                      ///< new points have none
  std::vector<RepairNote<D>> notes;  ///< by kind, then by ids
  double tolerance = 0;              ///< input units: what was made to touch at first
  /// The largest distance of the new from the old features, and of the old from the new, but for
  /// what is dropped.
  double deviation = 0;
};

/// How much a repair makes touch.
template <int D>
struct RepairOptions {
  /// Of the Options that the graph will be meshed with; default: snapped_domain of its points.
  std::optional<Box<D>> domain{};
  /// Parts closer than this are made to touch; in input units. If it is less than the least
  /// tolerance, as 0 is, that is taken. Default: the least one in the plane, in space
  /// kDefaultRepairShare of the box's side. At most kLargestRepairShare of it.
  std::optional<double> tolerance{};
};
/// What models with coordinates of six digits tell apart.
inline constexpr double kDefaultRepairShare = 0x1p-20;
inline constexpr double kLargestRepairShare = 0x1p-6;

/// Repairs a graph. Positions that `file` does not have are unknown.
/// Throws: Error (not_finite, magnitude, outside_domain, repeated_id, unknown_id, wrong_count: of
/// attributes) for a graph that cannot be repaired; Error(bad_option) for a domain that cannot be
/// meshed, or a tolerance that is negative, not finite or too large; Error(too_close) if
/// kRepairRounds rounds are not enough.
/// Cost: O((n + c) log L/s) for n pieces of lines and c crossings, if lines are about as long as
/// they are far apart or lie side by side (10^5 segments that cross 10^5 times: 3 s); more for long
/// lines in all directions. The worst case is many lines that cross at one position: O(n^1.5 log
/// L/s).
[[nodiscard]] Repaired<2> repair(const GraphFile<2>& file, const RepairOptions<2>& options = {});
[[nodiscard]] Repaired<2> repair(const Graph<2>& pslg, const RepairOptions<2>& options = {});

/// The largest number of rounds of a repair.
inline constexpr int kRepairRounds = 32;

// Repairs a complex whose parts do not fit together: afterwards, segments and polygons meet only at
// common points and edges, and polygons are flat.
//
// Example:
//   const mesher::GraphFile<3> read = mesher::read<3>("house.poly");
//   const mesher::Repaired<3> repaired = mesher::repair(read);
//   for (const auto& note : repaired.notes) std::puts(note.text().c_str());
//   ... repaired.file.graph ...
//
// Parts closer than a tolerance are made to touch, where that comes to an end soon: to bend what is
// there makes other parts touch. What is left is done with a tolerance that is 64 times less, and
// so on, down to the least one: 2^-42 of the side of the meshing box, and at least 64 units in the
// last place of the largest coordinate. The box is that of Options::domain. (Where surfaces whose
// coordinates were rounded touch, with the least tolerance they cross each other in thousands of
// lines, at distances and angles that are all rounding; a mesh of that has many times the vertices,
// and takes as long.)
//
// Guarantees:
//   (1) a Mesher accepts the result, unless angles are too small for doubles: the repair ends with
//       the tests of the Mesher, and an Error if they find a fault;
//   (2) points that are kept stay where they were, bit for bit, with their ids, markers and
//       attributes;
//   (3) segments and polygons cover the same set as before up to `deviation`, some tolerances; a
//       polygon that is not flat covers what the triangles between its points cover. Holes and
//       regions stay;
//   (4) a complex without faults is returned as it is, so repair(repair(x)) is repair(x);
//   (5) the result depends only on coordinates and ids, not on the order of the input's elements,
//       except for the order of the returned elements.
//
// Rules, applied in this order until nothing is left to do:
//   merging      As in the plane: of points within twice the tolerance one is kept.
//   edges        An edge within the tolerance of a point is led through it. Two edges that come
//                that close to each other get a common point: an existing one within twice the
//                tolerance, or a new one, rounded to doubles. An edge is one of a segment, of a
//                loop of a polygon, or declared to lie in a polygon.
//   polygons     A position is inside if an odd number of loops go around it; edges that two loops
//                share, and loops that go there and back, are no borders. A polygon that meets
//                itself in a point is cut there. A polygon that is not flat by the mesher's measure
//                is cut into triangles, as near to Delaunay in its plane as its loops and the
//                features inside it, and edges that lie on it within the tolerance, allow. Edges
//                that only cuts have get a common point with others only where they cross.
//   on polygons  A point, or an edge, on a polygon is declared to lie in it. Where an edge goes
//                through a polygon, it gets a point, which is declared as well.
//   crossings    Polygons that cross both get the edges along their line of intersection.
//   overlaps     An area that several polygons cover, or a length that several segments cover,
//                belongs to the one with the smallest id.
//   ids          The first part of a polygon or segment keeps the id, ordered by coordinates (of a
//                segment: from its first end on); others are numbered after the highest id, with
//                the same marker. New points are numbered likewise; they have the marker of the
//                segment with the smallest id through them, or else of such a polygon, and
//                attributes interpolated linearly along an edge.
//   dropping     Segments without length and polygons without area are dropped.

/// Repairs a complex. Positions that `file` does not have are unknown.
/// Throws: Error (not_finite, magnitude, outside_domain, repeated_id, unknown_id, wrong_count: of
/// attributes) for a complex that cannot be repaired; Error(bad_option) for a domain that cannot be
/// meshed, or a tolerance as in the plane; Error(not_flat) for a polygon with holes or more than
/// 256 corners that is so bent that its edges cross in every view; Error(too_close) if twice
/// kRepairRounds rounds are not enough, or nearly parallel parts cannot be told apart.
/// Cost: O((n + c) log L/s) for n edges and c crossings, if polygons are about as large as they are
/// far apart.
[[nodiscard]] Repaired<3> repair(const GraphFile<3>& file, const RepairOptions<3>& options = {});
[[nodiscard]] Repaired<3> repair(const Graph<3>& plc, const RepairOptions<3>& options = {});

}  // namespace mesher
