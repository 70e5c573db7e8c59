// Queries of a graph that do not depend on its geometry.
#pragma once

#include <algorithm>

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

/// Whether a part of a list (points, lines, polygons, or edges and faces of a mesh) has a marker.
[[nodiscard]] bool has_marker(const auto& parts) {
  return std::any_of(parts.begin(), parts.end(), [](const auto& part) { return part.marker != 0; });
}

}  // namespace mesher
