// Finds all conflicts in the plane, for all segments and points at once.
//
// A line sweeps from left to right (of places with equal x from below) over the segments, which it
// keeps in the order in which it meets them [Shamos and Hoey, Geometric intersection problems,
// 1976]. Two that are in conflict are neighbours in this order before it comes to where they meet.
// One of the two is then a suspect, and is left out, so that the order stays one; likewise a
// segment on which there is a point that is no end of it. Exact.
#pragma once

#include <functional>
#include <vector>

#include "records/segment.hpp"
#include "records/vertex.hpp"

namespace mesher::detail {

/// Segments such that every conflict (segments/planarity.hpp) among `segments`, and of these with
/// `points`, is one of some of them; none: there is no conflict. Requires: the ends of segments are
/// among the points. `ask` is called in between, and may
/// throw. Cost: O(n log n), whatever the segments' lengths.
[[nodiscard]] std::vector<const Segment*> suspects_among(
    const std::vector<const Segment*>& segments, const std::vector<const Vertex<2>*>& points,
    const std::function<void()>& ask);

}  // namespace mesher::detail
