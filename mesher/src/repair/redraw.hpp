// What a planar drawing makes of the lines and points that were drawn.
#pragma once

#include <vector>

#include "mesher/repair.hpp"
#include "repair/drawing.hpp"

namespace mesher::detail {

/// The graph of `file` as it is in the drawing, with notes of what is not as it was.
/// spots: of each point of the file; keepers: of each of the first spots, the point that stays.
[[nodiscard]] Repaired<2> redraw(const GraphFile<2>& file, const Drawing& drawing,
                                 const std::vector<Spot>& spots,
                                 const std::vector<std::size_t>& keepers);

}  // namespace mesher::detail
