// The naive twin of BuildQT [Fig 4.3, 4.4]: largest cells first, every question asked of all
// points.
#pragma once

#include <cmath>
#include <cstdint>
#include <set>
#include <vector>

#include "geometry/grid.hpp"
#include "program/build_qt.hpp"

namespace support {

using Cell = mesher::detail::Cell<2>;
using Fixed = mesher::detail::Fixed<2>;

/// The cells that are split, for these points: a cell of level k that holds a point is crowded if
/// the block of 3 x 3 cells kCoarser levels below it, around the point, holds another; a cell is
/// split if it is crowded, or if one beside it (corners included) has children that are split.
class NaiveQuadtree {
 public:
  explicit NaiveQuadtree(const std::vector<Fixed>& points) : points_(points) {
    for (int level = 0; level < mesher::detail::kLevels; ++level) {  // largest first
      for (const Fixed& p : points_) {
        if (crowded(p, level + mesher::detail::kCoarser)) enqueue(cell(p, level));
      }
    }
  }

  [[nodiscard]] const std::set<Cell>& split() const noexcept { return split_; }

  /// The leaves under the split cells.
  [[nodiscard]] std::set<Cell> leaves() const {
    std::set<Cell> all;
    collect(Cell{}, all);
    return all;
  }

  static Cell child(const Cell& c, unsigned which) {
    Cell inner{c.corner, c.level + 1};
    for (unsigned i = 0; i < 2; ++i) {
      inner.corner[i] |= std::uint64_t{which >> i & 1} << (mesher::detail::kLevels - inner.level);
    }
    return inner;
  }

 private:
  static Cell cell(const Fixed& p, int level) { return mesher::detail::MeshBox<2>::cell(p, level); }

  [[nodiscard]] bool crowded(const Fixed& p, int level) const {
    if (level >= mesher::detail::kLevels) return false;
    const int shift = mesher::detail::kLevels - level;
    for (const Fixed& q : points_) {
      if (q == p) continue;
      const auto apart = [&](std::size_t i) {
        return std::abs(static_cast<long long>(p[i] >> shift) -
                        static_cast<long long>(q[i] >> shift));
      };
      if (apart(0) <= 1 && apart(1) <= 1) return true;
    }
    return false;
  }

  // Splits c, after its parent, and every larger cell that touches it.
  void enqueue(const Cell& c) {
    if (!split_.insert(c).second || c.level == 0) return;
    const auto size =
        static_cast<std::int64_t>(std::uint64_t{1} << (mesher::detail::kLevels - c.level));
    const std::int64_t all = std::int64_t{1} << mesher::detail::kLevels;
    for (int dx = -1; dx <= 1; ++dx) {
      for (int dy = -1; dy <= 1; ++dy) {
        const std::int64_t x = static_cast<std::int64_t>(c.corner[0]) + dx * size;
        const std::int64_t y = static_cast<std::int64_t>(c.corner[1]) + dy * size;
        if (x < 0 || y < 0 || x >= all || y >= all) continue;
        enqueue(cell({static_cast<std::uint64_t>(x), static_cast<std::uint64_t>(y)}, c.level - 1));
      }
    }
  }

  void collect(const Cell& c, std::set<Cell>& all) const {
    if (!split_.contains(c)) {
      all.insert(c);
      return;
    }
    for (unsigned i = 0; i < 4; ++i) collect(child(c, i), all);
  }

  std::vector<Fixed> points_;
  std::set<Cell> split_;
};

}  // namespace support
