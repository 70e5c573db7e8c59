// The quadtree's cells: marked as split and the marks taken back, children given and taken, and the
// vertices in the buckets of the leaves.
#pragma once

#include <algorithm>
#include <utility>

#include "index/quadtree.hpp"

namespace mesher::detail {

// Room for so many splits of cells: memory cannot run out on the way.
template <int D>
void Quadtree<D>::reserve_splits(std::size_t splits) {
  const std::size_t nodes = nodes_.size() + splits * kChildren;
  if (nodes > nodes_.capacity()) nodes_.reserve(std::max(nodes, 2 * nodes_.capacity()));
  free_.reserve(nodes_.capacity() / kChildren + 1);  // so that taking back cannot fail
  // Each child may leave one bucket half empty.
  reserve_buckets(splits * kChildren);
}

template <int D>
void Quadtree<D>::reserve_buckets(std::size_t more) {
  const std::size_t buckets = buckets_.size() + more;
  if (buckets > buckets_.capacity()) buckets_.reserve(std::max(buckets, 2 * buckets_.capacity()));
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
    nodes_[first + static_cast<NodeIndex>(i)] =
        Node{.parent_and_mark = n, .reach = nodes_[n].reach};
  }
  nodes_[n].child = first;
  for (BucketIndex b = std::exchange(nodes_[n].head, 0); b != 0;) {
    const Bucket bucket = buckets_[b];
    free_buckets_.push_back(b);
    for (std::uint32_t i = 0; i < bucket.count; ++i) {
      const int c = MeshBox<D>::child_of(box_.fixed(bucket.place[i]), level);
      put(first + static_cast<NodeIndex>(c), bucket.handle[i], bucket.place[i]);
    }
    b = bucket.next;
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
  buckets_[b].next = next;
  buckets_[b].count = 0;
  return b;
}

// Only the first bucket of a leaf may have room.
template <int D>
void Quadtree<D>::put(NodeIndex leaf, VertexHandle h, const Point<D>& p) noexcept {
  const BucketIndex head = nodes_[leaf].head;
  if (head == 0 || buckets_[head].count == buckets_[head].handle.size()) {
    nodes_[leaf].head = new_bucket(head);
  }
  Bucket& bucket = buckets_[nodes_[leaf].head];
  bucket.handle[bucket.count] = h;
  bucket.place[bucket.count++] = p;
}

// The children's vertices fit into no more buckets than they had.
template <int D>
void Quadtree<D>::take_children(NodeIndex n) noexcept {
  const NodeIndex first = std::exchange(nodes_[n].child, 0);
  for (int i = 0; i < kChildren; ++i) {
    const NodeIndex c = first + static_cast<NodeIndex>(i);
    for (BucketIndex b = std::exchange(nodes_[c].head, 0); b != 0;) {
      const Bucket bucket = buckets_[b];
      free_buckets_.push_back(b);
      for (std::uint32_t k = 0; k < bucket.count; ++k) put(n, bucket.handle[k], bucket.place[k]);
      b = bucket.next;
    }
  }
  free_.push_back(first);
}

template <int D>
typename Quadtree<D>::NodeIndex Quadtree<D>::mark(const Cell<D>& cell) {
  SAC_EXPECTS(cell.level >= 0 && cell.level < kLevels);
  int depth = 0;
  static_cast<void>(leaf_of(cell.corner, &depth));
  if (depth <= cell.level) reserve_splits(static_cast<std::size_t>(cell.level - depth + 1));
  NodeIndex n = 0;
  for (int level = 0;; ++level) {
    if (nodes_[n].child == 0) give_children(n, level);
    if (level == cell.level) break;
    n = nodes_[n].child + static_cast<NodeIndex>(MeshBox<D>::child_of(cell.corner, level));
  }
  nodes_[n].parent_and_mark |= 0x80000000u;
  return n;
}

template <int D>
void Quadtree<D>::unmark(NodeIndex n) noexcept {
  nodes_[n].parent_and_mark &= 0x7fffffffu;
  while (!nodes_[n].marked() && nodes_[n].child != 0) {
    for (int i = 0; i < kChildren; ++i) {
      if (nodes_[nodes_[n].child + static_cast<NodeIndex>(i)].child != 0) return;
    }
    take_children(n);
    n = nodes_[n].parent();
  }
}

template <int D>
void Quadtree<D>::insert(Vertex<D>& v) {
  reserve_buckets(1);
  put(leaf_of(box_.fixed(v.p)), v.self, v.p);
}

// The last vertex of the first bucket takes the place of the one that goes.
template <int D>
void Quadtree<D>::erase(Vertex<D>& v) noexcept {
  Node& leaf = nodes_[leaf_of(box_.fixed(v.p))];
  Bucket& first = buckets_[leaf.head];
  for (BucketIndex b = leaf.head; b != 0; b = buckets_[b].next) {
    Bucket& bucket = buckets_[b];
    for (std::uint32_t i = 0; i < bucket.count; ++i) {
      if (bucket.handle[i] != v.self) continue;
      bucket.handle[i] = first.handle[first.count - 1];
      bucket.place[i] = first.place[first.count - 1];
      if (--first.count == 0) {
        free_buckets_.push_back(leaf.head);
        leaf.head = first.next;
      }
      return;
    }
  }
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
