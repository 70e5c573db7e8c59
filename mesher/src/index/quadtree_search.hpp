// Searches in the quadtree, in boxes.
#pragma once

#include <algorithm>
#include <array>
#include <bit>

#include "index/quadtree_class.hpp"

namespace mesher::detail {

// The last cell that holds both places, or the one that holds its vertices.
template <int D>
typename Quadtree<D>::Step Quadtree<D>::cell_around(const Fixed<D>& lo, const Fixed<D>& hi) const {
  const int common = MeshBox<D>::common_level(lo, hi);
  NodeIndex n = 0;
  int level = 0;
  for (; level < common && nodes_[n].open() != 0; ++level) {
    n = nodes_[n].open() + static_cast<NodeIndex>(MeshBox<D>::child_of(lo, level));
  }
  return {n, level, MeshBox<D>::cell(lo, level).corner};
}

// Where vertices lie is rounded to their finest cells as the box is, so that no margin is needed
// for what is in it; but the box itself is rounded, when it is moved to the center.
template <int D>
std::array<Fixed<D>, 2> Quadtree<D>::fixed_box(const Point<D>& center, const Box<D>& box) const {
  Point<D> low;
  Point<D> high;
  for (int i = 0; i < D; ++i) {
    low[i] = center[i] + box.lo[i] - margin_;
    high[i] = center[i] + box.hi[i] + margin_;
  }
  return {box_.fixed(low), box_.fixed(high)};
}

// Depth first.
template <int D>
template <class Enters, class Visit>
bool Quadtree<D>::visit_box(const Point<D>& center, const Box<D>& box, Looked& looked,
                            Enters&& enters, Visit&& visit, std::uint64_t most) const {
  const auto [lo, hi] = fixed_box(center, box);
  Stack stack;
  std::size_t top = 0;
  stack[top++] = cell_around(lo, hi);
  while (top > 0) {
    const Step s = stack[--top];
    const NodeIndex child = nodes_[s.node].open();
    const std::uint64_t size = std::uint64_t{1} << (kLevels - s.level);
    if (child == 0) {
      if (nodes_[s.node].head == 0 || looked.meets(s.corner, size)) continue;
      if (most-- == 0) return false;
      Point<D> rel;
      for (int i = 0; i < D; ++i) {
        rel[i] = box_.lo[i] + static_cast<double>(s.corner[i]) * unit_ - center[i];
      }
      if (!enters(rel, static_cast<double>(size) * unit_)) continue;
      for (BucketIndex b = nodes_[s.node].head; b != 0; b = buckets_[b].next) {
        visit(buckets_[b].handle, buckets_[b].place, buckets_[b].count);
        most -= std::min<std::uint64_t>(most, buckets_[b].count);
      }
      continue;
    }
    const std::uint64_t half = size / 2;
    unsigned meets = (1u << kChildren) - 1;  // a bit for each child
    for (int i = 0; i < D; ++i) {
      const std::uint64_t middle = s.corner[i] + half;
      if (hi[i] < middle) meets &= kLower[static_cast<std::size_t>(i)];
      if (lo[i] >= middle) meets &= ~kLower[static_cast<std::size_t>(i)];
    }
    for (; meets != 0; meets &= meets - 1) {
      const int c = std::countr_zero(meets);
      Step& t = stack[top++];
      t = {child + static_cast<NodeIndex>(c), s.level + 1, s.corner};
      for (int i = 0; i < D; ++i) t.corner[i] += (c >> i & 1) != 0 ? half : 0;
      expect(t.node);
    }
  }
  looked.lo = lo;
  looked.hi = hi;
  return true;
}

// Depth first as well, of the children the one nearest to the center first: what is met early makes
// what is asked about smaller, so that cells full of vertices far away are not entered at all.
template <int D>
template <class Enters, class Visit>
void Quadtree<D>::visit_outward(const Point<D>& center, const Box<D>& area, const Looked& looked,
                                Enters&& enters, Visit&& visit) const {
  const auto [lo, hi] = fixed_box(center, area);
  const Fixed<D> from = box_.fixed(center);
  Stack stack;
  std::size_t top = 0;
  stack[top++] = cell_around(lo, hi);
  while (top > 0) {
    const Step s = stack[--top];
    const NodeIndex child = nodes_[s.node].open();
    const std::uint64_t size = std::uint64_t{1} << (kLevels - s.level);
    if (child == 0 && (nodes_[s.node].head == 0 || looked.meets(s.corner, size))) continue;
    Point<D> rel;
    for (int i = 0; i < D; ++i) {
      rel[i] = box_.lo[i] + static_cast<double>(s.corner[i]) * unit_ - center[i];
    }
    if (!enters(rel, static_cast<double>(size) * unit_)) continue;
    if (child == 0) {
      for (BucketIndex b = nodes_[s.node].head; b != 0; b = buckets_[b].next) {
        visit(buckets_[b].handle, buckets_[b].place, buckets_[b].count);
      }
      continue;
    }
    const std::uint64_t half = size / 2;
    int nearest = 0;
    for (int i = 0; i < D; ++i) nearest |= static_cast<int>(from[i] >= s.corner[i] + half) << i;
    for (int far = kChildren - 1; far >= 0; --far) {
      const int c = nearest ^ far;
      Step& t = stack[top++];
      t = {child + static_cast<NodeIndex>(c), s.level + 1, s.corner};
      for (int i = 0; i < D; ++i) t.corner[i] += (c >> i & 1) != 0 ? half : 0;
    }
  }
}

}  // namespace mesher::detail
