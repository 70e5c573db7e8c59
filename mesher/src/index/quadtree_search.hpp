// Searches in the quadtree: around a center in shells of doubling radius, and in a box.
#pragma once

#include <algorithm>
#include <array>
#include <bit>

#include "index/quadtree.hpp"

namespace mesher::detail {

// Depth first, nearest child first, within the shell.
template <int D>
template <class Enters, class Visit>
void Quadtree<D>::descend(const Step& from, const Search& search, Enters&& enters,
                          Visit&& visit) const {
  std::array<Step, (kLevels + 1) * (kChildren - 1) + 1> stack;
  std::size_t top = 0;
  stack[top++] = from;
  while (top > 0) {
    const Step s = stack[--top];
    if (!enters(s.rel, s.side)) continue;
    const NodeIndex child = nodes_[s.node].child;
    if (child == 0) {
      visit_leaf(s.node, visit);
      continue;
    }
    const double half = s.side / 2;
    // Per axis and half of the cell: squared distance to the near and to the far side.
    std::array<std::array<double, 2>, D> near2;
    std::array<std::array<double, 2>, D> far2;
    int nearest = 0;
    for (int i = 0; i < D; ++i) {
      const double low = s.rel[i];
      const double middle = low + half;
      const double high = middle + half;
      const auto square = [](double x) { return x * x; };
      near2[i] = {square(std::max(std::max(low, -middle), 0.0)),
                  square(std::max(std::max(middle, -high), 0.0))};
      far2[i] = {square(std::max(-low, middle)), square(std::max(-middle, high))};
      nearest |= (middle <= 0 ? 1 : 0) << i;
    }
    for (int k = kChildren - 1; k >= 0; --k) {
      const int c = nearest ^ k;
      double n2 = 0;
      double f2 = 0;
      for (int i = 0; i < D; ++i) n2 += near2[i][c >> i & 1], f2 += far2[i][c >> i & 1];
      if (n2 > search.outer * search.outer) continue;
      if (search.inner > 0 && f2 < search.inner * search.inner) continue;
      Step& t = stack[top++];
      t.node = child + static_cast<NodeIndex>(c);
      t.side = half;
      for (int i = 0; i < D; ++i) t.rel[i] = s.rel[i] + ((c >> i & 1) != 0 ? half : 0);
    }
  }
}

template <int D>
void Quadtree<D>::find_path(const Point<D>& center, Search& search) const {
  const Fixed<D> f = box_.fixed(center);
  Step s{0, {}, box_.side};
  for (int i = 0; i < D; ++i) s.rel[i] = box_.lo[i] - center[i];
  for (;; ++search.depth) {
    search.path[static_cast<std::size_t>(search.depth)] = s;
    const NodeIndex child = nodes_[s.node].child;
    if (child == 0) return;
    const int c = MeshBox<D>::child_of(f, search.depth);
    s.node = child + static_cast<NodeIndex>(c);
    s.side /= 2;
    for (int i = 0; i < D; ++i) s.rel[i] += (c >> i & 1) != 0 ? s.side : 0;
  }
}

// From the center's leaf up to the first cell that holds the whole shell, visiting siblings.
template <int D>
template <class Enters, class Visit>
void Quadtree<D>::visit_shell(const Search& search, Enters&& enters, Visit&& visit) const {
  descend(search.path[static_cast<std::size_t>(search.depth)], search, enters, visit);
  for (int depth = search.depth; depth > 0; --depth) {
    const Step& own = search.path[static_cast<std::size_t>(depth)];
    double inside = own.side;  // distance from the center to the cell's boundary
    for (int i = 0; i < D; ++i) inside = std::min({inside, -own.rel[i], own.rel[i] + own.side});
    if (inside >= search.outer) return;
    const Step& up = search.path[static_cast<std::size_t>(depth - 1)];
    const NodeIndex first = nodes_[up.node].child;
    const int c = static_cast<int>(own.node - first);
    for (int k = 1; k < kChildren; ++k) {
      const int other = c ^ k;
      Step t{first + static_cast<NodeIndex>(other), up.rel, own.side};
      for (int i = 0; i < D; ++i) t.rel[i] += (other >> i & 1) != 0 ? own.side : 0;
      if (in_shell(t, search)) descend(t, search, enters, visit);
    }
  }
}

template <int D>
template <class Radius, class Enters, class Visit>
void Quadtree<D>::visit_around(const Point<D>& center, Radius&& radius, Enters&& enters,
                               Visit&& visit) const {
  Search search;
  find_path(center, search);
  double bound = radius() + margin_;
  double shell = kFirstShell * search.path[static_cast<std::size_t>(search.depth)].side;
  for (;; shell *= 2) {
    search.outer = std::min(shell, bound);
    visit_shell(search, enters, [&](VertexHandle h, const Point<D>& p) {
      if (!visit(h, p)) return;
      bound = radius() + margin_;
      search.outer = std::min(search.outer, bound);
    });
    if (search.outer >= bound) return;
    search.inner = search.outer - margin_;
  }
}

// Down to the last cell that holds the whole box, then depth first.
template <int D>
template <class Enters, class Visit>
void Quadtree<D>::visit_box(const Point<D>& center, const Point<D>& lo, const Point<D>& hi,
                            Enters&& enters, Visit&& visit) const {
  std::array<Step, (kLevels + 1) * (kChildren - 1) + 1> stack;
  std::size_t top = 0;
  stack[top++] = {0, {}, box_.side};
  for (int i = 0; i < D; ++i) stack[0].rel[i] = box_.lo[i] - center[i];
  while (top > 0) {
    const Step s = stack[--top];
    const NodeIndex child = nodes_[s.node].child;
    if (child == 0) {
      if (enters(s.rel, s.side)) visit_leaf(s.node, visit);
      continue;
    }
    const double half = s.side / 2;
    unsigned meets = (1u << kChildren) - 1;  // a bit for each child
    for (int i = 0; i < D; ++i) {
      const double middle = s.rel[i] + half;
      if (hi[i] < middle - margin_) meets &= kLower[static_cast<std::size_t>(i)];
      if (lo[i] > middle + margin_) meets &= ~kLower[static_cast<std::size_t>(i)];
    }
    for (; meets != 0; meets &= meets - 1) {
      const int c = std::countr_zero(meets);
      Step& t = stack[top++];
      t = {child + static_cast<NodeIndex>(c), s.rel, half};
      for (int i = 0; i < D; ++i) t.rel[i] += (c >> i & 1) != 0 ? half : 0;
      expect(t.node);
    }
  }
}

}  // namespace mesher::detail
