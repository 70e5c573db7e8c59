// A simplex of a background: sizes at its corners, interpolated linearly.
//
// Simplices in space may be flat up to rounding, so the gradient is computed in twice the
// precision; for even flatter simplices the least size is used everywhere.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "geometry/twofold.hpp"
#include "mesher/sizes.hpp"
#include "sizes/tile.hpp"

namespace mesher::detail {

template <int D>
class Facet : public Tile<D> {
 public:
  /// Of the corners, in this order.
  using Sizes = std::array<double, D + 1>;

  Facet(const CornersOf<D>& at, const Sizes& size)
      : Tile<D>(at),
        least_(*std::min_element(size.begin(), size.end())),
        most_(*std::max_element(size.begin(), size.end())),
        first_(size[0]),
        slope_(gradient(at, size)) {
    const bool finite =
        std::all_of(slope_.begin(), slope_.end(), [](double x) { return std::isfinite(x); });
    if (finite) return;
    slope_ = {};
    first_ = least_;
  }

  [[nodiscard]] double least() const { return least_; }
  [[nodiscard]] double most() const { return most_; }
  /// At a place inside or out.
  [[nodiscard]] double at(const Point<D>& p) const {
    double h = first_;
    for (std::size_t i = 0; i < D; ++i) h += slope_[i] * (p[i] - this->at_[0][i]);
    return std::clamp(h, least_, most_);
  }
  /// Bounds of at() in the part inside the box. They hold to the last bit, as each step of at() is
  /// monotone in each coordinate, rounded as it is.
  [[nodiscard]] SizeRange range(const Box<D>& box) const {
    const Box<D> extent = this->extent();
    if (mesher::detail::contains(box, extent)) return {least_, most_};
    const Box<D> inside = common(box, extent);
    Point<D> low = inside.lo, high = inside.hi;
    for (std::size_t i = 0; i < D; ++i) {
      if (slope_[i] < 0) std::swap(low[i], high[i]);
    }
    return {at(low), at(high)};
  }

 private:
  // e g = the differences of sizes, e the edges at the first corner: by elimination. Not finite
  // where these are in one hyperplane.
  static Point<D> gradient(const CornersOf<D>& at, const Sizes& size) {
    std::array<std::array<Twofold, D + 1>, D> rows;
    for (std::size_t r = 0; r < D; ++r) {
      for (std::size_t i = 0; i < D; ++i) rows[r][i] = twofold_sum(at[r + 1][i], -at[0][i]);
      rows[r][D] = twofold_sum(size[r + 1], -size[0]);
    }
    for (std::size_t i = 0; i < D; ++i) eliminate(rows, i);
    Point<D> slope;
    for (std::size_t i = 0; i < D; ++i) slope[i] = (rows[i][D] / rows[i][i]).hi;
    return slope;
  }
  // Leaves the i-th unknown in the i-th row alone.
  static void eliminate(std::array<std::array<Twofold, D + 1>, D>& rows, std::size_t i) {
    const auto larger = [i](const auto& a, const auto& b) {
      return std::abs(a[i].hi) < std::abs(b[i].hi);
    };
    const auto from = rows.begin() + static_cast<std::ptrdiff_t>(i);
    std::iter_swap(from, std::max_element(from, rows.end(), larger));
    for (std::size_t r = 0; r < D; ++r) {
      if (r == i) continue;
      const Twofold factor = -(rows[r][i] / rows[i][i]);
      for (std::size_t k = i; k <= D; ++k) rows[r][k] = rows[r][k] + factor * rows[i][k];
    }
  }

  double least_, most_, first_;
  Point<D> slope_;
};

}  // namespace mesher::detail
