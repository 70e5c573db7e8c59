// The queries of ChooseSteiners about segments, and in space about edges and polygons.
#pragma once

#include <cstdint>

#include "program/space_lines.hpp"
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

/// In space inserts vertices on the features that cross v's star at once: none is left to be cut.
/// Returns whether it did.
template <class S>
bool conform(S& s, Staying<S, 3>& beside, int b) {
  return beside.disencroach(s, b);
}
template <class S, int D>
bool conform(S&, Staying<S, D>&, int) {
  return false;
}

template <class S>
Outcome yields(S& s, World<S, 2>& w, Staying<S, 2>&, const InsertionRule<2>::NewPoint& x, int b) {
  const bool waits = w.leaves.any() && w.post_cuts(s, w.leaves.around(s, x.p), b);
  return waits ? Outcome::waits : Outcome::stands;
}
template <class S>
Outcome yields(S& s, World<S, 3>&, Staying<S, 3>& beside, const InsertionRule<3>::NewPoint& x,
               int b) {
  if (beside.any()) return beside.yields(s, x, b);
  beside.note_new();
  return Outcome::stands;
}

template <class S, int D>
Outcome yields(S&, World<S, D>&, Staying<S, D>&, const typename InsertionRule<D>::NewPoint&, int) {
  return Outcome::stands;
}

/// Whether a new point that stands may be moved to the lattice.
template <class S, int D>
bool has_room(const Staying<S, D>&, const typename InsertionRule<D>::NewPoint&) {
  return true;
}
template <class S>
bool has_room(const Staying<S, 3>& beside, const InsertionRule<3>::NewPoint& x) {
  return !beside.any() || beside.has_room(x);
}

/// Whether lines, polygons or slivers may concern Complete(v, b).
template <class S>
bool has_lines_at(const World<S, 2>& w, VertexRef<2> v) {
  return v->on_segment && w.leaves.any();
}
template <class S>
bool has_lines_at(const World<S, 3>& w, VertexRef<3>) {
  return w.has_features() || w.slivers.any();
}
template <class S, int D>
bool has_lines_at(const World<S, D>&, VertexRef<D>) {
  return false;
}
/// Whether Complete(v, b) has nothing to do, as is seen without v's cell. A traced call looks at
/// the cell.
template <class S, int D>
bool is_settled(S&, World<S, D>& w, VertexRef<D> v, int b) {
  if constexpr (S::kTraced) {
    return false;
  } else {
    const double radius = w.buckets().clip_radius(b);
    if (w.halo != nullptr && w.halo->notes(v->p, kReads<D> * radius)) return false;
    return !has_lines_at(w, v) && w.vertices.is_settled(v, radius);
  }
}

}  // namespace mesher::detail
