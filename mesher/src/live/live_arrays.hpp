// The arrays of a live mesh, and their updates.
//
//   SlotChange slots = arrays.plan(change);  ... arrays.keep();  // or drop()
//
// A plan reads the arrays of the last update and changes none of them. Neighbours of new simplices
// are found by unmatched sides: those of new simplices, and those of remaining simplices beside
// removed ones.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "geometry/place_hash.hpp"
#include "live/slot_table.hpp"
#include "mesher/mesher.hpp"

namespace mesher::detail {

/// Of what is named by vertex slots.
struct SlotsHash {
  template <std::size_t N>
  [[nodiscard]] std::uint64_t operator()(const std::array<Slot, N>& slots) const noexcept {
    std::uint64_t h = 0;
    for (const Slot s : slots) h = sac::mix(h + s);
    return h;
  }
  template <class Edge>
  requires requires(const Edge& e) { e.low, e.high; }
  [[nodiscard]] std::uint64_t operator()(const Edge& e) const noexcept {
    return (*this)(std::array{e.low, e.high});
  }
  template <class Face>
  requires requires(const Face& f) { f.corners; }
  [[nodiscard]] std::uint64_t operator()(const Face& f) const noexcept {
    return (*this)(f.corners);
  }
};
struct PlaceHash {
  template <std::size_t D>
  [[nodiscard]] std::uint64_t operator()(const std::array<double, D>& p) const noexcept {
    return place_hash(p);
  }
};

template <int D>
class LiveArrays {
 public:
  using Simplex = std::array<Slot, D + 1>;
  using Edge = typename Mesh<D>::Edge;
  using Face = typename Mesh<D>::Face;
  using Corners = std::array<Point<D>, D + 1>;

  /// Of nothing.
  LiveArrays() = default;
  /// Slots are the numbers of the mesh.
  explicit LiveArrays(const Mesh<D>& mesh);

  /// Requires: no plan; the change is one of the mesh that is here.
  /// Throws: std::bad_alloc, sac::UsageError, and then changes nothing.
  /// Cost: O(c log c) for a change of c.
  [[nodiscard]] SlotChange plan(const Change<D>& change);
  /// Makes the planned change; or not. Without a plan, nothing.
  void keep() noexcept;
  void drop() noexcept;

  [[nodiscard]] const auto& vertices() const noexcept { return vertices_; }
  [[nodiscard]] const auto& simplices() const noexcept { return simplices_; }
  [[nodiscard]] const auto& edges() const noexcept { return edges_; }
  [[nodiscard]] const auto& faces() const noexcept { return faces_; }
  [[nodiscard]] const std::vector<VertexKind>& kinds() const noexcept { return kinds_; }
  [[nodiscard]] const std::vector<Simplex>& neighbours() const noexcept { return neighbours_; }
  [[nodiscard]] Slot simplex_at(Slot vertex) const noexcept { return simplex_at_[vertex]; }
  /// Corners as in Change. kNoSlot: there is none.
  [[nodiscard]] Slot find_simplex(const Corners& corners) const noexcept;

  [[nodiscard]] typename LiveMesh<D>::Compact compact() const;
  [[nodiscard]] std::size_t bytes() const noexcept;
  /// Requires: no plan. Throws: sac::InvariantError. Cost: O(m log m).
  void check_invariants() const;

 private:
  using Side = std::array<Slot, D>;
  struct OpenSide {
    Side corners{};          // ascending
    Slot simplex = kNoSlot;  // what comes: its number in the change
    std::uint32_t side = 0;
    bool comes = false;
  };
  struct Link {
    Slot simplex;
    std::uint32_t side;
    Slot neighbour;
  };
  class Planner;

  void forget_plan() noexcept;

  SlotTable<Point<D>, PlaceHash> vertices_;
  SlotTable<Simplex, SlotsHash> simplices_;
  SlotTable<Edge, SlotsHash> edges_;
  SlotTable<Face, SlotsHash> faces_;
  std::vector<VertexKind> kinds_;    // by vertex
  std::vector<Slot> simplex_at_;     // likewise; kNoSlot: the slot is free
  std::vector<Simplex> neighbours_;  // by simplex
  // The plan.
  SlotChange plan_;
  std::vector<VertexKind> kinds_come_;
  std::vector<Link> links_;
  bool first_ = false;  // it makes the first mesh; its vertices are there already
};

}  // namespace mesher::detail
