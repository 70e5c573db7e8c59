// The edges of a polygon, or the features on it, in the plane of its frame: a tree of boxes, to
// find edges near a position and to test whether it is inside.
//
// Edges come in chains: each of a chain begins where the one before it ends; a loop is a chain that
// ends where it begins. A node has edges that follow each other in one chain, or some whole chains,
// and a box turned as most of their length is: so combs and grids of any direction have boxes that
// do not overlap much.
//
//   near     a node is looked into if its box, some wider, may have what is asked for;
//   around   whether a ray from x to the right crosses an odd number of edges. What is in a box
//   that
//            x is clear of crosses it as often, but for an even number, as the straight line from
//            the chain's beginning to its end does; so only boxes that x is in are looked into.
//
// Both are shortcuts and nothing else: what they find is what looking at all edges finds, bit for
// bit. For that the box of (around) is wider by more than rounding can turn the side of an edge
// that x is on: with x between the ends' heights, and h beside the edge, the exact side is h times
// the difference of these heights, and its error at most 14 2^-53 times that times the edge's
// length; so h of 2^-48 of the coordinates is enough, and kSlack of them is four times as much.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "mesher/mesh.hpp"

namespace mesher::detail {

/// Whether the ray from x to the right crosses ab, which is half open: its upper end is not part.
[[nodiscard]] inline bool is_crossed(const Point<2>& x, const Point<2>& a, const Point<2>& b) {
  if ((a[1] > x[1]) == (b[1] > x[1])) return false;
  if (x[0] < std::min(a[0], b[0])) return true;
  if (x[0] > std::max(a[0], b[0])) return false;
  const double left = (b[0] - a[0]) * (x[1] - a[1]) - (b[1] - a[1]) * (x[0] - a[0]);
  return (left > 0) == (b[1] > a[1]);
}

class EdgeTree {
 public:
  using Ends = std::array<Point<2>, 2>;
  /// Coordinates and distances in the frame may be off by this, times what they are made of.
  static constexpr double kSlack = 0x1p-46;

  /// `chain_end`: the number of edges up to the end of each chain, ascending.
  /// Cost: O(edges log edges); of up to kLeaf edges nothing is kept but their number.
  void build(const std::vector<Ends>& edges, const std::vector<std::uint32_t>& chain_end);

  /// Something not far from x: at least `above` away from it across the plane, at most `below`.
  struct Place {
    Point<2> x{};
    double slack = 0;  // how far places of the frame may be off
    double above = 0, below = 0;
  };
  /// Calls visit(i) for the edges that may be within sqrt(most2) of a place, nearer ones first
  /// where that is easily told, until it returns true; returns whether it did. `most2` may become
  /// less meanwhile. Cost: O(log edges), and what is as near, where boxes do not overlap much.
  template <class Visit>
  bool visit_near(const Place& place, const double& most2, Visit&& visit) const;
  /// Likewise for the edges that may have a place at this distance.
  template <class Visit>
  bool visit_at(const Place& place, double distance, Visit&& visit) const;
  /// Whether an odd number of the edges that count are crossed by the ray from x to the right. All
  /// of a chain counts, or nothing. `ends_of(i)`: of the i-th edge. Requires: chains are loops.
  template <class EndsOf, class Counts>
  [[nodiscard]] bool is_around(const Point<2>& x, EndsOf&& ends_of, Counts&& counts) const;

  /// Of all coordinates, the largest magnitude.
  [[nodiscard]] double extent() const noexcept { return extent_; }
  /// From now on edges and boxes that are looked at are counted there.
  void count_in(std::uint64_t& looked_at) noexcept { looked_at_ = &looked_at; }
  [[nodiscard]] std::size_t bytes() const noexcept {
    return nodes_.capacity() * sizeof(nodes_[0]) + items_.capacity() * sizeof(items_[0]);
  }

 private:
  static constexpr std::uint32_t kLeaf = 8;  // edges

  // The first of two children follows its parent. `axis`: where the box's first side leads.
  struct Node {
    Point<2> axis{1, 0}, lo{}, hi{};
    std::uint32_t begin = 0, end = 0;  // in items_
    std::uint32_t second = 0;          // child; 0: none
    bool in_chain = false;             // all of one chain

    [[nodiscard]] Point<2> local(const Point<2>& x) const noexcept {
      return {axis[0] * x[0] + axis[1] * x[1], axis[0] * x[1] - axis[1] * x[0]};
    }
    [[nodiscard]] double nearest2(const Place& place) const noexcept {
      const Point<2> at = local(place.x);
      double sum = place.above * place.above;
      for (std::size_t i = 0; i < 2; ++i) {
        const double d = std::max(std::max(lo[i] - at[i], at[i] - hi[i]) - place.slack, 0.0);
        sum += d * d;
      }
      return sum * (1 - 0x1p-40);
    }
    [[nodiscard]] double farthest2(const Place& place) const noexcept {
      const Point<2> at = local(place.x);
      double sum = place.below * place.below;
      for (std::size_t i = 0; i < 2; ++i) {
        const double d = std::max(at[i] - lo[i], hi[i] - at[i]) + place.slack;
        sum += d * d;
      }
      return sum * (1 + 0x1p-40);
    }
    [[nodiscard]] bool is_clear_of(const Point<2>& x, double slack) const noexcept {
      const Point<2> at = local(x);
      return at[0] < lo[0] - slack || at[0] > hi[0] + slack || at[1] < lo[1] - slack ||
             at[1] > hi[1] + slack;
    }
  };
  class Builder;

