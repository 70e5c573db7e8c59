// A mesh that is edited, in arrays by slot: numbers that last.
//
// Example, a solver's field over edits:
//   mesher::Mesher<2> m(options);
//   ... m.insert(...), m.update() ...        // live() below begins to keep slots
//   std::vector<double> field(m.live().vertex_slots());
//   m.insert(id, point);
//   const mesher::Change<2> change = m.update();
//   field.resize(m.live().vertex_slots());
//   for (mesher::Slot v : change.slots.vertices_added) field[v] = start(m.live().points()[v]);
//
// Guarantees, after every update():
//   (1) the arrays are mesh(), with other numbers: points, kinds, simplices, edges and faces of
//       features are the same;
//   (2) a vertex, simplex, edge or face that stays has the slot that it had;
//   (3) Change::slots names all that came and went, once, in the order of Change's own lists;
//   (4) what goes leaves its slot free from the next update on: until then the slot shows what was
//       there. What comes takes the lowest free slots, in canonical order. So slots are a function
//       of the meshes after each successful update: updates that fail or are stopped leave no
//       trace.
// A mesher keeps slots from the first call of live() on; they begin as mesh() numbers. Cost: a
// change's.
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

/// Where a vertex, simplex, edge or face is in the arrays of its kind, as long as it lives.
using Slot = std::uint32_t;
inline constexpr Slot kNoSlot = UINT32_MAX;

/// A change of a mesh by slots. Each list is in the order of the list of that name in Change, and
/// as long. What was removed is still to be seen in its slot, until the next update.
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

/// The live mesh of a mesher: a view, which shows the mesh of the last update() as long as the
/// mesher is there. Spans hold until the next update().
template <int D>
class LiveMesh {
 public:
  using Simplex = std::array<Slot, D + 1>;
  using Edge = typename Mesh<D>::Edge;  ///< between vertex slots
  using Face = typename Mesh<D>::Face;

  /// Lengths of the arrays, free slots included.
  [[nodiscard]] std::size_t vertex_slots() const noexcept { return points().size(); }
  [[nodiscard]] std::size_t simplex_slots() const noexcept { return simplices().size(); }

  /// By vertex slot. A free slot shows its last vertex.
  [[nodiscard]] std::span<const Point<D>> points() const noexcept;
  [[nodiscard]] std::span<const VertexKind> kinds() const noexcept;
  /// By simplex slot, vertex slots: the lexicographically smallest corner first, positively
  /// oriented, as in Change.
  [[nodiscard]] std::span<const Simplex> simplices() const noexcept;
  /// By simplex slot: across from each corner the simplex there; kNoSlot at the boundary.
  [[nodiscard]] std::span<const Simplex> neighbours() const noexcept;
  /// By edge slot and by face slot, those on features: `low` is the lexicographically smaller end,
  /// corners ascend by coordinates.
  [[nodiscard]] std::span<const Edge> edges() const noexcept;
  [[nodiscard]] std::span<const Face> faces() const noexcept;

  /// Whether something is in the slot now. Any slot.
  [[nodiscard]] bool is_vertex(Slot slot) const noexcept;
  [[nodiscard]] bool is_simplex(Slot slot) const noexcept;
  [[nodiscard]] bool is_edge(Slot slot) const noexcept;
  [[nodiscard]] bool is_face(Slot slot) const noexcept;
  /// How many there are.
  [[nodiscard]] std::size_t vertices() const noexcept;
  [[nodiscard]] std::size_t simplex_count() const noexcept;

  /// The slot of the vertex or simplex; kNoSlot if there is none. `corners`: in the order of
  /// simplices(). Cost: O(1).
  [[nodiscard]] Slot find(const Point<D>& vertex) const;
  [[nodiscard]] Slot find_simplex(const std::array<Point<D>, D + 1>& corners) const;
  /// A simplex with this corner, to walk from. Requires: is_vertex(vertex).
  [[nodiscard]] Slot simplex_at(Slot vertex) const;

  /// The mesh without free slots.
  struct Compact {
    Mesh<D> mesh;                 ///< canonical
    std::vector<Slot> vertices;   ///< the slot of each vertex of it
    std::vector<Slot> simplices;  ///< the slot of each simplex of it
  };
  /// Cost: O(m log m).
  [[nodiscard]] Compact compact() const;

  /// Memory of the arrays and of what finds slots. Cost: O(1).
  [[nodiscard]] std::size_t bytes() const noexcept;

  explicit LiveMesh(const detail::LiveArrays<D>& arrays) noexcept : arrays_(&arrays) {}

 private:
  const detail::LiveArrays<D>* arrays_;
};

}  // namespace mesher
