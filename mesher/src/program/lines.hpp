// What ChooseSteiners asks of segments, in space of edges and polygons. Where there are none yet,
// beyond space, the answer is no.
#pragma once

#include <type_traits>

#include "program/space_lines.hpp"
#include "program/world.hpp"

namespace mesher::detail {

template <int D>
using NewPoint = typename InsertionRule<D>::NewPoint;

/// Cuts the leaves that v, in its bucket, encroaches [5.2b]; returns whether there are any. In
/// space inserts vertices on features that the cell meets, at once: none is left to be cut later.
template <class S>
bool disencroach(S& s, World<S, 2>& w, VertexRef<2> v, VoronoiCell&, int b) {
  return v->on_segment && w.post_cuts(s, w.leaves.around(s, v), b);
}
template <class S>
bool disencroach(S& s, World<S, 3>& w, VertexRef<3> v, VoronoiCell3& cell, int b) {
  if (w.plc.any()) Yielding<S>(s, w, *v, cell, b).disencroach();
  return false;
}

/// What becomes of a point [5.2c]: it is inserted; not, since leaves that have it in their balls
/// are to be cut; not, since a vertex on a feature was.
enum class Outcome : std::uint8_t { stands, waits, replaced };

template <class S>
Outcome yields(S& s, World<S, 2>& w, VertexRef<2>, VoronoiCell&, const NewPoint<2>& x, int b) {
  const bool waits = w.leaves.any() && w.post_cuts(s, w.leaves.around(s, x.p), b);
  return waits ? Outcome::waits : Outcome::stands;
}
template <class S>
Outcome yields(S& s, World<S, 3>& w, VertexRef<3> v, VoronoiCell3& cell, const NewPoint<3>& x,
               int b) {
  const bool replaced = w.plc.any() && Yielding<S>(s, w, *v, cell, b).yields(x);
  return replaced ? Outcome::replaced : Outcome::stands;
}

}  // namespace mesher::detail
