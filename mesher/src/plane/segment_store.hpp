// The segments of the input: found by their ends, at an end, and near a position.
//
// To be found by place, each live segment is covered by *tiles*: parts of it, each with a disc in a
// ReachTree. It starts as one tile; a search that meets the disc of a tile much longer than what it
// looks at, in vain, halves the tile. So tiles become as short as the searches beside them are, and
// a long segment is not looked at by all that goes on within its length. Answers do not depend on
// the tiling.
#pragma once

#include <tsl/robin_map.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <new>
#include <type_traits>
#include <vector>

#include "geometry/segment_tests.hpp"
#include "records/handle_table.hpp"
#include "records/reach_tree.hpp"
#include "records/segment.hpp"

namespace mesher::detail {

template <int D>
class SegmentStoreOf {
 public:
  using Segment = SegmentOf<D>;

  SegmentStoreOf(const MeshBox<D>& box, const VertexPool<D>& points)
      : box_(box),
        points_(points),
        by_ends_(*this),
        tiles_(1),
        trees_{ReachTree<TileHandle, D>(box), ReachTree<TileHandle, D>(box)} {}
  SegmentStoreOf(const SegmentStoreOf&) = delete;
  SegmentStoreOf& operator=(const SegmentStoreOf&) = delete;

  [[nodiscard]] const SegmentPoolOf<D>& pool() const noexcept { return pool_; }
  [[nodiscard]] Segment& operator[](SegmentHandle h) const noexcept { return pool_[h]; }
  /// How many segments there are, less those of freed records.
  [[nodiscard]] std::size_t live() const noexcept { return live_; }

  /// The live segment between two points, in either order; null if there is none. Cost: O(1).
  [[nodiscard]] const Segment* find(VertexHandle a, VertexHandle b) const;

  /// The record of the segment between two different points, in either order, made if there is
  /// none; it is freed by commit() unless it is live then. Throws: std::bad_alloc, and then changes
  /// nothing.
  [[nodiscard]] Segment& record(VertexHandle a, VertexHandle b);

  /// Makes s live; `bounds`: as a side of something else, through which it is found, too. Throws:
  /// std::bad_alloc, and then changes nothing. Cost: O(log L/s).
  void put(Segment& s, bool bounds = false);
  /// It is not only a side. Throws: std::bad_alloc, and then changes nothing. Cost: O(log L/s) for
  /// each of its tiles.
  void set_free(Segment& s);
  /// Requires: s is live. Cost: O(segments at its ends, and its tiles).
  void take(Segment& s) noexcept;

  /// Calls visit(segment) for the live segments at a point until it returns true (or for all, if it
  /// returns nothing); in no particular order. Returns whether it did.
  template <class Visit>
  bool visit_at(VertexHandle end, Visit&& visit) const;

  /// Calls visit(segment) for the live segments within `slack` of the segment pq (p = q: of the
  /// point), and some others, some of them repeatedly, until it returns true: it has found what it
  /// looks for. Returns whether it did. visit must not throw, nor search.
  template <class Visit>
  bool visit_near(const Point<D>& p, const Point<D>& q, double slack, Visit&& visit) noexcept;
  /// The same with the segments that are not only sides, within `reach` of p, but for those of
  /// which all is `outside`: outside(x, r) says so of the ball of radius r around x.
  template <class Outside, class Visit>
  bool visit_free_in(const Point<D>& p, double reach, Outside&& outside, Visit&& visit) noexcept;

  /// Visits the segments within `within` of p, and some others, some repeatedly, near ones first
  /// where that is easily told. `within` may become less meanwhile.
  template <class Visit>
  void visit_nearest(const Point<D>& p, const double& within, Visit&& visit) noexcept;

  /// How much searches, and visits to the segments at a point, have looked at so far.
  [[nodiscard]] std::uint64_t looked_at() const noexcept {
    return trees_[0].looked_at() + trees_[1].looked_at() + met_.count();
  }
  /// While it is held several threads may search at once: nothing is counted, and the tiling stays.
  void hold(bool held) noexcept {
    for (auto& tree : trees_) tree.hold(held);
    met_.hold(held);
  }

  /// Calls visit(segment) for those that have come or gone since the last commit, or that someone
  /// has noted.
  template <class Visit>
  void for_each_changed(Visit&& visit) const {
    for (SegmentHandle h = changed_; h != 0; h = pool_[h].next_changed) {
      visit(std::as_const(pool_[h]));
    }
  }
  void note_change(const Segment& s) noexcept { touch(pool_[s.self]); }
  /// How many have ever been among these.
  [[nodiscard]] std::uint64_t changes() const noexcept { return changes_; }
  /// Frees the records of segments that are not live.
  void commit() noexcept;

  [[nodiscard]] std::size_t bytes() const noexcept;
  /// Throws InvariantError if a list, a tile or a record is lost. Cost: O(tiles).
  void check_invariants() const;

 private:
  using TileHandle = std::uint32_t;  // 0: none
  struct Tile {
    SegmentHandle segment = 0;
    TileHandle next = 0;    // of the same segment; in a free one: the next free one
    double lo = 0, hi = 1;  // fractions of the segment
  };
  struct Ends {
    VertexHandle least, most;
    friend bool operator==(const Ends&, const Ends&) = default;
  };
  static Ends ends(VertexHandle a, VertexHandle b) noexcept {
    return {std::min(a, b), std::max(a, b)};
  }
  friend class HandleTable<SegmentStoreOf>;
  using Key = Ends;
  [[nodiscard]] Ends key(SegmentHandle h) const noexcept { return ends(pool_[h].a, pool_[h].b); }
  [[nodiscard]] static std::size_t hash(const Ends& e) noexcept {
    return sac::mix(std::uint64_t{e.least} << 32 | e.most);
  }

