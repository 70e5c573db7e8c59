// Fill [rules A7.4]: where triangles must not be large, vertices come from a lattice before
// anything is refined.
//
// Which places are candidates is a function of space. Whether one is taken depends on the features
// beside it and the leaves around it, on no other candidate: an edit changes what it is near.
#pragma once

#include "program/build_qt.hpp"
#include "program/world.hpp"

namespace mesher::detail {

struct Fill {
  static constexpr std::string_view kName = "fill";
  template <class S>
  void operator()(S& s, Cell<2> c) const;
};
inline constexpr Fill fill{};

/// When fill(c) runs: a cell before those inside it, and with all of these before the next one, so
/// that few calls wait.
[[nodiscard]] inline sac::Key fill_key(const Cell<2>& c) { return {.order = morton<2>(c.corner)}; }

// if c is large: split it, enqueue its parts. Else for each candidate q in c: if no feature is near
// and no leaf's ball has q, add q to the vertices; enqueue it, unless its triangles will do
template <class S>
void Fill::operator()(S& s, Cell<2> c) const {
  auto& w = s.template environment<World<S>>();
  const auto [parts, candidates, looked_at] = w.plans.plan(s, c);
  if (parts) return w.post_parts(s, c);
  const std::vector<Room> rooms = w.surroundings.rooms(s, c, candidates);
  s.weigh(candidates.size());
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const auto& q = candidates[i];
    if (rooms[i] == Room::none || !w.leaves.around(s, q.place).empty()) continue;
    const VertexRef<2> v = w.vertices.insert_early(s, q.place);
    w.require_room(s);
    if (!q.amid || rooms[i] != Room::ample) w.post_nearest_from(s, v, kClear * q.pitch);
    w.post_star(s, v);
  }
}

}  // namespace mesher::detail
