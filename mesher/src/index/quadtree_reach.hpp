// Finds the vertices whose queries reach a position: each cell knows the area of the queries below
// it. It grows with a query and is tightened with every visit.
#pragma once

#include <algorithm>
#include <bit>

#include "index/quadtree_class.hpp"

namespace mesher::detail {

// Where p lies in its cell of `level`, in units of the cell's side.
template <int D>
Point<D> Quadtree<D>::within_cell(const Point<D>& p, int level) const noexcept {
  const Fixed<D> f = box_.fixed(p);
  Point<D> u;
  for (int i = 0; i < D; ++i) {
    u[i] = (p[i] - box_.lo[i]) / box_.side * cells_across(level) -
           static_cast<double>(f[i] >> (kLevels - level));
  }
  return u;
}

template <int D>
Area<D> Quadtree<D>::area_around(const Point<D>& p, Reach<D> reach, int level) const noexcept {
  return {within_cell(p, level), reach.box(), cells_across(level)};
}

template <int D>
void Quadtree<D>::raise_reach(const Vertex<D>& v) noexcept {
  const Fixed<D> f = box_.fixed(v.p);
  int level = 0;
  NodeIndex n = leaf_of(f, &level);
  const Entry at = entry(n, v.self);
  buckets_[at.bucket].reach[at.i] = v.reach;
  Area<D> area = area_around(v.p, v.reach, level);
  while (!nodes_[n].area.covers(area)) {
    nodes_[n].area.include(area);
    if (n == 0) return;
    n = nodes_[n].parent();
    area = area.in_parent(MeshBox<D>::child_of(f, --level));
  }
}

// `u`: p relative to the cell, in units of its side; `across`: as many of it are as long as the
// box's side.
template <int D>
template <class Visit>
void Quadtree<D>::reach_below(NodeIndex n, const Point<D>& u, double across, const Point<D>& p,
                              Visit& visit) noexcept {
  const NodeIndex child = nodes_[n].open();
  if (child == 0) return reach_in_leaf(n, u, across, p, visit);
  const auto u_in = [&](int c) {
    Point<D> inner;
    for (int i = 0; i < D; ++i) inner[i] = 2 * u[i] - (c >> i & 1);
    return inner;
  };
  const double slack = margin_ * inverse_side_ * 2 * across;
  unsigned entered = 0;  // a bit for each child
  for (int c = 0; c < kChildren; ++c) {
    const bool enter = nodes_[child + static_cast<NodeIndex>(c)].area.contains(u_in(c), slack);
    entered |= static_cast<unsigned>(enter) << c;
  }
  for (unsigned rest = entered; rest != 0; rest &= rest - 1) {
    expect(child + static_cast<NodeIndex>(std::countr_zero(rest)));
  }
  for (; entered != 0; entered &= entered - 1) {
    const int c = std::countr_zero(entered);
    reach_below(child + static_cast<NodeIndex>(c), u_in(c), 2 * across, p, visit);
  }
  Area<D> area;
  for (int c = 0; c < kChildren; ++c) {
    area.include(nodes_[child + static_cast<NodeIndex>(c)].area.in_parent(c));
  }
  nodes_[n].area = area;
}

template <int D>
template <class Visit>
void Quadtree<D>::reach_in_leaf(NodeIndex n, const Point<D>& u, double across, const Point<D>& p,
                                Visit& visit) noexcept {
  bool tightened = false;
  for (BucketIndex b = nodes_[n].head; b != 0; b = buckets_[b].next) {
    Bucket& bucket = buckets_[b];
    expect_bucket(bucket.next);
    unsigned near = 0;  // a bit for each entry
    for (std::uint32_t i = 0; i < kSlots; ++i) {
      const double most = bucket.reach[i].most() * box_.side;
      bool within = true;
      for (int k = 0; k < D; ++k) within &= std::abs(p[k] - bucket.place[i][k]) <= most;
      near |= static_cast<unsigned>(within) << i;
    }
    for (; near != 0; near &= near - 1) {
      const auto i = static_cast<std::uint32_t>(std::countr_zero(near));
      const Point<D> d = offset(bucket.place[i], p);
      if (!bucket.reach[i].contains(d)) continue;
      Vertex<D>& v = vertices_[bucket.handle[i]];
      tightened |= bucket.reach[i] != v.reach;
      bucket.reach[i] = v.reach;
      if (v.reach.contains(d)) visit(v, d);
    }
  }
  if (!tightened) return;
  Area<D> area;
  for (BucketIndex b = nodes_[n].head; b != 0; b = buckets_[b].next) {
    for (std::uint32_t i = 0; i < buckets_[b].count; ++i) {
      Point<D> place = offset(p, buckets_[b].place[i]);
      for (int k = 0; k < D; ++k) place[k] = u[k] + place[k] * across;
      area.include({place, buckets_[b].reach[i].box(), across});
    }
  }
  nodes_[n].area = area;
}

// `u`: the area relative to the cell, in units of its side.
template <int D>
template <class Visit>
void Quadtree<D>::reach_box_below(NodeIndex n, const Box<D>& u, double across, const Box<D>& area,
                                  Visit& visit) const noexcept {
  if (!nodes_[n].area.meets(u, margin_ * inverse_side_ * across)) return;
  const NodeIndex child = nodes_[n].open();
  if (child == 0) {
    visit_leaf(n, [&](VertexHandle h, const Point<D>& place) {
      const Box<D> around{offset(place, area.lo), offset(place, area.hi)};
      if (vertices_[h].reach.meets(around)) visit(vertices_[h]);
    });
    return;
  }
  for (int c = 0; c < kChildren; ++c) {
    Box<D> inner;
    for (int i = 0; i < D; ++i) {
      inner.lo[i] = 2 * u.lo[i] - (c >> i & 1);
      inner.hi[i] = 2 * u.hi[i] - (c >> i & 1);
    }
    reach_box_below(child + static_cast<NodeIndex>(c), inner, 2 * across, area, visit);
  }
}

template <int D>
template <class Beyond, class Visit>
void Quadtree<D>::within_below(NodeIndex n, const Point<D>& corner, double side, double times,
                               Beyond& beyond, Visit& visit) const noexcept {
  Point<D> middle = corner;
  for (double& x : middle) x += side / 2;
  const double half = std::sqrt(double{D}) / 2 * side + margin_;
  if (beyond(middle, half + times * nodes_[n].area.farthest() * side)) return;
  const NodeIndex child = nodes_[n].open();
  if (child == 0) {
    visit_entries(n, [&](const Bucket& bucket, std::uint32_t i) {
      const double most = times * bucket.reach[i].most() * box_.side;
      if (!beyond(bucket.place[i], most)) visit(vertices_[bucket.handle[i]]);
    });
    return;
  }
  for (int c = 0; c < kChildren; ++c) {
    Point<D> inner = corner;
    for (int i = 0; i < D; ++i) inner[i] += (c >> i & 1) * (side / 2);
    within_below(child + static_cast<NodeIndex>(c), inner, side / 2, times, beyond, visit);
  }
}

}  // namespace mesher::detail
