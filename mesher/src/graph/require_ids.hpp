// Whether the parts of a graph have ids of their own, and its lines end at points.
#pragma once

#include "mesher/graph.hpp"

namespace mesher::detail {

/// Throws: Error (repeated_id; unknown_id for an end that is no point; bad_syntax for a line of
/// fewer than two points).
template <int D>
void require_ids(const GraphFile<D>& file);

}  // namespace mesher::detail
