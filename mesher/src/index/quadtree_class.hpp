// The quadtree for finding vertices.
//
// The cells are those that BuildQT marks as split: a cell is *wanted* while it, or a cell inside
// it, is marked, and has children then. Answers do not depend on the subdivision, only their cost
// does, so the tree may be between two states while a propagation is under way: marks come only
// after the points that they are for, and many may come at once. So a cell also has children while
// more than kMany vertices lie in it. A cell with children is *open* while more than kFull vertices
// lie in it: these are in its children. Else it is *closed*: it keeps them itself, and who looks up
// goes no deeper. So the cells that a search meets hold a handful of vertices, however deep BuildQT
// splits. Each cell also knows the area in which the queries centred in it look, and each entry of
// a bucket a bound on how far its own do, to find the queries that a new vertex concerns.
//
// Here is what it offers and consists of; what it does is in quadtree_cells, _search, _reach,
// _check.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "geometry/grid.hpp"
#include "index/line_allocator.hpp"
#include "records/reach.hpp"
#include "records/vertex.hpp"
#include "sac/check.hpp"

namespace mesher::detail {

template <int D>
struct NearestFirst;

template <int D>
class Quadtree {
 public:
  using NodeIndex = std::uint32_t;
  static constexpr std::size_t kSlots = 5;
  using Handles = std::array<VertexHandle, kSlots>;
  using Places = std::array<Point<D>, kSlots>;
  static constexpr int kChildren = 1 << D;

  template <class Array>
  static constexpr Array filled(const typename Array::value_type& x) noexcept {
    Array all{};
    all.fill(x);
    return all;
  }

  Quadtree(const MeshBox<D>& box, VertexPool<D>& vertices) : box_(box), vertices_(vertices) {
    nodes_.resize(kChildren);  // the root; its siblings only keep the blocks of children aligned
    buckets_.resize(1);
  }

  /// Marks `cell` as split, with the cells above it given children as needed; returns its node.
  /// Requires: 0 <= cell.level < kLevels. Throws: std::bad_alloc, and then changes nothing.
  NodeIndex mark(const Cell<D>& cell);
  /// Takes the mark back and removes children that nothing needs. Requires: mark gave `node`.
  void unmark(NodeIndex node) noexcept;

  /// Puts a vertex into its leaf. Throws: std::bad_alloc, and then changes nothing. Cost: O(depth).
  void insert(Vertex<D>& v);
  /// Requires: insert(v) before.
  void erase(Vertex<D>& v) noexcept;
  /// The record with exactly these coordinates; null if there is none.
  [[nodiscard]] Vertex<D>* find(const Point<D>& p) const;

  /// Where a search has looked: nowhere, to begin with.
  class Looked {
    friend class Quadtree;
    Fixed<D> lo = filled<Fixed<D>>(~std::uint64_t{0});
    Fixed<D> hi{};
    [[nodiscard]] bool meets(const Fixed<D>& corner, std::uint64_t size) const noexcept {
      bool meets = true;
      for (int i = 0; i < D; ++i) meets = meets && corner[i] <= hi[i] && lo[i] < corner[i] + size;
      return meets;
    }
  };
  /// Visits vertices in a box, relative to `center`, by cells: visit(handles, places, count) for
  /// buckets of so many entries, in which every vertex in the box is and some beyond, but for those
  /// in cells where the search has looked before. The entries behind the count are 0, and nowhere
  /// near. `looked`: that was inside the box; now it is the box. A cell is only entered if
  /// enters(its lower corner relative to the center, its side). Returns true; false, with `looked`
  /// as it was, if it has come to an early end as there are more than `most` cells and vertices.
  template <class Enters, class Visit>
  bool visit_box(const Point<D>& center, const Box<D>& box, Looked& looked, Enters&& enters,
                 Visit&& visit, std::uint64_t most = ~std::uint64_t{0}) const;
  /// Visits buckets as visit_box, from the center outward, but for those of cells where the search
  /// has looked before: a cell is entered if enters() says so when its turn comes, after the visits
  /// to what is nearer. `area`: all that enters() is true of, relative to `center`.
  template <class Enters, class Visit>
  void visit_outward(const Point<D>& center, const Box<D>& area, const Looked& looked,
                     Enters&& enters, Visit&& visit) const;
  /// Calls visit(handle, place, |place - center|^2) for vertices in order of distance, as long as
  /// this is at most limit2(), which may become less. A cell is only entered if
  /// enters(its lower corner relative to the center, its side) when its turn comes.
  template <class Limit, class Enters, class Visit>
  void visit_nearest_first(const Point<D>& center, NearestFirst<D>& queue, Limit&& limit2,
                           Enters&& enters, Visit&& visit) const;
  /// The side of the cell that vertices at p are in.
  [[nodiscard]] double side_at(const Point<D>& p) const {
    int level = 0;
    static_cast<void>(leaf_of(box_.fixed(p), &level));
    return unit_ * static_cast<double>(std::uint64_t{1} << (kLevels - level));
  }

