// Edits of the set of segments reach all that observes it.
#include "plane/input_segments.hpp"

#include "plane/exempt.hpp"

namespace mesher::detail {

PieceRef InputSegments<sac::PlainScope>::insert(VertexHandle a, VertexHandle b) {
  Segment& s = store_.record(a, b);
  store_.put(s);
  return whole(s);
}

using Traced = InputSegments<sac::Scope>;

void Traced::put(Segment& s) {
  store_.put(s);
  crowding_.came(s);
  shells_.segment_changed(s);
  legs_changed(s);
}

void Traced::take(Segment& s) noexcept {
  store_.take(s);
  crowding_.went(s);
  shells_.segment_changed(s);
  legs_changed(s);
}

// An end matters as the far end of a leg: with another leg beside s, at the other end of s. Where
// that comes or goes in the same update it is found by one of the two, and then by its own end.
void Traced::legs_changed(const Segment& s) noexcept {
  for (const VertexHandle end : {s.a, s.b}) {
    if (has_sharp_neighbour(store_, s, s.other(end))) {
      vertices_.legs_changed(vertices_.pool()[end]);
    }
  }
}

// How to undo is noted first, and does nothing where the edit has failed.
PieceRef Traced::insert(VertexHandle a, VertexHandle b) {
  Segment& s = store_.record(a, b);
  engine_.on_rollback([this, &s] {
    if (s.alive) take(s);
  });
  put(s);
  return whole(s);
}

PieceRef Traced::erase(VertexHandle a, VertexHandle b) {
  Segment& s = store_.record(a, b);
  engine_.on_rollback([this, &s] {
    if (!s.alive) put(s);
  });
  take(s);
  return whole(s);
}

void Traced::point_came(const Vertex<2>& v) noexcept {
  crowding_.came(v);
  shells_.feature_changed(v.p, v.p);
}

void Traced::point_went(const Vertex<2>& v) noexcept {
  crowding_.went(v);
  shells_.feature_changed(v.p, v.p);
}

}  // namespace mesher::detail
