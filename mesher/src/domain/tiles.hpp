// A changing triangulation: its triangles in slots, with their neighbours and walls. In space read
// tetrahedra and faces for triangles and edges.
//
// Vertices are numbers of the caller's. No table of edges is kept: a triangle is found by walking
// around one of its corners from the one triangle that the corner remembers.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "domain/journal.hpp"
#include "mesh/adjacency.hpp"

namespace mesher::detail {

using Slot = std::uint32_t;
inline constexpr std::uint32_t kNone = UINT32_MAX;

/// The corners of a simplex, positively oriented; those of a side of one.
template <int D>
using CornersOf = std::array<std::uint32_t, D + 1>;
template <int D>
using SideOf = std::array<std::uint32_t, D>;

template <int D>
[[nodiscard]] constexpr CornersOf<D> no_corners() noexcept {
  CornersOf<D> none;
  none.fill(kNone);
  return none;
}

template <int D>
struct TileOf {
  CornersOf<D> corners = no_corners<D>();     // all kNone: the slot is free
  CornersOf<D> neighbours = no_corners<D>();  // slots, across from each corner; free: [0] next
  std::uint32_t component = kNone;
  std::uint32_t walls : D + 1 = 0;        // bit i: side i
  std::uint32_t seed : 31 - D = kNoSeed;  // the first of those held here

  static constexpr std::uint32_t kNoSeed = (1u << (31 - D)) - 1;
  static constexpr std::uint32_t kAllWalls = (1u << (D + 1)) - 1;

  [[nodiscard]] bool is_free() const noexcept { return corners[0] == kNone; }
  [[nodiscard]] bool is_wall(int i) const noexcept { return (walls >> i & 1) != 0; }
  /// Where a flood gets across edge i; kNone if nowhere.
  [[nodiscard]] Slot open_neighbour(int i) const noexcept {
    return is_wall(i) ? kNone : neighbours[static_cast<std::size_t>(i)];
  }
  /// Edges at the boundary of the triangulation that are no walls.
  [[nodiscard]] std::uint32_t exits() const noexcept {
    std::uint32_t count = 0;
    for (int i = 0; i <= D; ++i) {
      count += neighbours[static_cast<std::size_t>(i)] == kNone && !is_wall(i) ? 1 : 0;
    }
    return count;
  }
  /// Requires: it has this corner.
  [[nodiscard]] int corner_of(std::uint32_t v) const noexcept { return index_of(corners, v); }
  [[nodiscard]] bool has(std::uint32_t v) const noexcept {
    return std::find(corners.begin(), corners.end(), v) != corners.end();
  }
  /// Which side leads to that neighbour.
  [[nodiscard]] int side_to(Slot n) const noexcept { return index_of(neighbours, n); }

 private:
  static int index_of(const CornersOf<D>& all, std::uint32_t x) noexcept {
    int i = 0;
    while (i < D && all[static_cast<std::size_t>(i)] != x) ++i;
    return i;
  }
};

/// A side of a triangle. slot = kNone: there is none.
struct TileSide {
  Slot slot = kNone;
  int side = 0;
};

/// What a change of the triangulation leaves to be looked at. *Survivors* are triangles that were
/// there before and still are.
template <int D>
struct SeamsOf {
  /// Survivors that could reach each other through what went, or across what became a wall: two
  /// have the same cut if they could through connected triangles that went.
  struct Bond {
    std::uint32_t cut;
    Slot survivor;
    friend auto operator<=>(const Bond&, const Bond&) = default;
  };
  std::vector<TileOf<D>> removed;  // as they were
  std::vector<Slot> added;         // in the order given
  std::vector<Slot> frontier;      // survivors beside a change, ascending, each once
  std::vector<Bond> bonds;         // ascending
  std::vector<SideOf<D>> toggled;  // edges whose wall came or went
  struct Exits {
    Slot survivor;
    int more;
  };
  std::vector<Exits> exits;  // survivors with other exits than before
};

template <int D>
class TilesOf {
 public:
  using Corners = CornersOf<D>;
  using Wall = SideOf<D>;
  using Tile = TileOf<D>;
  using Seams = SeamsOf<D>;

  /// Components are not set yet; keep() is due. Throws: Error(bad_mesh) for a wall that is no edge.
  /// Cost: O(m).
  TilesOf(const std::vector<Corners>& triangles, const std::vector<Wall>& walls);

  /// Takes triangles and walls out and puts others in. Edges in both `lost` and `gained` are
  /// neither. Requires: those to go are there, and those to come are not; what comes covers what
  /// goes; walls are edges of the triangulation, before and after.
  /// Throws: sac::UsageError, std::bad_alloc; then take_back() is due.
  /// Cost: O(c log c) for c triangles and walls.
  Seams change(std::span<const Corners> out, std::span<const Corners> in,
               std::span<const Wall> lost, std::span<const Wall> gained);

  [[nodiscard]] const Tile& operator[](Slot s) const noexcept { return tiles_[s]; }
  [[nodiscard]] Tile& edit(Slot s) { return tiles_.edit(s); }
  /// Slots, free ones included.
  [[nodiscard]] std::uint32_t slots() const noexcept { return tiles_.size(); }
  [[nodiscard]] std::uint32_t live() const noexcept { return heads_[0].live; }
  [[nodiscard]] std::size_t bytes() const noexcept { return tiles_.bytes() + at_vertex_.bytes(); }

  /// The triangle with these corners, from any on; kNone if there is none. Cost: O(degree).
  [[nodiscard]] Slot find(const Corners& t) const;
  /// One of the sides that lie on an edge, whose ends come in any order. Cost: O(degree).
  [[nodiscard]] TileSide side_on(const Wall& ends) const;
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
    Wall ends;  // ascending
    Slot slot;
    int side;
    bool survivor;
  };
  class Changer;

  template <class Visit>
  void turn_around(std::uint32_t v, Slot first, Visit&& visit) const;

  Journal<Tile> tiles_;
  Journal<Slot> at_vertex_;
  Journal<Heads> heads_;  // one
};

template <int D>
template <class Visit>
void TilesOf<D>::for_each_around(std::uint32_t v, Visit&& visit) const {
  const Slot first = at_vertex(v);
  if (first == kNone) return;
  if constexpr (D == 2) return turn_around(v, first, visit);
  std::vector<Slot> reached{first};
  for (std::size_t k = 0; k < reached.size(); ++k) {
    const Tile& tile = tiles_[reached[k]];
    if (!visit(reached[k])) return;
    for (int i = 0; i <= D; ++i) {
      const Slot n = tile.neighbours[static_cast<std::size_t>(i)];
      if (n == kNone || i == tile.corner_of(v)) continue;
      if (std::find(reached.begin(), reached.end(), n) == reached.end()) reached.push_back(n);
    }
  }
}

// In the plane: they are a ring.
template <int D>
template <class Visit>
void TilesOf<D>::turn_around(std::uint32_t v, Slot first, Visit&& visit) const {
  const auto neighbour = [&](Slot s, int i) {
    return tiles_[s].neighbours[static_cast<std::size_t>(i)];
  };
  Slot s = first;
  do {  // counterclockwise, until the boundary
    if (!visit(s)) return;
    s = neighbour(s, next_corner(tiles_[s].corner_of(v)));
  } while (s != kNone && s != first);
  if (s == first) return;
  const auto clockwise = [&](Slot t) {
    return neighbour(t, previous_corner(tiles_[t].corner_of(v)));
  };
  for (s = clockwise(first); s != kNone; s = clockwise(s)) {
    if (!visit(s)) return;
  }
}

}  // namespace mesher::detail
