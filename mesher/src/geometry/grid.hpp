// The meshing box, and the integer coordinates that name quadtree cells.
//
// The box [lo, lo + L]^D has a power-of-two side L, and lo is a multiple of L/64. A coordinate x
// maps to floor((x - lo) / L * 2^50): a monotone function of x alone, so every use agrees on the
// cell of a point. A cell of level k holds the points that agree in their first k bits.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include "mesher/mesh.hpp"
#include "sac/check.hpp"
#include "sac/label.hpp"

namespace mesher::detail {

// 2^50 steps: points closer than L * 2^-50 in both coordinates may share the finest cell, and are
// then refused; points farther apart than that in one coordinate never are.
inline constexpr int kLevels = 50;

template <int D>
using Fixed = std::array<std::uint64_t, D>;

/// A quadtree cell: `corner` has its lowest kLevels - level bits zero.
template <int D>
struct Cell {
  Fixed<D> corner{};
  int level = 0;
  friend auto operator<=>(const Cell&, const Cell&) = default;
  friend std::uint64_t hash_value(const Cell& c) noexcept {
    auto h = static_cast<std::uint64_t>(c.level);
    for (const std::uint64_t x : c.corner) h = sac::mix(h + x);
    return h;
  }
  friend std::ostream& operator<<(std::ostream& out, const Cell& c) {
    out << c.level;
    for (const std::uint64_t x : c.corner) out << ':' << (x >> (kLevels - c.level));
    return out;
  }
  friend void label_bytes(sac::LabelSink& sink, const Cell& c) {
    sink.number(static_cast<std::uint64_t>(c.level));
    for (const std::uint64_t x : c.corner) sink.number(x);
  }
};

template <int D>
struct MeshBox {
  Point<D> lo{};
  double side = 1;
  int boundary_steps = 16;  // of the grid on its sides [L 4.4.1]; see boundary_place

  [[nodiscard]] double hi(int axis) const { return lo[axis] + side; }
  [[nodiscard]] double cell_side(int level) const { return std::ldexp(side, -level); }
  [[nodiscard]] bool contains(const Point<D>& p) const {
    for (int i = 0; i < D; ++i) {
      if (!(p[i] >= lo[i] && p[i] <= hi(i))) return false;  // nor if it is no number
    }
    return true;
  }

  /// The coordinate of the boundary grid's i-th plane across `axis`, 0 <= i <= boundary_steps:
  /// equally spaced but for rounding to multiples of side / kBoundaryUnits, which makes it exact.
  static constexpr int kBoundaryUnits = 4096;
  [[nodiscard]] double boundary_place(int axis, int i) const {
    const int unit = (2 * i * kBoundaryUnits + boundary_steps) / (2 * boundary_steps);
    return lo[axis] + unit * (side / kBoundaryUnits);
  }
  /// Calls visit(point) for each point of the boundary grid.
  template <class Visit>
  void for_each_boundary_point(Visit&& visit) const;

  /// Between which neighbouring planes of the grid are apart.
  [[nodiscard]] double longest_boundary_step() const {
    return side * (1.0 / boundary_steps + 1.0 / kBoundaryUnits);
  }
  [[nodiscard]] double shortest_boundary_step() const {
    return side * (1.0 / boundary_steps - 1.0 / kBoundaryUnits);
  }

  /// Steps of a lattice that differ by less are as near: they may be halves but for rounding.
  static constexpr double kTie = 0x1p-20;
  /// The point nearest to p of the body-centred lattice with this spacing, a power of two of the
  /// side.
  [[nodiscard]] Point<D> nearest_in_lattice(const Point<D>& p, double spacing) const;
  /// Where along the axis x lies in spacings, to the next whole number; what is halfway but for
  /// rounding goes down.
  [[nodiscard]] double nearest_step(int axis, double x, double spacing) const {
    return std::ceil((x - lo[axis]) / spacing - (0.5 + kTie));
  }

  [[nodiscard]] Fixed<D> fixed(const Point<D>& p) const {
    constexpr double kSteps = static_cast<double>(std::uint64_t{1} << kLevels);
    Fixed<D> f;
    for (int i = 0; i < D; ++i) {
      const double step = (p[i] - lo[i]) / side * kSteps;  // exact but for the subtraction
      f[i] = step >= kSteps ? (std::uint64_t{1} << kLevels) - 1
             : step <= 0    ? 0
                            : static_cast<std::uint64_t>(step);
    }
    return f;
  }

  /// Which child of its cell of `level` contains `f`: bit i is the half along axis i.
  [[nodiscard]] static int child_of(const Fixed<D>& f, int level) {
    int child = 0;
    for (int i = 0; i < D; ++i) child |= static_cast<int>(f[i] >> (kLevels - 1 - level) & 1) << i;
    return child;
  }

  /// The deepest level at which one cell contains both, but not the finest.
  [[nodiscard]] static int common_level(const Fixed<D>& f, const Fixed<D>& g) {
    std::uint64_t differ = 1;
    for (int i = 0; i < D; ++i) differ |= f[i] ^ g[i];
    return std::countl_zero(differ) - (64 - kLevels);
  }

  /// The cell of `level` that contains `f`.
  [[nodiscard]] static Cell<D> cell(const Fixed<D>& f, int level) {
    Cell<D> c{.level = level};
    for (int i = 0; i < D; ++i) c.corner[i] = f[i] >> (kLevels - level) << (kLevels - level);
    return c;
  }

