// The quadtree as a place to look vertices up.
//
// The cells are those that BuildQT marks as split; a leaf lists its vertices. Answers do not depend
// on the subdivision, only their cost does, so the tree may be between two states while a
// propagation is under way: a cell has children while it, or a cell inside it, is marked.
// Each cell also knows a bound on how far the queries centred in it look (`reach`), to find the
// queries that a new vertex concerns.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "grid.hpp"
#include "sac/check.hpp"
#include "vertex.hpp"

namespace mesher::detail {

template <int D>
class Quadtree {
 public:
  using NodeIndex = std::uint32_t;
  static constexpr int kChildren = 1 << D;

  Quadtree(const MeshBox<D>& box, VertexPool<D>& vertices) : box_(box), vertices_(vertices) {
    nodes_.resize(1);
  }

  /// Marks `cell` as split, with the cells above it given children as needed; returns its node.
  NodeIndex mark(const Cell<D>& cell);
  /// Takes the mark back and removes children that no mark needs.
  void unmark(NodeIndex node);
  [[nodiscard]] bool is_marked(NodeIndex n) const noexcept { return nodes_[n].marked(); }

  /// Puts a vertex into its leaf. Cost: O(depth).
  void insert(Vertex<D>& v);
  void erase(Vertex<D>& v);
  /// The record with exactly these coordinates; null if there is none.
  [[nodiscard]] Vertex<D>* find(const Point<D>& p) const;

  /// Visits vertices u around `center` near ones first, by cells: visit(u) for every u with
  /// |u - center|^2 <= radius2(), a bound that may shrink while visiting.
  template <class Radius2, class Visit>
  void visit_around(const Point<D>& center, Radius2&& radius2, Visit&& visit) const;

  /// Calls visit(v) for every vertex v with |v - p| <= v.reach (in units of the box's side), and tightens the cells' bounds.
  template <class Visit>
  void visit_reaching(const Point<D>& p, Visit&& visit) {
    reach_below(0, box_.lo, box_.side, p, visit);
  }
  /// A query centred at `v` looks as far as v.reach: raises the bounds of the cells around it.
  void raise_reach(const Vertex<D>& v);

  /// Throws InvariantError if a cell underestimates the reach of its vertices.
  void check_reach() const { check_reach_below(0, 0); }

  /// Calls visit(cell, vertices_in_it) for every leaf.
  template <class Visit>
  void for_each_leaf(Visit&& visit) const;

  [[nodiscard]] std::size_t bytes() const noexcept { return nodes_.capacity() * sizeof(Node); }

 private:
  struct Node {
    NodeIndex child = 0;  // first of kChildren; 0: a leaf
    NodeIndex parent_and_mark = 0;
    VertexHandle head = 0;
    float reach = 0;

    [[nodiscard]] NodeIndex parent() const noexcept { return parent_and_mark & 0x7fffffffu; }
    [[nodiscard]] bool marked() const noexcept { return parent_and_mark >> 31 != 0; }
  };
  struct Step {
    NodeIndex node;
    Point<D> rel;  // lower corner of the cell, relative to the center
    double side;
  };

  static int child_of(const Fixed<D>& f, int level) {
    int child = 0;
    for (int i = 0; i < D; ++i) child |= static_cast<int>(f[i] >> (kLevels - 1 - level) & 1) << i;
    return child;
  }
  [[nodiscard]] NodeIndex leaf_of(const Fixed<D>& f, int* level = nullptr) const {
    NodeIndex n = 0;
    int depth = 0;
    for (; nodes_[n].child != 0; ++depth) n = nodes_[n].child + child_of(f, depth);
    if (level != nullptr) *level = depth;
    return n;
  }
  void give_children(NodeIndex n, int level);
  void take_children(NodeIndex n);
  [[nodiscard]] double margin() const { return margin_; }
  static double distance2(const Point<D>& rel, double side) {
    double d2 = 0;
    for (int i = 0; i < D; ++i) {
      const double d = rel[i] > 0 ? rel[i] : rel[i] + side < 0 ? rel[i] + side : 0;
      d2 += d * d;
    }
    return d2;
  }
  template <class Radius2, class Visit>
  void descend(const Step& from, Radius2&& radius2, Visit&& visit) const;
  template <class Visit>
  void visit_leaf(NodeIndex n, Visit&& visit) const {
    for (VertexHandle h = nodes_[n].head; h != 0;) {
      Vertex<D>& v = vertices_[h];
      h = v.next;
      visit(v);
    }
  }
  template <class Visit>
  float reach_below(NodeIndex n, const Point<D>& lo, double side, const Point<D>& p, Visit& visit);
  template <class Visit>
  void leaves_below(NodeIndex n, const Cell<D>& cell, Visit& visit) const;
  float check_reach_below(NodeIndex n, int level) const;

