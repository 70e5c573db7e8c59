// The canonical form of a mesh: a function of its set of vertices and simplices.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "mesher/mesh.hpp"
#include "records/vertex.hpp"

namespace mesher::detail {

/// An edge on a line of the input, by handles.
struct LineEdge {
  VertexHandle from, to;
  mesher::Feature name;      // as in Mesh::Edge
  std::uint32_t record = 0;  // in space: of the edge of the input
  friend auto operator<=>(const LineEdge&, const LineEdge&) = default;
};
/// A face in a polygon of the input.
struct PolygonFace {
  std::array<VertexHandle, 3> corners;
  PolygonId polygon;
  friend auto operator<=>(const PolygonFace&, const PolygonFace&) = default;
};
/// What of a mesh is part of the input's features; in any order.
struct OnFeatures {
  std::vector<LineEdge> edges;
  std::vector<PolygonFace> faces;
};

/// Rotates a triangle so that the smallest corner comes first.
template <class T>
[[nodiscard]] std::array<T, 3> smallest_first(std::array<T, 3> t) {
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  return t;
}
/// The same of a tetrahedron, without turning it inside out: then the smallest of the others.
template <class T>
[[nodiscard]] std::array<T, 4> smallest_first(std::array<T, 4> t) {
  // All in order by swaps, of which an odd number turns it; no branch could be foreseen.
  bool turned = false;
  const auto order = [&](std::size_t i, std::size_t j) {
    const bool swaps = t[j] < t[i];
    const T least = swaps ? t[j] : t[i], other = swaps ? t[i] : t[j];
    t[i] = least, t[j] = other;
    turned ^= swaps;
  };
  order(0, 1), order(2, 3), order(0, 2), order(1, 3), order(1, 2);
  const T c = turned ? t[3] : t[2], d = turned ? t[2] : t[3];
  return {t[0], t[1], c, d};
}

/// `vertices` in any order; `simplices` by handles, positively oriented.
/// Cost: O(m log m).
template <std::size_t N>
[[nodiscard]] Mesh<N - 1> canonical(const VertexPool<N - 1>& pool,
                                    std::vector<VertexHandle> vertices,
                                    const std::vector<std::array<VertexHandle, N>>& simplices,
                                    const OnFeatures& on = {});

/// Calls act(batch) with what for_each(visit) visits, many at a time. What batches need of memory
/// is fetched as they fill: prepare(simplex).
template <class Simplex, class ForEach, class Prepare, class Act>
void for_each_batch(ForEach&& for_each, Prepare&& prepare, Act&& act) {
  std::array<Simplex, 64> batch;
  std::size_t used = 0;
  for_each([&](const Simplex& simplex) {
    prepare(simplex);
    batch[used++] = simplex;
    if (used < batch.size()) return;
    act(std::span(batch));
    used = 0;
  });
  act(std::span(batch).first(used));
}

/// Renamed simplices, smallest corners first, in lexicographic order: counted by their first
/// corner, then each corner's few are sorted. `for_each(visit)` calls visit(simplex) for each, in
/// the same order each time: a list of them would be as large again. `index`: the new names, below
/// `corners`. Requires: fewer than 2^32 simplices.
template <std::size_t N, class ForEach>
[[nodiscard]] std::vector<std::array<std::uint32_t, N>> sorted_by_corner(
    const std::vector<std::uint32_t>& index, std::size_t corners, ForEach&& for_each) {
  using Simplex = std::array<std::uint32_t, N>;
  const auto fetch_names = [&](const Simplex& t) {
    for (const std::uint32_t corner : t) __builtin_prefetch(&index[corner]);
  };
  std::vector<std::uint32_t> begin(corners + 1, 0);
  for_each_batch<Simplex>(for_each, fetch_names, [&](std::span<const Simplex> batch) {
    for (const Simplex& t : batch) {
      std::uint32_t least = index[t[0]];
      for (const std::uint32_t corner : t) least = std::min(least, index[corner]);
      ++begin[least + std::size_t{1}];
    }
  });
  std::inclusive_scan(begin.begin(), begin.end(), begin.begin());
  std::vector<Simplex> sorted(begin.back());
  std::vector<std::uint32_t> next = begin;
  for_each_batch<Simplex>(for_each, fetch_names, [&](std::span<Simplex> batch) {
    for (Simplex& t : batch) {
      for (std::uint32_t& corner : t) corner = index[corner];
      t = smallest_first(t);
      __builtin_prefetch(&next[t[0]], 1);
    }
    for (const Simplex& t : batch) __builtin_prefetch(sorted.data() + next[t[0]], 1);
    for (const Simplex& t : batch) sorted[next[t[0]]++] = t;
  });
  const auto is_before = [](const Simplex& a, const Simplex& b) {
    return a[1] != b[1] ? a[1] < b[1] : a < b;
  };
  for (std::size_t i = 0; i < corners; ++i) {
    std::sort(sorted.data() + begin[i], sorted.data() + begin[i + 1], is_before);
  }
  return sorted;
}

/// A mesh of vertices alone, which are called first, first + 1, ... at `places`. `index`: where
/// they went, by name.
template <int D>
[[nodiscard]] Mesh<D> sorted_vertices(std::span<const Point<D>> places,
                                      std::span<const VertexKind> kinds, std::uint32_t first,
                                      std::vector<std::uint32_t>& index);

/// `index`: in the mesh, by the names that `on` calls vertices.
template <int D>
void add_parts(Mesh<D>& mesh, const OnFeatures& on, const std::vector<std::uint32_t>& index);

/// The same of vertices first, first + 1, ... at `places`, and for_each as in sorted_by_corner.
template <int D, class ForEach>
[[nodiscard]] Mesh<D> canonical(std::span<const Point<D>> places, std::span<const VertexKind> kinds,
                                std::uint32_t first, const OnFeatures& on, ForEach&& for_each) {
  std::vector<std::uint32_t> index;
  Mesh<D> mesh = sorted_vertices<D>(places, kinds, first, index);
  mesh.simplices = sorted_by_corner<D + 1>(index, places.size(), for_each);
  add_parts(mesh, on, index);
  return mesh;
}

}  // namespace mesher::detail
