// Items with a position and a radius, i.e. discs, found by the objects that they meet.
//
// A trie over Morton cells. Each block keeps the largest reach below each of its four children, so
// a search enters only what may reach it; one large disc among small ones costs its own path.
// Blocks that would have one child are left out, and up to kMost items lie in a list, so that
// memory is linear in the items wherever they lie.
//
// It is an accelerator: a search visits all requested items and few others, in no particular order.
// The caller tests exactly, and sorts.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "geometry/grid.hpp"
#include "records/tally.hpp"
#include "sac/check.hpp"

namespace mesher::detail {

/// Distances from the segment pq (p = q: a point).
template <int D>
class FromSegment {
 public:
  static constexpr double kHalfDiagonal = D == 2 ? 0.7072 : 0.8661;  // of a unit cube, and more

  FromSegment(const Point<D>& p, const Point<D>& q) : p_(p) {
    for (int i = 0; i < D; ++i) along_[i] = q[i] - p[i];
    length2_ = squared(along_);
  }

  /// The distance of x, but for rounding.
  [[nodiscard]] double distance(const Point<D>& x) const noexcept {
    Point<D> from_p;
    double along = 0;
    for (int i = 0; i < D; ++i) {
      from_p[i] = x[i] - p_[i];
      along += from_p[i] * along_[i];
    }
    const double at = length2_ > 0 ? std::clamp(along / length2_, 0.0, 1.0) : 0;
    for (int i = 0; i < D; ++i) from_p[i] -= at * along_[i];
    return std::sqrt(squared(from_p));
  }
  /// At most the distance of the cube [lo, lo + side]^D.
  [[nodiscard]] double distance(const Point<D>& lo, double side) const noexcept {
    Point<D> x;
    if (length2_ > 0) {
      for (int i = 0; i < D; ++i) x[i] = lo[i] + side / 2;
      return distance(x) - kHalfDiagonal * side;
    }
    for (int i = 0; i < D; ++i) x[i] = std::max({lo[i] - p_[i], p_[i] - lo[i] - side, 0.0});
    return std::sqrt(squared(x));
  }

 private:
  static_assert(D == 2 || D == 3);

  static double squared(const Point<D>& x) noexcept {
    double sum = 0;
    for (int i = 0; i < D; ++i) sum += x[i] * x[i];
    return sum;
  }

  Point<D> p_, along_;
  double length2_;
};

template <class Item, int D = 2>
class ReachTree {
  static_assert(std::is_trivially_copyable_v<Item>);

 public:
  explicit ReachTree(const MeshBox<D>& box)
      : box_(box), unit_(box.cell_side(kLevels)), nodes_(1), entries_(1) {}

  /// Adds an item; others may have its place, and it may have others. Requires: reach >= 0, finite.
  /// Throws: std::bad_alloc, and then changes nothing. Cost: O(depth), at most kLevels.
  void insert(const Point<D>& place, double reach, const Item& item);

  /// Requires: the item was inserted with this place. Cost: O(depth, and items in its finest cell).
  void erase(const Point<D>& place, const Item& item) noexcept;

