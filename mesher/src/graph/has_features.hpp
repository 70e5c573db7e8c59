// What a graph is asked before its geometry is.
#pragma once

#include "mesher/graph.hpp"

namespace mesher {

/// Whether there are lines or polygons.
template <int D>
[[nodiscard]] bool has_features(const Graph<D>& graph) {
  if constexpr (D == 3) {
    if (!graph.polygons.empty()) return true;
  }
  return !graph.segments.empty() || !graph.polylines.empty();
}

}  // namespace mesher
