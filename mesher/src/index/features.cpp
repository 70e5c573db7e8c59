// Observing the level of an input point, and outside edits of the set of points.
#include "program/world.hpp"

namespace mesher::detail {

using TracedFeatures = Features<sac::Scope>;

int TracedFeatures::level(sac::Scope& s, Vertex<2>& v) {
  const auto same = [&](const LevelEdge& edge) { return edge.vertex == v.self; };
  if (s.recall<LevelEdge>(id_, 0, same) == nullptr) s.observe<LevelEdge>(id_, 0).vertex = v.self;
  v.locator = engine_.handle_of(s.self());
  return v.level;
}

void TracedFeatures::retract(sac::Call& call, sac::Edge& edge) noexcept {
  Vertex<2>& v = pool_[static_cast<LevelEdge&>(edge).vertex];
  if (v.locator == engine_.handle_of(call)) v.locator = 0;
}

void TracedFeatures::label(const sac::Call&, const sac::Edge& edge, sac::LabelSink& sink) const {
  const Vertex<2>& v = pool_[static_cast<const LevelEdge&>(edge).vertex];
  sink.number(static_cast<std::uint64_t>(v.level));
}

void TracedFeatures::print(const sac::Call&, const sac::Edge& edge, std::ostream& out) const {
  out << "crowded to level " << pool_[static_cast<const LevelEdge&>(edge).vertex].level;
}

void TracedFeatures::changed(Vertex<2>& v) {
  if (v.locator != 0) engine_.invalidate(engine_.call(v.locator));
}

void TracedFeatures::put(Vertex<2>& v) {
  tree_.insert(v, [&](Vertex<2>& f) { changed(f); });
  changed(v);
}

void TracedFeatures::take(Vertex<2>& v) {
  tree_.erase(v, [&](Vertex<2>& f) { changed(f); });
}

// How to undo is noted first, and does nothing where the edit has failed.
void TracedFeatures::insert(Vertex<2>& v) {
  engine_.on_rollback([this, &v] {
    if (tree_.obstacle(v.p) == &v) take(v);
  });
  put(v);
}

void TracedFeatures::erase(Vertex<2>& v) {
  engine_.on_rollback([this, &v] {
    if (tree_.obstacle(v.p) != &v) put(v);
  });
  take(v);
}

}  // namespace mesher::detail
