// Points, and the cells of a quadtree of D dimensions: their names, and the geometry that follows
// from the names.
//
// The root is [0, L]^D, L a power of two; a cell of level k has side L / 2^k and integer
// coordinates in units of its side, so that every bound of a cell is an exact double. A cell holds
// the points on its lower sides, and on the sides of the root.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <compare>
#include <cstdint>
#include <ostream>
#include <tuple>

#include "sac/label.hpp"

namespace examples::thesis {

inline constexpr int kDeepest = 48;  ///< level; bounds of cells are still exact in a double

template <int D>
struct Point {
  std::array<double, D> x{};

  double operator[](std::size_t i) const { return x[i]; }
  friend auto operator<=>(const Point&, const Point&) = default;
  friend std::uint64_t hash_value(const Point& p) {
    std::uint64_t h = D;
    for (const double x : p.x) h = sac::mix(h + std::bit_cast<std::uint64_t>(x + 0.0));
    return h;
  }
  friend void label_bytes(sac::LabelSink& sink, const Point& p) {
    sac::label_arguments(sink, std::tie(p.x));
  }
  friend std::ostream& operator<<(std::ostream& out, const Point& p) {
    for (std::size_t i = 0; i < D; ++i) out << (i == 0 ? '(' : ' ') << p[i];
    return out << ')';
  }
};

template <int D>
[[nodiscard]] double squared_distance(const Point<D>& a, const Point<D>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < D; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return sum;
}

template <int D>
struct Cell {
  int level = 0;
  std::array<std::uint64_t, D> at{};

  friend bool operator==(const Cell&, const Cell&) = default;
  /// The larger first, then in the order of the Z curve, in which children stand as well.
  friend std::strong_ordering operator<=>(const Cell& a, const Cell& b) {
    if (a.level != b.level) return a.level <=> b.level;
    std::size_t most = 0;  // the coordinate that differs in the highest bit
    for (std::size_t i = 1; i < D; ++i) {
      const std::uint64_t x = a.at[most] ^ b.at[most], y = a.at[i] ^ b.at[i];
      if (x < y && x < (x ^ y)) most = i;
    }
    return a.at[most] <=> b.at[most];
  }
  friend std::uint64_t hash_value(const Cell& c) {
    std::uint64_t h = static_cast<std::uint64_t>(c.level);
    for (const std::uint64_t i : c.at) h = sac::mix(h + 0x9e3779b97f4a7c15u + i);
    return h;
  }
  friend void label_bytes(sac::LabelSink& sink, const Cell& c) {
    sac::label_arguments(sink, std::tie(c.level, c.at));
  }
  friend std::ostream& operator<<(std::ostream& out, const Cell& c) {
    out << c.level;
    for (const std::uint64_t i : c.at) out << ' ' << i;
    return out;
  }
};

template <int D>
[[nodiscard]] double side_of(const Cell<D>& c, double L) {
  return std::ldexp(L, -c.level);
}
template <int D>
[[nodiscard]] Cell<D> parent_of(const Cell<D>& c) {
  Cell<D> parent{c.level - 1, c.at};
  for (std::uint64_t& i : parent.at) i >>= 1;
  return parent;
}
/// 0 <= which < 2^D.
template <int D>
[[nodiscard]] Cell<D> child_of(const Cell<D>& c, unsigned which) {
  Cell<D> child{c.level + 1, c.at};
  for (std::size_t i = 0; i < D; ++i) child.at[i] = 2 * c.at[i] + (which >> (D - 1 - i) & 1);
  return child;
}
/// The cell of this level that holds p. Requires: p lies in the root; 0 <= level <= kDeepest.
template <int D>
[[nodiscard]] Cell<D> cell_at(const Point<D>& p, int level, double L) {
  Cell<D> c{level, {}};
  const std::uint64_t last = (std::uint64_t{1} << level) - 1;
  for (std::size_t i = 0; i < D; ++i) {
    c.at[i] = std::min(static_cast<std::uint64_t>(std::ldexp(p[i] / L, level)), last);
  }
  return c;
}
/// The deepest level whose cells have at least this side; 0 if none has.
[[nodiscard]] inline int level_of(double side, double L) {
  const int level = static_cast<int>(std::floor(std::log2(L / side)));
  return std::clamp(level, 0, kDeepest);
}
/// Whether two cells of which neither holds the other share a corner, a point of their sides.
/// Requires: a.level >= b.level.
template <int D>
[[nodiscard]] bool touch(const Cell<D>& a, const Cell<D>& b) {
  const int finer = a.level - b.level;
  for (std::size_t i = 0; i < D; ++i) {
    const std::uint64_t lo = b.at[i] << finer, hi = (b.at[i] + 1) << finer;
    if (a.at[i] + 1 < lo || a.at[i] > hi) return false;
  }
  return true;
}
/// The squared distance from p to the nearest point of c.
template <int D>
[[nodiscard]] double squared_distance(const Point<D>& p, const Cell<D>& c, double L) {
  const double side = side_of(c, L);
  double sum = 0;
  for (std::size_t i = 0; i < D; ++i) {
    const double lo = static_cast<double>(c.at[i]) * side;
    const double out = std::max({0.0, lo - p[i], p[i] - (lo + side)});
    sum += out * out;
  }
  return sum;
}
/// Calls visit(n) for the cells beside c of c's size, in the order of their offsets, until one says
/// true; whether one has.
template <int D, class Visit>
bool any_beside(const Cell<D>& c, Visit&& visit) {
  const std::uint64_t last = (std::uint64_t{1} << c.level) - 1;
  std::array<int, D> offset;
  offset.fill(-1);
  for (;;) {
    Cell<D> n = c;
    bool inside = true;
    for (std::size_t i = 0; i < D; ++i) {
      n.at[i] += static_cast<std::uint64_t>(offset[i]);  // below 0: beyond last
      inside = inside && n.at[i] <= last;
    }
    if (inside && n != c && visit(n)) return true;
    std::size_t i = D;
    while (i > 0 && offset[i - 1] == 1) offset[--i] = -1;
    if (i == 0) return false;
    ++offset[i - 1];
  }
}

}  // namespace examples::thesis
