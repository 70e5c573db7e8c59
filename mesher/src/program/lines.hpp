// What ChooseSteiners asks of segments. Where there are none yet, beyond the plane, the answer is
// no.
#pragma once

#include <type_traits>

#include "program/world.hpp"

namespace mesher::detail {

/// Cuts the leaves that v, in its bucket, encroaches [5.2b]; returns whether there are any.
template <class S>
bool disencroach(S& s, World<S, 2>& w, VertexRef<2> v, int b) {
  return v->on_segment && w.post_cuts(s, w.leaves.around(s, v), b);
}
template <class S, int D>
bool disencroach(S&, World<S, D>&, VertexRef<D>, int) {
  return false;
}

/// Cuts the leaves that have x in their balls [5.2c]; returns whether there are any.
template <class S>
bool yields(S& s, World<S, 2>& w, const Point<2>& x, int b) {
  return w.leaves.any() && w.post_cuts(s, w.leaves.around(s, x), b);
}
template <class S, int D>
bool yields(S&, World<S, D>&, const std::type_identity_t<Point<D>>&, int) {
  return false;
}

}  // namespace mesher::detail
