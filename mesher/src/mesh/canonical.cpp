// Sorting vertices and triangles.
#include "mesh/canonical.hpp"

namespace mesher::detail {

namespace {

using Simplex = Mesh<2>::Simplex;

// The triangles in lexicographic order: counted by their first corner, then each corner's few.
std::vector<Simplex> sorted_by_corner(const std::vector<std::array<VertexHandle, 3>>& triangles,
                                      const std::vector<std::uint32_t>& index,
                                      std::size_t corners) {
  std::vector<Simplex> renamed;
  renamed.reserve(triangles.size());
  std::vector<std::uint32_t> start(corners + 1, 0);
  for (const auto& t : triangles) {
    renamed.push_back(smallest_first(Simplex{index[t[0]], index[t[1]], index[t[2]]}));
    ++start[renamed.back()[0] + 1];
  }
  for (std::size_t i = 1; i <= corners; ++i) start[i] += start[i - 1];
  std::vector<Simplex> sorted(triangles.size());
  std::vector<std::uint32_t> next = start;
  for (const Simplex& t : renamed) sorted[next[t[0]]++] = t;
  for (std::size_t i = 0; i < corners; ++i) {
    std::sort(sorted.begin() + start[i], sorted.begin() + start[i + 1]);
  }
  return sorted;
}

}  // namespace

Mesh<2> canonical(const VertexPool<2>& pool, std::vector<VertexHandle> vertices,
                  const std::vector<std::array<VertexHandle, 3>>& triangles,
                  const std::vector<LineEdge>& edges) {
  struct Placed {
    Point<2> p;
    VertexHandle handle;
  };
  std::vector<Placed> placed;
  placed.reserve(vertices.size());
  for (const VertexHandle h : vertices) placed.push_back({pool[h].p, h});
  std::sort(placed.begin(), placed.end(),
            [](const Placed& a, const Placed& b) { return a.p < b.p; });
  Mesh<2> mesh;
  mesh.vertices.reserve(placed.size());
  mesh.kinds.reserve(placed.size());
  std::vector<std::uint32_t> index(
      vertices.empty() ? 0 : *std::max_element(vertices.begin(), vertices.end()) + std::size_t{1});
  for (const Placed& v : placed) {
    index[v.handle] = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.push_back(v.p);
    mesh.kinds.push_back(pool[v.handle].kind());
  }
  mesh.simplices = sorted_by_corner(triangles, index, placed.size());
  mesh.edges.reserve(edges.size());
  for (const LineEdge& e : edges) {
    const auto [low, high] = std::minmax(index[e.from], index[e.to]);
    mesh.edges.push_back({low, high, e.line});
  }
  std::sort(mesh.edges.begin(), mesh.edges.end());
  return mesh;
}

}  // namespace mesher::detail
