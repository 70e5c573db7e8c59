// Sorting vertices and triangles.
#include "canonical.hpp"

namespace mesher::detail {

Mesh<2> canonical(const VertexPool<2>& pool, std::vector<VertexHandle> vertices,
                  const std::vector<std::array<VertexHandle, 3>>& triangles) {
  std::sort(vertices.begin(), vertices.end(),
            [&](VertexHandle a, VertexHandle b) { return pool[a].p < pool[b].p; });
  Mesh<2> mesh;
  mesh.vertices.reserve(vertices.size());
  mesh.kinds.reserve(vertices.size());
  std::vector<std::uint32_t> index;
  for (const VertexHandle h : vertices) {
    if (h >= index.size()) index.resize(2 * std::size_t{h} + 1);
    index[h] = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.push_back(pool[h].p);
    mesh.kinds.push_back(pool[h].kind());
  }
  mesh.simplices.reserve(triangles.size());
  for (const auto& t : triangles) {
    mesh.simplices.push_back(
        smallest_first(std::array<std::uint32_t, 3>{index[t[0]], index[t[1]], index[t[2]]}));
  }
  std::sort(mesh.simplices.begin(), mesh.simplices.end());
  return mesh;
}

}  // namespace mesher::detail
