// A triangulation that is changed: its triangles in slots, with their neighbours and walls.
//
// Vertices are numbers of the caller's. No table of edges is kept: a triangle is found by walking
// around one of its corners from the one triangle that the corner remembers.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "domain/adjacency.hpp"
#include "domain/journal.hpp"

namespace mesher::detail {

using Slot = std::uint32_t;
inline constexpr std::uint32_t kNone = UINT32_MAX;

struct Tile {
  Corners corners{kNone, kNone, kNone};                 // all kNone: the slot is free
  std::array<Slot, 3> neighbours{kNone, kNone, kNone};  // across from each corner; free: [0] next
  std::uint32_t component = kNone;
  std::uint32_t walls : 3 = 0;        // bit i: edge i
  std::uint32_t seed : 29 = kNoSeed;  // the first of those held here

  static constexpr std::uint32_t kNoSeed = (1u << 29) - 1;

  [[nodiscard]] bool is_free() const noexcept { return corners[0] == kNone; }
  [[nodiscard]] bool is_wall(int i) const noexcept { return (walls >> i & 1) != 0; }
  /// Where a flood gets across edge i; kNone if nowhere.
  [[nodiscard]] Slot open_neighbour(int i) const noexcept {
    return is_wall(i) ? kNone : neighbours[i];
  }
  /// Edges at the boundary of the triangulation that are no walls.
  [[nodiscard]] std::uint32_t exits() const noexcept {
    std::uint32_t count = 0;
    for (int i = 0; i < 3; ++i) count += neighbours[i] == kNone && !is_wall(i);
    return count;
  }
  [[nodiscard]] int corner_of(std::uint32_t v) const noexcept {
    return v == corners[0] ? 0 : v == corners[1] ? 1 : 2;
  }
  /// Which edge leads to that neighbour.
  [[nodiscard]] int edge_to(Slot n) const noexcept {
    return n == neighbours[0] ? 0 : n == neighbours[1] ? 1 : 2;
  }
};

/// A side of a triangle. slot = kNone: there is none.
struct TileEdge {
  Slot slot = kNone;
  int edge = 0;
};

/// What a change of the triangulation leaves to be looked at. *Survivors* are triangles that were
/// there before and still are.
struct Seams {
  /// Survivors that could reach each other through what went, or across what became a wall: two
  /// have the same cut if they could through connected triangles that went.
  struct Bond {
    std::uint32_t cut;
    Slot survivor;
    friend auto operator<=>(const Bond&, const Bond&) = default;
  };
  std::vector<Tile> removed;   // as they were
  std::vector<Slot> added;     // in the order given
  std::vector<Slot> frontier;  // survivors beside a change, ascending, each once
  std::vector<Bond> bonds;     // ascending
  std::vector<Edge> toggled;   // edges whose wall came or went
  struct Exits {
    Slot survivor;
    int more;
  };
  std::vector<Exits> exits;  // survivors with other exits than before
};

class Tiles {
 public:
  /// Components are not set yet; keep() is due. Throws: Error(bad_mesh) for a wall that is no edge.
  /// Cost: O(m).
  Tiles(const std::vector<Corners>& triangles, const std::vector<Edge>& walls);

  /// Takes triangles and walls out and puts others in. Edges in both `lost` and `gained` are
  /// neither. Requires: those to go are there, and those to come are not; what comes covers what
  /// goes; walls are edges of the triangulation, before and after.
  /// Throws: sac::UsageError, std::bad_alloc; then take_back() is due.
  /// Cost: O(c log c) for c triangles and walls.
  Seams change(std::span<const Corners> out, std::span<const Corners> in,
               std::span<const Edge> lost, std::span<const Edge> gained);

  [[nodiscard]] const Tile& operator[](Slot s) const noexcept { return tiles_[s]; }
  [[nodiscard]] Tile& edit(Slot s) { return tiles_.edit(s); }
  /// Slots, free ones included.
  [[nodiscard]] std::uint32_t slots() const noexcept { return tiles_.size(); }
  [[nodiscard]] std::uint32_t live() const noexcept { return heads_[0].live; }
  [[nodiscard]] std::size_t bytes() const noexcept { return tiles_.bytes() + at_vertex_.bytes(); }

  /// The triangle left of the edge from u to v. Cost: O(degree of u).
  [[nodiscard]] TileEdge left_of(std::uint32_t u, std::uint32_t v) const;
  /// A triangle at the vertex; kNone if there is none.
  [[nodiscard]] Slot at_vertex(std::uint32_t v) const noexcept {
    return v < at_vertex_.size() ? at_vertex_[v] : kNone;
  }
  /// Calls visit(slot) for the triangles around a vertex, until it returns false.
  template <class Visit>
  void for_each_around(std::uint32_t v, Visit&& visit) const;

  void keep() noexcept;
  void take_back() noexcept;
  void check_invariants() const;

 private:
  struct Heads {
    Slot free = kNone;
    std::uint32_t live = 0;
  };
  struct Side {
    Edge ends;  // ascending
    Slot slot;
    int edge;
    bool survivor;
  };
  class Changer;

  [[nodiscard]] Slot find(const Corners& t) const;

  Journal<Tile> tiles_;
  Journal<Slot> at_vertex_;
  Journal<Heads> heads_;  // one
};

template <class Visit>
void Tiles::for_each_around(std::uint32_t v, Visit&& visit) const {
  const Slot first = at_vertex(v);
  if (first == kNone) return;
  Slot s = first;
  do {  // counterclockwise, until the boundary
    if (!visit(s)) return;
    s = tiles_[s].neighbours[next_corner(tiles_[s].corner_of(v))];
  } while (s != kNone && s != first);
  if (s == first) return;
  const auto clockwise = [&](Slot t) {
    return tiles_[t].neighbours[previous_corner(tiles_[t].corner_of(v))];
  };
  for (s = clockwise(first); s != kNone; s = clockwise(s)) {
    if (!visit(s)) return;
  }
}

}  // namespace mesher::detail
