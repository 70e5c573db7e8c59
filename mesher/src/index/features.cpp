// Observing the level of a point, outside edits of the set of points, and splits of segments.
#include "index/features.hpp"

#include "geometry/input_point.hpp"
#include "mesher/error.hpp"

namespace mesher::detail {

template <int D>
void refuse_close(const Vertex<D>& v, const Vertex<D>& w) {
  throw Error(ErrorCode::too_close, "features are too close to each other: they need vertices at " +
                                        place_text(v.p) + " and " + place_text(w.p) +
                                        ", which share a cell of 2^-50 of the meshing box's side");
}

template <int D>
void Features<sac::PlainScope, D>::insert(sac::PlainScope&, VertexRef<D> v) {
  if (const Vertex<D>* other = tree_.obstacle(v->p)) refuse_(*v, *other);
  tree_.insert_only(*v);
}

// --- Observations ----------------------------------------------------------------------------

template <int D>
int Features<sac::Scope, D>::level(sac::Scope& s, Vertex<D>& v) {
  const auto same = [&](const LevelEdge& edge) { return edge.vertex == v.self; };
  if (s.recall<LevelEdge>(id_, kLevel, same) == nullptr) {
    s.observe<LevelEdge>(id_, kLevel).vertex = v.self;
  }
  v.locator = engine_.handle_of(s.self());
  if (const Vertex<D>* other = companion(v)) refuse_(v, *other);
  if (engine_.appending()) v.level = static_cast<std::int16_t>(tree_.crowded_level(v));
  return v.level;
}

// Another in v's finest cell.
template <int D>
const Vertex<D>* Features<sac::Scope, D>::companion(const Vertex<D>& v) const {
  if (hidden_.empty()) return nullptr;
  const Vertex<D>* shown = tree_.obstacle(v.p);
  if (shown != &v) return shown;
  const auto it = hidden_.find(box_.fixed(v.p));
  return it == hidden_.end() ? nullptr : &pool_[it->second];
}

template <int D>
void Features<sac::Scope, D>::changed(Vertex<D>& v) noexcept {
  if (v.locator != nullptr) {
    engine_.invalidate(engine_.call(v.locator));
  } else if (listener_ != nullptr) {
    listener_->level_changed(v);
  }
}

template <int D>
void Features<sac::Scope, D>::require_apart() const {
  if (hidden_.empty()) return;
  const Vertex<D>& v = pool_[hidden_.begin()->second];
  refuse_(v, *tree_.obstacle(v.p));
}

// --- What is there ---------------------------------------------------------------------------

template <int D>
void Features<sac::Scope, D>::cell_changed(const Point<D>& p) noexcept {
  if (const Vertex<D>* shown = tree_.obstacle(p)) changed(pool_[shown->self]);
  const auto [first, last] = hidden_.equal_range(box_.fixed(p));
  for (auto it = first; it != last; ++it) changed(pool_[it->second]);
}

template <int D>
void Features<sac::Scope, D>::put(Vertex<D>& v) {
  put_in_tree(v);
  if (feature_listener_ != nullptr) feature_listener_->feature_changed(v.p);
}

template <int D>
void Features<sac::Scope, D>::put_in_tree(Vertex<D>& v) {
  if (tree_.obstacle(v.p) != nullptr) {
    hidden_.emplace(box_.fixed(v.p), v.self);
    return cell_changed(v.p);
  }
  if (engine_.appending()) return tree_.insert_only(v);  // levels come with level()
  tree_.insert(v, [&](Vertex<D>& f) { changed(f); });
  changed(v);
}

template <int D>
void Features<sac::Scope, D>::take(Vertex<D>& v) noexcept {
  take_from_tree(v);
  if (feature_listener_ != nullptr) feature_listener_->feature_changed(v.p);
}

template <int D>
void Features<sac::Scope, D>::take_from_tree(Vertex<D>& v) noexcept {
  const auto [first, last] = hidden_.equal_range(box_.fixed(v.p));
  if (first == last) return tree_.erase(v, [&](Vertex<D>& f) { changed(f); });
  auto gone = first;
  if (tree_.obstacle(v.p) == &v) {
    Vertex<D>& heir = pool_[first->second];
    tree_.replace(v, heir);
    heir.level = v.level;
  } else {
    while (gone->second != v.self) ++gone;
  }
  hidden_.erase(gone);
  cell_changed(v.p);
}

template <int D>
void Features<sac::Scope, D>::put_point(Vertex<D>& v) {
  if (splits_.find(v.self) == splits_.end()) put(v);
  v.feature = true;
  if (listener_ != nullptr) listener_->point_came(v);
}

template <int D>
void Features<sac::Scope, D>::take_point(Vertex<D>& v) noexcept {
  v.feature = false;
  if (splits_.find(v.self) == splits_.end()) take(v);
  if (listener_ != nullptr) listener_->point_went(v);
}

template <int D>
void Features<sac::Scope, D>::put_split(Vertex<D>& v) {
  const auto [it, is_new] = splits_.try_emplace(v.self, 0);
  try {
    if (is_new && !v.feature) put(v);
  } catch (...) {
    splits_.erase(it);
    throw;
  }
  ++it->second;
}

template <int D>
void Features<sac::Scope, D>::take_split(Vertex<D>& v) noexcept {
  const auto it = splits_.find(v.self);
  if (--it->second != 0) return;
  splits_.erase(it);
  if (!v.feature) take(v);
}

// --- Edits and effects -----------------------------------------------------------------------

template <int D>
const Vertex<D>* Features<sac::Scope, D>::point_at(const Point<D>& p) const {
  const Vertex<D>* shown = tree_.obstacle(p);
  if (shown == nullptr || shown->feature) return shown;
  const auto [first, last] = hidden_.equal_range(box_.fixed(p));
  for (auto it = first; it != last; ++it) {
    if (pool_[it->second].feature) return &pool_[it->second];
  }
  return nullptr;
}

// How to undo is noted first, and does nothing where the edit has failed.
template <int D>
void Features<sac::Scope, D>::insert(Vertex<D>& v) {
  engine_.on_rollback([this, &v] {
    if (v.feature) take_point(v);
  });
  put_point(v);
}

template <int D>
void Features<sac::Scope, D>::erase(Vertex<D>& v) {
  engine_.on_rollback([this, &v] {
    if (!v.feature) put_point(v);
  });
  take_point(v);
}

template <int D>
void Features<sac::Scope, D>::limits_changed(const Box<D>& where) noexcept {
  visit_features_in(where, [&](const Vertex<D>& v) {
    changed(pool_[v.self]);
    return false;
  });
}

template <int D>
void Features<sac::Scope, D>::insert(sac::Scope& s, VertexRef<D> v) {
  const auto same = [&](const SplitEdge& edge) { return edge.vertex == v->self; };
  if (s.recall<SplitEdge>(id_, kSplit, same) != nullptr) return;
  auto& edge = s.effect<SplitEdge>(id_, kSplit);
  edge.vertex = 0;
  put_split(*v);
  edge.vertex = v->self;
}

template <int D>
void Features<sac::Scope, D>::retract(sac::Call& call, sac::Edge& edge) noexcept {
  if (edge.kind == kSplit) {
    const VertexHandle h = static_cast<SplitEdge&>(edge).vertex;
    if (h != 0) take_split(pool_[h]);
    return;
  }
  Vertex<D>& v = pool_[static_cast<LevelEdge&>(edge).vertex];
  if (v.locator == engine_.handle_of(call)) v.locator = nullptr;
}

// --- For people and for traces ---------------------------------------------------------------

template <int D>
void Features<sac::Scope, D>::label(const sac::Call&, const sac::Edge& edge,
                                    sac::LabelSink& sink) const {
  if (edge.kind == kSplit) return;
  const Vertex<D>& v = pool_[static_cast<const LevelEdge&>(edge).vertex];
  sink.number(static_cast<std::uint64_t>(v.level));
}

template <int D>
void Features<sac::Scope, D>::print(const sac::Call&, const sac::Edge& edge,
                                    std::ostream& out) const {
  if (edge.kind == kSplit) {
    out << "splits at " << VertexRef<D>{&pool_[static_cast<const SplitEdge&>(edge).vertex]};
    return;
  }
  out << "crowded to level " << pool_[static_cast<const LevelEdge&>(edge).vertex].level;
}

template <int D>
void Features<sac::Scope, D>::check_invariants() const {
  tree_.check_invariants();
  SAC_INVARIANT(hidden_.empty());
  std::size_t points = 0;
  pool_.for_each([&](const Vertex<D>& v) {
    const bool there = v.feature || splits_.find(v.self) != splits_.end();
    SAC_INVARIANT((tree_.obstacle(v.p) == &v) == there);
    SAC_INVARIANT(!there || v.level == tree_.crowded_level(v));
    points += there;
  });
  SAC_INVARIANT(points == tree_.size());
}

template void refuse_close<2>(const Vertex<2>&, const Vertex<2>&);
template class Features<sac::PlainScope, 2>;
template class Features<sac::Scope, 2>;
#ifndef MESHER_PLANE_ONLY
template void refuse_close<3>(const Vertex<3>&, const Vertex<3>&);
template class Features<sac::PlainScope, 3>;
template class Features<sac::PlainScope, 4>;
template class Features<sac::Scope, 3>;
template class Features<sac::Scope, 4>;
#endif

}  // namespace mesher::detail