  /// Visits all items whose discs are within `slack` of the segment pq, and few others, until
  /// visit(item) returns true (or all, if it returns nothing). Returns whether it did.
  template <class Visit>
  bool visit_near(const Point<D>& p, const Point<D>& q, double slack, Visit&& visit) const {
    const FromSegment<D> segment(p, q);
    return visit_where(
        [&](const Point<D>& lo, double side, double reach) {
          return segment.distance(lo, side) <= slack + reach + margin();
        },
        [&](const Point<D>& x, double reach) {
          return segment.distance(x) <= slack + reach + margin();
        },
        visit);
  }
  /// The same for the items whose discs meet the point p.
  template <class Visit>
  bool visit_at(const Point<D>& p, Visit&& visit) const {
    return visit_near(p, p, 0, visit);
  }
  /// Visits all items whose discs are within `within` of p, and few others, those of near blocks
  /// first. `within` may become less meanwhile: what is farther then is left out.
  template <class Visit>
  void visit_nearest(const Point<D>& p, const double& within, Visit&& visit) const;
  /// As visit_near() for the items but those that lie outside: outside(x, r) says so of all of the
  /// ball of radius r around x.
  template <class Outside, class Visit>
  bool visit_unless(Outside&& outside, Visit&& visit) const {
    return visit_where(
        [&](const Point<D>& lo, double side, double reach) {
          Point<D> middle = lo;
          for (double& x : middle) x += side / 2;
          return !outside(middle, FromSegment<D>::kHalfDiagonal * side + reach + margin());
        },
        [&](const Point<D>& x, double reach) { return !outside(x, reach + margin()); }, visit);
  }
  /// The same for the items whose places (whatever they reach) lie in the closed box.
  template <class Visit>
  bool visit_in(const Box<D>& box, Visit&& visit) const {
    const auto meets = [&](const Point<D>& lo, double side) {
      for (int i = 0; i < D; ++i) {
        if (lo[i] > box.hi[i] + margin() || lo[i] + side < box.lo[i] - margin()) return false;
      }
      return true;
    };
    return visit_where([&](const Point<D>& lo, double side, double) { return meets(lo, side); },
                       [&](const Point<D>& x, double) { return meets(x, 0); }, visit);
  }
  /// The same for the items whose boxes around their discs meet the box.
  template <class Visit>
  bool visit_beside(const Box<D>& box, Visit&& visit) const {
    const auto meets = [&](const Point<D>& lo, double side, double reach) {
      const double r = reach + margin();
      for (int i = 0; i < D; ++i) {
        if (lo[i] - r > box.hi[i] || box.lo[i] > lo[i] + side + r) return false;
      }
      return true;
    };
    return visit_where(
        meets, [&](const Point<D>& x, double reach) { return meets(x, 0, reach); }, visit);
  }
  /// Visits all items.
  template <class Visit>
  bool visit_all(Visit&& visit) const {
    return visit_where([](const Point<D>&, double, double) { return true; },
                       [](const Point<D>&, double) { return true; }, visit);
  }

  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  /// Blocks and items that searches have looked at so far.
  [[nodiscard]] std::uint64_t looked_at() const noexcept { return looked_at_.count(); }
  /// While it is held several threads may search at once, and nothing is counted.
  void hold(bool held) noexcept { looked_at_.hold(held); }
  [[nodiscard]] std::size_t bytes() const noexcept {
    return nodes_.capacity() * sizeof(Node) + entries_.capacity() * sizeof(Entry);
  }
  /// Throws InvariantError if an item lies in the wrong block, a bound is not the largest reach, a
  /// list is too long, or something is lost. Cost: O(size).
  void check_invariants() const;

 private:
  static constexpr int kChildren = 1 << D;
  using Link = std::uint32_t;  // 0 nothing; kList | entry; node
  static constexpr Link kList = 0x80000000u;
  // Lists of up to so many items that do not share a finest cell; merged again at half as many.
  static constexpr std::uint32_t kMost = 6;

  struct Entry {
    Point<D> place{};
    Item item{};
    float reach = 0;
    Link next = 0;            // 0: the last; in a free one: the next free one
    std::uint32_t count = 0;  // of the first in a list: how long that is
  };
  struct Node {
    Fixed<D> corner{};
    std::array<Link, kChildren> child{};  // in a free one: [0] is the next free one
    std::array<float, kChildren> reach{};
    int level = 0;  // its children are of the next level
  };
  // Where a link is stored: in a node, or at the root (node 0).
  struct Slot {
    Link node = 0;
    int child = 0;
  };
  struct Path {
    std::array<Slot, kLevels + 1> slots{};
    int depth = 0;
    [[nodiscard]] const Slot& last() const noexcept { return slots[depth]; }
    void push(Slot s) noexcept { slots[++depth] = s; }
  };

