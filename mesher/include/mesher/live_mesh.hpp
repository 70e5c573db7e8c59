// An edited mesh in arrays indexed by slot, a number that lasts.
//
// Example, a solver's field under edits:
//   mesher::Mesher<2> m(options);
//   ... m.insert(...), m.update() ...        // live() below begins to keep slots
//   std::vector<double> field(m.live().vertex_slots());
//   m.insert(id, point);
//   const mesher::Change<2> change = m.update();
//   field.resize(m.live().vertex_slots());
//   for (mesher::Slot v : change.slots.vertices_added) field[v] = start(m.live().points()[v]);
//
// Guarantees, after every update():
//   (1) the arrays hold the same points, kinds, simplices, and edges and faces on features as
//       box_mesh(), with other numbers;
//   (2) a vertex, simplex, edge or face that stays has the slot that it had;
//   (3) Change::slots names everything that was added or removed, once, in the order of the lists
//       of Change;
//   (4) the slot of a removed element becomes free at the next update; until then it shows the old
//       element. A new element takes the lowest free slot, in canonical order. So slots are a
//       function of the meshes after each successful update: updates that fail or are stopped have
//       no influence.
// A mesher keeps slots from the first call of live() on; they start with the numbers of
// box_mesh().
// Cost: proportional to the change.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mesher/mesh.hpp"

namespace mesher {

namespace detail {
template <int D>
class LiveArrays;
}

/// The index of a vertex, simplex, edge or face in the arrays of its kind, as long as it exists.
using Slot = std::uint32_t;
inline constexpr Slot kNoSlot = UINT32_MAX;

/// A change of a mesh by slots. Each list has the order and the length of the list with the same
/// name in Change. A removed element can still be read in its slot until the next update.
struct SlotChange {
  struct Kind {
    Slot vertex = kNoSlot;
    VertexKind before{}, after{};
    friend bool operator==(const Kind&, const Kind&) = default;
  };
  std::vector<Slot> vertices_added, vertices_removed;
  std::vector<Kind> kinds_changed;
  std::vector<Slot> simplices_added, simplices_removed;
  std::vector<Slot> edges_added, edges_removed;  ///< on features
  std::vector<Slot> faces_added, faces_removed;  ///< likewise; in the plane none
  friend bool operator==(const SlotChange&, const SlotChange&) = default;
};

/// A view of the mesh of a mesher. It shows the mesh of the last update() as long as the mesher
/// exists. Spans are valid until the next update().
template <int D>
class LiveMesh {
 public:
  using Simplex = std::array<Slot, D + 1>;
  using Edge = typename Mesh<D>::Edge;  ///< between vertex slots
  using Face = typename Mesh<D>::Face;

  /// The lengths of the arrays, including free slots.
  [[nodiscard]] std::size_t vertex_slots() const noexcept { return points().size(); }
  [[nodiscard]] std::size_t simplex_slots() const noexcept { return simplices().size(); }

  /// The coordinates by vertex slot. A free slot shows its last vertex.
  [[nodiscard]] std::span<const Point<D>> points() const noexcept;
  [[nodiscard]] std::span<const VertexKind> kinds() const noexcept;
  /// The corners of each simplex by simplex slot, as vertex slots: the lexicographically smallest
  /// corner first, positively oriented, as in Change.
  [[nodiscard]] std::span<const Simplex> simplices() const noexcept;
  /// By simplex slot: the simplex across from each corner; kNoSlot at the boundary.
  [[nodiscard]] std::span<const Simplex> neighbours() const noexcept;
  /// The edges and faces on features, by edge slot and by face slot: `low` is the lexicographically
  /// smaller end; corners ascend by coordinates.
  [[nodiscard]] std::span<const Edge> edges() const noexcept;
  [[nodiscard]] std::span<const Face> faces() const noexcept;

  /// Whether the slot is in use now. `slot`: any number.
  [[nodiscard]] bool is_vertex(Slot slot) const noexcept;
  [[nodiscard]] bool is_simplex(Slot slot) const noexcept;
  [[nodiscard]] bool is_edge(Slot slot) const noexcept;
  [[nodiscard]] bool is_face(Slot slot) const noexcept;
  /// The numbers of vertices and simplices.
  [[nodiscard]] std::size_t vertices() const noexcept;
  [[nodiscard]] std::size_t simplex_count() const noexcept;

  /// The slot of a vertex or simplex; kNoSlot if the mesh does not have it. `corners`: in the order
  /// of simplices(). Cost: O(1).
  [[nodiscard]] Slot find(const Point<D>& vertex) const;
  [[nodiscard]] Slot find_simplex(const std::array<Point<D>, D + 1>& corners) const;
  /// The slot of a simplex with this corner, to start a walk. Requires: is_vertex(vertex).
  [[nodiscard]] Slot simplex_at(Slot vertex) const;

  /// The mesh without free slots.
  struct Compact {
    Mesh<D> mesh;                 ///< canonical
    std::vector<Slot> vertices;   ///< the slot of each vertex of `mesh`
    std::vector<Slot> simplices;  ///< the slot of each simplex of `mesh`
  };
  /// Cost: O(m log m).
  [[nodiscard]] Compact compact() const;

  /// Memory of the arrays and of the tables behind find(). Cost: O(1).
  [[nodiscard]] std::size_t bytes() const noexcept;

  explicit LiveMesh(const detail::LiveArrays<D>& arrays) noexcept : arrays_(&arrays) {}

 private:
  const detail::LiveArrays<D>* arrays_;
};

}  // namespace mesher
