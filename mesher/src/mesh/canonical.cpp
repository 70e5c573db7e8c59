// Sorting vertices and simplices.
#include "mesh/canonical.hpp"

namespace mesher::detail {

namespace {

// The simplices in lexicographic order: counted by their first corner, then each corner's few.
template <std::size_t N>
auto sorted_by_corner(const std::vector<std::array<VertexHandle, N>>& simplices,
                      const std::vector<std::uint32_t>& index, std::size_t corners) {
  using Simplex = std::array<std::uint32_t, N>;
  std::vector<Simplex> renamed;
  renamed.reserve(simplices.size());
  std::vector<std::uint32_t> start(corners + 1, 0);
  for (Simplex t : simplices) {
    for (std::uint32_t& corner : t) corner = index[corner];
    renamed.push_back(smallest_first(t));
    ++start[renamed.back()[0] + 1];
  }
  for (std::size_t i = 1; i <= corners; ++i) start[i] += start[i - 1];
  std::vector<Simplex> sorted(simplices.size());
  std::vector<std::uint32_t> next = start;
  for (const Simplex& t : renamed) sorted[next[t[0]]++] = t;
  for (std::size_t i = 0; i < corners; ++i) {
    std::sort(sorted.begin() + start[i], sorted.begin() + start[i + 1]);
  }
  return sorted;
}

template <int D>
struct Placed {
  Point<D> p;
  std::uint32_t handle;
};

// All of a mesh but its edges, and where the vertices went, by handle.
template <std::size_t N, class KindOf>
Mesh<N - 1> sorted(std::vector<Placed<N - 1>> placed, KindOf&& kind_of,
                   const std::vector<std::array<VertexHandle, N>>& simplices,
                   std::vector<std::uint32_t>& index) {
  std::sort(placed.begin(), placed.end(), [](const auto& a, const auto& b) { return a.p < b.p; });
  Mesh<N - 1> mesh;
  mesh.vertices.reserve(placed.size());
  mesh.kinds.reserve(placed.size());
  for (const auto& v : placed) {
    index[v.handle] = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.push_back(v.p);
    mesh.kinds.push_back(kind_of(v.handle));
  }
  mesh.simplices = sorted_by_corner(simplices, index, placed.size());
  return mesh;
}

// `index`: in the mesh, by the names that `on` calls vertices.
template <int D>
void add_parts(Mesh<D>& mesh, const OnFeatures& on, const std::vector<std::uint32_t>& index) {
  mesh.edges.reserve(on.edges.size());
  for (const LineEdge& e : on.edges) {
    const auto [low, high] = std::minmax(index[e.from], index[e.to]);
    mesh.edges.push_back({low, high, e.line, e.of_polygon});
  }
  std::sort(mesh.edges.begin(), mesh.edges.end());
  mesh.faces.reserve(on.faces.size());
  for (const PolygonFace& f : on.faces) {
    std::array<std::uint32_t, 3> corners{index[f.corners[0]], index[f.corners[1]],
                                         index[f.corners[2]]};
    std::sort(corners.begin(), corners.end());
    mesh.faces.push_back({corners, f.polygon});
  }
  std::sort(mesh.faces.begin(), mesh.faces.end());
}

}  // namespace

template <int D>
Mesh<D> canonical(std::span<const Point<D>> places, std::span<const VertexKind> kinds,
                  std::uint32_t first,
                  const std::vector<std::array<std::uint32_t, D + 1>>& simplices,
                  const OnFeatures& on) {
  std::vector<Placed<D>> placed;
  placed.reserve(places.size());
  for (const Point<D>& p : places) {
    placed.push_back({p, first + static_cast<std::uint32_t>(placed.size())});
  }
  std::vector<std::uint32_t> index(first + places.size());
  const auto kind_of = [&](std::uint32_t v) { return kinds[v - first]; };
  Mesh<D> mesh = sorted<D + 1>(std::move(placed), kind_of, simplices, index);
  add_parts(mesh, on, index);
  return mesh;
}

template <std::size_t N>
Mesh<N - 1> canonical(const VertexPool<N - 1>& pool, std::vector<VertexHandle> vertices,
                      const std::vector<std::array<VertexHandle, N>>& simplices,
                      const OnFeatures& on) {
  std::vector<Placed<N - 1>> placed;
  placed.reserve(vertices.size());
  for (const VertexHandle h : vertices) placed.push_back({pool[h].p, h});
  std::vector<std::uint32_t> index(
      vertices.empty() ? 0 : *std::max_element(vertices.begin(), vertices.end()) + std::size_t{1});
  const auto kind_of = [&](VertexHandle h) { return pool[h].kind(); };
  Mesh<N - 1> mesh = sorted<N>(std::move(placed), kind_of, simplices, index);
  add_parts(mesh, on, index);
  return mesh;
}

template Mesh<2> canonical<2>(std::span<const Point<2>>, std::span<const VertexKind>, std::uint32_t,
                              const std::vector<std::array<std::uint32_t, 3>>&,
                              const OnFeatures&);
template Mesh<3> canonical<3>(std::span<const Point<3>>, std::span<const VertexKind>, std::uint32_t,
                              const std::vector<std::array<std::uint32_t, 4>>&,
                              const OnFeatures&);
template Mesh<2> canonical(const VertexPool<2>&, std::vector<VertexHandle>,
                           const std::vector<std::array<VertexHandle, 3>>&, const OnFeatures&);
template Mesh<3> canonical(const VertexPool<3>&, std::vector<VertexHandle>,
                           const std::vector<std::array<VertexHandle, 4>>&, const OnFeatures&);

}  // namespace mesher::detail
