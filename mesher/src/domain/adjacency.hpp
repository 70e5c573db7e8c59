// Who is next to whom in a set of triangles, and which of their edges are walls.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mesh/sides.hpp"

namespace mesher::detail {

/// Edge i of a triangle is across from its corner i.
struct Adjacency {
  std::vector<std::array<std::uint32_t, 3>> neighbours;  // kNoTriangle at the boundary
  std::vector<std::uint8_t> walls;                       // bit i: edge i is a wall

  [[nodiscard]] bool is_wall(std::uint32_t t, int i) const { return (walls[t] >> i & 1) != 0; }
  /// The triangle that a flood reaches across edge i; kNoTriangle if it does not.
  [[nodiscard]] std::uint32_t open_neighbour(std::uint32_t t, int i) const;
};

/// The ends of walls.
[[nodiscard]] std::vector<Edge> ends_of(const std::vector<MeshEdge>& walls);

/// Requires: no edge borders more than two triangles. Throws: Error(bad_mesh) for a wall that is no
/// edge. Cost: O(m log d) for vertices of degree d.
[[nodiscard]] Adjacency adjacency(const std::vector<Corners>& triangles,
                                  const std::vector<Edge>& walls);

/// The number of each triangle's region, counted in the order of their smallest triangles.
/// Cost: O(m).
[[nodiscard]] std::vector<std::uint32_t> flood(const Adjacency& adjacency);

}  // namespace mesher::detail
