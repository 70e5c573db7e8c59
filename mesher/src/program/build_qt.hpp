// BuildQT-Dyn [Fig 4.3, 4.4]: the quadtree that conforms to the local feature size.
//
// Departures (docs/paper_map.md has the proofs):
// - Crowding is a question about the block of 3^d cells of the same size around a point, answered
//   by FeatureTree for all levels at once: locate(p) asks for the deepest crowded level of p, which
//   is lines 10-13 and 20-24 of Fig 4.4 for all cells on p's path. An answer that does not change
//   re-executes nothing.
// - Crowding is then a function of the input alone, so the shadows of Fig 4.4 need not be run
//   between crowded splits: split(c) runs deepest first and asks for the cells that c and its
//   neighbours are parts of. Equal posts merge, which does what the reason tags did.
#pragma once

#include "program/world.hpp"

namespace mesher::detail {

// Cells are split this many levels less deep than crowding asks for: a leaf then holds a handful of
// mesh vertices instead of a twentieth of one. Measured (uniform 10^5 points, static run): 0 levels
// 4.6 s, 1 2.6 s, 2 2.3 s, 3 1.5 s, 4 1.2 s, 5 1.0 s; on a grid 5 is a quarter slower than 4, since
// each level lets a leaf hold four times as many vertices.
inline constexpr int kCoarser = 4;

struct Split {
  static constexpr std::string_view kName = "split";
  template <class S, int D>
  void operator()(S& s, Cell<D> c) const;
};
inline constexpr Split split{};

struct Locate {
  static constexpr std::string_view kName = "locate";
  template <class S, int D>
  void operator()(S& s, VertexRef<D> p) const;
};
inline constexpr Locate locate{};

/// When locate(p) runs: first of all.
template <std::size_t N>
[[nodiscard]] sac::Key locate_key(const std::array<std::uint64_t, N>& f) {
  return {.bucket = -kLevels - 1, .order = morton<N>(f)};
}
template <int D>
[[nodiscard]] sac::Key split_key(const Cell<D>& c) {
  return {.bucket = -c.level, .order = morton<D>(c.corner)};
}

// for each point p: find the cells that it crowds, largest first; enqueue the last
template <class S, int D>
void Locate::operator()(S& s, VertexRef<D> p) const {
  auto& w = s.template environment<World<S, D>>();
  const Fixed<D> f = w.box.fixed(p->p);
  const int level = w.features.level(s, *p);
  if constexpr (!S::kTraced) p->level = static_cast<std::int16_t>(level);
  w.vertices.insert(s, p);
  if (level >= kCoarser && w.vertices.searches()) {
    const Cell<D> c = MeshBox<D>::cell(f, level - kCoarser);
    w.quadtree.template post<split>(s, split_key(c), c);
  }
  w.post_nearest(s, p, level + 1);
  w.post_star(s, p);
}

// split c into 2^d smaller cells; for every neighbour c' of c (c itself to begin with): if c' has
// to be made by splitting a larger cell, enqueue that
template <class S, int D>
void Split::operator()(S& s, Cell<D> c) const {
  auto& w = s.template environment<World<S, D>>();
  if (!w.vertices.searches()) return;
  w.subdivision.split(s, c);
  if (c.level == 0) return;
  MeshBox<D>::for_each_parent_around(c, [&](const Cell<D>& larger) {
    w.quadtree.template post<split>(s, split_key(larger), larger);
  });
}

}  // namespace mesher::detail
