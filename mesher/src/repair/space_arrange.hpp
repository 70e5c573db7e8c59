// Makes a drawing in space one that fits together.
#pragma once

#include <vector>

#include "repair/space_drawing.hpp"

namespace mesher::detail {

/// Leads edges through the points near them, makes points where edges cross and where they go
/// through polygons, declares what lies on polygons, joins polygons along the lines in which they
/// cross, and leaves to the first of several what they cover together; until there is nothing to be
/// done. `names`: of facets. Returns the number of rounds.
/// Throws: Error(too_close) if kRepairRounds do not do; Error(not_flat).
int arrange(SpaceDrawing& drawing, const std::vector<PolygonId>& names);

}  // namespace mesher::detail
