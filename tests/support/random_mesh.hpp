// Random meshes with features, for tests of what goes into files: a grid of triangles with places
// moved a little, and origins, markers, regions and edges of all kinds.
#pragma once

#include <cmath>
#include <cstdint>
#include <utility>

#include "mesher/extra/generate.hpp"
#include "mesher/mesh.hpp"

namespace support {

/// Which values a random mesh may have.
struct MeshValues {
  bool any_region = true;  ///< else small positive integers
  bool any_marker = true;  ///< else small positive integers
};

/// A valid mesh of (n+1)^2 vertices; its edges are of the mesh, no array is all 0. Requires: n
/// >= 1.
[[nodiscard]] inline mesher::MeshData<2> random_mesh(std::uint32_t n, mesher::SplitMix64& random,
                                                     MeshValues values = {}) {
  using mesher::LineId;
  using mesher::PointId;
  using mesher::VertexKind;
  mesher::MeshData<2> mesh;
  const double scale = std::ldexp(1.0, static_cast<int>(random.below(60)) - 30);
  const auto integer = [&] { return static_cast<std::int64_t>(random.bits()) >> random.below(64); };
  const auto marker = [&] {
    const std::int64_t any = integer();
    return values.any_marker && any != 0 ? any : static_cast<std::int64_t>(1 + random.below(5));
  };
  for (std::uint32_t x = 0; x <= n; ++x) {
    for (std::uint32_t y = 0; y <= n; ++y) {
      mesh.vertices.push_back({scale * (x + random.unit() / 4), -scale * (y + random.unit() / 4)});
      mesh.kinds.push_back(static_cast<VertexKind>(random.below(4)));
      mesher::Feature origin;
      if (mesh.kinds.back() == VertexKind::input) origin = PointId{integer()};
      if (mesh.kinds.back() == VertexKind::segment) origin = LineId{integer()};
      mesh.features.origins.push_back(origin);
      mesh.features.markers.push_back(random.below(3) == 0 ? marker() : 0);
    }
  }
  const auto at = [&](std::uint32_t x, std::uint32_t y) { return x * (n + 1) + y; };
  for (std::uint32_t x = 0; x < n; ++x) {
    for (std::uint32_t y = 0; y < n; ++y) {
      mesh.simplices.push_back({at(x, y), at(x, y + 1), at(x + 1, y + 1)});
      mesh.simplices.push_back({at(x, y), at(x + 1, y + 1), at(x + 1, y)});
    }
  }
  for (std::size_t i = 0; i < mesh.simplices.size(); ++i) {
    const double small = static_cast<double>(1 + random.below(3));
    mesh.features.regions.push_back(values.any_region ? small * random.unit() - 1 : small);
  }
  for (const auto& [low, high] : mesher::edges(mesh)) {
    if (random.below(3) != 0) continue;
    mesher::MeshEdge edge;
    edge.low = low;
    edge.high = high;
    if (random.below(4) != 0) edge.line = LineId{integer()};
    edge.marker = edge.line && random.below(2) == 0 ? 0 : marker();
    mesh.features.edges.push_back(edge);
  }
  mesh.kinds[0] = VertexKind::input;
  mesh.features.origins[0] = PointId{7};
  mesh.features.markers[0] = marker();
  return mesh;
}

}  // namespace support
