// Edges where polygons end that enclose nothing.
#pragma once

#include <cstddef>
#include <optional>

#include "mesher/graph.hpp"
#include "mesher/mesh.hpp"

namespace tool {

/// Edges that have a polygon on one side only.
struct OpenSurface {
  std::size_t edges = 0;
  mesher::Point<3> from{}, to{};  ///< one of them
  mesher::PolygonId polygon{};    ///< that it belongs to
};

/// Of the edges that are not edges of a mesh which keeps what polygons enclose; of all of them if
/// `keeps_all`. Nothing if there are none. Cost: O(n log n).
[[nodiscard]] std::optional<OpenSurface> open_surface(const mesher::Graph<3>& graph,
                                                      const mesher::Mesh<3>& mesh, bool keeps_all);

}  // namespace tool
