// Numbers of vertices and simplices in a mesh of which each process has a part.
#pragma once

#include <cstdint>
#include <vector>

#include "tiles/tiled_mesher.hpp"

namespace mesher::detail {

/// In the whole mesh, from 0: the vertices that a process owns are numbered behind those of the
/// processes before it, by their places; so are simplices, in their order.
template <int D>
struct JointNumbers {
  std::vector<std::uint64_t> vertices;  // of the part, one each
  std::uint64_t first_simplex = 0;      // of the part
  std::vector<Point<D>> owned;          // by this process, ascending, and their numbers from...
  std::uint64_t first_owned = 0;
  std::uint64_t all_vertices = 0, all_simplices = 0;
};

/// Of all processes. `own`: the part of this one, with a vertex of others wherever it needs one.
/// Cost: O(n log n) for the part, and three exchanges between neighbours.
template <int D>
[[nodiscard]] JointNumbers<D> joint_numbers(const Mesh<D>& own, const TiledMesher<D>& tiles,
                                            Peers& peers);

}  // namespace mesher::detail
