// The quadtree as a place to look vertices up.
//
// The cells are those that BuildQT marks as split; a leaf lists its vertices. Answers do not depend
// on the subdivision, only their cost does, so the tree may be between two states while a
// propagation is under way: a cell has children while it, or a cell inside it, is marked.
// Each cell also knows a bound on how far the queries centred in it look (`reach`), to find the
// queries that a new vertex concerns.
//
// Here is what it offers and consists of; what it does is in quadtree_cells, _search, _reach,
// _check.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "geometry/grid.hpp"
#include "index/line_allocator.hpp"
#include "index/vertex.hpp"
#include "sac/check.hpp"

namespace mesher::detail {

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

}  // namespace mesher::detail

#include "index/quadtree_cells.hpp"   // IWYU pragma: export
#include "index/quadtree_check.hpp"   // IWYU pragma: export
#include "index/quadtree_reach.hpp"   // IWYU pragma: export
#include "index/quadtree_search.hpp"  // IWYU pragma: export
