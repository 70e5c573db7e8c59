// The cells of the quadtree: marking and unmarking them as split, adding and removing children, and
// the vertices in the buckets of the leaves.
#pragma once

#include <algorithm>
#include <utility>

#include "index/quadtree_class.hpp"

namespace mesher::detail {

// By a quarter, once it is large: what is not used is memory that a trace takes.
template <int D>
template <class T>
void Quadtree<D>::make_room(std::vector<T, LineAllocator<T>>& records, std::size_t more) {
  const std::size_t size = records.size() + more;
  const std::size_t room = records.capacity();
  if (size > room) records.reserve(std::max(size, room < 4096 ? 2 * room : room + room / 4));
}

// Room for so many splits of cells: memory cannot run out on the way.
template <int D>
void Quadtree<D>::reserve_splits(std::size_t splits) {
  make_room(nodes_, splits * kChildren);
  free_.reserve(nodes_.capacity() / kChildren + 1);  // so that taking back cannot fail
  // Each child may leave one bucket half empty.
  reserve_buckets(splits * kChildren);
}

template <int D>
void Quadtree<D>::reserve_buckets(std::size_t more) {
  make_room(buckets_, more);
  free_buckets_.reserve(buckets_.capacity());  // so that giving back cannot fail
}

// Requires: reserve_splits.
template <int D>
void Quadtree<D>::give_children(NodeIndex n, int level) noexcept {
  NodeIndex first;
  if (free_.empty()) {
    first = static_cast<NodeIndex>(nodes_.size());
    nodes_.resize(nodes_.size() + kChildren);
  } else {
    first = free_.back();
    free_.pop_back();
  }
  for (int i = 0; i < kChildren; ++i) {
    nodes_[first + static_cast<NodeIndex>(i)] = Node{.parent_and_marks = n};
  }
  nodes_[n].child_and_closed = first;
  held(n) > kFull ? spread(n, level) : nodes_[n].close();
}

// Opens a cell: its vertices move into the children.
template <int D>
void Quadtree<D>::spread(NodeIndex n, int level) noexcept {
  const NodeIndex first = nodes_[n].child();
  nodes_[n].child_and_closed = first;
  for (int i = 0; i < kChildren; ++i) nodes_[first + static_cast<NodeIndex>(i)].area = {};
  for (BucketIndex b = std::exchange(nodes_[n].head, 0); b != 0;) {
    const Bucket bucket = buckets_[b];
    free_buckets_.push_back(b);
    for (std::uint32_t i = 0; i < bucket.count; ++i) {
      const Point<D>& p = bucket.place[i];
      const NodeIndex c =
          first + static_cast<NodeIndex>(MeshBox<D>::child_of(box_.fixed(p), level));
      nodes_[c].area.include(area_around(p, bucket.reach[i], level + 1));
      put(c, bucket, i);
    }
    b = bucket.next;
  }
  for (int i = 0; i < kChildren; ++i) raise_above(first + static_cast<NodeIndex>(i));
  for (int i = 0; i < kChildren; ++i) open_if_full(first + static_cast<NodeIndex>(i), level + 1);
}

// An area is rounded once more in each cell on the way up: it may be larger from the children than
// from their vertices, and who raises a reach stops where a cell's area covers it.
template <int D>
void Quadtree<D>::raise_above(NodeIndex n) noexcept {
  while (n != 0) {
    const Area<D> area = nodes_[n].area.in_parent(static_cast<int>(n % kChildren));
    n = nodes_[n].parent();
    if (nodes_[n].area.covers(area)) return;
    nodes_[n].area.include(area);
  }
}

// For a cell that keeps its vertices itself. Requires: reserve_splits.
template <int D>
void Quadtree<D>::open_if_full(NodeIndex n, int level) noexcept {
  if (nodes_[n].child() != 0) {
    if (held(n) > kFull) spread(n, level);
  } else if (level < kLevels && held(n) > kMany) {
    give_children(n, level);
  }
}

// Requires: a free bucket, or reserve_buckets.
template <int D>
typename Quadtree<D>::BucketIndex Quadtree<D>::new_bucket(BucketIndex next) noexcept {
  BucketIndex b;
  if (free_buckets_.empty()) {
    b = static_cast<BucketIndex>(buckets_.size());
    buckets_.emplace_back();
  } else {
    b = free_buckets_.back();
    free_buckets_.pop_back();
  }
  buckets_[b] = Bucket{.next = next};
  return b;
}

// Only the first bucket of a leaf may have room.
template <int D>
void Quadtree<D>::put(NodeIndex leaf, const Bucket& from, std::uint32_t i) noexcept {
  const BucketIndex head = nodes_[leaf].head;
  if (head == 0 || buckets_[head].count == kSlots) nodes_[leaf].head = new_bucket(head);
  Bucket& bucket = buckets_[nodes_[leaf].head];
  bucket.handle[bucket.count] = from.handle[i];
  bucket.reach[bucket.count] = from.reach[i];
  bucket.place[bucket.count++] = from.place[i];
}

// The vertices of the children, which have none below them, fit into no more buckets than they had.
template <int D>
void Quadtree<D>::gather(NodeIndex n) noexcept {
  for (int i = 0; i < kChildren; ++i) {
    const NodeIndex c = nodes_[n].child() + static_cast<NodeIndex>(i);
    for (BucketIndex b = std::exchange(nodes_[c].head, 0); b != 0;) {
      const Bucket bucket = buckets_[b];
      free_buckets_.push_back(b);
      for (std::uint32_t k = 0; k < bucket.count; ++k) put(n, bucket, k);
      b = bucket.next;
    }
  }
}

// The vertices that the cell itself holds.
template <int D>
std::size_t Quadtree<D>::held(NodeIndex n) const noexcept {
  if (nodes_[n].head == 0) return 0;
  const Bucket& first = buckets_[nodes_[n].head];
  std::size_t vertices = first.count;
  for (BucketIndex b = first.next; b != 0; b = buckets_[b].next) vertices += kSlots;
  return vertices;
}

// The vertices of a cell with children, if none of these is open; else more than any limit.
template <int D>
std::size_t Quadtree<D>::held_below(NodeIndex n) const noexcept {
  if (nodes_[n].closed()) return held(n);
  std::size_t vertices = 0;
  for (int i = 0; i < kChildren; ++i) {
    const NodeIndex c = nodes_[n].child() + static_cast<NodeIndex>(i);
    if (nodes_[c].open() != 0) return kMany + 1;
    vertices += held(c);
  }
  return vertices;
}

// Closes the cell, or takes its children, if its vertices are few enough; returns whether they are.
// What is not wanted has children for its vertices only, and so has what is in it: where they are
// few, there is nothing further below.
template <int D>
bool Quadtree<D>::shrink(NodeIndex n) noexcept {
  const bool wanted = nodes_[n].wanted();
  if (held_below(n) > (wanted ? kFull : kMany)) return false;
  if (!nodes_[n].closed()) gather(n);
  nodes_[n].close();
  if (wanted) return true;
  free_.push_back(nodes_[n].child());
  nodes_[n].child_and_closed = 0;
  return true;
}

template <int D>
bool Quadtree<D>::any_child_wanted(NodeIndex n) const noexcept {
  bool wanted = false;
  for (int i = 0; i < kChildren; ++i) {
    wanted = wanted || nodes_[nodes_[n].child() + static_cast<NodeIndex>(i)].wanted();
  }
  return wanted;
}

// How deep cells are subdivided around f.
template <int D>
int Quadtree<D>::subdivided(const Fixed<D>& f) const {
  int depth = 0;
  for (NodeIndex n = 0; nodes_[n].child() != 0; ++depth) {
    n = nodes_[n].child() + static_cast<NodeIndex>(MeshBox<D>::child_of(f, depth));
  }
  return depth;
}

template <int D>
typename Quadtree<D>::NodeIndex Quadtree<D>::mark(const Cell<D>& cell) {
  SAC_EXPECTS(cell.level >= 0 && cell.level < kLevels);
  const int depth = subdivided(cell.corner);
  if (depth <= cell.level) reserve_splits(static_cast<std::size_t>(cell.level - depth + 1));
  NodeIndex n = 0;
  for (int level = 0;; ++level) {
    if (nodes_[n].child() == 0) give_children(n, level);
    nodes_[n].set(kWanted, true);
    if (level == cell.level) break;
    n = nodes_[n].child() + static_cast<NodeIndex>(MeshBox<D>::child_of(cell.corner, level));
  }
  nodes_[n].set(kMarked, true);
  return n;
}

template <int D>
void Quadtree<D>::unmark(NodeIndex n) noexcept {
  nodes_[n].set(kMarked, false);
  while (nodes_[n].wanted() && !nodes_[n].marked() && !any_child_wanted(n)) {
    nodes_[n].set(kWanted, false);
    static_cast<void>(shrink(n));
    n = nodes_[n].parent();
  }
}

// Should cells open, there is at most a bucket for each vertex. A full cell opens into one that is
// just as full, at worst, and so on.
template <int D>
void Quadtree<D>::insert(Vertex<D>& v) {
  static_assert(kMany + 2 <= kLevels * kChildren);
  reserve_splits(kLevels);
  int level = 0;
  const NodeIndex n = leaf_of(box_.fixed(v.p), &level);
  Bucket one;
  one.handle[0] = v.self;
  one.reach[0] = v.reach;
  one.place[0] = v.p;
  put(n, one, 0);
  open_if_full(n, level);
}

template <int D>
typename Quadtree<D>::Entry Quadtree<D>::entry(NodeIndex leaf, VertexHandle h) const noexcept {
  for (BucketIndex b = nodes_[leaf].head;; b = buckets_[b].next) {
    for (std::uint32_t i = 0; i < buckets_[b].count; ++i) {
      if (buckets_[b].handle[i] == h) return {b, i};
    }
  }
}

// The last vertex of the first bucket takes the place of the one that goes. Then cells above close
// or lose their children that have few enough.
template <int D>
void Quadtree<D>::erase(Vertex<D>& v) noexcept {
  NodeIndex n = leaf_of(box_.fixed(v.p));
  const Entry gone = entry(n, v.self);
  const BucketIndex head = nodes_[n].head;
  Bucket& first = buckets_[head];
  Bucket& bucket = buckets_[gone.bucket];
  --first.count;
  bucket.handle[gone.i] = first.handle[first.count];
  bucket.reach[gone.i] = first.reach[first.count];
  bucket.place[gone.i] = first.place[first.count];
  first.clear(first.count);
  if (first.count == 0) {
    free_buckets_.push_back(head);
    nodes_[n].head = first.next;
  }
  while (n != 0 && shrink(nodes_[n].parent())) n = nodes_[n].parent();
}

template <int D>
Vertex<D>* Quadtree<D>::find(const Point<D>& p) const {
  Vertex<D>* found = nullptr;
  visit_leaf(leaf_of(box_.fixed(p)), [&](VertexHandle h, const Point<D>& place) {
    if (place == p) found = &vertices_[h];
  });
  return found;
}

}  // namespace mesher::detail
