// The lattices of vertices for filling where simplices must not be large [rules A7.2]: L(t), with
// *pitch* t, from the origin of coordinates.
//
// In the plane the points (t (i + 1/2 (j odd)), 7/8 t j): triangles of area 7/16 t^2, nearly
// equilateral. In space the body-centred points t (i, j, k) / 2, all of i, j, k odd or all even:
// tetrahedra of volume t^3 / 12, all alike, with two edges of t and four of sqrt(3)/2 t.
//
// No D + 2 of the points are on an empty sphere, so their Delaunay triangulation is one, and all of
// its simplices are of one measure. A pitch has so few bits that all points near the domain are
// exact: those of one pitch fit together wherever they are computed.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "mesher/mesh.hpp"

namespace mesher::detail {

template <int D>
class Lattice;

template <>
class Lattice<2> {
 public:
  static constexpr double kRow = 0.875;         // between rows, in pitches
  static constexpr double kMeasure = kRow / 2;  // of a triangle, in squared pitches
  /// Of a triangle, in pitches: (1/4 + kRow^2) / (4 kMeasure), rounded up.
  static constexpr double kCircumradius = 0.581;

  struct Node {
    std::int64_t i = 0, j = 0;
  };
  static constexpr std::size_t kAround = 6;
  /// The triangles at a node, by the places of their other corners in around().
  static constexpr std::array<std::array<std::size_t, 2>, 6> kSimplices{
      {{0, 1}, {1, 2}, {2, 3}, {3, 4}, {4, 5}, {5, 0}}};

  explicit Lattice(double pitch) : pitch_(pitch) {}

  /// The pitch for triangles of this area, but for its bits.
  [[nodiscard]] static double spacing(double area) noexcept { return std::sqrt(area / kMeasure); }

  [[nodiscard]] double pitch() const noexcept { return pitch_; }
  [[nodiscard]] Point<2> place(const Node& q) const noexcept {
    return {pitch_ / 2 * static_cast<double>(2 * q.i + (q.j & 1)),
            pitch_ / 8 * static_cast<double>(7 * q.j)};
  }
  /// The six around q, counterclockwise.
  [[nodiscard]] static std::array<Node, kAround> around(const Node& q) noexcept {
    const std::int64_t left = q.i - 1 + (q.j & 1);  // in the next rows
    return {{{q.i + 1, q.j},
             {left + 1, q.j + 1},
             {left, q.j + 1},
             {q.i - 1, q.j},
             {left, q.j - 1},
             {left + 1, q.j - 1}}};
  }
  /// Calls visit(node) for those in the closed box, and some just outside, by rows, until it
  /// returns true; returns whether it did.
  template <class Visit>
  bool visit_in(const Box<2>& box, Visit&& visit) const {
    const auto floor_of = [](double x) { return static_cast<std::int64_t>(std::floor(x)); };
    const double row = pitch_ / 8 * 7;
    for (std::int64_t j = floor_of(box.lo[1] / row); j <= floor_of(box.hi[1] / row) + 1; ++j) {
      const double shift = (j & 1) != 0 ? 0.5 : 0;
      const std::int64_t last = floor_of(box.hi[0] / pitch_ - shift) + 1;
      for (std::int64_t i = floor_of(box.lo[0] / pitch_ - shift); i <= last; ++i) {
        if (visit(Node{i, j})) return true;
      }
    }
    return false;
  }

 private:
  double pitch_;
};

template <>
class Lattice<3> {
 public:
  static constexpr double kMeasure = 1.0 / 12;  // of a tetrahedron, in cubed pitches
  /// Of a tetrahedron, in pitches: sqrt(5) / 4, rounded up.
  static constexpr double kCircumradius = 0.5591;

  /// In halves of a pitch: all odd, or all even.
  struct Node {
    std::array<std::int64_t, 3> at{};
  };
  static constexpr std::size_t kAround = 14;
  static constexpr std::size_t kAtNode = 24;
  /// The tetrahedra at a node, by the places of their other corners in around().
  static const std::array<std::array<std::size_t, 3>, kAtNode> kSimplices;

