// The input points in a tree of their own, and for each the deepest level at which it is crowded.
//
// A cell of level k is crowded for the point p in it if the block of 3^D cells of level k around it
// holds another point. K(p) is the deepest such level, -1 if there is none. Crowding is monotone
// [L 4.1.1]: p is crowded at every level up to K(p). So BuildQT makes one query per point: K(p).
//
// The tree splits a cell while it holds two points; a node is one 32-bit word (empty, one point, or
// a block of children). A walk from the root that keeps the 3^D nodes around a point finds K(p);
// the same walk around a point that comes or goes meets, each as a lone point in one of these
// nodes, exactly the points whose K may change:
//   if q changes K(f) at level k, f is alone in its cell of level k (else its companion crowds it
//   at k with or without q), hence a one-point node of the block around q.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/grid.hpp"
#include "records/tally.hpp"
#include "records/vertex.hpp"
#include "sac/check.hpp"

namespace mesher::detail {

template <int D>
class FeatureTree {
 public:
  FeatureTree(const MeshBox<D>& box, const VertexPool<D>& vertices)
      : box_(box), vertices_(vertices) {
    blocks_.push_back({});  // handle 0 is "empty"
  }

  /// The point that stands in the way of `p`: one in the same finest cell; null if there is none.
  [[nodiscard]] const Vertex<D>* obstacle(const Point<D>& p) const;

  /// Adds a point and updates K of all points. Calls changed(f) for each other point whose K
  /// changed. Requires: obstacle(v.p) == nullptr. Throws: std::bad_alloc, and then changes nothing.
  /// Cost: O(log L/s).
  template <class Changed>
  void insert(Vertex<D>& v, Changed&& changed);

  /// Takes a point out and updates K likewise. Requires: it is in. Cost: O(log L/s), and as much
  /// again for each point whose K changes.
  template <class Changed>
  void erase(Vertex<D>& v, Changed&& changed) noexcept;

  class Path;
  /// K(p) from the tree. Cost: O(K(p)); of points in Morton order O(1) as a rule, if nothing is
  /// inserted or erased meanwhile.
  [[nodiscard]] int crowded_level(const Vertex<D>& v) const { return crowded_level(v, path_); }
  /// The same; threads that ask at once have a path each, which is empty to begin with.
  [[nodiscard]] int crowded_level(const Vertex<D>& v, Path& path) const;

  /// One of the points that crowd a point at `p` at its deepest level, but not one at `p` itself:
  /// one in the same finest cell, if there is one; null if there is none. Cost: O(that level).
  [[nodiscard]] const Vertex<D>* crowder(const Point<D>& p) const;

  /// Adds a point without updating K: for many at once, each then asked for its crowded_level().
  /// Requires: obstacle(v.p) == nullptr.
  void insert_only(Vertex<D>& v) {
    const Vertex<D>* other = insert_unless(v);
    SAC_ENSURES(other == nullptr);
    static_cast<void>(other);
  }
  /// The same, unless there is an obstacle: returns it. Throws: std::bad_alloc, and then changes
  /// nothing.
  [[nodiscard]] const Vertex<D>* insert_unless(Vertex<D>& v);

  /// Calls visit(vertex) for the points in the closed box, until it returns true; returns whether
  /// it did. Points just outside may be visited, too. Cost: O(size of the tree in the box).
  template <class Visit>
  bool visit_in(const Box<D>& area, Visit&& visit) const;

  /// Puts w in the place of v, whose finest cell it shares. K of both is left as it is.
  void replace(const Vertex<D>& v, const Vertex<D>& w) noexcept;

