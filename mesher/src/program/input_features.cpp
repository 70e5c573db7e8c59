// Edits of the set of features reach all that observes it.
#include "program/input_features.hpp"

#include "plane/crowding_impl.hpp"

namespace mesher::detail {

template class Crowding<sac::PlainScope, EdgePieces>;
template class Crowding<sac::Scope, EdgePieces>;
template class Crowding<sac::PlainScope, FacetPieces>;
template class Crowding<sac::Scope, FacetPieces>;
template class Crowding<sac::PlainScope, HingePieces>;
template class Crowding<sac::Scope, HingePieces>;
template class Crowding<sac::PlainScope, GuardPieces>;
template class Crowding<sac::Scope, GuardPieces>;

const Edge& InputFeatures<sac::PlainScope>::insert(VertexHandle a, VertexHandle b) {
  Edge& e = store_.record(a, b);
  store_.use(e);
  return e;
}

const Polygon& InputFeatures<sac::PlainScope>::insert(PolygonParts parts) {
  Polygon& f = store_.record(std::move(parts));
  store_.put(f);
  return f;
}

using Traced = InputFeatures<sac::Scope>;

// How to undo is noted first, and does nothing where the edit has failed.
const Edge& Traced::insert(VertexHandle a, VertexHandle b) {
  Edge& e = store_.record(a, b);
  engine_.on_rollback([this, &e, before = store_.users(e)] {
    if (store_.users(e) > before) store_.leave(e);
  });
  store_.use(e);
  return e;
}

void Traced::erase(const Edge& edge) {
  Edge& e = store_.record(edge.a, edge.b);
  engine_.on_rollback([this, &e, before = store_.users(e)] {
    if (store_.users(e) < before) store_.use(e);
  });
  store_.leave(e);
}

const Polygon& Traced::insert(PolygonParts parts) {
  Polygon& f = store_.record(std::move(parts));
  engine_.on_rollback([this, &f] {
    if (f.alive) store_.take(f);
  });
  store_.put(f);
  return f;
}

void Traced::erase(const Polygon& polygon) {
  Polygon& f = store_.polygons()[polygon.self];
  engine_.on_rollback([this, &f] {
    if (!f.alive) store_.put(f);
  });
  store_.take(f);
}

void Traced::point_came(const Vertex<3>& v) noexcept {
  tell_pieces_came(v);
  if (surroundings_ != nullptr) surroundings_->changed(extent_of(v));
}
void Traced::point_went(const Vertex<3>& v) noexcept {
  tell_pieces_went(v);
  if (surroundings_ != nullptr) surroundings_->changed(extent_of(v));
}

}  // namespace mesher::detail
