// Round numbers, and observations of where pieces are split.
#include "plane/shells.hpp"

#include <cmath>

namespace mesher::detail {

// --- The place -------------------------------------------------------------------------------

namespace {

/// The largest power of two up to x.
double power_below(double x) { return std::ldexp(1.0, std::ilogb(x)); }

/// The multiple of the largest power of two in [lo, hi], the smaller of two.
double roundest(double lo, double hi) {
  for (double unit = power_below(hi);; unit /= 2) {
    const double multiple = std::ceil(lo / unit) * unit;
    if (multiple <= hi) return multiple;
  }
}

double roundest_in_middle_third(double from, double to) {
  return roundest(from + (to - from) / 3, to - (to - from) / 3);
}

// How the two ends of a segment share it.
PieceKind kind_of_whole(double length, const Zones& zones) {
  const bool a_reaches = zones.a >= length / 2;
  const bool b_reaches = zones.b >= length / 2;
  if (a_reaches && b_reaches) return PieceKind::whole;
  if (b_reaches) return zones.a > 0 ? PieceKind::from_b_to_a : PieceKind::from_b;
  return zones.b > 0 ? PieceKind::from_a_to_b : PieceKind::from_a;
}

}  // namespace

PieceSplit split_place(const PieceRef& ref, const Zones& zones) {
  const Piece& piece = ref.piece;
  const double length = ref.segment->length;
  PieceKind kind = piece.kind;
  if (kind == PieceKind::whole) kind = kind_of_whole(length, zones);
  if (kind == PieceKind::whole) {
    return {{length / 2, false}, PieceKind::from_a, PieceKind::from_b};
  }
  const bool from_b = kind == PieceKind::from_b || kind == PieceKind::from_b_to_a;
  const Label& near = from_b ? piece.hi : piece.lo;
  const Label& far = from_b ? piece.lo : piece.hi;
  const double distance =
      roundest_in_middle_third(near.from(from_b, length), far.from(from_b, length));
  const Label at{distance, from_b};
  if (kind == PieceKind::from_a || kind == PieceKind::from_b) return {at, kind, kind};
  if (from_b) {
    const bool last = length - distance <= zones.a;
    return {at, last ? PieceKind::from_a : kind, PieceKind::from_b};
  }
  const bool last = length - distance <= zones.b;
  return {at, PieceKind::from_a, last ? PieceKind::from_b : kind};
}

namespace {

template <class S>
Zones zones_now(const Segment& s, const VertexPool<2>& pool, SegmentStore& segments,
                const Features<S>& points, ApexReaches& reaches, LegFans& fans) {
  const auto zone_at = [&](VertexHandle end) {
    const LongestBeside others = fans.longest_beside(segments, s, end);
    return zone(s, others, [&] {
      return reaches.of(pool[end], [&] { return apex_reach(segments, points, pool[end]); });
    });
  };
  return {zone_at(s.a), zone_at(s.b)};
}

template <class S>
PieceSplit place_now(const PieceRef& piece, const VertexPool<2>& pool, SegmentStore& segments,
                     const Features<S>& points, ApexReaches& reaches, LegFans& fans) {
  if (!looks_at_zones(piece.piece.kind)) return split_place(piece, {});
  return split_place(piece, zones_now(*piece.segment, pool, segments, points, reaches, fans));
}

}  // namespace

// --- Reaches ---------------------------------------------------------------------------------

VertexHandle ApexReaches::meeting(const Point<2>& p, const Point<2>& q) const {
  VertexHandle found = 0;
  discs_.visit_near(p, q, 0, [&](VertexHandle v) {
    found = v;
    return true;
  });
  return found;
}

void ApexReaches::forget(const Vertex<2>& v) noexcept {
  reaches_.erase(v.self);
  discs_.erase(v.p, v.self);
}

PieceSplit Shells<sac::PlainScope>::place(sac::PlainScope&, const PieceRef& piece) {
  return place_now(piece, pool_, segments_, points_, reaches_, fans_);
}

// --- Observations ----------------------------------------------------------------------------

using TracedShells = Shells<sac::Scope>;

Zones TracedShells::zones(const Segment& s) {
  return zones_now(s, pool_, segments_, points_, reaches_, fans_);
}

PieceSplit TracedShells::answer(const PieceRef& piece) {
  if (!given_.empty()) return split_place(piece, given_[piece.piece.segment]);
  return place_now(piece, pool_, segments_, points_, reaches_, fans_);
}

PieceSplit TracedShells::place(sac::Scope& s, const PieceRef& piece) {
  const auto looked_at = [&] { return segments_.looked_at() + points_.looked_at(); };
  const std::uint64_t before = looked_at();
  const PieceSplit now = s.guarded([&] { return answer(piece); });
  s.weigh(looked_at() - before);
  if (!looks_at_zones(piece.piece.kind)) return now;
  const auto same = [&](const PlaceEdge& edge) { return edge.piece == piece; };
  if (auto* edge = s.recall<PlaceEdge>(id_, kPlace, same)) return edge->seen = now;
  auto& edge = s.observe<PlaceEdge>(id_, kPlace);
  edge.call = engine_.handle_of(s.self());
  edge.piece = piece;
  edge.seen = now;
  Segment& segment = segments_[piece.piece.segment];
  edge.next = std::exchange(segment.place_observers, engine_.arena().handle_of(&edge));
  return now;
}

void TracedShells::retract(sac::Call&, sac::Edge& edge) noexcept {
  auto& gone = static_cast<PlaceEdge&>(edge);
  const sac::Handle self = engine_.arena().handle_of(&gone);
  sac::Handle* link = &segments_[gone.piece.piece.segment].place_observers;
  while (*link != self) link = &at(*link).next;
  *link = gone.next;
}

bool TracedShells::unchanged(sac::Call&, sac::Edge& edge) {
  const auto& e = static_cast<const PlaceEdge&>(edge);
  return answer(e.piece) == e.seen;
}

// --- Edits -----------------------------------------------------------------------------------

void TracedShells::give(const Segment& s, const Zones& zones) {
  if (s.self >= given_.size()) given_.resize(s.self + std::size_t{1});
  given_[s.self] = zones;
  doubt(s);
}

void TracedShells::doubt(const Segment& s) noexcept {
  segments_.note_change(s);
  for (sac::Handle h = s.place_observers; h != 0; h = at(h).next) {
    engine_.doubt(engine_.call(at(h).call));
  }
}

void TracedShells::doubt_at(VertexHandle end) noexcept {
  segments_.visit_at(end, [&](const Segment& t) { doubt(t); });
}

void TracedShells::forget(VertexHandle apex) noexcept {
  reaches_.forget(pool_[apex]);
  doubt_at(apex);
}

void TracedShells::feature_changed(const Point<2>& p, const Point<2>& q) noexcept {
  while (const VertexHandle apex = reaches_.meeting(p, q)) forget(apex);
}

// Beside those that t is near to: its ends have other segments now.
void TracedShells::segment_changed(const Segment& t) noexcept {
  feature_changed(t.place_a, t.place_b);
  for (const VertexHandle end : {t.a, t.b}) {
    fans_.forget(end);
    doubt_at(end);
  }
}

// --- For people and for traces ---------------------------------------------------------------

void TracedShells::label(const sac::Call&, const sac::Edge& edge, sac::LabelSink& sink) const {
  const PieceSplit& seen = static_cast<const PlaceEdge&>(edge).seen;
  sink.number(seen.at.bits());
  sink.number(static_cast<std::uint64_t>(seen.lo) | static_cast<std::uint64_t>(seen.hi) << 3);
}

void TracedShells::print(const sac::Call&, const sac::Edge& edge, std::ostream& out) const {
  const Label& at = static_cast<const PlaceEdge&>(edge).seen.at;
  out << "split at " << at.distance() << (at.from_b() ? " from b" : " from a");
}

void TracedShells::check_invariants() const {
  reaches_.for_each([&](VertexHandle v, double reach) {
    SAC_INVARIANT(reach == apex_reach(segments_, points_, pool_[v]));
  });
  const auto zone_at = [&](const Segment& s, VertexHandle end) {
    return zone(s, longest_beside(segments_, s, end),
                [&] { return apex_reach(segments_, points_, pool_[end]); });
  };
  segments_.pool().for_each([&](const Segment& s) {
    for (sac::Handle h = s.place_observers; h != 0; h = at(h).next) {
      const PlaceEdge& e = at(h);
      SAC_INVARIANT(s.alive && e.piece.segment == &s && !engine_.call(e.call).dead());
      SAC_INVARIANT(!given_.empty() ||
                    e.seen == split_place(e.piece, {zone_at(s, s.a), zone_at(s, s.b)}));
      SAC_INVARIANT(given_.empty() || e.seen == split_place(e.piece, given_[s.self]));
    }
  });
}

}  // namespace mesher::detail
