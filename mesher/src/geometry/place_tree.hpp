// Finds the places in a ball, among a fixed set of places.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

#include "mesher/mesh.hpp"

namespace mesher::detail {

/// A closed ball by its centre relative to a place `at`: it is known better than where it is.
template <int D>
struct RelativeBall {
  Point<D> at{};
  Point<D> center{};
  double radius = 0;

  /// The same answer for the same numbers wherever it is asked.
  [[nodiscard]] bool contains(const Point<D>& p) const noexcept {
    double distance2 = 0;
    for (std::size_t i = 0; i < D; ++i) {
      const double d = p[i] - at[i] - center[i];
      distance2 += d * d;
    }
    return distance2 <= radius * radius;
  }
  /// A box around it, wider by what rounding may be.
  [[nodiscard]] Box<D> box() const noexcept {
    Box<D> box;
    for (std::size_t i = 0; i < D; ++i) {
      const double slack = 0x1p-46 * (std::abs(at[i]) + std::abs(center[i]) + radius);
      box.lo[i] = at[i] + center[i] - radius - slack;
      box.hi[i] = at[i] + center[i] + radius + slack;
    }
    return box;
  }
};

/// A k-d tree without nodes: places are ordered so that the middle one of a range separates it,
/// along the axes in turns.
template <int D>
class PlaceTree {
 public:
  /// Cost: O(n log n).
  explicit PlaceTree(const std::vector<Point<D>>& places) : number_(places.size()) {
    std::iota(number_.begin(), number_.end(), 0u);
    build(places, 0, places.size(), 0);
    places_.reserve(places.size());
    for (const std::uint32_t i : number_) places_.push_back(places[i]);
  }

  /// Calls visit(i) for the places in the ball. Cost: O(log n) each, if they are few.
  template <class Visit>
  void for_each_in(const RelativeBall<D>& ball, Visit&& visit) const {
    find(ball, ball.box(), 0, places_.size(), 0, visit);
  }

 private:
  static constexpr std::size_t kLeaf = 8;

  void build(const std::vector<Point<D>>& places, std::size_t begin, std::size_t end,
             std::size_t axis) {
    if (end - begin <= kLeaf) return;
    const auto at = [&](std::size_t i) { return number_.begin() + static_cast<std::ptrdiff_t>(i); };
    const std::size_t middle = begin + (end - begin) / 2;
    std::nth_element(at(begin), at(middle), at(end), [&](std::uint32_t a, std::uint32_t b) {
      return places[a][axis] < places[b][axis];
    });
    build(places, begin, middle, (axis + 1) % D);
    build(places, middle + 1, end, (axis + 1) % D);
  }
  template <class Visit>
  void find(const RelativeBall<D>& ball, const Box<D>& box, std::size_t begin, std::size_t end,
            std::size_t axis, Visit& visit) const {
    if (end - begin <= kLeaf) {
      for (std::size_t i = begin; i < end; ++i) {
        if (ball.contains(places_[i])) visit(number_[i]);
      }
      return;
    }
    const std::size_t middle = begin + (end - begin) / 2;
    const double x = places_[middle][axis];
    if (ball.contains(places_[middle])) visit(number_[middle]);
    if (x >= box.lo[axis]) find(ball, box, begin, middle, (axis + 1) % D, visit);
    if (x <= box.hi[axis]) find(ball, box, middle + 1, end, (axis + 1) % D, visit);
  }

  std::vector<std::uint32_t> number_;  // of places, as in places_
  std::vector<Point<D>> places_;
};

}  // namespace mesher::detail
