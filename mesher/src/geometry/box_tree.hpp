// Finds the pairs of boxes that meet, in a fixed set of boxes.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

#include "geometry/box.hpp"

namespace mesher::detail {

/// Halved by middles along the longest side, down to kMost boxes.
template <int D>
class BoxTree {
 public:
  /// Cost: O(n log n).
  explicit BoxTree(const std::vector<Box<D>>& boxes) : order_(boxes.size()) {
    std::iota(order_.begin(), order_.end(), 0u);
    if (!boxes.empty()) build(boxes, 0, static_cast<std::uint32_t>(boxes.size()));
    sorted_.reserve(boxes.size());
    for (const std::uint32_t i : order_) sorted_.push_back(boxes[i]);
  }

  /// Calls visit(i, j) for every pair of boxes that meet, once and in either order, until it
  /// returns true; returns whether it did. Cost: O(n log n + pairs) for boxes that few others meet.
  template <class Visit>
  [[nodiscard]] bool visit_pairs(Visit&& visit) const {
    std::vector<std::uint32_t> open;
    for (std::uint32_t k = 0; k < sorted_.size(); ++k) {
      open.assign(1, 0);
      while (!open.empty()) {
        const std::uint32_t n = open.back();
        open.pop_back();
        const Node& node = nodes_[n];
        if (node.end <= k + 1 || !meet(node.box, sorted_[k])) continue;
        if (node.right != 0) {
          open.push_back(node.right);
          open.push_back(n + 1);
          continue;
        }
        for (std::uint32_t j = std::max(node.begin, k + 1); j < node.end; ++j) {
          if (meet(sorted_[j], sorted_[k]) && visit(order_[k], order_[j])) return true;
        }
      }
    }
    return false;
  }

 private:
  static constexpr std::uint32_t kMost = 6;
  struct Node {
    Box<D> box;
    std::uint32_t begin, end;  // of sorted_
    std::uint32_t right = 0;   // the left one is the next node; 0: a leaf
  };

  [[nodiscard]] static bool meet(const Box<D>& a, const Box<D>& b) noexcept {
    bool meet = true;
    for (std::size_t i = 0; i < D; ++i) meet &= a.lo[i] <= b.hi[i] && b.lo[i] <= a.hi[i];
    return meet;
  }
  void build(const std::vector<Box<D>>& boxes, std::uint32_t begin, std::uint32_t end) {
    Box<D> all = boxes[order_[begin]];
    for (std::uint32_t k = begin + 1; k < end; ++k) {
      for (std::size_t i = 0; i < D; ++i) {
        all.lo[i] = std::min(all.lo[i], boxes[order_[k]].lo[i]);
        all.hi[i] = std::max(all.hi[i], boxes[order_[k]].hi[i]);
      }
    }
    const std::size_t self = nodes_.size();
    nodes_.push_back({all, begin, end});
    if (end - begin <= kMost) return;
    std::size_t axis = 0;
    for (std::size_t i = 1; i < D; ++i) {
      if (all.hi[i] - all.lo[i] > all.hi[axis] - all.lo[axis]) axis = i;
    }
    const auto middle = [&](std::uint32_t i) { return boxes[i].lo[axis] + boxes[i].hi[axis]; };
    const std::uint32_t half = begin + (end - begin) / 2;
    std::nth_element(order_.begin() + begin, order_.begin() + half, order_.begin() + end,
                     [&](std::uint32_t a, std::uint32_t b) { return middle(a) < middle(b); });
    build(boxes, begin, half);
    nodes_[self].right = static_cast<std::uint32_t>(nodes_.size());
    build(boxes, half, end);
  }

  std::vector<std::uint32_t> order_;  // of boxes, as in sorted_
  std::vector<Box<D>> sorted_;
  std::vector<Node> nodes_;
};

}  // namespace mesher::detail
