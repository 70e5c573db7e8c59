// Making observations, and what they say.
#include "plc/nearby.hpp"

namespace mesher::detail {

auto NearObservations::recall(sac::Scope& s, std::uint8_t kind, PolygonHandle polygon,
                              const Point<3>& place, double reach) -> NearEdge* {
  return s.recall<NearEdge>(id_, kind, [&](const NearEdge& edge) {
    return edge.polygon == polygon && edge.place == place && edge.reach == reach;
  });
}

auto NearObservations::observe(sac::Scope& s, std::uint8_t kind, PolygonHandle polygon,
                               const Point<3>& place, double reach) -> NearEdge& {
  auto& edge = s.observe<NearEdge>(id_, kind);
  edge.call = engine_.handle_of(s.self());
  edge.polygon = polygon;
  edge.place = place;
  edge.reach = reach;
  edge.seen = edge.now = 0;
  edge.listed = false;  // nothing to take back, should listing fail
  s.guarded([&] { tree_.insert(place, reach * (1 + 0x1p-29), engine_.arena().handle_of(&edge)); });
  edge.listed = true;
  return edge;
}

template <class Look>
void NearObservations::weighed(sac::Scope& s, Look&& look) {
  const auto looked_at = [&] { return store_.looked_at() + points_.looked_at(); };
  const std::uint64_t before = looked_at();
  look();
  s.weigh(looked_at() - before);
}

const FeaturesNear& NearObservations::near(sac::Scope& s, const Point<3>& place, double radius) {
  if (recall(s, kNear, 0, place, radius) == nullptr) observe(s, kNear, 0, place, radius);
  weighed(s, [&] { find_near(place, radius, store_, found_); });
  return found_;
}

double NearObservations::spacing(sac::Scope& s, const Point<3>& x, const Polygon& f, double cap) {
  if (NearEdge* edge = recall(s, kSpacing, f.self, x, cap)) return edge->seen = edge->now;
  double answer = 0;
  weighed(s, [&] { answer = find_spacing(x, f, cap, store_, points_); });
  NearEdge& edge = observe(s, kSpacing, f.self, x, cap);
  return edge.seen = edge.now = answer;
}

void NearObservations::turn(NearEdge& edge, double spacing) noexcept {
  if (spacing == edge.now) return;
  edge.now = spacing;
  engine_.doubt(engine_.call(edge.call));
}

void NearObservations::retract(sac::Call&, sac::Edge& edge) noexcept {
  auto& e = static_cast<NearEdge&>(edge);
  if (e.listed) tree_.erase(e.place, engine_.arena().handle_of(&e));
}

// Who asks what is near is invalidated, never doubted.
bool NearObservations::unchanged(sac::Call&, sac::Edge& edge) {
  const auto& e = static_cast<const NearEdge&>(edge);
  return e.seen == e.now;
}

void NearObservations::label(const sac::Call&, const sac::Edge& edge, sac::LabelSink& sink) const {
  const auto& e = static_cast<const NearEdge&>(edge);
  if (e.kind == kSpacing) return sink.number(std::bit_cast<std::uint64_t>(e.seen));
  FeaturesNear found;
  find_near(e.place, e.reach, store_, found);
  for (const Edge* at : found.edges) label_bytes(sink, EdgePiece{at});
  for (const Polygon* at : found.polygons) label_bytes(sink, PolygonRef{at});
}

void NearObservations::print(const sac::Call&, const sac::Edge& edge, std::ostream& out) const {
  const auto& e = static_cast<const NearEdge&>(edge);
  if (e.kind == kSpacing) {
    out << e.seen << " from other features";
    return;
  }
  FeaturesNear found;
  find_near(e.place, e.reach, store_, found);
  out << found.edges.size() << " edges and " << found.polygons.size() << " polygons within "
      << e.reach;
}

void NearObservations::check_invariants() const {
  tree_.check_invariants();
  tree_.visit_all([&](sac::Handle h) {
    const NearEdge& e = at(h);
    SAC_INVARIANT(!engine_.call(e.call).dead());
    if (e.kind == kNear) return;
    SAC_INVARIANT(polygon(e).alive && e.seen == e.now && e.now == spacing(e));
  });
}

}  // namespace mesher::detail
