// The size of a mesh, and the times of the parts of the run that made it.
#pragma once

#include <chrono>

#include "mesher/mesher.hpp"

namespace mesher::detail {

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