  /// Throws InvariantError if a point lies in the wrong cell, a block holds fewer than two points,
  /// or blocks are lost. Cost: O(size of the tree).
  void check_invariants() const;

  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  /// Blocks and points that visit_in has looked at so far.
  [[nodiscard]] std::uint64_t looked_at() const noexcept { return looked_at_.count(); }
  /// While it is held several threads may visit_in() at once, and nothing is counted.
  void hold(bool held) noexcept { looked_at_.hold(held); }
  [[nodiscard]] std::size_t bytes() const noexcept {
    return blocks_.capacity() * sizeof(Block) + free_.capacity() * sizeof(std::uint32_t);
  }

 private:
  using Node = std::uint32_t;  // 0 empty; kPoint | vertex; block index
  static constexpr Node kPoint = 0x80000000u;
  static constexpr int kChildren = 1 << D;
  static constexpr int kBlock3 = [] {  // 3^D
    int cells = 1;
    for (int i = 0; i < D; ++i) cells *= 3;
    return cells;
  }();
  using Block = std::array<Node, kChildren>;
  using Around = std::array<Node, kBlock3>;

 public:
  /// The blocks around a place, by level, down to `deepest`; those of the cells that another place
  /// has in common with it are the same. Good until something is inserted or erased.
  class Path {
   public:
    void forget() noexcept { deepest_ = -1; }

   private:
    friend class FeatureTree;
    Fixed<D> at_{};
    int deepest_ = -1;  // -1: nothing
    std::array<Around, kLevels + 1> around_;
  };

 private:
  // Of the cells around one: in which of those around its parent each is, and as which child. By
  // the half of the parent, along each axis, that it is in.
  struct Descent {
    std::uint8_t parent, child;
  };
  static constexpr std::array<std::array<Descent, kBlock3>, kChildren> kBelow = [] {
    std::array<std::array<Descent, kBlock3>, kChildren> all{};
    for (int half = 0; half < kChildren; ++half) {
      for (int n = 0; n < kBlock3; ++n) {
        int parent = 0, child = 0;
        for (int i = 0, power = 1, rest = n; i < D; ++i, power *= 3, rest /= 3) {
          const int at = 2 + (half >> i & 1) + rest % 3 - 1;  // in halves, from a parent before
          parent += at / 2 * power;
          child |= (at & 1) << i;
        }
        all[half][n] = {static_cast<std::uint8_t>(parent), static_cast<std::uint8_t>(child)};
      }
    }
    return all;
  }();

  [[nodiscard]] Fixed<D> fixed_of(Node point) const {
    return box_.fixed(vertices_[point & ~kPoint].p);
  }
  struct Step {
    Node node;
    int level;
    Fixed<D> corner;
  };
  [[nodiscard]] Step cell_around(const Fixed<D>& lo, const Fixed<D>& hi) const;
  [[nodiscard]] bool inside(Node point, const std::array<std::int64_t, D>& cell, int level) const;
  [[nodiscard]] Around down(const Around& around, const Fixed<D>& f, int level) const;
  [[nodiscard]] Around start() const {
    Around a{};
    a[kBlock3 / 2] = root_;
    return a;
  }
  template <class Visit>
  void visit_isolated(const Fixed<D>& f, VertexHandle self, Visit&& visit) const;
  void reserve_blocks(std::size_t more);
  Node new_block() noexcept;
  struct Below {
    std::size_t points = 0, blocks = 0;
  };
  [[nodiscard]] Below check_below(Node node, const Cell<D>& cell) const;

  void forget_path() noexcept { path_.forget(); }

