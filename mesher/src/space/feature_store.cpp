// Records of polygons, and the users of edges.
#include "space/feature_store.hpp"

#include <algorithm>

#include "sets/make_set.hpp"
#include "space/feature_search.hpp"

namespace mesher::detail {

// --- Records ---------------------------------------------------------------------------------

std::size_t FeatureStore::hash(const Key& key) noexcept {
  std::uint64_t h = key.f->points.size();
  for (const VertexHandle v : key.f->corners) h = sac::mix(h + v);
  for (const EdgeHandle e : key.f->all_edges) h = sac::mix(h + e);
  return h;
}

Edge& FeatureStore::record(VertexHandle a, VertexHandle b) {
  Edge& e = edges_.record(a, b);
  if (e.self >= users_.size()) users_.resize(e.self + std::size_t{1});
  if (e.self >= at_edge_.size()) at_edge_.resize(users_.size());
  return e;
}

namespace {

template <class Handle, class Key>
void sort_by(std::vector<Handle>& all, Key&& key) {
  std::sort(all.begin(), all.end(), [&](Handle a, Handle b) { return key(a) < key(b); });
}

// Of an edge that is there twice, which is refused later, the first corner.
void number_edges(Polygon& f) {
  f.corner_of.assign(f.all_edges.size(), Polygon::kInner);
  for (std::size_t i = f.edges.size(); i-- > 0;) {
    const auto at = std::lower_bound(f.all_edges.begin(), f.all_edges.end(), f.edges[i]);
    f.corner_of[static_cast<std::size_t>(at - f.all_edges.begin())] = static_cast<std::uint32_t>(i);
  }
}

}  // namespace

// All of a record. What is inside is known by its places, too: inner edges by those of their ends.
Polygon FeatureStore::shaped(PolygonParts& parts) {
  const auto place = [&](VertexHandle v) { return points_[v].p; };
  put_in_order(parts.loops, place);
  Polygon f;
  for (const Loop& loop : parts.loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      f.corners.push_back(loop[i]);
      f.places.push_back(place(loop[i]));
      f.edges.push_back(record(loop[i], loop[(i + 1) % loop.size()]).self);
    }
    f.loop_end.push_back(static_cast<std::uint32_t>(f.corners.size()));
  }
  f.points = f.corners;
  f.all_edges = f.edges;
  for (const auto& [a, b] : parts.edges) {
    f.inner_edges.push_back(record(a, b).self);
    parts.points.insert(parts.points.end(), {a, b});
  }
  make_set(f.inner_edges);
  make_set(parts.points);
  f.inner_points = std::move(parts.points);
  const auto ends = [&](EdgeHandle e) { return std::pair(edges()[e].place_a, edges()[e].place_b); };
  sort_by(f.inner_edges, ends);
  sort_by(f.inner_points, place);
  for (const EdgeHandle e : f.inner_edges) {
    f.inside.insert(f.inside.end(), {edges()[e].place_a, edges()[e].place_b});
  }
  for (const VertexHandle v : f.inner_points) f.inside.push_back(place(v));
  f.points.insert(f.points.end(), f.inner_points.begin(), f.inner_points.end());
  f.all_edges.insert(f.all_edges.end(), f.inner_edges.begin(), f.inner_edges.end());
  make_set(f.points);
  make_set(f.all_edges);
  number_edges(f);
  return f;
}

Polygon& FeatureStore::record(PolygonParts parts) {
  Polygon f = shaped(parts);
  PolygonHandle h = by_parts_.find(Key{&f});
  if (h == 0) {
    f.outline_tree.count_in(parts_looked_at_);
    f.inner_tree.count_in(parts_looked_at_);
    static_cast<void>(find_shape(f));
    h = polygons_.create(std::move(f)).self;
    try {
      by_parts_.insert(h);
    } catch (...) {
      polygons_.release(polygons_[h]);
      throw;
    }
  }
  touch(polygons_[h]);
  return polygons_[h];
}

void FeatureStore::touch(Polygon& f) noexcept {
  if (f.changed) return;
  f.changed = true;
  ++changes_;
  f.next_changed = std::exchange(changed_, f.self);
}

void FeatureStore::find_changed() {
  const std::uint64_t changes = edges_.changes() + changes_;
  if (changed_tree_ && found_changes_ == changes) return;
  forget_changed();
  ReachTree<Changed, 3> tree(box_);
  edges_.for_each_changed([&](const Edge& e) {
    tree.insert(middle_of(e), reach_of(e), {true, e.self});
  });
  for (PolygonHandle h = changed_; h != 0; h = polygons_[h].next_changed) {
    tree.insert(polygons_[h].middle, reach_of(polygons_[h]), {false, h});
  }
  changed_tree_.emplace(std::move(tree));
  found_changes_ = changes;
}

void FeatureStore::forget_changed() noexcept {
  if (!changed_tree_) return;
  changed_looked_at_ += changed_tree_->looked_at();
  changed_tree_.reset();
}

