// The canonical form of a mesh: a function of its set of vertices and triangles.
#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <vector>

#include "mesher/mesher.hpp"
#include "index/vertex.hpp"

namespace mesher::detail {

/// An edge on a line of the input, by handles.
struct LineEdge {
  VertexHandle from, to;
  FeatureId line;
};

/// `vertices` and `edges` in any order; `triangles` by handles, counterclockwise. Cost: O(m log m).
[[nodiscard]] Mesh<2> canonical(const VertexPool<2>& pool, std::vector<VertexHandle> vertices,
                                const std::vector<std::array<VertexHandle, 3>>& triangles,
                                const std::vector<LineEdge>& edges = {});

/// Rotates a triangle so that the smallest corner comes first.
template <class T>
[[nodiscard]] std::array<T, 3> smallest_first(std::array<T, 3> t) {
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  return t;
}

template <class W>
[[nodiscard]] MeshStats timed_stats(const W& world, const Mesh<2>& mesh) {
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
