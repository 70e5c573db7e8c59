// Territories: the parts of the meshing box that tiles have, one each.
//
// A territory is a box of a k-d tree of cuts, so that each has about as many points as others. A
// place on a cut belongs to the upper side; territories at the sides of the meshing box have no end
// there. The cuts are a function of the points.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "mesher/mesh.hpp"

namespace mesher::detail {

template <int D>
class Territories {
 public:
  /// Cost: O(n log tiles).
  Territories(std::vector<Point<D>> places, std::size_t tiles) {
    Box<D> all;
    all.lo.fill(-std::numeric_limits<double>::infinity());
    all.hi.fill(std::numeric_limits<double>::infinity());
    cut(places.data(), places.data() + places.size(), tiles, all);
  }

  [[nodiscard]] std::size_t size() const noexcept { return boxes_.size(); }
  /// Half open: without its upper sides.
  [[nodiscard]] const Box<D>& box(std::size_t tile) const noexcept { return boxes_[tile]; }
  [[nodiscard]] bool owns(std::size_t tile, const Point<D>& p) const noexcept {
    const Box<D>& box = boxes_[tile];
    bool owns = true;
    for (int i = 0; i < D; ++i) owns = owns && box.lo[i] <= p[i] && p[i] < box.hi[i];
    return owns;
  }
  [[nodiscard]] std::size_t owner(const Point<D>& p) const noexcept {
    std::size_t node = 0;
    while (nodes_[node].tile == kInner) {
      node = p[nodes_[node].axis] < nodes_[node].at ? node + 1 : nodes_[node].upper;
    }
    return nodes_[node].tile;
  }
  /// Calls visit(tile) for those that the closed box meets, perhaps others that it touches.
  template <class Visit>
  void for_each_met(const Box<D>& area, Visit&& visit) const {
    meet(0, area, visit);
  }

 private:
  static constexpr std::uint32_t kInner = ~std::uint32_t{0};
  // In pre-order: the lower part is the next one.
  struct Node {
    double at = 0;
    int axis = 0;
    std::uint32_t upper = 0;
    std::uint32_t tile = kInner;
  };

  void cut(Point<D>* begin, Point<D>* end, std::size_t tiles, const Box<D>& box) {
    const std::size_t self = nodes_.size();
    nodes_.emplace_back();
    const auto leaf = [&] {
      nodes_[self].tile = static_cast<std::uint32_t>(boxes_.size());
      boxes_.push_back(box);
    };
    if (tiles < 2 || end - begin < 2) return leaf();
    const int axis = longest_axis(begin, end);
    const auto n = static_cast<std::size_t>(end - begin);
    Point<D>* middle = begin + n * (tiles / 2) / tiles;
    std::nth_element(begin, middle, end, [axis](const Point<D>& a, const Point<D>& b) {
      return a[axis] != b[axis] ? a[axis] < b[axis] : a < b;
    });
    const double at = (*middle)[axis];
    // Those at the cut are all on its upper side.
    middle = std::partition(begin, end, [&](const Point<D>& p) { return p[axis] < at; });
    if (middle == begin) return leaf();
    Box<D> lower = box, upper = box;
    lower.hi[axis] = upper.lo[axis] = at;
    nodes_[self].axis = axis;
    nodes_[self].at = at;
    cut(begin, middle, tiles / 2, lower);
    nodes_[self].upper = static_cast<std::uint32_t>(nodes_.size());
    cut(middle, end, tiles - tiles / 2, upper);
  }

  static int longest_axis(const Point<D>* begin, const Point<D>* end) {
    Point<D> lo = *begin, hi = *begin;
    for (const Point<D>* p = begin; p != end; ++p) {
      for (int i = 0; i < D; ++i)
        lo[i] = std::min(lo[i], (*p)[i]), hi[i] = std::max(hi[i], (*p)[i]);
    }
    int longest = 0;
    for (int i = 1; i < D; ++i) {
      if (hi[i] - lo[i] > hi[longest] - lo[longest]) longest = i;
    }
    return longest;
  }

  template <class Visit>
  void meet(std::size_t node, const Box<D>& area, Visit& visit) const {
    const Node& n = nodes_[node];
    if (n.tile != kInner) return visit(std::size_t{n.tile});
    if (area.lo[n.axis] < n.at) meet(node + 1, area, visit);
    if (area.hi[n.axis] >= n.at) meet(n.upper, area, visit);
  }

  std::vector<Node> nodes_;
  std::vector<Box<D>> boxes_;
};

}  // namespace mesher::detail
