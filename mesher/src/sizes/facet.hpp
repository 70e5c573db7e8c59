// A triangle of a background: sizes at its corners, and what is linear between them.
#pragma once

#include <algorithm>
#include <array>
#include <limits>

#include "mesher/sizes.hpp"
#include "sizes/tile.hpp"

namespace mesher::detail {

class Facet : public Tile<2> {
 public:
  Facet(const CornersOf<2>& at, const std::array<double, 3>& size) : Tile<2>(at), size_(size) {}

  [[nodiscard]] double least() const { return *std::min_element(size_.begin(), size_.end()); }
  [[nodiscard]] double most() const { return *std::max_element(size_.begin(), size_.end()); }
  /// At a place inside or out.
  [[nodiscard]] double linear(const Point<2>& p) const {
    const double a = doubled(p, at_[1], at_[2]), b = doubled(at_[0], p, at_[2]);
    const double all = doubled(at_[0], at_[1], at_[2]);
    return size_[2] + (a * (size_[0] - size_[2]) + b * (size_[1] - size_[2])) / all;
  }
  [[nodiscard]] double at(const Point<2>& p) const {
    return std::clamp(linear(p), least(), most());
  }
  /// Bounds in the part inside the box.
  [[nodiscard]] SizeRange range(const Box<2>& box) const {
    SizeRange at_corners{std::numeric_limits<double>::infinity(), 0};
    for (const double x : {box.lo[0], box.hi[0]}) {
      for (const double y : {box.lo[1], box.hi[1]}) {
        const double h = linear({x, y});
        at_corners.least = std::min(at_corners.least, h);
        at_corners.most = std::max(at_corners.most, h);
      }
    }
    constexpr double kSlack = 0x1p-30;
    return {std::max(at_corners.least * (1 - kSlack), least()),
            std::min(at_corners.most * (1 + kSlack), most())};
  }
  /// False only if the box lies outside.
  [[nodiscard]] bool meets(const Box<2>& box) const {
    for (std::size_t i = 0; i < 3; ++i) {
      const Point<2>&a = at_[i], &b = at_[(i + 1) % 3];
      if (doubled(a, b, farthest_left(a, b, box)) < 0) return false;
    }
    return true;
  }

 private:
  // Twice the area.
  static double doubled(const Point<2>& a, const Point<2>& b, const Point<2>& c) {
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  }
  std::array<double, 3> size_;
};

}  // namespace mesher::detail
