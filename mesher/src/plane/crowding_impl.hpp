// Observations of crowding, and edits that change them; instantiated for each kind of pieces.
#pragma once

#include "plane/crowding.hpp"

namespace mesher::detail {

template <class Kind>
auto Crowding<sac::Scope, Kind>::find_weighed(sac::Scope& s, const Zone& zone) -> Witness {
  const auto looked_at = [&] { return segments_.looked_at() + points_.looked_at(); };
  const std::uint64_t before = looked_at();
  const Witness witness = find_witness(zone, segments_, points_);
  s.weigh(looked_at() - before);
  return witness;
}

template <class Kind>
bool Crowding<sac::Scope, Kind>::crowded(sac::Scope& s, const Piece& piece) {
  const auto same = [&](const CrowdedEdge& edge) { return edge.piece == piece; };
  if (auto* edge = s.template recall<CrowdedEdge>(id_, kCrowded, same)) {
    return edge->seen = static_cast<bool>(edge->witness);
  }
  const Zone zone(piece);
  const Witness witness = find_weighed(s, zone);
  auto& edge = s.template observe<CrowdedEdge>(id_, kCrowded);
  edge.call = engine_.handle_of(s.self());
  edge.witness = witness;
  edge.piece = piece;
  edge.seen = static_cast<bool>(witness);
  edge.listed = false;  // nothing to take back, should listing fail
  s.guarded([&] { tree_.insert(zone.middle(), zone.reach(), engine_.arena().handle_of(&edge)); });
  edge.listed = true;
  return edge.seen;
}

template <class Kind>
void Crowding<sac::Scope, Kind>::turn(CrowdedEdge& edge, Witness witness) noexcept {
  const bool flips = static_cast<bool>(edge.witness) != static_cast<bool>(witness);
  edge.witness = witness;
  if (flips) engine_.doubt(engine_.call(edge.call));
}

// The zone reaches farther than the ball.
template <class Kind>
void Crowding<sac::Scope, Kind>::limits_changed(const Box<D>& where) noexcept {
  tree_.visit_beside(where, [&](sac::Handle h) { engine_.invalidate(engine_.call(at(h).call)); });
}

template <class Kind>
void Crowding<sac::Scope, Kind>::retract(sac::Call&, sac::Edge& edge) noexcept {
  auto& e = static_cast<CrowdedEdge&>(edge);
  if (e.listed) tree_.erase(Zone(e.piece).middle(), engine_.arena().handle_of(&e));
}

template <class Kind>
bool Crowding<sac::Scope, Kind>::unchanged(sac::Call&, sac::Edge& edge) {
  const auto& e = static_cast<const CrowdedEdge&>(edge);
  return e.seen == static_cast<bool>(e.witness);
}

template <class Kind>
void Crowding<sac::Scope, Kind>::label(const sac::Call&, const sac::Edge& edge,
                                       sac::LabelSink& sink) const {
  sink.number(static_cast<const CrowdedEdge&>(edge).seen ? 1 : 0);
}

template <class Kind>
void Crowding<sac::Scope, Kind>::print(const sac::Call&, const sac::Edge& edge,
                                       std::ostream& out) const {
  out << (static_cast<const CrowdedEdge&>(edge).seen ? "crowded" : "not crowded");
}

template <class Kind>
void Crowding<sac::Scope, Kind>::check_invariants() const {
  tree_.check_invariants();
  tree_.visit_all([&](sac::Handle h) {
    const CrowdedEdge& e = at(h);
    const Zone zone(e.piece);
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
    SAC_INVARIANT(Kind::alive(e.piece) && !engine_.call(e.call).dead());
    SAC_INVARIANT(e.seen == crowded && static_cast<bool>(e.witness) == witnessed);
  });
}

}  // namespace mesher::detail