  // Covers the rounding of coordinates in cells and of distances.
  [[nodiscard]] double margin() const noexcept { return box_.side * 0x1p-46; }
  [[nodiscard]] static float rounded_up(double reach) noexcept {
    const auto f = static_cast<float>(reach);
    return double{f} < reach ? std::nextafter(f, std::numeric_limits<float>::infinity()) : f;
  }
  // The level of the smallest cell that holds both.
  [[nodiscard]] static int common_level(const Fixed<D>& a, const Fixed<D>& b) noexcept {
    std::uint64_t differ = 0;
    for (int i = 0; i < D; ++i) differ |= a[i] ^ b[i];
    return kLevels - static_cast<int>(std::bit_width(differ));
  }
  [[nodiscard]] static bool is_list(Link link) noexcept { return (link & kList) != 0; }
  [[nodiscard]] static bool holds(const Node& n, const Fixed<D>& f) noexcept {
    return common_level(n.corner, f) >= n.level;
  }
  [[nodiscard]] Fixed<D> fixed_of(Link list) const noexcept {
    return box_.fixed(entries_[list & ~kList].place);
  }
  [[nodiscard]] Link& at(const Slot& s) noexcept { return nodes_[s.node].child[s.child]; }
  [[nodiscard]] Path descend(const Fixed<D>& f) const noexcept;
  [[nodiscard]] static float reach_of(const Node& n) noexcept {
    return *std::max_element(n.reach.begin(), n.reach.end());
  }
  [[nodiscard]] float reach_of(Link link) const noexcept;
  [[nodiscard]] std::uint32_t count_of(Link list) const noexcept {
    return list == 0 ? 0 : entries_[list & ~kList].count;
  }
  [[nodiscard]] int list_level(Link list) const noexcept;

  void make_room();
  [[nodiscard]] Link new_node(const Fixed<D>& f, int level) noexcept;
  [[nodiscard]] Link new_entry(const Point<D>& place, float reach, const Item& item) noexcept;
  void free_node(Link node) noexcept;
  void push_front(Link& list, Link entry) noexcept;
  void split(const Slot& s, int level) noexcept;
  void put_above(const Slot& s, int level, const Fixed<D>& f, Link entry) noexcept;
  void unlink(Link& list, const Point<D>& place, const Item& item) noexcept;
  [[nodiscard]] Link shrunk(Link node) noexcept;

  template <class Enter, class Take, class Visit>
  bool visit_where(Enter&& enter, Take&& take, Visit&& visit) const;
  template <class Visit>
  void visit_children(Link link, Visit&& visit) const;
  template <class Take, class Visit>
  bool visit_list(Link list, Take& take, Visit& visit) const;
  struct Below {
    std::size_t nodes = 0, entries = 0;
    float reach = 0;
  };
  [[nodiscard]] Below check_below(Link link, const Cell<D>& cell) const;
  [[nodiscard]] Below check_list(Link list, const Cell<D>& cell) const;

