// Fill [rules A7.4]: where simplices must not be large, it inserts vertices of a lattice before
// refinement.
//
// The candidates are a function of space. Whether one is inserted depends on the features near it,
// in the plane also on the leaves around it, and on no other candidate: an edit changes only
// candidates near it.
#pragma once

#include "program/build_qt.hpp"
#include "program/world.hpp"

namespace mesher::detail {

struct Fill {
  static constexpr std::string_view kName = "fill";
  template <class S, int D>
  void operator()(S& s, Cell<D> c) const;
};
inline constexpr Fill fill{};

/// When fill(c) runs: a cell before those inside it, and with all of these before the next one, so
/// that few calls wait.
template <int D>
[[nodiscard]] sac::Key fill_key(const Cell<D>& c) {
  return {.order = morton<D>(c.corner)};
}

/// Whether a leaf's ball has a place. In space there are no leaves.
template <class S>
bool is_in_leaf(S& s, World<S, 2>& w, const Point<2>& place) {
  return !w.leaves.around(s, place).empty();
}
template <class S>
bool is_in_leaf(S&, World<S, 3>&, const Point<3>&) {
  return false;
}

/// Of a vertex amid the lattice: who is around it in the end is not farther than this, in pitches,
/// since its simplices on the lattice have no vertex in their circumspheres.
template <int D>
inline constexpr double kAmidReach = 2 * Lattice<D>::kCircumradius*(1 + 0x1p-20);

// if c is large: split it, enqueue its parts. Else for each candidate q in c: if no feature is near
// and no leaf's ball has q, add q to the vertices; enqueue it, unless its triangles will do
template <class S, int D>
void Fill::operator()(S& s, Cell<D> c) const {
  auto& w = s.template environment<World<S, D>>();
  const auto [parts, candidates, looked_at] = w.plans.plan(s, c);
  if (parts) return w.post_parts(s, c);
  const std::vector<Room> rooms = w.surroundings.rooms(s, c, candidates);
  s.weigh(candidates.size());
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const auto& q = candidates[i];
    if (!w.owns(q.place) || rooms[i] == Room::none || is_in_leaf(s, w, q.place)) continue;
    const VertexRef<D> v = w.vertices.insert_early(s, q.place);
    w.require_room(s);
    const bool does = q.amid && rooms[i] == Room::ample;
    does ? w.post_border_star(s, v, kAmidReach<D> * q.pitch)
         : w.post_nearest_from(s, v, kClear * q.pitch);
    w.post_star(s, v);
  }
}

}  // namespace mesher::detail