// --- What is there ---------------------------------------------------------------------------

/// `bounds`: as a side of a polygon with few. (Who uses it otherwise makes it a free one until it
/// goes.)
void FeatureStore::use(Edge& e, bool bounds) {
  if (users(e) == 0) {
    edges_.put(e, bounds);
    if (listener_ != nullptr) listener_->came(e);
  } else if (!bounds) {
    edges_.set_free(e);
  }
  ++users_[e.self];
}

void FeatureStore::leave(Edge& e) noexcept {
  if (--users_[e.self] != 0) return;
  edges_.take(e);
  if (listener_ != nullptr) listener_->went(e);
}

void FeatureStore::leave(std::span<const EdgeHandle> edges) noexcept {
  for (const EdgeHandle e : edges) leave(edges_[e]);
}

void FeatureStore::make_room_at_edges(const Polygon& f) {
  for (const EdgeHandle e : f.all_edges) at_edge_[e].reserve(at_edge_[e].size() + 1);
}

void FeatureStore::put_at_edges(const Polygon& f) noexcept {
  for (const EdgeHandle e : f.all_edges) {
    PolygonsAtEdge& all = at_edge_[e];
    const auto at = std::find_if(all.begin(), all.end(),
                                 [&](PolygonHandle h) { return order(f, polygons_[h]) < 0; });
    all.insert(at, f.self);
  }
}

void FeatureStore::put(Polygon& f) {
  SAC_EXPECTS(!f.alive);
  make_room_at_edges(f);
  std::size_t used = 0;
  try {
    for (; used < f.all_edges.size(); ++used)
      use(edges_[f.all_edges[used]], f.all_edges.size() <= kFewSides);
    tree_.insert(f.middle, f.reach + f.thickness, f.self);
  } catch (...) {
    leave(std::span(f.all_edges).first(used));
    throw;
  }
  put_at_edges(f);
  touch(f);
  f.alive = true;
  if (listener_ != nullptr) listener_->came(f);
}

void FeatureStore::take(Polygon& f) noexcept {
  tree_.erase(f.middle, f.self);
  for (const EdgeHandle e : f.all_edges) {
    at_edge_[e].erase(std::find(at_edge_[e].begin(), at_edge_[e].end(), f.self));
  }
  touch(f);
  f.alive = false;
  if (listener_ != nullptr) listener_->went(f);
  leave(f.all_edges);
}

// Polygons refer to edges.
void FeatureStore::commit() noexcept {
  forget_changed();
  for (PolygonHandle h = std::exchange(changed_, 0); h != 0;) {
    Polygon& f = polygons_[h];
    h = std::exchange(f.next_changed, 0);
    f.changed = false;
    if (f.alive) continue;
    by_parts_.erase(f.self);
    polygons_.release(f);
  }
  edges_.commit();
}

std::size_t FeatureStore::bytes() const noexcept {
  std::size_t lists = at_edge_.capacity() * sizeof(at_edge_[0]);
  for (const auto& all : at_edge_) {
    if (all.capacity() > 2) lists += all.capacity() * sizeof(all[0]);
  }
  return edges_.bytes() + users_.capacity() * sizeof(users_[0]) + lists + polygons_.bytes() +
         by_parts_.bytes() + tree_.bytes();
}

void FeatureStore::check_invariants() const {
  edges_.check_invariants();
  tree_.check_invariants();
  std::vector<std::size_t> count(users_.size());
  std::size_t records = 0, live = 0;
  polygons_.for_each([&](const Polygon& f) {
    ++records;
    SAC_INVARIANT(by_parts_.find(Key{&f}) == f.self && (f.alive || f.changed));
    if (!f.alive) return;
    ++live;
    for (const EdgeHandle e : f.all_edges) {
      ++count[e];
      const auto all = polygons_at(edges()[e]);
      SAC_INVARIANT(std::find(all.begin(), all.end(), f.self) != all.end());
    }
    for (std::size_t i = 0; i < f.corners.size(); ++i) {
      SAC_INVARIANT(points_[f.corners[i]].p == f.places[i]);
      SAC_INVARIANT(f.has(f.corners[i]) && f.has_edge(f.edges[i]));
    }
  });
  SAC_INVARIANT(records == by_parts_.size() && live == tree_.size());
  edges().for_each([&](const Edge& e) {
    SAC_INVARIANT((users(e) > 0) == e.alive);
    const auto all = polygons_at(e);
    SAC_INVARIANT(e.alive || all.empty());
    if (!e.alive) return;
    SAC_INVARIANT(all.size() == count[e.self] && users(e) >= all.size());
    SAC_INVARIANT(std::is_sorted(all.begin(), all.end(), [&](PolygonHandle f, PolygonHandle g) {
      return order(polygons_[f], polygons_[g]) < 0;
    }));
  });
}

}  // namespace mesher::detail
