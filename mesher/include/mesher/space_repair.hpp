// Repairs a complex whose parts do not fit together: after it, segments and polygons meet at common
// points and edges only, and polygons are flat.
//
// Example:
//   const mesher::PlcFile read = mesher::read_plc("house.poly");
//   const mesher::RepairedPlc repaired = mesher::repair(read);
//   for (const auto& note : repaired.notes) std::puts(note.text().c_str());
//   ... repaired.file.plc ...
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
#pragma once

#include <optional>
#include <vector>

#include "mesher/plc.hpp"
#include "mesher/repair.hpp"

namespace mesher {

/// A complex without faults, and how it became so.
struct RepairedPlc {
  PlcFile file;  ///< what is new has the position of what it comes from; new points have none
  std::vector<RepairNoteOf<3>> notes;  ///< by kind, then by ids
  double tolerance = 0;                ///< input units
  double deviation = 0;  ///< of new segments and flat polygons from the old ones: the most
};

/// Repairs a complex. `domain`: of the Options that it will be meshed with, snapped_domain of its
/// points by default. Positions that `file` does not have are unknown.
/// Throws: Error (not_finite, magnitude, outside_domain, repeated_id, unknown_id, wrong_count: of
/// attributes) for what cannot be repaired; Error(bad_option) for a domain that cannot be meshed;
/// Error(not_flat) for a polygon that is so bent that its edges cross in every view, if it has
/// holes or more than 256 corners; Error(too_close) if twice kRepairRounds do not do, or what is
/// nearly parallel cannot be told apart.
/// Cost: O((n + c) log L/s) for n edges and c crossings, where polygons are about as large as they
/// are far apart.
[[nodiscard]] RepairedPlc repair(const PlcFile& file, const std::optional<Box<3>>& domain = {});
[[nodiscard]] RepairedPlc repair(const Plc& plc, const std::optional<Box<3>>& domain = {});

}  // namespace mesher
