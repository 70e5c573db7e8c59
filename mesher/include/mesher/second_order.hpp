// Nodes of a mesh of second order: its vertices, and the midpoints of its edges.
//
// Edges are straight: a midpoint is the mean of two vertices, and is projected on nothing.
//
// Example: the nodes of the first triangle.
//   const mesher::SecondOrder<2> second(mesh);
//   const std::array<std::uint32_t, 6> nodes = second.nodes_of(mesh.simplices[0]);
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "mesher/mesh.hpp"

namespace mesher {

/// Midpoints of the edges of a mesh. Node i is vertex i if there is one, else the midpoint of
/// edges()[i - vertices]. Nodes of cells and facets are in the order of VTK: the corners a, b, c,
/// d, then the midpoints of ab, bc, ca, ad, bd, cd. D is 2 or 3.
template <int D>
class SecondOrder {
 public:
  static constexpr std::size_t kCellNodes = D == 2 ? 6 : 10;

  /// Throws: Error(too_many) if nodes cannot be numbered by 32 bits. Cost: O(m log d).
  explicit SecondOrder(const Mesh<D>& mesh);

  /// (low, high), ascending.
  [[nodiscard]] const std::vector<std::array<std::uint32_t, 2>>& edges() const { return edges_; }
  [[nodiscard]] std::size_t nodes() const { return vertices_ + edges_.size(); }

  /// The midpoint of an edge. Throws: Error(bad_mesh) if no simplex has the edge. Cost: O(log d).
  [[nodiscard]] std::uint32_t between(std::uint32_t a, std::uint32_t b) const;

  /// Of a simplex, or a side of one. Throws: likewise.
  [[nodiscard]] std::array<std::uint32_t, kCellNodes> nodes_of(
      const std::array<std::uint32_t, D + 1>& simplex) const;
  [[nodiscard]] std::array<std::uint32_t, 3> nodes_of(const MeshEdge& edge) const;
  [[nodiscard]] std::array<std::uint32_t, 6> nodes_of(const MeshFace& face) const;

 private:
  [[nodiscard]] std::array<std::uint32_t, 6> nodes_of_triangle(
      const std::array<std::uint32_t, 3>& corners) const;

  std::size_t vertices_ = 0;
  std::vector<std::size_t> begin_;  // of the edges with a low vertex, and the end
  std::vector<std::array<std::uint32_t, 2>> edges_;
};

/// The mesh with the nodes as its vertices; simplices, edges and faces are as they were. A midpoint
/// of an edge on a line, or in space of a face in a polygon or on the boundary, has the marker and
/// the origin of that line or polygon, and the kind `segment` if the line or polygon is known;
/// other midpoints are of the kind `steiner`. Requires: `second` is of `mesh`. Throws:
/// Error(bad_mesh) for an edge or face of no simplex. Cost: O(m log d).
template <int D>
[[nodiscard]] MeshData<D> with_midpoints(const Mesh<D>& mesh, const MeshFeatures& features,
                                         const SecondOrder<D>& second);

}  // namespace mesher
