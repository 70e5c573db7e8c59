// Sorting vertices and simplices.
#include "mesh/canonical.hpp"

#include <cmath>

#include "sets/counting_sort.hpp"

namespace mesher::detail {

namespace {

template <int D>
struct PlacedVertex {
  Point<D> p;
  std::uint32_t handle;
};

// By coordinates from `axis` on; the earlier ones are equal. Requires: as many `spare`.
template <int D>
void sort_places(std::span<PlacedVertex<D>> placed, std::span<PlacedVertex<D>> spare,
                 std::size_t axis = 0) {
  const auto by_comparing = [&] {
    std::sort(placed.begin(), placed.end(),
              [axis](const PlacedVertex<D>& a, const PlacedVertex<D>& b) {
                return a.p[axis] != b.p[axis] ? a.p[axis] < b.p[axis] : a.p < b.p;
              });
  };
  if (placed.size() < kFewToSort || axis + 1 == D) return by_comparing();
  const auto ends = std::minmax_element(
      placed.begin(), placed.end(),
      [axis](const PlacedVertex<D>& a, const PlacedVertex<D>& b) { return a.p[axis] < b.p[axis]; });
  const double lo = ends.first->p[axis], width = ends.second->p[axis] - lo;
  if (width == 0) return sort_places<D>(placed, spare, axis + 1);
  const double scale = 0x1p62 / width;
  if (!std::isfinite(scale)) return by_comparing();
  spread_by_key(
      placed, spare,
      [&](const PlacedVertex<D>& v) {
        return static_cast<std::uint64_t>((v.p[axis] - lo) * scale);
      },
      [axis](auto part, auto rest) { sort_places<D>(part, rest, axis); });
}

// A mesh of vertices alone, and where they went, by handle.
template <int D, class KindOf>
Mesh<D> sorted(std::vector<PlacedVertex<D>> placed, KindOf&& kind_of,
               std::vector<std::uint32_t>& index) {
  std::vector<PlacedVertex<D>> spare(placed.size());
  sort_places<D>(placed, spare);
  Mesh<D> mesh;
  mesh.vertices.reserve(placed.size());
  mesh.kinds.reserve(placed.size());
  for (const auto& v : placed) {
    index[v.handle] = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.push_back(v.p);
    mesh.kinds.push_back(kind_of(v.handle));
  }
  return mesh;
}

}  // namespace

template <int D>
void add_parts(Mesh<D>& mesh, const OnFeatures& on, const std::vector<std::uint32_t>& index) {
  mesh.edges.reserve(on.edges.size());
  for (const LineEdge& e : on.edges) {
    const auto [low, high] = std::minmax(index[e.from], index[e.to]);
    mesh.edges.push_back({low, high, e.name});
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

template <int D>
Mesh<D> sorted_vertices(std::span<const Point<D>> places, std::span<const VertexKind> kinds,
                        std::uint32_t first, std::vector<std::uint32_t>& index) {
  std::vector<PlacedVertex<D>> placed;
  placed.reserve(places.size());
  for (const Point<D>& p : places) {
    placed.push_back({p, first + static_cast<std::uint32_t>(placed.size())});
  }
  index.resize(first + places.size());
  return sorted<D>(
      std::move(placed), [&](std::uint32_t v) { return kinds[v - first]; }, index);
}

template <std::size_t N>
Mesh<N - 1> canonical(const VertexPool<N - 1>& pool, std::vector<VertexHandle> vertices,
                      const std::vector<std::array<VertexHandle, N>>& simplices,
                      const OnFeatures& on) {
  std::vector<PlacedVertex<N - 1>> placed;
  placed.reserve(vertices.size());
  for (const VertexHandle h : vertices) placed.push_back({pool[h].p, h});
  std::vector<std::uint32_t> index(
      vertices.empty() ? 0 : *std::max_element(vertices.begin(), vertices.end()) + std::size_t{1});
  Mesh<N - 1> mesh = sorted<N - 1>(
      std::move(placed), [&](VertexHandle h) { return pool[h].kind(); }, index);
  mesh.simplices = sorted_by_corner<N>(index, mesh.vertices.size(), [&](auto&& visit) {
    std::for_each(simplices.begin(), simplices.end(), visit);
  });
  add_parts(mesh, on, index);
  return mesh;
}

template Mesh<2> sorted_vertices<2>(std::span<const Point<2>>, std::span<const VertexKind>,
                                    std::uint32_t, std::vector<std::uint32_t>&);
template void add_parts(Mesh<2>&, const OnFeatures&, const std::vector<std::uint32_t>&);
template Mesh<2> canonical(const VertexPool<2>&, std::vector<VertexHandle>,
                           const std::vector<std::array<VertexHandle, 3>>&, const OnFeatures&);
#ifndef MESHER_PLANE_ONLY
template Mesh<3> sorted_vertices<3>(std::span<const Point<3>>, std::span<const VertexKind>,
                                    std::uint32_t, std::vector<std::uint32_t>&);
template void add_parts(Mesh<3>&, const OnFeatures&, const std::vector<std::uint32_t>&);
template Mesh<3> canonical(const VertexPool<3>&, std::vector<VertexHandle>,
                           const std::vector<std::array<VertexHandle, 4>>&, const OnFeatures&);
#endif

}  // namespace mesher::detail
