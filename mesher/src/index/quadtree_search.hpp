// Searches in the quadtree, in boxes.
#pragma once

#include <algorithm>
#include <array>
#include <bit>

#include "index/quadtree.hpp"

namespace mesher::detail {

// The last cell that holds both places, or the one that holds its vertices.
template <int D>
typename Quadtree<D>::Step Quadtree<D>::cell_around(const Fixed<D>& lo, const Fixed<D>& hi) const {
  std::uint64_t differ = 1;
  for (int i = 0; i < D; ++i) differ |= lo[i] ^ hi[i];
  const int common = std::countl_zero(differ) - (64 - kLevels);  // levels at which they agree
  NodeIndex n = 0;
  int level = 0;
  for (; level < common && nodes_[n].open() != 0; ++level) {
    n = nodes_[n].open() + static_cast<NodeIndex>(MeshBox<D>::child_of(lo, level));
  }
  return {n, level, MeshBox<D>::cell(lo, level).corner};
}

// Depth first. Where vertices lie is rounded to their finest cells as the box is, so that no margin
// is needed for what is in it; but the box itself is rounded, when it is moved to the center.
template <int D>
template <class Enters, class Visit>
void Quadtree<D>::visit_box(const Point<D>& center, const Box<D>& box, Looked& looked,
                            Enters&& enters, Visit&& visit) const {
  Point<D> low;
  Point<D> high;
  for (int i = 0; i < D; ++i) {
    low[i] = center[i] + box.lo[i] - margin_;
    high[i] = center[i] + box.hi[i] + margin_;
  }
  const Fixed<D> lo = box_.fixed(low);
  const Fixed<D> hi = box_.fixed(high);
  std::array<Step, (kLevels + 1) * (kChildren - 1) + 1> stack;
  std::size_t top = 0;
  stack[top++] = cell_around(lo, hi);
  while (top > 0) {
    const Step s = stack[--top];
    const NodeIndex child = nodes_[s.node].open();
    const std::uint64_t size = std::uint64_t{1} << (kLevels - s.level);
    if (child == 0) {
      if (nodes_[s.node].head == 0 || looked.meets(s.corner, size)) continue;
      Point<D> rel;
      for (int i = 0; i < D; ++i) {
        rel[i] = box_.lo[i] + static_cast<double>(s.corner[i]) * unit_ - center[i];
      }
      if (!enters(rel, static_cast<double>(size) * unit_)) continue;
      for (BucketIndex b = nodes_[s.node].head; b != 0; b = buckets_[b].next) {
        visit(buckets_[b].handle, buckets_[b].place, buckets_[b].count);
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
}

}  // namespace mesher::detail
