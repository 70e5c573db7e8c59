// The canonical form of a mesh: a function of its set of vertices and simplices.
#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <span>
#include <utility>
#include <vector>

#include "index/vertex.hpp"
#include "mesher/mesher.hpp"

namespace mesher::detail {

/// An edge on a line of the input, by handles.
struct LineEdge {
  VertexHandle from, to;
  FeatureId line;
  bool of_polygon = false;
  std::uint32_t feature = 0;  // in space: the record of the edge of the input
  friend auto operator<=>(const LineEdge&, const LineEdge&) = default;
};
/// A face in a polygon of the input.
struct PolygonFace {
  std::array<VertexHandle, 3> corners;
  FeatureId polygon;
  friend auto operator<=>(const PolygonFace&, const PolygonFace&) = default;
};
/// What of a mesh is part of the input's features; in any order.
struct OnFeatures {
  std::vector<LineEdge> edges;
  std::vector<PolygonFace> faces;
};

/// `vertices` in any order; `simplices` by handles, positively oriented.
/// Cost: O(m log m).
template <std::size_t N>
[[nodiscard]] Mesh<N - 1> canonical(const VertexPool<N - 1>& pool,
                                    std::vector<VertexHandle> vertices,
                                    const std::vector<std::array<VertexHandle, N>>& simplices,
                                    const OnFeatures& on = {});

/// The same of vertices first, first + 1, ... at `places`.
template <int D>
[[nodiscard]] Mesh<D> canonical(std::span<const Point<D>> places, std::span<const VertexKind> kinds,
                                std::uint32_t first,
                                const std::vector<std::array<std::uint32_t, D + 1>>& simplices,
                                const OnFeatures& on = {});

/// Rotates a triangle so that the smallest corner comes first.
template <class T>
[[nodiscard]] std::array<T, 3> smallest_first(std::array<T, 3> t) {
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  return t;
}
/// The same of a tetrahedron, without turning it inside out: then the smallest of the others.
template <class T>
[[nodiscard]] std::array<T, 4> smallest_first(std::array<T, 4> t) {
  const auto least = std::min_element(t.begin(), t.end());
  if (least != t.begin()) {
    std::swap(t[0], *least);
    std::swap(t[2], t[3]);  // turns it back, whichever was swapped
  }
  std::rotate(t.begin() + 1, std::min_element(t.begin() + 1, t.end()), t.end());
  return t;
}

template <class W, int D>
[[nodiscard]] MeshStats timed_stats(const W& world, const Mesh<D>& mesh) {
  const auto seconds = [&](std::size_t i) {
    return std::chrono::duration<double>(world.marks[i + 1] - world.marks[i]).count();
  };
  MeshStats stats;
  stats.vertices = mesh.vertices.size();
  stats.simplices = mesh.simplices.size();
  stats.seconds_quadtree = seconds(0);
  stats.seconds_steiner = seconds(1);
  stats.seconds_triangulate = seconds(2);
  return stats;
}

}  // namespace mesher::detail
