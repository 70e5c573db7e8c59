// The neighbours in a set of triangles or tetrahedra, and their sides that are walls.
//
// A side of a triangle is an edge, of a tetrahedron a face; it is across from a corner.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mesh/half_faces.hpp"
#include "mesh/sides.hpp"

namespace mesher::detail {

/// Side i of a simplex is across from its corner i.
template <int D>
struct AdjacencyOf {
  std::vector<std::array<std::uint32_t, D + 1>> neighbours;  // kNoTriangle at the boundary
  std::vector<std::uint8_t> walls;                           // bit i: side i is a wall

  [[nodiscard]] bool is_wall(std::uint32_t t, int i) const { return (walls[t] >> i & 1) != 0; }
  /// The simplex that a flood reaches across side i; kNoTriangle if it does not.
  [[nodiscard]] std::uint32_t open_neighbour(std::uint32_t t, int i) const {
    return is_wall(t, i) ? kNoTriangle : neighbours[t][static_cast<std::size_t>(i)];
  }
};
using Adjacency = AdjacencyOf<2>;

/// The corners of walls.
[[nodiscard]] std::vector<SideEnds> corners_of(const std::vector<MeshEdge>& walls);
[[nodiscard]] std::vector<Face> corners_of(const std::vector<MeshFace>& walls);

/// Requires: no edge borders more than two triangles. Throws: Error(bad_mesh) for a wall that is no
/// edge. Cost: O(m log d) for vertices of degree d.
[[nodiscard]] Adjacency adjacency(const std::vector<Corners>& triangles,
                                  const std::vector<SideEnds>& walls);
/// The same in space; walls by their corners, ascending. Cost: O(m log m).
[[nodiscard]] AdjacencyOf<3> adjacency(const std::vector<Mesh<3>::Simplex>& tetrahedra,
                                       const std::vector<Face>& walls);

/// The number of each simplex's region, counted in the order of their smallest simplices.
/// Cost: O(m).
template <int D>
[[nodiscard]] std::vector<std::uint32_t> flood(const AdjacencyOf<D>& adjacency);

}  // namespace mesher::detail
