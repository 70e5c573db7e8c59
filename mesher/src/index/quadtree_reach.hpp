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
  const Entry at = entry(n, v.self);
  float& own = buckets_[at.bucket].reach[at.i];
  own = std::max(own, v.reach);
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
float Quadtree<D>::reach_below(NodeIndex n, Point<D> rel, double side, const Point<D>& p,
                               Visit& visit) noexcept {
  const NodeIndex child = nodes_[n].open();
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
    const bool enter = d2 <= bound * bound;
    entered |= static_cast<unsigned>(enter) << c;
    reach = std::max(reach, enter ? 0 : nodes_[k].reach);
  }
  for (unsigned rest = entered; rest != 0; rest &= rest - 1) {
    expect(child + static_cast<NodeIndex>(std::countr_zero(rest)));
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
  for (BucketIndex b = nodes_[n].head; b != 0; b = buckets_[b].next) {
    Bucket& bucket = buckets_[b];
    expect_bucket(bucket.next);
    unsigned near = 0;  // a bit for each entry
    for (std::uint32_t i = 0; i < kSlots; ++i) {
      double d2 = 0;
      for (int k = 0; k < D; ++k) {
        d2 += (bucket.place[i][k] - p[k]) * (bucket.place[i][k] - p[k]);
      }
      const double bound = bucket.reach[i] * box_.side;
      near |= static_cast<unsigned>(d2 <= bound * bound) << i;
    }
    for (unsigned rest = near; rest != 0; rest &= rest - 1) {
      __builtin_prefetch(&vertices_[bucket.handle[std::countr_zero(rest)]].reach);
    }
    for (; near != 0; near &= near - 1) {
      const auto i = static_cast<std::uint32_t>(std::countr_zero(near));
      bucket.reach[i] = vertices_[bucket.handle[i]].reach;
      visit(vertices_[bucket.handle[i]], bucket.place[i]);
    }
    for (const float r : bucket.reach) reach = std::max(reach, r);
  }
  return reach;
}

// `lo`: the cell's lower corner.
template <int D>
template <class Visit>
void Quadtree<D>::reach_box_below(NodeIndex n, const Point<D>& lo, double side, const Box<D>& area,
                                  Visit& visit) const noexcept {
  const auto distance2 = [&](const Point<D>& corner, double width) {
    double d2 = 0;
    for (int i = 0; i < D; ++i) {
      const double d = std::max({area.lo[i] - corner[i] - width, corner[i] - area.hi[i], 0.0});
      d2 += d * d;
    }
    return d2;
  };
  const double bound = nodes_[n].reach * box_.side + margin_;
  if (distance2(lo, side) > bound * bound) return;
  const NodeIndex child = nodes_[n].open();
  if (child == 0) {
    for (BucketIndex b = nodes_[n].head; b != 0; b = buckets_[b].next) {
      for (const VertexHandle h : buckets_[b].handle) {
        if (h == 0) continue;
        const double own = vertices_[h].reach * box_.side;
        if (distance2(vertices_[h].p, 0) <= own * own) visit(vertices_[h]);
      }
    }
    return;
  }
  for (int c = 0; c < kChildren; ++c) {
    Point<D> corner = lo;
    for (int i = 0; i < D; ++i) corner[i] += (c >> i & 1) != 0 ? side / 2 : 0;
    reach_box_below(child + static_cast<NodeIndex>(c), corner, side / 2, area, visit);
  }
}

}  // namespace mesher::detail