  const MeshBox<D>& box_;
  const VertexPool<D>& vertices_;
  mutable Path path_;  // of the last crowded_level()
  std::vector<Block> blocks_;
  std::vector<std::uint32_t> free_;
  Node root_ = 0;
  std::size_t size_ = 0;
  mutable Tally looked_at_;
};

template <int D>
bool FeatureTree<D>::inside(Node point, const std::array<std::int64_t, D>& cell, int level) const {
  const Fixed<D> f = fixed_of(point);
  for (int i = 0; i < D; ++i) {
    if (static_cast<std::int64_t>(f[i] >> (kLevels - level)) != cell[i]) return false;
  }
  return true;
}

// From the block of level `level` around f to that of the next level.
template <int D>
typename FeatureTree<D>::Around FeatureTree<D>::down(const Around& around, const Fixed<D>& f,
                                                     int level) const {
  Around next{};
  std::array<std::int64_t, D> own;
  std::size_t half = 0;  // of f, in its cell, a bit an axis
  for (std::size_t i = 0; i < D; ++i) {
    own[i] = static_cast<std::int64_t>(f[i] >> (kLevels - 1 - level));
    half |= static_cast<std::size_t>(own[i] & 1) << i;
  }
  for (std::size_t n = 0; n < kBlock3; ++n) {
    const Descent& below = kBelow[half][n];
    const Node above = around[below.parent];
    if (above == 0) continue;
    if ((above & kPoint) == 0) {
      next[n] = blocks_[above][below.child];
      continue;
    }
    std::array<std::int64_t, D> cell;
    for (std::size_t i = 0, rest = n; i < D; ++i, rest /= 3) {
      cell[i] = own[i] + static_cast<std::int64_t>(rest % 3) - 1;
    }
    if (inside(above, cell, level + 1)) next[n] = above;
  }
  return next;
}

template <int D>
int FeatureTree<D>::crowded_level(const Vertex<D>& v, Path& path) const {
  const Fixed<D> f = box_.fixed(v.p);
  int known = std::min(path.deepest_, MeshBox<D>::common_level(f, path.at_));
  if (known < 0) path.around_[0] = start(), known = 0;
  path.at_ = f;
  for (int level = 0;; ++level) {
    if (level > known) path.around_[level] = down(path.around_[level - 1], f, level - 1);
    path.deepest_ = std::max(known, level);
    const Around& around = path.around_[level];
    bool alone = around[kBlock3 / 2] == (kPoint | v.self);
    for (int n = 0; alone && n < kBlock3; ++n) alone = n == kBlock3 / 2 || around[n] == 0;
    if (alone) return level - 1;
    if (level == kLevels)
      return kLevels - 1;  // neighbours in the finest cells: cannot be told apart
  }
}

// Calls visit(f, level) for the lone points in the blocks around f, coarse to fine.
template <int D>
template <class Visit>
void FeatureTree<D>::visit_isolated(const Fixed<D>& f, VertexHandle self, Visit&& visit) const {
  Around around = start();
  for (int level = 0; level <= kLevels; ++level) {
    bool others = false;
    for (const Node n : around) {
      if (n == 0 || n == (kPoint | self)) continue;
      others = true;
      if ((n & kPoint) != 0) visit(n & ~kPoint, std::min(level, kLevels - 1));
    }
    if (!others || level == kLevels) return;
    around = down(around, f, level);
  }
}

template <int D>
const Vertex<D>* FeatureTree<D>::obstacle(const Point<D>& p) const {
  const Fixed<D> f = box_.fixed(p);
  Node node = root_;
  for (int level = 0; node != 0 && (node & kPoint) == 0; ++level) {
    node = blocks_[node][MeshBox<D>::child_of(f, level)];
  }
  if (node == 0) return nullptr;
  return fixed_of(node) == f ? &vertices_[node & ~kPoint] : nullptr;
}

template <int D>
const Vertex<D>* FeatureTree<D>::crowder(const Point<D>& p) const {
  const Vertex<D>* there = obstacle(p);
  if (there != nullptr && there->p != p) return there;
  const Node self = there == nullptr ? Node{0} : kPoint | there->self;
  const auto other_in = [self](const auto& nodes) {
    const auto it =
        std::find_if(nodes.begin(), nodes.end(), [self](Node n) { return n != 0 && n != self; });
    return it == nodes.end() ? Node{0} : *it;
  };
  const Fixed<D> f = box_.fixed(p);
  Around around = start();
  Node deepest = 0;
  for (int level = 0;; ++level) {
    const Node other = other_in(around);
    if (other == 0) break;
    deepest = other;
    if (level == kLevels) break;
    around = down(around, f, level);
  }
  if (deepest == 0) return nullptr;
  while ((deepest & kPoint) == 0) deepest = other_in(blocks_[deepest]);
  return &vertices_[deepest & ~kPoint];
}

// The last cell that holds both places, or the one that holds its point.
template <int D>
auto FeatureTree<D>::cell_around(const Fixed<D>& lo, const Fixed<D>& hi) const -> Step {
  const int common = MeshBox<D>::common_level(lo, hi);
  Node node = root_;
  int level = 0;
  for (; level < common && node != 0 && (node & kPoint) == 0; ++level) {
    node = blocks_[node][MeshBox<D>::child_of(lo, level)];
  }
  return {node, level, MeshBox<D>::cell(lo, level).corner};
}

template <int D>
template <class Visit>
bool FeatureTree<D>::visit_in(const Box<D>& area, Visit&& visit) const {
  const Fixed<D> lo = box_.fixed(area.lo), hi = box_.fixed(area.hi);
  std::array<Step, (kChildren - 1) * kLevels + 2> stack;
  std::size_t open = 0;
  stack[open++] = cell_around(lo, hi);
  const auto beside = [&](const Fixed<D>& corner, std::uint64_t last) {
    for (int i = 0; i < D; ++i) {
      if (corner[i] > hi[i] || corner[i] + last < lo[i]) return true;
    }
    return false;
  };
  while (open > 0) {
    const Step at = stack[--open];
    if (at.node == 0) continue;
    looked_at_.add();
    if ((at.node & kPoint) != 0) {
      if (!beside(fixed_of(at.node), 0) && visit(vertices_[at.node & ~kPoint])) return true;
      continue;
    }
    for (int c = 0; c < kChildren; ++c) {
      Step inner{blocks_[at.node][c], at.level + 1, at.corner};
      const std::uint64_t side = std::uint64_t{1} << (kLevels - inner.level);
      for (int i = 0; i < D; ++i) inner.corner[i] |= (c >> i & 1) != 0 ? side : 0;
      if (!beside(inner.corner, side - 1)) stack[open++] = inner;
    }
  }
  return false;
}

template <int D>
void FeatureTree<D>::replace(const Vertex<D>& v, const Vertex<D>& w) noexcept {
  const Fixed<D> f = box_.fixed(v.p);
  forget_path();
  Node* link = &root_;
  for (int level = 0; (*link & kPoint) == 0; ++level) {
    link = &blocks_[*link][MeshBox<D>::child_of(f, level)];
  }
  *link = kPoint | w.self;
}

// Room for so many blocks, and for all blocks to be freed: memory cannot run out on the way.
template <int D>
void FeatureTree<D>::reserve_blocks(std::size_t more) {
  const std::size_t blocks = blocks_.size() + more;
  if (blocks > blocks_.capacity()) blocks_.reserve(std::max(blocks, 2 * blocks_.capacity()));
  free_.reserve(blocks_.capacity());
}

// Requires: reserve_blocks.
template <int D>
typename FeatureTree<D>::Node FeatureTree<D>::new_block() noexcept {
  if (free_.empty()) {
    blocks_.push_back({});
    return static_cast<Node>(blocks_.size() - 1);
  }
  const Node b = free_.back();
  free_.pop_back();
  blocks_[b] = {};
  return b;
}

template <int D>
const Vertex<D>* FeatureTree<D>::insert_unless(Vertex<D>& v) {
  reserve_blocks(kLevels);
  forget_path();
  const Fixed<D> f = box_.fixed(v.p);
  Node block = 0;  // where the link to the current node is stored; 0: in root_
  int child = 0;
  const auto link = [&]() -> Node& { return block == 0 ? root_ : blocks_[block][child]; };
  int level = 0;
  while (link() != 0) {
    if ((link() & kPoint) != 0) {
      const Node other = link();
      if (fixed_of(other) == f) return &vertices_[other & ~kPoint];
      const Node fresh = new_block();
      blocks_[fresh][MeshBox<D>::child_of(fixed_of(other), level)] = other;
      link() = fresh;
    }
    block = link();
    child = MeshBox<D>::child_of(f, level++);
  }
  link() = kPoint | v.self;
  ++size_;
  return nullptr;
}

template <int D>
template <class Changed>
void FeatureTree<D>::insert(Vertex<D>& v, Changed&& changed) {
  insert_only(v);
  v.level = static_cast<std::int16_t>(crowded_level(v));
  visit_isolated(box_.fixed(v.p), v.self, [&](VertexHandle h, int level) {
    Vertex<D>& f = vertices_[h];
    if (f.level >= level) return;
    f.level = static_cast<std::int16_t>(level);
    changed(f);
  });
}

template <int D>
template <class Changed>
void FeatureTree<D>::erase(Vertex<D>& v, Changed&& changed) noexcept {
  const Fixed<D> f = box_.fixed(v.p);
  forget_path();
  std::array<VertexHandle, std::size_t{kBlock3} * (kLevels + 1)> affected;
  std::size_t count = 0;
  visit_isolated(f, v.self, [&](VertexHandle h, int level) {
    if (vertices_[h].level == level) affected[count++] = h;
  });
  std::array<Node, kLevels + 1> path{};
  int depth = 0;
  Node node = root_;
  for (; (node & kPoint) == 0; ++depth) {
    path[depth] = node;
    node = blocks_[node][MeshBox<D>::child_of(f, depth)];
  }
  Node rest = 0;  // what the parent's link becomes
  while (depth > 0) {
    --depth;
    Block& block = blocks_[path[depth]];
    block[MeshBox<D>::child_of(f, depth)] = rest;
    int children = 0;
    Node last = 0;
    for (const Node n : block) {
      if (n != 0) ++children, last = n;
    }
    if (children > 1 || (children == 1 && (last & kPoint) == 0)) {
      rest = root_;
      break;
    }
    free_.push_back(path[depth]);
    rest = last;
  }
  root_ = rest;
  --size_;
  for (const VertexHandle h : std::span(affected).first(count)) {
    Vertex<D>& other = vertices_[h];
    const int level = crowded_level(other);
    if (level == other.level) continue;
    other.level = static_cast<std::int16_t>(level);
    changed(other);
  }
}

template <int D>
void FeatureTree<D>::check_invariants() const {
  const Below all = check_below(root_, Cell<D>{});
  SAC_INVARIANT(all.points == size_);
  SAC_INVARIANT(all.blocks + free_.size() + 1 == blocks_.size());
  SAC_INVARIANT(free_.capacity() >= blocks_.size() - 1);
}

template <int D>
typename FeatureTree<D>::Below FeatureTree<D>::check_below(Node node, const Cell<D>& cell) const {
  if (node == 0) return {};
  if ((node & kPoint) != 0) {
    SAC_INVARIANT(vertices_[node & ~kPoint].self == (node & ~kPoint));
    SAC_INVARIANT(MeshBox<D>::cell(fixed_of(node), cell.level) == cell);
    return {1, 0};
  }
  Below below{0, 1};
  for (int c = 0; c < kChildren; ++c) {
    Cell<D> inner{cell.corner, cell.level + 1};
    for (int i = 0; i < D; ++i) {
      inner.corner[i] |= static_cast<std::uint64_t>(c >> i & 1) << (kLevels - inner.level);
    }
    const Below there = check_below(blocks_[node][c], inner);
    below = {below.points + there.points, below.blocks + there.blocks};
  }
  SAC_INVARIANT(below.points >= 2);
  return below;
}

}  // namespace mesher::detail