  /// Calls visit(v, p - v.p) for every vertex v with p in its reach, all in units of the box's
  /// side, and tightens the cells' areas. visit must not throw.
  template <class Visit>
  void visit_reaching(const Point<D>& p, Visit&& visit) noexcept {
    reach_below(0, offset(box_.lo, p), 1, p, visit);
  }
  /// Calls visit(v) for every vertex v that has a place of the box in its reach. visit must not
  /// throw.
  template <class Visit>
  void visit_reaching(const Box<D>& area, Visit&& visit) const noexcept {
    reach_box_below(0, {offset(box_.lo, area.lo), offset(box_.lo, area.hi)}, 1, area, visit);
  }
  /// Calls visit(v) for every vertex v from which something is at most `times` the farthest side of
  /// its reach away, and for some others. `beyond(x, r)`: only if it is farther than r from x;
  /// visit must not throw.
  template <class Beyond, class Visit>
  void visit_within(double times, Beyond&& beyond, Visit&& visit) const noexcept {
    within_below(0, box_.lo, box_.side, times, beyond, visit);
  }
  /// A query centred at `v` looks as far as v.reach: so do the cells around it.
  void raise_reach(const Vertex<D>& v) noexcept;

  /// Throws InvariantError if a cell has children without need or none in spite of one, a vertex
  /// lies in the wrong cell, or a cell underestimates the reach of its vertices.
  void check_invariants() const;

  /// Calls visit(cell) for every leaf of BuildQT's subdivision.
  template <class Visit>
  void for_each_leaf(Visit&& visit) const;

  /// How far a cell's computed sides may be off.
  [[nodiscard]] double margin() const noexcept { return margin_; }
  [[nodiscard]] std::size_t bytes() const noexcept {
    return nodes_.capacity() * sizeof(Node) + buckets_.capacity() * sizeof(Bucket);
  }

 private:
  static constexpr std::uint32_t kMarked = 0x80000000u;
  static constexpr std::uint32_t kWanted = 0x40000000u;
  struct alignas(32) Node {
    NodeIndex child_and_closed = 0;  // first of kChildren, 0: none
    NodeIndex parent_and_marks = 0;
    std::uint32_t head = 0;  // first bucket
    Area<D> area = {};

