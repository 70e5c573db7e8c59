// Makes a drawing one that fits together.
#pragma once

#include <vector>

#include "repair/drawing.hpp"
#include "repair/space_drawing.hpp"

namespace mesher::detail {

/// Makes it planar: leads rods through the points near them, and makes points where they cross,
/// until no rod is near a point that is not its end, and no two meet but at a common end. Returns
/// the number of rounds. Throws: Error(too_close) if kRepairRounds do not do.
///
/// Why it ends: rods are only split into shorter ones, with their ends among the points. While no
/// point is made, the rods' lengths are some of finitely many, and a multiset of these in which one
/// is replaced by smaller ones again and again comes to an end. Points are made only so far from
/// others (half the tolerance), in the box of all points: that comes to an end as well. How many
/// rounds it takes is another matter; two or three is what is seen.
int arrange(Drawing<2>& drawing);

/// Leads edges through the points near them, makes points where edges cross and where they go
/// through polygons, declares what lies on polygons, joins polygons along the lines in which they
/// cross, and leaves to the first of several what they cover together; until there is nothing to be
/// done. `names`: of facets. Returns the number of rounds.
/// Begins with the drawing's tolerance. Where that is not the `least`, only so many rounds are made
/// with it, and what is left to be done, or cannot be, is done with less and less: to bend what is
/// there makes other parts touch, and that need not come to an end soon with a large tolerance.
/// Throws: Error(too_close) if twice kRepairRounds do not do with the least; Error(not_flat).
int arrange(Drawing<3>& drawing, const std::vector<PolygonId>& names, double least);

}  // namespace mesher::detail