  void count_one() const noexcept {
    if (looked_at_ != nullptr) ++*looked_at_;
  }
  template <class Visit>
  bool visit_items(const Node& node, Visit& visit) const;
  template <class Visit>
  bool near_below(std::uint32_t n, double bound, const Place& place, const double& most2,
                  Visit& visit) const;
  template <class Visit>
  bool at_below(std::uint32_t n, const Place& place, double distance, Visit& visit) const;
  template <class EndsOf, class Counts>
  bool around_below(std::uint32_t n, const Point<2>& x, double slack, EndsOf& ends_of,
                    Counts& counts) const;

  std::vector<Node> nodes_;           // without: all edges in their order
  std::vector<std::uint32_t> items_;  // in the order of leaves
  std::uint32_t count_ = 0;
  double extent_ = 0;
  std::uint64_t* looked_at_ = nullptr;
};

template <class Visit>
bool EdgeTree::visit_items(const Node& node, Visit& visit) const {
  for (std::uint32_t k = node.begin; k < node.end; ++k) {
    count_one();
    if (visit(nodes_.empty() ? k : items_[k])) return true;
  }
  return false;
}

template <class Visit>
bool EdgeTree::visit_near(const Place& place, const double& most2, Visit&& visit) const {
  if (nodes_.empty()) return visit_items({.begin = 0, .end = count_}, visit);
  return near_below(0, nodes_[0].nearest2(place), place, most2, visit);
}

template <class Visit>
bool EdgeTree::near_below(std::uint32_t n, double bound, const Place& place, const double& most2,
                          Visit& visit) const {
  if (bound > most2) return false;
  count_one();
  const Node& node = nodes_[n];
  if (node.second == 0) return visit_items(node, visit);
  const double first = nodes_[n + 1].nearest2(place), second = nodes_[node.second].nearest2(place);
  const auto look_into = [&](bool other) {
    return near_below(other ? node.second : n + 1, other ? second : first, place, most2, visit);
  };
  const bool swapped = second < first;
  return look_into(swapped) || look_into(!swapped);
}

template <class Visit>
bool EdgeTree::visit_at(const Place& place, double distance, Visit&& visit) const {
  if (nodes_.empty()) return visit_items({.begin = 0, .end = count_}, visit);
  return at_below(0, place, distance, visit);
}

template <class Visit>
bool EdgeTree::at_below(std::uint32_t n, const Place& place, double distance, Visit& visit) const {
  count_one();
  const Node& node = nodes_[n];
  const double distance2 = distance * distance;
  if (node.nearest2(place) > distance2 || node.farthest2(place) < distance2) return false;
  if (node.second == 0) return visit_items(node, visit);
  return at_below(n + 1, place, distance, visit) || at_below(node.second, place, distance, visit);
}

template <class EndsOf, class Counts>
bool EdgeTree::is_around(const Point<2>& x, EndsOf&& ends_of, Counts&& counts) const {
  if (!nodes_.empty()) {
    const double slack = kSlack * (extent_ + std::abs(x[0]) + std::abs(x[1]));
    return around_below(0, x, slack, ends_of, counts);
  }
  bool around = false;
  const auto cross = [&](std::uint32_t i) {
    if (counts(i)) around ^= is_crossed(x, ends_of(i)[0], ends_of(i)[1]);
    return false;
  };
  visit_items({.begin = 0, .end = count_}, cross);
  return around;
}

template <class EndsOf, class Counts>
bool EdgeTree::around_below(std::uint32_t n, const Point<2>& x, double slack, EndsOf& ends_of,
                            Counts& counts) const {
  count_one();
  const Node& node = nodes_[n];
  if (node.is_clear_of(x, slack)) {
    const std::uint32_t first = items_[node.begin], last = items_[node.end - 1];
    return node.in_chain && counts(first) && is_crossed(x, ends_of(first)[0], ends_of(last)[1]);
  }
  if (node.second != 0) {
    return around_below(n + 1, x, slack, ends_of, counts) !=
           around_below(node.second, x, slack, ends_of, counts);
  }
  bool around = false;
  const auto cross = [&](std::uint32_t i) {
    if (counts(i)) around ^= is_crossed(x, ends_of(i)[0], ends_of(i)[1]);
    return false;
  };
  visit_items(node, cross);
  return around;
}

}  // namespace mesher::detail
