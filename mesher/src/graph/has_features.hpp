// Queries of a graph that do not depend on its geometry.
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