    [[nodiscard]] NodeIndex child() const noexcept { return child_and_closed & 0x7fffffffu; }
    [[nodiscard]] bool closed() const noexcept { return child_and_closed >> 31 != 0; }
    /// First child of an open cell; 0: the vertices are here.
    [[nodiscard]] NodeIndex open() const noexcept { return closed() ? 0 : child_and_closed; }
    void close() noexcept { child_and_closed |= 0x80000000u; }
    [[nodiscard]] NodeIndex parent() const noexcept { return parent_and_marks & 0x3fffffffu; }
    [[nodiscard]] bool marked() const noexcept { return (parent_and_marks & kMarked) != 0; }
    [[nodiscard]] bool wanted() const noexcept { return (parent_and_marks & kWanted) != 0; }
    void set(std::uint32_t flag, bool on) noexcept {
      parent_and_marks = on ? parent_and_marks | flag : parent_and_marks & ~flag;
    }
  };
  struct Step {
    NodeIndex node;
    int level;
    Fixed<D> corner;
  };
  [[nodiscard]] Step cell_around(const Fixed<D>& lo, const Fixed<D>& hi) const;
  [[nodiscard]] std::array<Fixed<D>, 2> fixed_box(const Point<D>& center, const Box<D>& box) const;
  using Stack = std::array<Step, (kLevels + 1) * (kChildren - 1) + 1>;
  // The cell that holds the vertices at f, and its level.
  [[nodiscard]] NodeIndex leaf_of(const Fixed<D>& f, int* level = nullptr) const {
    NodeIndex n = 0;
    int depth = 0;
    for (; nodes_[n].open() != 0; ++depth) n = nodes_[n].open() + MeshBox<D>::child_of(f, depth);
    if (level != nullptr) *level = depth;
    return n;
  }
  [[nodiscard]] int subdivided(const Fixed<D>& f) const;
  void find_way(const Point<D>& center, NearestFirst<D>& queue) const;
  [[nodiscard]] double beyond2(const Point<D>& rel, double side) const noexcept;
  [[nodiscard]] double within2(const Point<D>& rel, double side) const noexcept;
  static double distance2(const Point<D>& a, const Point<D>& b) noexcept {
    double d2 = 0;
    for (int i = 0; i < D; ++i) d2 += (a[i] - b[i]) * (a[i] - b[i]);
    return d2;
  }
  [[nodiscard]] Point<D> offset(const Point<D>& from, const Point<D>& to) const noexcept {
    Point<D> d;
    for (int i = 0; i < D; ++i) d[i] = (to[i] - from[i]) * inverse_side_;
    return d;
  }
  template <class T>
  static void make_room(std::vector<T, LineAllocator<T>>& records, std::size_t more);
  void reserve_splits(std::size_t splits);
  void give_children(NodeIndex n, int level) noexcept;
  void open_if_full(NodeIndex n, int level) noexcept;
  void spread(NodeIndex n, int level) noexcept;
  void raise_above(NodeIndex n) noexcept;
  void gather(NodeIndex n) noexcept;
  [[nodiscard]] bool shrink(NodeIndex n) noexcept;
  [[nodiscard]] bool any_child_wanted(NodeIndex n) const noexcept;
  [[nodiscard]] std::size_t held_below(NodeIndex n) const noexcept;
  // More vertices than this are looked at in the children, if there are any. Measured in space
  // (updates of uniform points): 20 take 4% fewer instructions than 8, which are as many as cells.
  static constexpr std::size_t kFull = D == 2 ? 8 : 20;
  // More than this ask for children.
  static constexpr std::size_t kMany = 32;
  static_assert(kFull <= kMany);
  // For each axis the children in the lower half, a bit each.
  static constexpr std::array<unsigned, D> kLower = [] {
    std::array<unsigned, D> lower{};
    for (int c = 0; c < kChildren; ++c) {
      for (int i = 0; i < D; ++i)
        lower[static_cast<std::size_t>(i)] |= (c >> i & 1) == 0 ? 1u << c : 0;
    }
    return lower;
  }();
  // The vertices of a leaf, with their coordinates: a search that is not interested in a vertex
  // does not touch its record. Two cache lines in the plane. Who reads all entries, used or not,
  // needs no branches, which could not be predicted.
  static constexpr double kNowhere = std::numeric_limits<double>::infinity();
  struct alignas(64) Bucket {
    std::uint32_t next = 0;  // further bucket of the same leaf; 0: none
    std::uint32_t count = 0;
    Handles handle{};
    std::array<Reach<D>, kSlots> reach{};  // a bound
    Places place = filled<Places>(filled<Point<D>>(kNowhere));

    void clear(std::uint32_t i) noexcept {
      handle[i] = 0;
      reach[i] = {};
      place[i] = filled<Point<D>>(kNowhere);
    }
  };
  using BucketIndex = std::uint32_t;

