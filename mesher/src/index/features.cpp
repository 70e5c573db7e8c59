// Observing the level of a point, outside edits of the set of points, and splits of segments.
#include "index/features.hpp"

#include "input.hpp"
#include "mesher/error.hpp"

namespace mesher::detail {

void refuse_close(const Vertex<2>& v, const Vertex<2>& w) {
  throw Error(ErrorCode::too_close, "features are too close to each other: they need vertices at " +
                                        place_text(v.p) + " and " + place_text(w.p) +
                                        ", which share a cell of 2^-50 of the meshing box's side");
}

void Features<sac::PlainScope>::insert(sac::PlainScope&, VertexRef<2> v) {
  if (const Vertex<2>* other = tree_.obstacle(v->p)) refuse_(*v, *other);
  tree_.insert_only(*v);
}

using TracedFeatures = Features<sac::Scope>;

// --- Observations ----------------------------------------------------------------------------

int TracedFeatures::level(sac::Scope& s, Vertex<2>& v) {
  const auto same = [&](const LevelEdge& edge) { return edge.vertex == v.self; };
  if (s.recall<LevelEdge>(id_, kLevel, same) == nullptr) {
    s.observe<LevelEdge>(id_, kLevel).vertex = v.self;
  }
  v.locator = engine_.handle_of(s.self());
  if (const Vertex<2>* other = companion(v)) refuse_(v, *other);
  if (engine_.appending()) v.level = static_cast<std::int16_t>(tree_.crowded_level(v));
  return v.level;
}

// Another in v's finest cell.
const Vertex<2>* TracedFeatures::companion(const Vertex<2>& v) const {
  if (hidden_.empty()) return nullptr;
  const Vertex<2>* shown = tree_.obstacle(v.p);
  if (shown != &v) return shown;
  const auto it = hidden_.find(box_.fixed(v.p));
  return it == hidden_.end() ? nullptr : &pool_[it->second];
}

void TracedFeatures::changed(Vertex<2>& v) noexcept {
  if (v.locator != 0) engine_.invalidate(engine_.call(v.locator));
}

// --- What is there ---------------------------------------------------------------------------

void TracedFeatures::cell_changed(const Point<2>& p) noexcept {
  if (const Vertex<2>* shown = tree_.obstacle(p)) changed(pool_[shown->self]);
  const auto [first, last] = hidden_.equal_range(box_.fixed(p));
  for (auto it = first; it != last; ++it) changed(pool_[it->second]);
}

void TracedFeatures::put(Vertex<2>& v) {
  put_in_tree(v);
  if (feature_listener_ != nullptr) feature_listener_->feature_changed(v.p);
}

void TracedFeatures::put_in_tree(Vertex<2>& v) {
  if (tree_.obstacle(v.p) != nullptr) {
    hidden_.emplace(box_.fixed(v.p), v.self);
    return cell_changed(v.p);
  }
  if (engine_.appending()) return tree_.insert_only(v);  // levels come with level()
  tree_.insert(v, [&](Vertex<2>& f) { changed(f); });
  changed(v);
}

void TracedFeatures::take(Vertex<2>& v) noexcept {
  take_from_tree(v);
  if (feature_listener_ != nullptr) feature_listener_->feature_changed(v.p);
}

void TracedFeatures::take_from_tree(Vertex<2>& v) noexcept {
  const auto [first, last] = hidden_.equal_range(box_.fixed(v.p));
  if (first == last) return tree_.erase(v, [&](Vertex<2>& f) { changed(f); });
  auto gone = first;
  if (tree_.obstacle(v.p) == &v) {
    Vertex<2>& heir = pool_[first->second];
    tree_.replace(v, heir);
    heir.level = v.level;
  } else {
    while (gone->second != v.self) ++gone;
  }
  hidden_.erase(gone);
  cell_changed(v.p);
}

void TracedFeatures::put_point(Vertex<2>& v) {
  if (splits_.find(v.self) == splits_.end()) put(v);
  v.feature = true;
  if (listener_ != nullptr) listener_->point_came(v);
}

void TracedFeatures::take_point(Vertex<2>& v) noexcept {
  v.feature = false;
  if (splits_.find(v.self) == splits_.end()) take(v);
  if (listener_ != nullptr) listener_->point_went(v);
}

void TracedFeatures::put_split(Vertex<2>& v) {
  const auto [it, is_new] = splits_.try_emplace(v.self, 0);
  try {
    if (is_new && !v.feature) put(v);
  } catch (...) {
    splits_.erase(it);
    throw;
  }
  ++it->second;
}

void TracedFeatures::take_split(Vertex<2>& v) noexcept {
  const auto it = splits_.find(v.self);
  if (--it->second != 0) return;
  splits_.erase(it);
  if (!v.feature) take(v);
}

// --- Edits and effects -----------------------------------------------------------------------

const Vertex<2>* TracedFeatures::point_at(const Point<2>& p) const {
  const Vertex<2>* shown = tree_.obstacle(p);
  if (shown == nullptr || shown->feature) return shown;
  const auto [first, last] = hidden_.equal_range(box_.fixed(p));
  for (auto it = first; it != last; ++it) {
    if (pool_[it->second].feature) return &pool_[it->second];
  }
  return nullptr;
}

// How to undo is noted first, and does nothing where the edit has failed.
void TracedFeatures::insert(Vertex<2>& v) {
  engine_.on_rollback([this, &v] {
    if (v.feature) take_point(v);
  });
  put_point(v);
}

void TracedFeatures::erase(Vertex<2>& v) {
  engine_.on_rollback([this, &v] {
    if (!v.feature) put_point(v);
  });
  take_point(v);
}

void TracedFeatures::limits_changed(const Box<2>& where) noexcept {
  visit_features_in(where, [&](const Vertex<2>& v) {
    changed(pool_[v.self]);
    return false;
  });
}

void TracedFeatures::insert(sac::Scope& s, VertexRef<2> v) {
  const auto same = [&](const SplitEdge& edge) { return edge.vertex == v->self; };
  if (s.recall<SplitEdge>(id_, kSplit, same) != nullptr) return;
  auto& edge = s.effect<SplitEdge>(id_, kSplit);
  edge.vertex = 0;
  put_split(*v);
  edge.vertex = v->self;
}

void TracedFeatures::retract(sac::Call& call, sac::Edge& edge) noexcept {
  if (edge.kind == kSplit) {
    const VertexHandle h = static_cast<SplitEdge&>(edge).vertex;
    if (h != 0) take_split(pool_[h]);
    return;
  }
  Vertex<2>& v = pool_[static_cast<LevelEdge&>(edge).vertex];
  if (v.locator == engine_.handle_of(call)) v.locator = 0;
}

// --- For people and for traces ---------------------------------------------------------------

void TracedFeatures::label(const sac::Call&, const sac::Edge& edge, sac::LabelSink& sink) const {
  if (edge.kind == kSplit) return;
  const Vertex<2>& v = pool_[static_cast<const LevelEdge&>(edge).vertex];
  sink.number(static_cast<std::uint64_t>(v.level));
}

void TracedFeatures::print(const sac::Call&, const sac::Edge& edge, std::ostream& out) const {
  if (edge.kind == kSplit) {
    out << "splits at " << VertexRef<2>{&pool_[static_cast<const SplitEdge&>(edge).vertex]};
    return;
  }
  out << "crowded to level " << pool_[static_cast<const LevelEdge&>(edge).vertex].level;
}

void TracedFeatures::check_invariants() const {
  tree_.check_invariants();
  SAC_INVARIANT(hidden_.empty());
  std::size_t points = 0;
  pool_.for_each([&](const Vertex<2>& v) {
    const bool there = v.feature || splits_.find(v.self) != splits_.end();
    SAC_INVARIANT((tree_.obstacle(v.p) == &v) == there);
    SAC_INVARIANT(!there || v.level == tree_.crowded_level(v));
    points += there;
  });
  SAC_INVARIANT(points == tree_.size());
}

}  // namespace mesher::detail