  const MeshBox<D>& box_;
  double unit_;              // the side of a finest cell
  std::vector<Node> nodes_;  // the first holds the root as its first child
  std::vector<Entry> entries_;
  Link free_nodes_ = 0;
  Link free_entries_ = 0;
  std::size_t size_ = 0;
  mutable Tally looked_at_;
};

// --- Searches --------------------------------------------------------------------------------

template <class Item, int D>
template <class Take, class Visit>
bool ReachTree<Item, D>::visit_list(Link list, Take& take, Visit& visit) const {
  for (Link e = list & ~kList; e != 0; e = entries_[e].next) {
    const Entry& entry = entries_[e];
    looked_at_.add();
    if (!take(entry.place, double{entry.reach})) continue;
    if constexpr (std::is_void_v<decltype(visit(entry.item))>) {
      visit(entry.item);
    } else {
      if (visit(entry.item)) return true;
    }
  }
  return false;
}

// A block on the way leaves all but one of its children behind on the stack.
template <class Item, int D>
template <class Enter, class Take, class Visit>
bool ReachTree<Item, D>::visit_where(Enter&& enter, Take&& take, Visit&& visit) const {
  std::array<Link, (kChildren - 1) * (kLevels + 1) + 1> stack;
  int top = 0;
  stack[top++] = nodes_[0].child[0];
  while (top > 0) {
    const Link link = stack[--top];
    if (is_list(link)) {
      if (visit_list(link, take, visit)) return true;
      continue;
    }
    if (link == 0) continue;
    visit_children(link, [&](const Point<D>& lo, double side, int c, const Node& n) {
      if (enter(lo, side, double{n.reach[c]})) stack[top++] = n.child[c];
    });
  }
  return false;
}

template <class Item, int D>
template <class Visit>
void ReachTree<Item, D>::visit_nearest(const Point<D>& p, const double& within,
                                       Visit&& visit) const {
  struct Block {
    double from;  // no disc in it is nearer
    Link link;
  };
  const FromSegment<D> here(p, p);
  std::array<Block, (kChildren - 1) * (kLevels + 1) + 1> stack;
  int top = 0;
  stack[top++] = {0, nodes_[0].child[0]};
  const auto take = [&](const Point<D>& x, double reach) {
    return here.distance(x) - reach - margin() <= within;
  };
  while (top > 0) {
    const Block block = stack[--top];
    if (block.link == 0 || block.from > within) continue;
    if (is_list(block.link)) {
      visit_list(block.link, take, visit);
      continue;
    }
    const int first = top;
    visit_children(block.link, [&](const Point<D>& lo, double side, int c, const Node& n) {
      const Block child{here.distance(lo, side) - n.reach[c] - margin(), n.child[c]};
      if (child.from > within) return;
      int i = top++;
      for (; i > first && stack[i - 1].from < child.from; --i) stack[i] = stack[i - 1];
      stack[i] = child;
    });
  }
}

/// Calls visit(lo, side, c, node) for the blocks of its children.
template <class Item, int D>
template <class Visit>
void ReachTree<Item, D>::visit_children(Link link, Visit&& visit) const {
  const Node& n = nodes_[link];
  looked_at_.add();
  const double side = unit_ * static_cast<double>(std::uint64_t{1} << (kLevels - 1 - n.level));
  for (int c = 0; c < kChildren; ++c) {
    if (n.child[c] == 0) continue;
    Point<D> lo;
    for (int i = 0; i < D; ++i) {
      lo[i] = box_.lo[i] + static_cast<double>(n.corner[i]) * unit_ + (c >> i & 1) * side;
    }
    visit(lo, side, c, n);
  }
}

// The slots from the root to the one in which a place belongs: it is empty, holds a list, or a node
// of which the place lies outside.
template <class Item, int D>
typename ReachTree<Item, D>::Path ReachTree<Item, D>::descend(const Fixed<D>& f) const noexcept {
  Path path;
  for (;;) {
    const Slot& s = path.last();
    const Link link = nodes_[s.node].child[s.child];
    if (link == 0 || is_list(link) || !holds(nodes_[link], f)) return path;
    path.push({link, MeshBox<D>::child_of(f, nodes_[link].level)});
  }
}

// --- Insertion -------------------------------------------------------------------------------

// Vectors grow by half; what is reserved here is all that an insertion takes.
template <class Item, int D>
void ReachTree<Item, D>::make_room() {
  const auto grow = [](auto& v, Link free) {
    if (free == 0 && v.size() == v.capacity()) v.reserve(v.size() + v.size() / 2 + 1);
  };
  grow(nodes_, free_nodes_);
  grow(entries_, free_entries_);
}

template <class Item, int D>
typename ReachTree<Item, D>::Link ReachTree<Item, D>::new_node(const Fixed<D>& f,
                                                               int level) noexcept {
  Link n = free_nodes_;
  if (n != 0) {
    free_nodes_ = nodes_[n].child[0];
  } else {
    n = static_cast<Link>(nodes_.size());
    nodes_.emplace_back();
  }
  nodes_[n] = Node{.corner = MeshBox<D>::cell(f, level).corner, .level = level};
  return n;
}

template <class Item, int D>
typename ReachTree<Item, D>::Link ReachTree<Item, D>::new_entry(const Point<D>& place, float reach,
                                                                const Item& item) noexcept {
  Link e = free_entries_;
  if (e != 0) {
    free_entries_ = entries_[e].next;
  } else {
    e = static_cast<Link>(entries_.size());
    entries_.emplace_back();
  }
  entries_[e] = Entry{place, item, reach};
  return e;
}

template <class Item, int D>
void ReachTree<Item, D>::push_front(Link& list, Link entry) noexcept {
  entries_[entry].count = count_of(list) + 1;
  entries_[entry].next = list & ~kList;
  list = kList | entry;
}

template <class Item, int D>
float ReachTree<Item, D>::reach_of(Link link) const noexcept {
  if (!is_list(link)) return link == 0 ? 0 : reach_of(nodes_[link]);
  float reach = 0;
  for (Link e = link & ~kList; e != 0; e = entries_[e].next) {
    reach = std::max(reach, entries_[e].reach);
  }
  return reach;
}

// The level of the smallest cell that holds the list.
template <class Item, int D>
int ReachTree<Item, D>::list_level(Link list) const noexcept {
  const Fixed<D> first = fixed_of(list);
  int level = kLevels;
  for (Link e = entries_[list & ~kList].next; e != 0; e = entries_[e].next) {
    level = std::min(level, common_level(first, fixed_of(e)));
  }
  return level;
}

// The list in the slot goes into lists below a node of this level.
template <class Item, int D>
void ReachTree<Item, D>::split(const Slot& s, int level) noexcept {
  const Link node = new_node(fixed_of(at(s)), level);
  for (Link e = at(s) & ~kList; e != 0;) {
    const Link next = entries_[e].next;
    const int c = MeshBox<D>::child_of(fixed_of(e), level);
    nodes_[node].reach[c] = std::max(nodes_[node].reach[c], entries_[e].reach);
    push_front(nodes_[node].child[c], e);
    e = next;
  }
  at(s) = node;
}

// What is in the slot, and beside it the entry, which is at `f`, go below a node of this level.
template <class Item, int D>
void ReachTree<Item, D>::put_above(const Slot& s, int level, const Fixed<D>& f,
                                   Link entry) noexcept {
  const Link old = at(s);
  const Fixed<D> corner = is_list(old) ? fixed_of(old) : nodes_[old].corner;
  const Link node = new_node(f, level);
  Node& n = nodes_[node];
  const int there = MeshBox<D>::child_of(corner, level);
  const int here = MeshBox<D>::child_of(f, level);
  n.child[there] = old;
  n.reach[there] = reach_of(old);
  n.reach[here] = entries_[entry].reach;
  push_front(n.child[here], entry);
  at(s) = node;
}

template <class Item, int D>
void ReachTree<Item, D>::insert(const Point<D>& place, double reach, const Item& item) {
  SAC_EXPECTS(reach >= 0);
  make_room();
  const Fixed<D> f = box_.fixed(place);
  const float up = rounded_up(reach);
  const Path path = descend(f);
  const Slot s = path.last();
  const Link old = at(s);
  const Link entry = new_entry(place, up, item);
  if (old != 0 && !is_list(old)) {
    put_above(s, common_level(nodes_[old].corner, f), f, entry);
  } else if (count_of(old) > kMost && fixed_of(old) != f) {  // a list so long is of one cell
    put_above(s, common_level(fixed_of(old), f), f, entry);
  } else {
    push_front(at(s), entry);
    const int level = count_of(at(s)) == kMost + 1 ? list_level(at(s)) : kLevels;
    if (level < kLevels) split(s, level);
  }
  for (int i = path.depth; i >= 0; --i) {
    float& bound = nodes_[path.slots[i].node].reach[path.slots[i].child];
    bound = std::max(bound, up);
  }
  ++size_;
}

// --- Removal ---------------------------------------------------------------------------------

template <class Item, int D>
void ReachTree<Item, D>::free_node(Link node) noexcept {
  nodes_[node].child[0] = std::exchange(free_nodes_, node);
}

template <class Item, int D>
void ReachTree<Item, D>::unlink(Link& list, const Point<D>& place, const Item& item) noexcept {
  const std::uint32_t left = count_of(list) - 1;
  Link before = 0;
  Link e = list & ~kList;
  const auto is_it = [&] { return entries_[e].item == item && entries_[e].place == place; };
  while (!is_it()) before = std::exchange(e, entries_[e].next);
  const Link next = entries_[e].next;
  if (before != 0) {
    entries_[before].next = next;
  } else {
    list = next == 0 ? 0 : kList | next;
  }
  if (list != 0) entries_[list & ~kList].count = left;
  entries_[e].next = std::exchange(free_entries_, e);
}

// What stands for a node that has lost an item: an only child, one list for few items, or itself.
template <class Item, int D>
typename ReachTree<Item, D>::Link ReachTree<Item, D>::shrunk(Link node) noexcept {
  const std::array<Link, kChildren> children = nodes_[node].child;
  Link only = 0;
  std::uint32_t count = 0;
  int used = 0;
  bool lists = true;
  for (const Link c : children) {
    if (c == 0) continue;
    ++used, only = c;
    lists = lists && is_list(c);
    count += is_list(c) ? count_of(c) : 0;
  }
  if (used > 1 && !(lists && count <= kMost / 2)) return node;
  free_node(node);
  if (used == 1) return only;
  Link merged = 0;
  for (const Link c : children) {
    for (Link e = c & ~kList; e != 0;) push_front(merged, std::exchange(e, entries_[e].next));
  }
  return merged;
}

template <class Item, int D>
void ReachTree<Item, D>::erase(const Point<D>& place, const Item& item) noexcept {
  const Path path = descend(box_.fixed(place));
  unlink(at(path.last()), place, item);
  for (int i = path.depth; i >= 0; --i) {
    Link& link = at(path.slots[i]);
    if (i < path.depth) link = shrunk(link);
    nodes_[path.slots[i].node].reach[path.slots[i].child] = reach_of(link);
  }
  --size_;
}

// --- Checks ----------------------------------------------------------------------------------

template <class Item, int D>
void ReachTree<Item, D>::check_invariants() const {
  const Below all = check_below(nodes_[0].child[0], Cell<D>{});
  SAC_INVARIANT(all.entries == size_ && all.reach == nodes_[0].reach[0]);
  std::size_t free = 0;
  for (Link n = free_nodes_; n != 0; n = nodes_[n].child[0]) ++free;
  SAC_INVARIANT(all.nodes + free + 1 == nodes_.size());
  free = 0;
  for (Link e = free_entries_; e != 0; e = entries_[e].next) ++free;
  SAC_INVARIANT(all.entries + free + 1 == entries_.size());
}

template <class Item, int D>
typename ReachTree<Item, D>::Below ReachTree<Item, D>::check_list(Link list,
                                                                  const Cell<D>& cell) const {
  Below below;
  for (Link e = list & ~kList; e != 0; e = entries_[e].next) {
    SAC_INVARIANT(MeshBox<D>::cell(fixed_of(e), cell.level) == cell);
    below.reach = std::max(below.reach, entries_[e].reach);
    ++below.entries;
  }
  SAC_INVARIANT(below.entries == count_of(list));
  SAC_INVARIANT(below.entries <= kMost || list_level(list) == kLevels);
  return below;
}

template <class Item, int D>
typename ReachTree<Item, D>::Below ReachTree<Item, D>::check_below(Link link,
                                                                   const Cell<D>& cell) const {
  if (link == 0) return {};
  if (is_list(link)) return check_list(link, cell);
  const Node& n = nodes_[link];
  SAC_INVARIANT(n.level >= cell.level && n.level < kLevels);
  SAC_INVARIANT(MeshBox<D>::cell(n.corner, cell.level) == cell);
  SAC_INVARIANT(MeshBox<D>::cell(n.corner, n.level).corner == n.corner);
  Below below{1, 0, 0};
  int used = 0;
  for (int c = 0; c < kChildren; ++c) {
    Cell<D> inner{n.corner, n.level + 1};
    for (int i = 0; i < D; ++i) {
      inner.corner[i] |= static_cast<std::uint64_t>(c >> i & 1) << (kLevels - inner.level);
    }
    const Below there = check_below(n.child[c], inner);
    SAC_INVARIANT(there.reach == n.reach[c]);
    used += n.child[c] != 0;
    below = {below.nodes + there.nodes, below.entries + there.entries,
             std::max(below.reach, there.reach)};
  }
  SAC_INVARIANT(used > 1);
  return below;
}

}  // namespace mesher::detail
