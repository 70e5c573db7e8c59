// Finds a vertex near a position, to start walks from.
//
// Grids over a cube, each twice as fine as the one before, the last with about a cell a vertex. A
// cell names a vertex in it, in the finest grid the last that was put there; a place is looked up
// in the finest grid whose cell has one. Points that lie evenly are a few steps from there; of m in
// one cell O(m^(1/D)).
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "delaunay/simplex_store.hpp"
#include "geometry/box.hpp"
#include "mesher/mesh.hpp"

namespace mesher::detail {

template <int D>
class Nearby {
 public:
  /// Nothing fits.
  Nearby() = default;
  /// For about n vertices, in the box and a quarter of its longest side around it.
  Nearby(const Box<D>& box, std::size_t n) : most_(2 * n), levels_(levels_for(n)) {
    const double longest = longest_side(box);
    for (std::size_t i = 0; i < D; ++i) lo_[i] = box.lo[i] - longest / 4;
    side_ = 1.5 * longest;
    scale_ = static_cast<double>(1u << levels_) / side_;
    std::size_t cells = 0;
    for (int level = 0; level <= levels_; ++level) cells += std::size_t{1} << (D * level);
    vertex_.assign(cells, kNone);
  }

  /// Whether p is in the cube and n vertices are not too many for it.
  [[nodiscard]] bool fits(const Point<D>& p, std::size_t n) const noexcept {
    bool inside = n <= most_;
    for (std::size_t i = 0; i < D; ++i) inside &= p[i] >= lo_[i] && p[i] - lo_[i] <= side_;
    return inside;
  }
  /// Requires (of every p): fits(p, 0).
  void add(std::uint32_t v, const Point<D>& p) noexcept {
    for_each_cell(p, [&](std::uint32_t& vertex) {
      const bool known = vertex != kNone;  // and then in the larger cells, too
      vertex = v;
      return known;
    });
  }
  /// v goes; w is a vertex near it. (Where w stands in for others that went, it stays when it goes
  /// itself: near() asks.)
  void replace(std::uint32_t v, const Point<D>& p, std::uint32_t w) noexcept {
    for_each_cell(p, [&](std::uint32_t& vertex) {
      if (vertex == v) vertex = w;
      return false;
    });
  }
  /// One for which is_there(v); kNone if none is known.
  template <class IsThere>
  [[nodiscard]] std::uint32_t near(const Point<D>& p, IsThere&& is_there) noexcept {
    std::uint32_t found = kNone;
    for_each_cell(p, [&](std::uint32_t vertex) {
      const bool good = vertex != kNone && is_there(vertex);
      if (good) found = vertex;
      return good;
    });
    return found;
  }

 private:
  static int levels_for(std::size_t n) { return static_cast<int>(std::bit_width(n)) / D; }

  // The cells that hold p, the smallest first, until visit(vertex) is true.
  template <class Visit>
  void for_each_cell(const Point<D>& p, Visit&& visit) noexcept {
    std::array<std::uint32_t, D> cell;
    const std::uint32_t last = (1u << levels_) - 1;
    for (std::size_t i = 0; i < D; ++i) {
      cell[i] = std::min(static_cast<std::uint32_t>((p[i] - lo_[i]) * scale_), last);
    }
    std::size_t end = vertex_.size();  // of this level's cells
    for (int level = levels_; level >= 0; --level) {
      const std::size_t begin = end - (std::size_t{1} << (D * level));
      std::size_t at = 0;
      for (std::size_t i = 0; i < D; ++i) at = at << level | cell[i] >> (levels_ - level);
      if (visit(vertex_[begin + at])) return;
      end = begin;
    }
  }

  std::size_t most_ = 0;
  int levels_ = 0;
  Point<D> lo_{};
  double side_ = -1, scale_ = 0;
  std::vector<std::uint32_t> vertex_;  // of the cells, the coarsest level's first
};

}  // namespace mesher::detail