  // A tile is halved if it is longer than this times what a search looks at.
  static constexpr double kLong = 2;

  [[nodiscard]] SegmentHandle& link_at(Segment& s, VertexHandle end) const noexcept {
    return end == s.a ? s.next_at_a : s.next_at_b;
  }
  void touch(Segment& s) noexcept;
  void leave(Segment& s, VertexHandle end) noexcept;
  void drop_if_empty(VertexHandle end) noexcept;
  [[nodiscard]] Point<D> at(const Segment& s, double fraction) const noexcept;
  [[nodiscard]] Point<D> middle(const Tile& t) const noexcept {
    return at(pool_[t.segment], t.lo + (t.hi - t.lo) / 2);
  }
  [[nodiscard]] double length(const Tile& t) const noexcept {
    return pool_[t.segment].length * (t.hi - t.lo);
  }
  // Half the length, and what rounding of the middle may hide.
  [[nodiscard]] double reach(const Tile& t) const noexcept {
    return length(t) / 2 * (1 + 0x1p-40) + box_.side * 0x1p-48;
  }
  [[nodiscard]] ReachTree<TileHandle, D>& tree_of(const Segment& s) noexcept {
    return trees_[s.bounds ? 1 : 0];
  }
  [[nodiscard]] TileHandle new_tile(const Tile& tile);
  void free_tile(TileHandle t) noexcept;
  [[nodiscard]] bool is_needless(const Tile& t, const Point<D>& p, const Point<D>& q,
                                 double slack) const noexcept;
  void halve(TileHandle t);
  template <class Search, class Visit>
  bool visit_tiles(const Point<D>& p, const Point<D>& q, double slack, Search&& search,
                   Visit& visit) noexcept;

  const MeshBox<D>& box_;
  const VertexPool<D>& points_;
  SegmentPoolOf<D> pool_;
  HandleTable<SegmentStoreOf> by_ends_;
  tsl::robin_map<VertexHandle, SegmentHandle> at_;  // the first of those at a point
  std::vector<Tile> tiles_;
  std::array<ReachTree<TileHandle, D>, 2> trees_;  // of free ones; of sides
  TileHandle free_tiles_ = 0;
  SegmentHandle changed_ = 0;
  std::uint64_t changes_ = 0;
  std::size_t live_ = 0;
  mutable Tally met_;  // at points
};
using SegmentStore = SegmentStoreOf<2>;

template <int D>
template <class Visit>
bool SegmentStoreOf<D>::visit_at(VertexHandle end, Visit&& visit) const {
  const auto it = at_.find(end);
  if (it == at_.end()) return false;
  for (SegmentHandle h = it->second; h != 0;) {
    Segment& s = pool_[h];
    met_.add();
    h = link_at(s, end);
    if constexpr (std::is_void_v<decltype(visit(s))>) {
      visit(s);
    } else {
      if (visit(s)) return true;
    }
  }
  return false;
}

template <int D>
template <class Visit>
bool SegmentStoreOf<D>::visit_near(const Point<D>& p, const Point<D>& q, double slack,
                                   Visit&& visit) noexcept {
  const auto search = [&](auto&& take) {
    return trees_[0].visit_near(p, q, slack, take) || trees_[1].visit_near(p, q, slack, take);
  };
  return visit_tiles(p, q, slack, search, visit);
}

template <int D>
template <class Outside, class Visit>
bool SegmentStoreOf<D>::visit_free_in(const Point<D>& p, double reach, Outside&& outside,
                                      Visit&& visit) noexcept {
  const auto search = [&](auto&& take) { return trees_[0].visit_unless(outside, take); };
  return visit_tiles(p, p, reach, search, visit);
}

template <int D>
template <class Visit>
void SegmentStoreOf<D>::visit_nearest(const Point<D>& p, const double& within,
                                      Visit&& visit) noexcept {
  const auto search = [&](auto&& take) {
    for (const auto& tree : trees_) {
      tree.visit_nearest(p, within, [&](TileHandle t) { static_cast<void>(take(t)); });
    }
    return false;
  };
  const auto visit_one = [&](const Segment& s) { return visit(s), false; };
  visit_tiles(p, p, within, search, visit_one);
}

// search(take): what has been found of a search for what is within `slack` of pq.
template <int D>
template <class Search, class Visit>
bool SegmentStoreOf<D>::visit_tiles(const Point<D>& p, const Point<D>& q, double slack,
                                    Search&& search, Visit& visit) noexcept {
  std::array<TileHandle, 16> needless;
  std::size_t count = 0;
  const std::size_t most = met_.is_held() ? 0 : needless.size();
  const bool found = search([&](TileHandle t) {
    if (visit(pool_[tiles_[t].segment])) return true;
    if (count < most && is_needless(tiles_[t], p, q, slack)) needless[count++] = t;
    return false;
  });
  try {
    while (count > 0) halve(needless[--count]);
  } catch (const std::bad_alloc&) {  // the tiling stays as it is
  }
  return found;
}

}  // namespace mesher::detail
