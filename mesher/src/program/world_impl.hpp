// The parts of World that need the program's functions.
#pragma once

#include "program/build_qt.hpp"
#include "program/choose_steiners.hpp"
#include "input.hpp"
#include "program/triangulate.hpp"
#include "program/world.hpp"

namespace mesher::detail {

// The points of the boundary grid, with their stars asked for from the outside.
template <class S>
void World<S>::add_boundary() {
  const int n = box.boundary_steps;
  const auto add = [&](int i, int j) {
    const double step = box.side / n;  // a power of two: exact
    const VertexRef<2> v = vertices.add_boundary({box.lo[0] + i * step, box.lo[1] + j * step});
    stars.template post_from_outside<star>(star_key(box.fixed(v->p)), v);
  };
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j <= n; j += i == 0 || i == n ? 1 : n) add(i, j);
  }
}

// add a ComputeNN(p) event, with key |c| / 2; c is the cell of `leaf_level` around p
template <class S>
void World<S>::post_nearest(S& s, VertexRef<2> v, int leaf_level) {
  if constexpr (!S::kTraced) plain.tick();
  const double half = box.cell_side(leaf_level) / 2;
  const int b = rule.bucket(half * half);
  steiner.template post<compute_nn>(s, nearest_key(box.fixed(v->p), b), v, b);
}

template <class S>
void World<S>::post_complete(S& s, VertexRef<2> v, int b) {
  if constexpr (!S::kTraced) plain.tick();
  steiner.template post<complete>(s, complete_key(*this, box.fixed(v->p), b), v, b);
}

template <class S>
void World<S>::post_star(S& s, VertexRef<2> v) {
  stars.template post<star>(s, star_key(box.fixed(v->p)), v);
}

template <class S>
void World<S>::output(S&, VertexRef<2> v, const VoronoiCell& cell) {
  if constexpr (!S::kTraced) {
    plain.tick();
    for_each_own_triangle(
        *v, cell.size(), [&](int i) { return cell.code(i); },
        [&](int i) -> const Point<2>& { return cell.place(i); },
        [&](const auto& t) { plain.triangles.push_back(t); });
  } else {
    (void)v, (void)cell;
  }
}

template <class S>
void World<S>::fail_useless(const Vertex<2>& v, const Vertex<2>& x) const {
  throw Error(ErrorCode::too_close, "input points are too close for double precision near " +
                                        place_text(v.p) + ": rounding moved a new vertex to " +
                                        place_text(x.p));
}

}  // namespace mesher::detail
