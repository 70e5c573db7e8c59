// Checks that the ids of a graph are distinct, and that its lines end at existing points.
#pragma once

#include "mesher/graph.hpp"

namespace mesher::detail {

/// `file`: where the parts stand; null: nowhere.
/// Throws: Error(repeated_id). Cost: O(n) where ids ascend, else O(n log n).
template <int D>
void require_distinct_ids(const Graph<D>& graph, const GraphFile<D>* file);

/// Throws: Error (repeated_id; unknown_id for an end of a line that is no point; for a line of
/// fewer than two points bad_syntax, of no file bad_option). Cost: the same; of lines O(log n)
/// each.
template <int D>
void require_ids(const Graph<D>& graph, const GraphFile<D>* file = nullptr);

}  // namespace mesher::detail
