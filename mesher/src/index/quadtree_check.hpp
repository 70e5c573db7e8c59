// All of the quadtree: its invariant, and its leaves.
#pragma once

#include <algorithm>

#include "index/quadtree.hpp"

namespace mesher::detail {

template <int D>
void Quadtree<D>::check_invariants() const {
  check_below(0, Cell<D>{});
  SAC_INVARIANT(free_.capacity() >= nodes_.size() / kChildren - 1);
  SAC_INVARIANT(free_buckets_.capacity() >= buckets_.size() - 1);
}

template <int D>
float Quadtree<D>::check_below(NodeIndex n, const Cell<D>& cell) const {
  float reach = 0;
  bool below = false;
  visit_leaf(n, [&](VertexHandle h, const Point<D>& p) {
    SAC_INVARIANT(vertices_[h].self == h && vertices_[h].p == p);
    SAC_INVARIANT(MeshBox<D>::cell(box_.fixed(p), cell.level) == cell);
    reach = std::max(reach, vertices_[h].reach);
  });
  if (nodes_[n].child != 0) {
    SAC_INVARIANT(nodes_[n].head == 0);
    for (int c = 0; c < kChildren; ++c) {
      const NodeIndex child = nodes_[n].child + static_cast<NodeIndex>(c);
      SAC_INVARIANT(nodes_[child].parent() == n);
      below = below || nodes_[child].child != 0;
      reach = std::max(reach, check_below(child, child_cell(cell, c)));
    }
  }
  SAC_INVARIANT(nodes_[n].reach >= reach);
  SAC_INVARIANT(nodes_[n].child == 0 || nodes_[n].marked() || below);
  SAC_INVARIANT(nodes_[n].child != 0 || !nodes_[n].marked());
  return reach;
}

template <int D>
template <class Visit>
void Quadtree<D>::for_each_leaf(Visit&& visit) const {
  leaves_below(0, Cell<D>{}, visit);
}

template <int D>
template <class Visit>
void Quadtree<D>::leaves_below(NodeIndex n, const Cell<D>& cell, Visit& visit) const {
  if (nodes_[n].child == 0) return visit(cell);
  for (int c = 0; c < kChildren; ++c) {
    leaves_below(nodes_[n].child + static_cast<NodeIndex>(c), child_cell(cell, c), visit);
  }
}

}  // namespace mesher::detail
