// Observations of crowding, and edits that change them.
#include "segments/crowding.hpp"

namespace mesher::detail {

using TracedCrowding = Crowding<sac::Scope>;

Witness TracedCrowding::find_weighed(sac::Scope& s, const CrowdedZone& zone) {
  const auto looked_at = [&] { return segments_.looked_at() + points_.looked_at(); };
  const std::uint64_t before = looked_at();
  const Witness witness = find_witness(zone, segments_, points_);
  s.weigh(looked_at() - before);
  return witness;
}

bool TracedCrowding::crowded(sac::Scope& s, const PieceRef& piece) {
  const auto same = [&](const CrowdedEdge& edge) { return edge.piece == piece; };
  if (auto* edge = s.recall<CrowdedEdge>(id_, kCrowded, same)) {
    return edge->seen = static_cast<bool>(edge->witness);
  }
  const CrowdedZone zone(piece);
  const Witness witness = find_weighed(s, zone);
  auto& edge = s.observe<CrowdedEdge>(id_, kCrowded);
  edge.call = engine_.handle_of(s.self());
  edge.witness = witness;
  edge.piece = piece;
  edge.seen = static_cast<bool>(witness);
  edge.listed = false;  // nothing to take back, should listing fail
  s.guarded([&] { tree_.insert(zone.middle(), zone.reach(), engine_.arena().handle_of(&edge)); });
  edge.listed = true;
  return edge.seen;
}

void TracedCrowding::turn(CrowdedEdge& edge, Witness witness) noexcept {
  const bool flips = static_cast<bool>(edge.witness) != static_cast<bool>(witness);
  edge.witness = witness;
  if (flips) engine_.doubt(engine_.call(edge.call));
}

template <class Feature>
void TracedCrowding::came(const Feature& f, const Point<2>& p, const Point<2>& q) noexcept {
  if (tree_.size() == 0) return;
  tree_.visit_near(p, q, 0, [&](sac::Handle h) {
    CrowdedEdge& edge = at(h);
    if (!edge.witness && CrowdedZone(edge.piece).has(f)) turn(edge, Witness(f));
  });
}

template <class Feature>
void TracedCrowding::went(const Feature& f, const Point<2>& p, const Point<2>& q) noexcept {
  if (tree_.size() == 0) return;
  tree_.visit_near(p, q, 0, [&](sac::Handle h) {
    CrowdedEdge& edge = at(h);
    if (edge.witness == Witness(f)) {
      turn(edge, find_witness(CrowdedZone(edge.piece), segments_, points_));
    }
  });
}

void TracedCrowding::segment_came(const Segment& t) noexcept { came(t, t.place_a, t.place_b); }
void TracedCrowding::segment_went(const Segment& t) noexcept { went(t, t.place_a, t.place_b); }
void TracedCrowding::point_came(const Vertex<2>& v) noexcept { came(v, v.p, v.p); }
void TracedCrowding::point_went(const Vertex<2>& v) noexcept { went(v, v.p, v.p); }

// The zone reaches farther than the ball.
void TracedCrowding::limits_changed(const Box<2>& where) noexcept {
  tree_.visit_beside(where, [&](sac::Handle h) { engine_.invalidate(engine_.call(at(h).call)); });
}

void TracedCrowding::retract(sac::Call&, sac::Edge& edge) noexcept {
  auto& e = static_cast<CrowdedEdge&>(edge);
  if (e.listed) tree_.erase(CrowdedZone(e.piece).middle(), engine_.arena().handle_of(&e));
}

bool TracedCrowding::unchanged(sac::Call&, sac::Edge& edge) {
  const auto& e = static_cast<const CrowdedEdge&>(edge);
  return e.seen == static_cast<bool>(e.witness);
}

void TracedCrowding::label(const sac::Call&, const sac::Edge& edge, sac::LabelSink& sink) const {
  sink.number(static_cast<const CrowdedEdge&>(edge).seen ? 1 : 0);
}

void TracedCrowding::print(const sac::Call&, const sac::Edge& edge, std::ostream& out) const {
  out << (static_cast<const CrowdedEdge&>(edge).seen ? "crowded" : "not crowded");
}

void TracedCrowding::check_invariants() const {
  tree_.check_invariants();
  tree_.visit_all([&](sac::Handle h) {
    const CrowdedEdge& e = at(h);
    const CrowdedZone zone(e.piece);
    bool crowded = false;
    bool witnessed = false;
    const auto look = [&](const auto& feature) {
      if (!zone.has(feature)) return false;
      crowded = true;
      witnessed = witnessed || e.witness == Witness(feature);
      return false;
    };
    segments_.visit_near(zone.middle(), zone.middle(), zone.reach(), look);
    points_.visit_points_in(zone.box(), look);
    SAC_INVARIANT(e.piece.segment->alive && !engine_.call(e.call).dead());
    SAC_INVARIANT(e.seen == crowded && static_cast<bool>(e.witness) == witnessed);
  });
}

}  // namespace mesher::detail
