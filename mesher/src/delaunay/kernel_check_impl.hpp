// Exact tests of the invariants of a triangulation.
//
// Neighbours and orientation are those of a closed surface (in the plane) around which the hull's
// ghosts close; no vertex across a facet conflicts with the simplex there: that is Delaunay, and
// for two ghosts, that the hull is convex [Delaunay's lemma].
#pragma once

#include <algorithm>

#include "delaunay/hole.hpp"
#include "delaunay/kernel.hpp"
#include "sac/check.hpp"

namespace mesher::detail {

template <int D, class Layout>
void DelaunayKernel<D, Layout>::check_facet(std::uint32_t s, std::size_t i) const {
  const std::uint32_t code = store_.across(s)[i], other = code >> 2, k = code & 3;
  SAC_INVARIANT(other < store_.places() && k <= D && store_.alive(other));
  SAC_INVARIANT(store_.across(other)[k] == (s << 2 | static_cast<std::uint32_t>(i)));
  const OrientedFacet<D> ours(store_.corners(s), i), theirs(store_.corners(other), k);
  SAC_INVARIANT(ours.corners == theirs.corners && ours.odd != theirs.odd);
  const std::uint32_t w = store_.corners(other)[k];
  SAC_INVARIANT(corner_of(s, w) > D);
  if (w != kInfinite) SAC_INVARIANT(!conflicts(s, place(w)));
}

template <int D, class Layout>
void DelaunayKernel<D, Layout>::check_simplex(std::uint32_t s) const {
  Ids c = store_.corners(s);
  if (!is_ghost(s)) SAC_INVARIANT(side(c, 0, place(c[0])) > 0);
  for (std::size_t i = 0; i <= D; ++i) check_facet(s, i);
  for (const std::uint32_t v : c) SAC_INVARIANT(v == kInfinite || (v < vertices_.size() && has(v)));
  std::sort(c.begin(), c.end());
  SAC_INVARIANT(std::adjacent_find(c.begin(), c.end()) == c.end());
}

template <int D, class Layout>
void DelaunayKernel<D, Layout>::check_vertices() const {
  std::size_t vertices = 0;
  for (std::uint32_t v = 1; v < vertices_.size(); ++v) {
    if (!has(v)) continue;
    ++vertices;
    SAC_INVARIANT(store_.alive(vertices_[v].simplex) && corner_of(vertices_[v].simplex, v) <= D);
  }
  if (D == 2 && store_.size() > 0) SAC_INVARIANT(store_.size() == 2 * vertices - 2);
}

template <int D, class Layout>
void DelaunayKernel<D, Layout>::check_invariants() const {
  SAC_INVARIANT(!kHasBalls || reach_.size() == vertices_.size());
  SAC_INVARIANT(mark_.size() == store_.places());
  SAC_INVARIANT(std::all_of(mark_.begin(), mark_.end(), [](auto mark) { return mark == 0; }));
  SAC_INVARIANT(cavity_.empty() && outside_.empty() && borders_.empty() && link_.empty());
  SAC_INVARIANT((store_.size() == 0) == (last_ == kNone));
  SAC_INVARIANT(last_ == kNone || store_.alive(last_));
  std::size_t alive = 0;
  for (std::uint32_t s = 0; s < store_.places(); ++s) {
    if (!store_.alive(s)) continue;
    ++alive;
    check_simplex(s);
  }
  SAC_INVARIANT(alive == store_.size());
  check_vertices();
}

}  // namespace mesher::detail