  /// Where a cell lies, but for rounding.
  [[nodiscard]] Box<D> box_of(const Cell<D>& c) const {
    Box<D> box;
    for (int i = 0; i < D; ++i) {
      box.lo[i] = lo[i] + static_cast<double>(c.corner[i]) * cell_side(kLevels);
      box.hi[i] = box.lo[i] + cell_side(c.level);
    }
    return box;
  }

  /// Calls visit(cell) for the cells that c consists of, half as wide. Requires: c.level < kLevels.
  template <class Visit>
  static void for_each_child(const Cell<D>& c, Visit&& visit) {
    for (int child = 0; child < 1 << D; ++child) {
      Cell<D> inner{c.corner, c.level + 1};
      for (int i = 0; i < D; ++i) {
        inner.corner[i] |= static_cast<std::uint64_t>(child >> i & 1) << (kLevels - inner.level);
      }
      visit(inner);
    }
  }

  /// Calls visit(cell) for each cell of twice c's side that holds a neighbour of c of c's own side
  /// (corners touch, too): the parent of c first. Requires: c.level > 0.
  template <class Visit>
  static void for_each_parent_around(const Cell<D>& c, Visit&& visit);
};

// Of the corners of the lattice's cubes, and of their middles, the nearest; a corner if both are as
// near but for rounding.
template <int D>
Point<D> MeshBox<D>::nearest_in_lattice(const Point<D>& p, double spacing) const {
  std::array<Point<D>, 2> nearest;
  std::array<double, 2> off{};  // squared, in spacings
  for (std::size_t n = 0; n < 2; ++n) {
    const double shift = n == 0 ? 0 : 0.5;
    for (int i = 0; i < D; ++i) {
      const double step = nearest_step(i, p[i] - shift * spacing, spacing) + shift;
      nearest[n][i] = lo[i] + spacing * step;
      const double away = (p[i] - nearest[n][i]) / spacing;
      off[n] += away * away;
    }
  }
  return nearest[off[1] < off[0] - kTie ? 1 : 0];
}

template <int D>
template <class Visit>
void MeshBox<D>::for_each_boundary_point(Visit&& visit) const {
  std::array<int, D> at{};
  for (int axis = 0; axis < D;) {
    const bool on_boundary =
        std::any_of(at.begin(), at.end(), [&](int i) { return i == 0 || i == boundary_steps; });
    Point<D> p;
    for (int i = 0; i < D; ++i) p[i] = boundary_place(i, at[i]);
    if (on_boundary) visit(p);
    for (axis = 0; axis < D && at[axis] == boundary_steps; ++axis) at[axis] = 0;
    if (axis < D) ++at[axis];
  }
}

// Along each axis the neighbours of c lie in c's parent and, on c's side of it, in the next cell of
// the parent's size.
template <int D>
template <class Visit>
void MeshBox<D>::for_each_parent_around(const Cell<D>& c, Visit&& visit) {
  SAC_EXPECTS(c.level > 0);
  constexpr std::uint64_t kEnd = std::uint64_t{1} << kLevels;
  const Cell<D> parent = cell(c.corner, c.level - 1);
  const std::uint64_t size = std::uint64_t{1} << (kLevels - parent.level);
  for (int beside = 0; beside < 1 << D; ++beside) {
    Cell<D> larger = parent;
    bool inside = true;
    for (int i = 0; i < D; ++i) {
      if ((beside >> i & 1) == 0) continue;
      const bool upper = c.corner[i] != parent.corner[i];
      inside = inside && (upper ? parent.corner[i] + size < kEnd : parent.corner[i] != 0);
      larger.corner[i] = upper ? parent.corner[i] + size : parent.corner[i] - size;
    }
    if (inside) visit(larger);
  }
}

/// The first 64/D bits of each coordinate, interleaved: Morton order, a canonical order of places.
template <int D>
[[nodiscard]] std::uint64_t morton(const Fixed<D>& f) {
  constexpr int kBits = 64 / D;
  std::uint64_t code = 0;
  for (int bit = 0; bit < kBits; ++bit) {
    for (int i = 0; i < D; ++i) {
      code |= (f[static_cast<std::size_t>(i)] >> (kLevels - kBits + bit) & 1) << (D * bit + i);
    }
  }
  return code;
}

template <>
[[nodiscard]] inline std::uint64_t morton<2>(const Fixed<2>& f) {
  const auto spread = [](std::uint64_t x) {
    x = (x | x << 16) & 0x0000ffff0000ffffu;
    x = (x | x << 8) & 0x00ff00ff00ff00ffu;
    x = (x | x << 4) & 0x0f0f0f0f0f0f0f0fu;
    x = (x | x << 2) & 0x3333333333333333u;
    return (x | x << 1) & 0x5555555555555555u;
  };
  return spread(f[0] >> (kLevels - 32)) | spread(f[1] >> (kLevels - 32)) << 1;
}

template <>
[[nodiscard]] inline std::uint64_t morton<3>(const Fixed<3>& f) {
  const auto spread = [](std::uint64_t x) {
    x = (x | x << 32) & 0x001f00000000ffffu;
    x = (x | x << 16) & 0x001f0000ff0000ffu;
    x = (x | x << 8) & 0x100f00f00f00f00fu;
    x = (x | x << 4) & 0x10c30c30c30c30c3u;
    return (x | x << 2) & 0x1249249249249249u;
  };
  return spread(f[0] >> (kLevels - 21)) | spread(f[1] >> (kLevels - 21)) << 1 |
         spread(f[2] >> (kLevels - 21)) << 2;
}

}  // namespace mesher::detail
