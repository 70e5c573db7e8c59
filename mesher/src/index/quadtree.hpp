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
#include <bit>
#include <cmath>
#include <cstdint>
#include <new>
#include <utility>
#include <vector>

#include "geometry/grid.hpp"
#include "index/vertex.hpp"
#include "sac/check.hpp"
#include "sac/internal/huge_pages.hpp"

namespace mesher::detail {

/// Memory from the start of a cache line: what is aligned in it lies in as few lines as it can.
/// Large blocks are on huge pages, since searches read them at random places.
template <class T>
struct LineAllocator {
  using value_type = T;
  static constexpr std::size_t kHuge = std::size_t{2} << 20;

  LineAllocator() = default;
  template <class U>
  explicit LineAllocator(const LineAllocator<U>&) noexcept {}
  [[nodiscard]] T* allocate(std::size_t n) {
    const std::size_t bytes = n * sizeof(T);
    void* const block = ::operator new(bytes, alignment(bytes));
    if (bytes >= 2 * kHuge) sac::advise_huge_pages(block, bytes);
    return static_cast<T*>(block);
  }
  void deallocate(T* block, std::size_t n) noexcept {
    ::operator delete(block, alignment(n * sizeof(T)));
  }
  friend bool operator==(const LineAllocator&, const LineAllocator&) { return true; }

 private:
  static std::align_val_t alignment(std::size_t bytes) noexcept {
    return std::align_val_t(bytes >= 2 * kHuge ? kHuge : 64);
  }
};

template <int D>
class Quadtree {
 public:
  using NodeIndex = std::uint32_t;
  static constexpr int kChildren = 1 << D;

  Quadtree(const MeshBox<D>& box, VertexPool<D>& vertices) : box_(box), vertices_(vertices) {
    nodes_.resize(kChildren);  // the root; its siblings only keep the blocks of children aligned
    buckets_.resize(1);
  }

  /// Marks `cell` as split, with the cells above it given children as needed; returns its node.
  /// Requires: 0 <= cell.level < kLevels. Throws: std::bad_alloc, and then changes nothing.
  NodeIndex mark(const Cell<D>& cell);
  /// Takes the mark back and removes children that no mark needs. Requires: mark gave `node`.
  void unmark(NodeIndex node) noexcept;

  /// Puts a vertex into its leaf. Throws: std::bad_alloc, and then changes nothing. Cost: O(depth).
  void insert(Vertex<D>& v);
  /// Requires: insert(v) before.
  void erase(Vertex<D>& v) noexcept;
  /// The record with exactly these coordinates; null if there is none.
  [[nodiscard]] Vertex<D>* find(const Point<D>& p) const;

  /// Visits vertices u around `center`, by cells, in shells of doubling radius so that what bounds
  /// the search is met early: visit(handle, place) for every vertex within radius() of
  /// the center, a bound that may shrink while visiting (visit says true when it has), and for some
  /// beyond.
  /// A cell is only entered if enters(its lower corner relative to the center, its side).
  template <class Radius, class Enters, class Visit>
  void visit_around(const Point<D>& center, Radius&& radius, Enters&& enters, Visit&& visit) const;

  /// Visits vertices as visit_around does, in the leaves that meet the box [lo, hi] relative to the
  /// center: for searches that know where to look. visit(handle, place) for every vertex in a leaf
  /// that is entered; what it returns does not matter.
  template <class Enters, class Visit>
  void visit_box(const Point<D>& center, const Point<D>& lo, const Point<D>& hi, Enters&& enters,
                 Visit&& visit) const;

  /// Calls visit(v, |v - p|^2) for every vertex v with |v - p| <= v.reach (in units of the box's
  /// side), and tightens the cells' bounds. visit must not throw.
  template <class Visit>
  void visit_reaching(const Point<D>& p, Visit&& visit) noexcept {
    Point<D> rel;
    for (int i = 0; i < D; ++i) rel[i] = box_.lo[i] - p[i];
    reach_below(0, rel, box_.side, p, visit);
  }
  /// A query centred at `v` looks as far as v.reach: raises the bounds of the cells around it.
  void raise_reach(const Vertex<D>& v) noexcept;

  /// Throws InvariantError if a cell without a mark in it has children, a vertex lies in the wrong
  /// leaf, or a cell underestimates the reach of its vertices.
  void check_invariants() const;

  /// Calls visit(cell) for every leaf.
  template <class Visit>
  void for_each_leaf(Visit&& visit) const;

  /// How far a cell's computed sides may be off.
  [[nodiscard]] double margin() const noexcept { return margin_; }
  [[nodiscard]] std::size_t bytes() const noexcept {
    return nodes_.capacity() * sizeof(Node) + buckets_.capacity() * sizeof(Bucket);
  }

 private:
  struct Node {
    NodeIndex child = 0;  // first of kChildren; 0: a leaf
    NodeIndex parent_and_mark = 0;
    std::uint32_t head = 0;  // first bucket of a leaf
    float reach = 0;

    [[nodiscard]] NodeIndex parent() const noexcept { return parent_and_mark & 0x7fffffffu; }
    [[nodiscard]] bool marked() const noexcept { return parent_and_mark >> 31 != 0; }
  };
  // The first shell's radius, in sides of the center's leaf.
  static constexpr double kFirstShell = 2;

  struct Step {
    NodeIndex node;
    Point<D> rel;  // lower corner of the cell, relative to the center
    double side;
  };