  explicit Lattice(double pitch) : pitch_(pitch) {}

  /// The pitch for tetrahedra of this volume, but for its bits. The same on every machine.
  [[nodiscard]] static double spacing(double volume) noexcept;

  [[nodiscard]] double pitch() const noexcept { return pitch_; }
  [[nodiscard]] Point<3> place(const Node& q) const noexcept {
    const double half = pitch_ / 2;
    return {half * static_cast<double>(q.at[0]), half * static_cast<double>(q.at[1]),
            half * static_cast<double>(q.at[2])};
  }
  /// The fourteen around q: the six a pitch away, down and up each axis; then the others, those
  /// that are up axis i having bit i of their place set.
  [[nodiscard]] static std::array<Node, kAround> around(const Node& q) noexcept {
    std::array<Node, kAround> all;
    for (std::size_t n = 0; n < kAround; ++n) {
      all[n] = q;
      for (std::size_t i = 0; i < 3; ++i) all[n].at[i] += step(n, i);
    }
    return all;
  }
  /// Calls visit(node) for those in the closed box, and some just outside, by rows, until it
  /// returns true; returns whether it did.
  template <class Visit>
  bool visit_in(const Box<3>& box, Visit&& visit) const {
    std::array<std::int64_t, 3> lo, hi;
    for (std::size_t i = 0; i < 3; ++i) {
      lo[i] = static_cast<std::int64_t>(std::floor(box.lo[i] / (pitch_ / 2)));
      hi[i] = static_cast<std::int64_t>(std::floor(box.hi[i] / (pitch_ / 2))) + 1;
    }
    for (std::int64_t k = lo[2]; k <= hi[2]; ++k) {
      for (std::int64_t j = lo[1] + ((lo[1] ^ k) & 1); j <= hi[1]; j += 2) {
        for (std::int64_t i = lo[0] + ((lo[0] ^ k) & 1); i <= hi[0]; i += 2) {
          if (visit(Node{{i, j, k}})) return true;
        }
      }
    }
    return false;
  }

 private:
  // From a node to the n-th around it, along axis i.
  [[nodiscard]] static constexpr std::int64_t step(std::size_t n, std::size_t i) noexcept {
    if (n < 6) return n / 2 != i ? 0 : (n & 1) != 0 ? 2 : -2;
    return (((n - 6) >> i) & 1) != 0 ? 1 : -1;
  }
  // A tetrahedron has the node and one a pitch away; of the four that both have around them, two
  // that are a pitch apart.
  [[nodiscard]] static constexpr std::array<std::array<std::size_t, 3>, kAtNode> simplices();

  double pitch_;
};

constexpr std::array<std::array<std::size_t, 3>, Lattice<3>::kAtNode> Lattice<3>::simplices() {
  std::array<std::array<std::size_t, 3>, kAtNode> all{};
  std::size_t count = 0;
  for (std::size_t far = 0; far < 6; ++far) {
    const std::size_t axis = far / 2, up = far & 1;
    for (std::size_t a = 0; a < 8; ++a) {
      if (((a >> axis) & 1) != up) continue;
      for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t b = a | (std::size_t{1} << i);
        if (i != axis && b != a) all[count++] = {far, 6 + a, 6 + b};
      }
    }
  }
  return all;
}
inline constexpr std::array<std::array<std::size_t, 3>, Lattice<3>::kAtNode>
    Lattice<3>::kSimplices = Lattice<3>::simplices();

// Newton's method on [1, 8): sums, products and quotients alone.
inline double Lattice<3>::spacing(double volume) noexcept {
  const double cubed = volume / kMeasure;
  if (!(cubed > 0) || std::isinf(cubed)) return cubed;
  int exponent = std::ilogb(cubed);
  exponent -= ((exponent % 3) + 3) % 3;
  const double x = std::ldexp(cubed, -exponent);
  double root = 1 + (x - 1) / 7;
  for (int i = 0; i < 6; ++i) root -= (root * root * root - x) / (3 * root * root);
  return std::ldexp(root, exponent / 3);
}

}  // namespace mesher::detail