  // Asks memory for what is below a node that will be visited soon.
  void expect(NodeIndex n) const noexcept {
    if (nodes_[n].open() != 0) {
      __builtin_prefetch(&nodes_[nodes_[n].open()]);
    } else {
      expect_bucket(nodes_[n].head);
    }
  }
  void expect_bucket(BucketIndex b) const noexcept {
    const auto* bucket = reinterpret_cast<const std::byte*>(&buckets_[b]);
    for (std::size_t at = 0; at < sizeof(Bucket); at += 64) __builtin_prefetch(bucket + at);
  }
  template <class Visit>
  void visit_leaf(NodeIndex n, Visit&& visit) const {
    visit_entries(n, [&](const Bucket& bucket, std::uint32_t i) {
      visit(bucket.handle[i], bucket.place[i]);
    });
  }
  // Calls visit(bucket, i) for the entries of a leaf.
  template <class Visit>
  void visit_entries(NodeIndex n, Visit&& visit) const {
    for (BucketIndex b = nodes_[n].head; b != 0; b = buckets_[b].next) {
      const Bucket& bucket = buckets_[b];
      expect_bucket(bucket.next);
      for (std::uint32_t i = 0; i < bucket.count; ++i) visit(bucket, i);
    }
  }
  void reserve_buckets(std::size_t more);
  void put(NodeIndex leaf, const Bucket& from, std::uint32_t i) noexcept;
  // The entry of h in the leaf. Requires: it is there.
  struct Entry {
    BucketIndex bucket;
    std::uint32_t i;
  };
  [[nodiscard]] Entry entry(NodeIndex leaf, VertexHandle h) const noexcept;
  [[nodiscard]] std::size_t held(NodeIndex n) const noexcept;
  [[nodiscard]] BucketIndex new_bucket(BucketIndex next) noexcept;
  [[nodiscard]] static double cells_across(int level) noexcept {
    return static_cast<double>(std::uint64_t{1} << level);
  }
  [[nodiscard]] Point<D> within_cell(const Point<D>& p, int level) const noexcept;
  [[nodiscard]] Area<D> area_around(const Point<D>& p, Reach<D> reach, int level) const noexcept;
  template <class Beyond, class Visit>
  void within_below(NodeIndex n, const Point<D>& corner, double side, double times, Beyond& beyond,
                    Visit& visit) const noexcept;
  template <class Visit>
  void reach_box_below(NodeIndex n, const Box<D>& u, double across, const Box<D>& area,
                       Visit& visit) const noexcept;
  template <class Visit>
  void reach_below(NodeIndex n, const Point<D>& u, double across, const Point<D>& p,
                   Visit& visit) noexcept;
  template <class Visit>
  void reach_in_leaf(NodeIndex n, const Point<D>& u, double across, const Point<D>& p,
                     Visit& visit) noexcept;
  static Cell<D> child_cell(const Cell<D>& cell, int c) {
    Cell<D> inner{cell.corner, cell.level + 1};
    for (int i = 0; i < D; ++i) {
      inner.corner[i] |= static_cast<std::uint64_t>(c >> i & 1) << (kLevels - inner.level);
    }
    return inner;
  }
  template <class Visit>
  void leaves_below(NodeIndex n, const Cell<D>& cell, Visit& visit) const;
  // What is in a cell: how many vertices, and, if any looks somewhere, where, in the box's sides.
  struct Below {
    std::size_t vertices = 0;
    bool looks = false;
    Point<D> lo = filled<Point<D>>(kNowhere), hi = filled<Point<D>>(-kNowhere);

    void add(const Point<D>& at, const Reach<D>& reach) {
      ++vertices;
      if (reach == Reach<D>()) return;
      Below one{0, true, reach.box().lo, reach.box().hi};
      for (int i = 0; i < D; ++i) one.lo[i] += at[i], one.hi[i] += at[i];
      add(one);
    }
    void add(const Below& other) {
      vertices += other.vertices;
      looks = looks || other.looks;
      for (int i = 0; i < D; ++i) {
        lo[i] = std::min(lo[i], other.lo[i]);
        hi[i] = std::max(hi[i], other.hi[i]);
      }
    }
  };
  Below check_below(NodeIndex n, const Cell<D>& cell, bool visible) const;
  void check_area(const Area<D>& area, const Cell<D>& cell, const Below& below) const;

  const MeshBox<D>& box_;
  VertexPool<D>& vertices_;
  std::vector<Node, LineAllocator<Node>> nodes_;
  std::vector<NodeIndex> free_;
  std::vector<Bucket, LineAllocator<Bucket>> buckets_;
  std::vector<BucketIndex> free_buckets_;
  // Cells are computed to within a few units in the last place of the largest coordinate.
  double margin_ = largest(box_) * 0x1p-50;
  double unit_ = box_.cell_side(kLevels);
  double inverse_side_ = 1 / box_.side;

  static double largest(const MeshBox<D>& box) {
    double m = box.side;
    for (int i = 0; i < D; ++i) m = std::max({m, std::abs(box.lo[i]), std::abs(box.hi(i))});
    return m;
  }
};

}  // namespace mesher::detail