  [[nodiscard]] NodeIndex leaf_of(const Fixed<D>& f, int* level = nullptr) const {
    NodeIndex n = 0;
    int depth = 0;
    for (; nodes_[n].child != 0; ++depth) n = nodes_[n].child + MeshBox<D>::child_of(f, depth);
    if (level != nullptr) *level = depth;
    return n;
  }
  void reserve_splits(std::size_t splits);
  void give_children(NodeIndex n, int level) noexcept;
  void take_children(NodeIndex n) noexcept;
  // For each axis the children in the lower half, a bit each.
  static constexpr std::array<unsigned, D> kLower = [] {
    std::array<unsigned, D> lower{};
    for (int c = 0; c < kChildren; ++c) {
      for (int i = 0; i < D; ++i)
        lower[static_cast<std::size_t>(i)] |= (c >> i & 1) == 0 ? 1u << c : 0;
    }
    return lower;
  }();
  static double distance2(const Point<D>& rel, double side) {
    double d2 = 0;
    for (int i = 0; i < D; ++i) {
      const double d = std::max(std::max(rel[i], -(rel[i] + side)), 0.0);
      d2 += d * d;
    }
    return d2;
  }
  static double farthest2(const Point<D>& rel, double side) {
    double d2 = 0;
    for (int i = 0; i < D; ++i) {
      const double d = std::max(-rel[i], rel[i] + side);
      d2 += d * d;
    }
    return d2;
  }
  // Where a search stands: the path of cells down to the center's leaf, and the shell.
  struct Search {
    std::array<Step, kLevels + 1> path;
    int depth = 0;
    double inner = -1;  // cells wholly nearer than this were visited before
    double outer = 0;   // cells beyond this wait for the next shell
  };
  static bool in_shell(const Step& s, const Search& search) {
    return distance2(s.rel, s.side) <= search.outer * search.outer &&
           (search.inner <= 0 || farthest2(s.rel, s.side) >= search.inner * search.inner);
  }
  void find_path(const Point<D>& center, Search& search) const;
  template <class Enters, class Visit>
  void visit_shell(const Search& search, Enters&& enters, Visit&& visit) const;
  template <class Enters, class Visit>
  void descend(const Step& from, const Search& search, Enters&& enters, Visit&& visit) const;
  // The vertices of a leaf, with their coordinates: a search that is not interested in a vertex
  // does not touch its record. Two cache lines in the plane.
  struct alignas(64) Bucket {
    std::uint32_t next = 0;  // further bucket of the same leaf; 0: none
    std::uint32_t count = 0;
    std::array<VertexHandle, 6> handle;
    std::array<Point<D>, 6> place;
  };
  using BucketIndex = std::uint32_t;

  // Asks memory for what is below a node that will be visited soon.
  void expect(NodeIndex n) const noexcept {
    if (nodes_[n].child != 0) {
      __builtin_prefetch(&nodes_[nodes_[n].child]);
    } else {
      const auto* bucket = reinterpret_cast<const std::byte*>(&buckets_[nodes_[n].head]);
      for (std::size_t at = 0; at < sizeof(Bucket); at += 64) __builtin_prefetch(bucket + at);
    }
  }
  template <class Visit>
  void visit_leaf(NodeIndex n, Visit&& visit) const {
    for (BucketIndex b = nodes_[n].head; b != 0; b = buckets_[b].next) {
      const Bucket& bucket = buckets_[b];
      for (std::uint32_t i = 0; i < bucket.count; ++i) visit(bucket.handle[i], bucket.place[i]);
    }
  }
  void reserve_buckets(std::size_t more);
  void put(NodeIndex leaf, VertexHandle h, const Point<D>& p) noexcept;
  [[nodiscard]] BucketIndex new_bucket(BucketIndex next) noexcept;
  // Squared distances along each axis from the origin to the near and the far half of a cell.
  using Halves = std::array<std::array<double, 2>, D>;
  static Halves near_halves(const Point<D>& rel, double half) {
    const auto square = [](double x) { return x * x; };
    Halves near2;
    for (int i = 0; i < D; ++i) {
      const double middle = rel[i] + half;
      near2[i] = {square(std::max(std::max(rel[i], -middle), 0.0)),
                  square(std::max(std::max(middle, -(middle + half)), 0.0))};
    }
    return near2;
  }
  template <class Visit>
  float reach_below(NodeIndex n, const Point<D>& rel, double side, const Point<D>& p,
                    Visit& visit) noexcept;
  template <class Visit>
  float reach_in_leaf(NodeIndex n, const Point<D>& p, Visit& visit) noexcept;
  static Cell<D> child_cell(const Cell<D>& cell, int c) {
    Cell<D> inner{cell.corner, cell.level + 1};
    for (int i = 0; i < D; ++i) {
      inner.corner[i] |= static_cast<std::uint64_t>(c >> i & 1) << (kLevels - inner.level);
    }
    return inner;
  }
  template <class Visit>
  void leaves_below(NodeIndex n, const Cell<D>& cell, Visit& visit) const;
  float check_below(NodeIndex n, const Cell<D>& cell) const;

  const MeshBox<D>& box_;
  VertexPool<D>& vertices_;
  std::vector<Node, LineAllocator<Node>> nodes_;
  std::vector<NodeIndex> free_;
  std::vector<Bucket, LineAllocator<Bucket>> buckets_;
  std::vector<BucketIndex> free_buckets_;
  // Cells are computed to within a few units in the last place of the largest coordinate.
  double margin_ = largest(box_) * 0x1p-50;

  static double largest(const MeshBox<D>& box) {
    double m = box.side;
    for (int i = 0; i < D; ++i) m = std::max({m, std::abs(box.lo[i]), std::abs(box.hi(i))});
    return m;
  }
};

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
