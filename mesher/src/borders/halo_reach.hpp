// How far the halo of a tile goes, in spacings of points: the same everywhere to begin with, and
// farther where that was not enough.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "mesher/mesh.hpp"

namespace mesher::detail {

/// A width for each cell of a grid, which is three times as wide as the tile in each direction;
/// what is beyond has that of the nearest cell.
template <int D>
class HaloReach {
 public:
  HaloReach(const Box<D>& tile, double width) : everywhere_(width), lo_(tile.lo) {
    std::size_t cells = 1;
    for (std::size_t i = 0; i < D; ++i) {
      const double side = tile.hi[i] - tile.lo[i];
      lo_[i] -= side;
      scale_[i] = side > 0 ? kAcross / (3 * side) : 0;
      cells *= kAcross;
    }
    widths_.assign(cells, width);
  }

  /// Of points at p.
  [[nodiscard]] double at(const Point<D>& p) const noexcept { return widths_[index(cell(p))]; }
  [[nodiscard]] double most() const noexcept {
    return *std::max_element(widths_.begin(), widths_.end());
  }
  /// Twice as far, in the cells of these places and in those beside them; if that has not been
  /// enough for one of them, everywhere.
  void widen(const std::vector<Point<D>>& places) {
    const double widest = most();
    const bool was_not_enough = std::any_of(places.begin(), places.end(), [&](const Point<D>& p) {
      return widest > everywhere_ && at(p) == widest;
    });
    if (was_not_enough) {
      everywhere_ = widest;
      return widths_.assign(widths_.size(), everywhere_);
    }
    std::vector<bool> wider(widths_.size(), false);
    for (const Point<D>& p : places) {
      for_each_around(cell(p), [&](std::size_t i) { wider[i] = true; });
    }
    for (std::size_t i = 0; i < widths_.size(); ++i) {
      if (wider[i]) widths_[i] = 2 * everywhere_;
    }
  }

 private:
  static constexpr int kAcross = 24;
  using Cell = std::array<int, D>;

  [[nodiscard]] Cell cell(const Point<D>& p) const noexcept {
    Cell cell;
    for (std::size_t i = 0; i < D; ++i) {
      const double at = std::floor((p[i] - lo_[i]) * scale_[i]);
      cell[i] = static_cast<int>(std::clamp(at, 0.0, kAcross - 1.0));
    }
    return cell;
  }
  [[nodiscard]] static std::size_t index(const Cell& cell) noexcept {
    std::size_t index = 0;
    for (const int i : cell) index = index * kAcross + static_cast<std::size_t>(i);
    return index;
  }
  template <class Visit>
  static void for_each_around(const Cell& cell, Visit&& visit) {
    Cell near;
    const auto go = [&](auto&& self, std::size_t axis) -> void {
      if (axis == D) return visit(index(near));
      for (int i = std::max(cell[axis] - 1, 0); i <= std::min(cell[axis] + 1, kAcross - 1); ++i) {
        near[axis] = i;
        self(self, axis + 1);
      }
    };
    go(go, 0);
  }

  double everywhere_;  // at least
  Point<D> lo_;
  std::array<double, D> scale_{};  // cells in a length
  std::vector<double> widths_;     // by cell
};

}  // namespace mesher::detail
