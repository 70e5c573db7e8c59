// The error for a mesh that needs more vertices than allowed: it names where they are.
#pragma once

#include <cstddef>
#include <map>

#include "index/vertex_search.hpp"
#include "mesher/error.hpp"
#include "plane/planarity.hpp"

namespace mesher::detail {

/// Names the two lines with the most vertices on them, if there are any. Cost: O(vertices).
[[nodiscard]] Error too_many_vertices(const VertexSearch<2>& vertices, const Names* names,
                                      std::size_t most);
/// The same where the vertices on each line are counted.
[[nodiscard]] Error too_many_vertices(const std::map<LineId, std::size_t>& on_lines,
                                      std::size_t most);
}  // namespace mesher::detail
