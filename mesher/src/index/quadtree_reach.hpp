// Which vertices' queries reach a place: bounds in the cells, raised with a query and tightened
// with every visit.
#pragma once

#include <algorithm>
#include <bit>

#include "index/quadtree.hpp"

namespace mesher::detail {

template <int D>
void Quadtree<D>::raise_reach(const Vertex<D>& v) noexcept {
  NodeIndex n = leaf_of(box_.fixed(v.p));
  while (nodes_[n].reach < v.reach) {
    nodes_[n].reach = v.reach;
    if (n == 0) return;
    n = nodes_[n].parent();
  }
}

// `rel`: the cell's lower corner relative to p. Children are only entered if p is within reach of
// what is centred in them.
template <int D>
template <class Visit>
float Quadtree<D>::reach_below(NodeIndex n, const Point<D>& rel, double side, const Point<D>& p,
                               Visit& visit) noexcept {
  const NodeIndex child = nodes_[n].child;
  if (child == 0) return nodes_[n].reach = reach_in_leaf(n, p, visit);
  const double half = side / 2;
  const Halves near2 = near_halves(rel, half);
  float reach = 0;
  unsigned entered = 0;  // a bit for each child
  for (int c = 0; c < kChildren; ++c) {
    const NodeIndex k = child + static_cast<NodeIndex>(c);
    double d2 = 0;
    for (int i = 0; i < D; ++i) d2 += near2[i][c >> i & 1];
    const double bound = nodes_[k].reach * box_.side + margin_;
    if (d2 <= bound * bound) {
      entered |= 1u << c;
      expect(k);
    } else {
      reach = std::max(reach, nodes_[k].reach);
    }
  }
  for (; entered != 0; entered &= entered - 1) {
    const int c = std::countr_zero(entered);
    Point<D> corner = rel;
    for (int i = 0; i < D; ++i) corner[i] += (c >> i & 1) != 0 ? half : 0;
    const float below = reach_below(child + static_cast<NodeIndex>(c), corner, half, p, visit);
    reach = std::max(reach, below);
  }
  return nodes_[n].reach = reach;
}

template <int D>
template <class Visit>
float Quadtree<D>::reach_in_leaf(NodeIndex n, const Point<D>& p, Visit& visit) noexcept {
  float reach = 0;
  visit_leaf(n, [&](VertexHandle h, const Point<D>&) { __builtin_prefetch(&vertices_[h]); });
  visit_leaf(n, [&](VertexHandle h, const Point<D>& place) {
    Vertex<D>& v = vertices_[h];
    double d2 = 0;
    for (int i = 0; i < D; ++i) d2 += (place[i] - p[i]) * (place[i] - p[i]);
    const double own = v.reach * box_.side;
    if (d2 <= own * own) visit(v, d2);
    reach = std::max(reach, v.reach);
  });
  return reach;
}

}  // namespace mesher::detail
