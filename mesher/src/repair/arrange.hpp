// Makes a drawing planar.
#pragma once

#include "repair/drawing.hpp"

namespace mesher::detail {

/// Leads rods through the points near them, and makes points where they cross, until no rod is near
/// a point that is not its end, and no two meet but at a common end. Returns the number of rounds.
/// Throws: Error(too_close) if kRepairRounds do not do.
///
/// Why it ends: rods are only split into shorter ones, with their ends among the points. While no
/// point is made, the rods' lengths are some of finitely many, and a multiset of these in which one
/// is replaced by smaller ones again and again comes to an end. Points are made only so far from
/// others (half the tolerance), in the box of all points: that comes to an end as well. How many
/// rounds it takes is another matter; two or three is what is seen.
int arrange(Drawing& drawing);

}  // namespace mesher::detail