  const MeshBox<D>& box_;
  VertexPool<D>& vertices_;
  std::vector<Node> nodes_;
  std::vector<NodeIndex> free_;
  // Cells are computed to within a few units in the last place of the largest coordinate.
  double margin_ = largest(box_) * 0x1p-50;

  static double largest(const MeshBox<D>& box) {
    double m = box.side;
    for (int i = 0; i < D; ++i) m = std::max({m, std::abs(box.lo[i]), std::abs(box.hi(i))});
    return m;
  }
};

template <int D>
void Quadtree<D>::give_children(NodeIndex n, int level) {
  NodeIndex first;
  if (free_.empty()) {
    first = static_cast<NodeIndex>(nodes_.size());
    nodes_.resize(nodes_.size() + kChildren);
  } else {
    first = free_.back();
    free_.pop_back();
  }
  for (int i = 0; i < kChildren; ++i) {
    nodes_[first + static_cast<NodeIndex>(i)] = Node{.parent_and_mark = n, .reach = nodes_[n].reach};
  }
  nodes_[n].child = first;
  for (VertexHandle h = std::exchange(nodes_[n].head, 0); h != 0;) {
    Vertex<D>& v = vertices_[h];
    h = v.next;
    Node& c = nodes_[first + static_cast<NodeIndex>(child_of(box_.fixed(v.p), level))];
    v.next = std::exchange(c.head, v.self);
  }
}

template <int D>
void Quadtree<D>::take_children(NodeIndex n) {
  const NodeIndex first = std::exchange(nodes_[n].child, 0);
  for (int i = 0; i < kChildren; ++i) {
    Node& c = nodes_[first + static_cast<NodeIndex>(i)];
    while (c.head != 0) {
      Vertex<D>& v = vertices_[c.head];
      c.head = std::exchange(v.next, nodes_[n].head);
      nodes_[n].head = v.self;
    }
  }
  free_.push_back(first);
}

template <int D>
typename Quadtree<D>::NodeIndex Quadtree<D>::mark(const Cell<D>& cell) {
  NodeIndex n = 0;
  for (int level = 0;; ++level) {
    if (nodes_[n].child == 0) give_children(n, level);
    if (level == cell.level) break;
    n = nodes_[n].child + static_cast<NodeIndex>(child_of(cell.corner, level));
  }
  nodes_[n].parent_and_mark |= 0x80000000u;
  return n;
}

template <int D>
void Quadtree<D>::unmark(NodeIndex n) {
  nodes_[n].parent_and_mark &= 0x7fffffffu;
  free_.reserve(free_.size() + 1);
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
  Node& leaf = nodes_[leaf_of(box_.fixed(v.p))];
  v.next = std::exchange(leaf.head, v.self);
}

template <int D>
void Quadtree<D>::erase(Vertex<D>& v) {
  VertexHandle* link = &nodes_[leaf_of(box_.fixed(v.p))].head;
  while (*link != v.self) link = &vertices_[*link].next;
  *link = v.next;
}

template <int D>
Vertex<D>* Quadtree<D>::find(const Point<D>& p) const {
  for (VertexHandle h = nodes_[leaf_of(box_.fixed(p))].head; h != 0; h = vertices_[h].next) {
    if (vertices_[h].p == p) return &vertices_[h];
  }
  return nullptr;
}

// Depth first, nearest child first.
template <int D>
template <class Radius2, class Visit>
void Quadtree<D>::descend(const Step& from, Radius2&& radius2, Visit&& visit) const {
  std::array<Step, (kLevels + 1) * (kChildren - 1) + 1> stack;
  std::size_t top = 0;
  stack[top++] = from;
  while (top > 0) {
    const Step s = stack[--top];
    const double d2 = distance2(s.rel, s.side) ;
    if (d2 > radius2()) continue;
    const NodeIndex child = nodes_[s.node].child;
    if (child == 0) {
      visit_leaf(s.node, visit);
      continue;
    }
    const double half = s.side / 2;
    int near = 0;
    for (int i = 0; i < D; ++i) near |= (s.rel[i] + half <= 0 ? 1 : 0) << i;
    for (int k = kChildren - 1; k >= 0; --k) {
      const int c = near ^ k;
      Step& t = stack[top++];
      t.node = child + static_cast<NodeIndex>(c);
      t.side = half;
      for (int i = 0; i < D; ++i) t.rel[i] = s.rel[i] + ((c >> i & 1) != 0 ? half : 0);
    }
  }
}

// Starts at the center's leaf and climbs until the ball lies inside the cell, visiting siblings.
template <int D>
template <class Radius2, class Visit>
void Quadtree<D>::visit_around(const Point<D>& center, Radius2&& radius2, Visit&& visit) const {
  const Fixed<D> f = box_.fixed(center);
  std::array<Step, kLevels + 1> path;
  Step s{0, {}, box_.side};
  for (int i = 0; i < D; ++i) s.rel[i] = box_.lo[i] - center[i];
  int depth = 0;
  for (;; ++depth) {
    path[static_cast<std::size_t>(depth)] = s;
    const NodeIndex child = nodes_[s.node].child;
    if (child == 0) break;
    const int c = child_of(f, depth);
    s.node = child + static_cast<NodeIndex>(c);
    s.side /= 2;
    for (int i = 0; i < D; ++i) s.rel[i] += (c >> i & 1) != 0 ? s.side : 0;
  }
  const auto padded = [&] {
    const double r = std::sqrt(radius2()) + margin_;
    return r * r;
  };
  double bound = padded();
  const auto bounded = [&] { return bound; };
  const auto visit_and_shrink = [&](Vertex<D>& v) {
    if (visit(v)) bound = padded();
  };
  visit_leaf(path[static_cast<std::size_t>(depth)].node, visit_and_shrink);
  for (; depth > 0; --depth) {
    const Step& own = path[static_cast<std::size_t>(depth)];
    double inner = own.side;  // distance from the center to the cell's boundary
    for (int i = 0; i < D; ++i) inner = std::min({inner, -own.rel[i], own.rel[i] + own.side});
    if (inner > 0 && inner * inner >= bound) return;
    const Step& up = path[static_cast<std::size_t>(depth - 1)];
    const NodeIndex first = nodes_[up.node].child;
    const int c = static_cast<int>(own.node - first);
    for (int k = 1; k < kChildren; ++k) {
      const int other = c ^ k;
      Step t{first + static_cast<NodeIndex>(other), up.rel, own.side};
      for (int i = 0; i < D; ++i) t.rel[i] += (other >> i & 1) != 0 ? own.side : 0;
      if (distance2(t.rel, t.side) <= bound) descend(t, bounded, visit_and_shrink);
    }
  }
}

template <int D>
void Quadtree<D>::raise_reach(const Vertex<D>& v) {
  NodeIndex n = leaf_of(box_.fixed(v.p));
  while (nodes_[n].reach < v.reach) {
    nodes_[n].reach = v.reach;
    if (n == 0) return;
    n = nodes_[n].parent();
  }
}

template <int D>
template <class Visit>
float Quadtree<D>::reach_below(NodeIndex n, const Point<D>& lo, double side, const Point<D>& p,
                               Visit& visit) {
  Point<D> rel;
  for (int i = 0; i < D; ++i) rel[i] = lo[i] - p[i];
  const double bound = nodes_[n].reach * box_.side + margin_;
  if (distance2(rel, side) > bound * bound) return nodes_[n].reach;
  float reach = 0;
  if (nodes_[n].child == 0) {
    visit_leaf(n, [&](Vertex<D>& v) {
      double d2 = 0;
      for (int i = 0; i < D; ++i) d2 += (v.p[i] - p[i]) * (v.p[i] - p[i]);
      const double own = v.reach * box_.side;
      if (d2 <= own * own) visit(v);
      reach = std::max(reach, v.reach);
    });
  } else {
    for (int c = 0; c < kChildren; ++c) {
      Point<D> corner = lo;
      for (int i = 0; i < D; ++i) corner[i] += (c >> i & 1) != 0 ? side / 2 : 0;
      reach = std::max(reach, reach_below(nodes_[n].child + static_cast<NodeIndex>(c), corner,
                                          side / 2, p, visit));
    }
  }
  return nodes_[n].reach = reach;
}

template <int D>
float Quadtree<D>::check_reach_below(NodeIndex n, int level) const {
  float reach = 0;
  bool below = false;
  visit_leaf(n, [&](const Vertex<D>& v) { reach = std::max(reach, v.reach); });
  if (nodes_[n].child != 0) {
    SAC_INVARIANT(nodes_[n].head == 0);
    for (int c = 0; c < kChildren; ++c) {
      const NodeIndex child = nodes_[n].child + static_cast<NodeIndex>(c);
      SAC_INVARIANT(nodes_[child].parent() == n);
      below = below || nodes_[child].child != 0;
      reach = std::max(reach, check_reach_below(child, level + 1));
    }
  }
  SAC_INVARIANT(nodes_[n].reach >= reach);
  SAC_INVARIANT(nodes_[n].child == 0 || nodes_[n].marked() || below);
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
  if (nodes_[n].child == 0) return visit(cell, nodes_[n].head);
  for (int c = 0; c < kChildren; ++c) {
    Cell<D> inner{cell.corner, cell.level + 1};
    for (int i = 0; i < D; ++i) {
      inner.corner[i] |= static_cast<std::uint64_t>(c >> i & 1) << (kLevels - inner.level);
    }
    leaves_below(nodes_[n].child + static_cast<NodeIndex>(c), inner, visit);
  }
}

}  // namespace mesher::detail
