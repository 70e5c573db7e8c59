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
    if (!has_sharp_neighbour(store_, s, s.other(end))) continue;
    const Vertex<2>* v = is_given_ ? vertices_.tree().find(end == s.a ? s.place_a : s.place_b)
                                   : &vertices_.pool()[end];
    if (v != nullptr) vertices_.legs_changed(*v);
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

// --- In a tile -------------------------------------------------------------------------------

void Traced::know(const GivenSegment& given, const Segment& s) {
  own_.insert_or_assign(given.name, s.self);
  if (s.self >= names_.size()) names_.resize(s.self + std::size_t{1});
  names_[s.self] = given.name;
  ends_.insert_or_assign(s.place_a, s.a);
  ends_.insert_or_assign(s.place_b, s.b);
}

void Traced::forget(const Segment& s) noexcept {
  own_.erase(names_[s.self]);
  const auto leave = [&](const Point<2>& p, VertexHandle end) {
    const auto it = ends_.find(p);
    if (it == ends_.end() || it->second != end) return;  // another point has its place
    if (!store_.visit_at(end, [](const Segment&) { return true; })) ends_.erase(it);
  };
  leave(s.place_a, s.a);
  leave(s.place_b, s.b);
}

// What is known of a segment that has gone stays for a roll-back. Two points may have had one
// place, one after the other.
void Traced::edit(const GivenSegment& given) {
  const Segment& s = store_.record(given.a, given.b);
  if (given.is) {
    know(given, s);
    if (given.was) engine_.on_rollback([this, &s, was = *given.was] { shells_.give(s, was); });
    shells_.give(s, *given.is);
  }
  if (given.was.has_value() == given.is.has_value()) return;
  given.is ? insert(given.a, given.b) : erase(given.a, given.b);
}

void Traced::commit() noexcept {
  if (is_given_) {
    store_.for_each_changed([&](const Segment& s) {
      if (!s.alive) forget(s);
    });
  }
  store_.commit();
}

// --- Points ----------------------------------------------------------------------------------

void Traced::point_came(const Vertex<2>& v) noexcept {
  crowding_.came(v);
  shells_.feature_changed(v.p, v.p);
}

void Traced::point_went(const Vertex<2>& v) noexcept {
  crowding_.went(v);
  shells_.feature_changed(v.p, v.p);
}

}  // namespace mesher::detail
