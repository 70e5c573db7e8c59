// Edits, as lines of a script, that make one graph of another.
//
// Example: what undoes an update is graph_edits(after, before), of the features that it edits.
#pragma once

#include <string>
#include <vector>

#include "mesher/graph.hpp"

namespace tool {

/// The edits of one batch that make `to` of `from`, without names of groups and attributes of
/// points. A line of two points is a segment. D is 2 or 3. Cost: O(n log n).
template <int D>
[[nodiscard]] std::vector<std::string> graph_edits(const mesher::Graph<D>& from,
                                                   const mesher::Graph<D>& to);

/// The script of one update: a line alone, others between begin and commit.
[[nodiscard]] std::string script_of(const std::vector<std::string>& lines);

/// A number as scripts have it, which reads back as it is.
[[nodiscard]] std::string script_number(double value);

/// Of all points, lines, polygons and seeds, in the order of the arrays, in hexadecimal.
template <int D>
[[nodiscard]] std::string hash_of_graph(const mesher::Graph<D>& graph);

}  // namespace tool
