// Records, lists at the ends, and tiles.
#include "plane/segment_store.hpp"

#include <algorithm>
#include <utility>

#include "geometry/space_distances.hpp"

namespace mesher::detail {

// --- Records ---------------------------------------------------------------------------------

template <int D>
const SegmentOf<D>* SegmentStoreOf<D>::find(VertexHandle a, VertexHandle b) const {
  const SegmentHandle h = by_ends_.find(ends(a, b));
  return h != 0 && pool_[h].alive ? &pool_[h] : nullptr;
}

template <int D>
void SegmentStoreOf<D>::touch(Segment& s) noexcept {
  if (s.changed) return;
  s.changed = true;
  ++changes_;
  s.next_changed = std::exchange(changed_, s.self);
}

template <int D>
SegmentOf<D>& SegmentStoreOf<D>::record(VertexHandle a, VertexHandle b) {
  SegmentHandle h = by_ends_.find(ends(a, b));
  if (h == 0) {
    const bool in_order = points_[a].p < points_[b].p;
    Segment& fresh = pool_.create(points_[in_order ? a : b], points_[in_order ? b : a]);
    h = fresh.self;
    try {
      by_ends_.insert(h);
    } catch (...) {
      pool_.release(fresh);
      throw;
    }
  }
  touch(pool_[h]);
  return pool_[h];
}

// The lists at the ends are there, though empty, before anything is put into them.
template <int D>
void SegmentStoreOf<D>::put(Segment& s, bool bounds) {
  SAC_EXPECTS(!s.alive);
  s.bounds = bounds;
  const TileHandle tile = new_tile(Tile{.segment = s.self});
  try {
    for (const VertexHandle end : {s.a, s.b}) at_.try_emplace(end, 0);
    tree_of(s).insert(middle(tiles_[tile]), reach(tiles_[tile]), tile);
  } catch (...) {
    for (const VertexHandle end : {s.a, s.b}) drop_if_empty(end);
    free_tile(tile);
    throw;
  }
  for (const VertexHandle end : {s.a, s.b}) {
    link_at(s, end) = std::exchange(at_.find(end).value(), s.self);
  }
  touch(s);
  s.tile = tile;
  s.alive = true;
  ++live_;
}

template <int D>
void SegmentStoreOf<D>::set_free(Segment& s) {
  SAC_EXPECTS(s.alive);
  if (!s.bounds) return;
  auto& [free, sides] = trees_;
  TileHandle put = s.tile;
  try {
    for (; put != 0; put = tiles_[put].next) {
      free.insert(middle(tiles_[put]), reach(tiles_[put]), put);
    }
  } catch (...) {
    for (TileHandle t = s.tile; t != put; t = tiles_[t].next) free.erase(middle(tiles_[t]), t);
    throw;
  }
  for (TileHandle t = s.tile; t != 0; t = tiles_[t].next) sides.erase(middle(tiles_[t]), t);
  s.bounds = false;
}

template <int D>
void SegmentStoreOf<D>::drop_if_empty(VertexHandle end) noexcept {
  const auto it = at_.find(end);
  if (it != at_.end() && it->second == 0) at_.erase(it);
}

template <int D>
void SegmentStoreOf<D>::leave(Segment& s, VertexHandle end) noexcept {
  const auto it = at_.find(end);
  SegmentHandle* link = &it.value();
  while (*link != s.self) link = &link_at(pool_[*link], end);
  *link = std::exchange(link_at(s, end), 0);
  drop_if_empty(end);
}

template <int D>
void SegmentStoreOf<D>::take(Segment& s) noexcept {
  leave(s, s.a);
  leave(s, s.b);
  for (TileHandle t = std::exchange(s.tile, 0); t != 0;) {
    const TileHandle next = tiles_[t].next;
    tree_of(s).erase(middle(tiles_[t]), t);
    free_tile(t);
    t = next;
  }
  touch(s);
  s.alive = false;
  --live_;
}

template <int D>
void SegmentStoreOf<D>::commit() noexcept {
  for (SegmentHandle h = std::exchange(changed_, 0); h != 0;) {
    Segment& s = pool_[h];
    h = std::exchange(s.next_changed, 0);
    s.changed = false;
    if (s.alive) continue;
    by_ends_.erase(s.self);
    pool_.release(s);
  }
}

// --- Tiles -----------------------------------------------------------------------------------

template <int D>
Point<D> SegmentStoreOf<D>::at(const Segment& s, double fraction) const noexcept {
  Point<D> p;
  for (int i = 0; i < D; ++i) p[i] = s.place_a[i] + fraction * (s.place_b[i] - s.place_a[i]);
  return p;
}

template <int D>
typename SegmentStoreOf<D>::TileHandle SegmentStoreOf<D>::new_tile(const Tile& tile) {
  if (free_tiles_ == 0) {
    if (tiles_.size() == tiles_.capacity()) tiles_.reserve(tiles_.size() + tiles_.size() / 2 + 1);
    tiles_.push_back(tile);
    return static_cast<TileHandle>(tiles_.size() - 1);
  }
  const TileHandle t = free_tiles_;
  free_tiles_ = tiles_[t].next;
  tiles_[t] = tile;
  return t;
}

template <int D>
void SegmentStoreOf<D>::free_tile(TileHandle t) noexcept {
  tiles_[t] = Tile{.next = std::exchange(free_tiles_, t)};
}

// A search of pq that has met the tile's disc, but is far from the tile.
template <int D>
bool SegmentStoreOf<D>::is_needless(const Tile& t, const Point<D>& p, const Point<D>& q,
                                    double slack) const noexcept {
  double long_side = 0;
  for (int i = 0; i < D; ++i) long_side = std::max(long_side, std::abs(q[i] - p[i]));
  if (length(t) <= kLong * (long_side + 2 * slack) || length(t) < box_.side * 0x1p-40) return false;
  const Segment& s = pool_[t.segment];
  return distance2(at(s, t.lo), at(s, t.hi), p, q) > slack * slack;
}

// The lower half keeps the tile's handle.
template <int D>
void SegmentStoreOf<D>::halve(TileHandle t) {
  const Tile old = tiles_[t];
  ReachTree<TileHandle, D>& tree = tree_of(pool_[old.segment]);
  const double cut = old.lo + (old.hi - old.lo) / 2;
  const Tile lower{old.segment, old.next, old.lo, cut};
  const TileHandle u = new_tile(Tile{old.segment, old.next, cut, old.hi});
  try {
    tree.insert(middle(tiles_[u]), reach(tiles_[u]), u);
    try {
      tree.insert(middle(lower), reach(lower), t);
    } catch (...) {
      tree.erase(middle(tiles_[u]), u);
      throw;
    }
  } catch (...) {
    free_tile(u);
    throw;
  }
  tree.erase(middle(old), t);
  tiles_[t] = lower;
  tiles_[t].next = u;
}

template <int D>
std::size_t SegmentStoreOf<D>::bytes() const noexcept {
  return pool_.bytes() + tiles_.capacity() * sizeof(Tile) + trees_[0].bytes() + trees_[1].bytes() +
         by_ends_.bytes() + at_.bucket_count() * 3 * sizeof(VertexHandle);
}

template <int D>
void SegmentStoreOf<D>::check_invariants() const {
  for (const auto& tree : trees_) tree.check_invariants();
  std::size_t records = 0, live = 0, tiles = 0, ends = 0;
  pool_.for_each([&](const Segment& s) {
    ++records;
    SAC_INVARIANT(by_ends_.find(key(s.self)) == s.self && s.place_a < s.place_b);
    SAC_INVARIANT(s.alive || s.changed);
    if (!s.alive) return;
    ++live;
    SAC_INVARIANT(points_[s.a].p == s.place_a && points_[s.b].p == s.place_b);
    double covered = 0;
    for (TileHandle t = s.tile; t != 0; t = tiles_[t].next, ++tiles) {
      SAC_INVARIANT(tiles_[t].segment == s.self);
      covered += tiles_[t].hi - tiles_[t].lo;
    }
    SAC_INVARIANT(covered == 1);
  });
  for (const auto& entry : at_) {
    const VertexHandle end = entry.first;
    SAC_INVARIANT(entry.second != 0);
    visit_at(end, [&](const Segment& s) {
      SAC_INVARIANT(s.alive && s.has_end(end));
      ++ends;
    });
  }
  SAC_INVARIANT(records == by_ends_.size() && live == live_ && ends == 2 * live);
  SAC_INVARIANT(tiles == trees_[0].size() + trees_[1].size());
}

template class SegmentStoreOf<2>;
#ifndef MESHER_PLANE_ONLY
template class SegmentStoreOf<3>;
#endif

}  // namespace mesher::detail
