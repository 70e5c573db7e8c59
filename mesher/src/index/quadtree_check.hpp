// Functions on the whole quadtree: its invariant, and its leaves.
#pragma once

#include <algorithm>

#include "index/quadtree_class.hpp"

namespace mesher::detail {

template <int D>
void Quadtree<D>::check_invariants() const {
  check_below(0, Cell<D>{}, true);
  SAC_INVARIANT(free_.capacity() >= nodes_.size() / kChildren - 1);
  SAC_INVARIANT(free_buckets_.capacity() >= buckets_.size() - 1);
}

// `visible`: all cells above are open.
template <int D>
typename Quadtree<D>::Below Quadtree<D>::check_below(NodeIndex n, const Cell<D>& cell,
                                                     bool visible) const {
  const Node& node = nodes_[n];
  Below below;
  for (BucketIndex b = node.head; b != 0; b = buckets_[b].next) {
    const Bucket& bucket = buckets_[b];
    for (std::uint32_t i = bucket.count; i < kSlots; ++i) {
      SAC_INVARIANT(bucket.handle[i] == 0 && bucket.reach[i] == Reach<D>());
      SAC_INVARIANT(bucket.place[i] == filled<Point<D>>(kNowhere));
    }
    SAC_INVARIANT(bucket.count > 0 && (b == node.head || bucket.count == kSlots));
    for (std::uint32_t i = 0; i < bucket.count; ++i) {
      const Vertex<D>& v = vertices_[bucket.handle[i]];
      SAC_INVARIANT(v.self == bucket.handle[i] && v.p == bucket.place[i]);
      SAC_INVARIANT(bucket.reach[i].covers(v.reach));
      SAC_INVARIANT(MeshBox<D>::cell(box_.fixed(v.p), cell.level) == cell);
      below.add(offset(box_.lo, v.p), v.reach);
    }
  }
  SAC_INVARIANT(visible || node.head == 0);
  SAC_INVARIANT(node.child() != 0 || (!node.closed() && !node.wanted()));
  SAC_INVARIANT(node.child() != 0 || !visible || cell.level == kLevels || below.vertices <= kMany);
  if (node.child() != 0) {
    SAC_INVARIANT(node.closed() ? held(n) <= kFull : node.head == 0);
    bool wanted = node.marked();
    for (int c = 0; c < kChildren; ++c) {
      const NodeIndex child = node.child() + static_cast<NodeIndex>(c);
      SAC_INVARIANT(nodes_[child].parent() == n);
      wanted = wanted || nodes_[child].wanted();
      if (visible && !node.closed()) {
        SAC_INVARIANT(node.area.covers(nodes_[child].area.in_parent(c)));
      }
      below.add(check_below(child, child_cell(cell, c), visible && !node.closed()));
    }
    SAC_INVARIANT(node.wanted() == wanted && (wanted || below.vertices > kMany));
    SAC_INVARIANT(node.closed() || below.vertices > kFull || !visible);
  }
  if (visible && below.looks) check_area(node.area, cell, below);
  return below;
}

// It holds all that is looked at.
template <int D>
void Quadtree<D>::check_area(const Area<D>& area, const Cell<D>& cell, const Below& below) const {
  const double across = cells_across(cell.level);
  const double slack = margin_ * inverse_side_ * across;
  Point<D> lo, hi;
  for (int i = 0; i < D; ++i) {
    const double corner = std::ldexp(static_cast<double>(cell.corner[i]), -kLevels);
    lo[i] = (below.lo[i] - corner) * across;
    hi[i] = (below.hi[i] - corner) * across;
  }
  SAC_INVARIANT(area.contains(lo, slack) && area.contains(hi, slack));
}

template <int D>
template <class Visit>
void Quadtree<D>::for_each_leaf(Visit&& visit) const {
  leaves_below(0, Cell<D>{}, visit);
}

template <int D>
template <class Visit>
void Quadtree<D>::leaves_below(NodeIndex n, const Cell<D>& cell, Visit& visit) const {
  if (!nodes_[n].wanted()) return visit(cell);
  for (int c = 0; c < kChildren; ++c) {
    leaves_below(nodes_[n].child() + static_cast<NodeIndex>(c), child_cell(cell, c), visit);
  }
}

}  // namespace mesher::detail
