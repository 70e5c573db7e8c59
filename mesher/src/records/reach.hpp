// The reach of queries: from a vertex, and from the cells that contain vertices.
//
// Both are boxes, rounded outward. A vertex has a Reach, four bytes: a power of two as the unit, in
// sides of the mesh's box, and the sides of its box in units. Coarser units are multiples of finer
// ones, so the box around several reaches does not depend on the order in which they come. A box
// fits the gap balls of a cell far better than a ball: of the queries within the farthest gap
// ball's diameter of a place one in three has the place in its box, and seven of ten of these have
// a gap ball around it. A cell has an Area: a box relative to the cell, in units of the cell's
// side, so that floats do at any depth.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include "mesher/mesh.hpp"

namespace mesher::detail {

template <int D>
class Reach {
 public:
  /// Nowhere but where the vertex is.
  Reach() = default;
  /// Requires: box.lo[i] <= 0 <= box.hi[i] <= kParts, relative to the vertex.
  explicit Reach(const Box<D>& box) noexcept {
    double farthest = 0;
    for (int i = 0; i < D; ++i) farthest = std::max({farthest, -box.lo[i], box.hi[i]});
    if (farthest == 0) return;
    const int exponent = std::max(std::ilogb(farthest) - kBits, 1 - kFinest);
    const bool fits = farthest <= std::ldexp(1, exponent + kBits);
    bits_ = static_cast<std::uint32_t>(exponent + (fits ? 0 : 1) + kFinest) << kUnitShift;
    for (int i = 0; i < D; ++i) {
      bits_ |= parts(-box.lo[i]) << shift(i) | parts(box.hi[i]) << (shift(i) + kBits);
    }
  }
  /// As far in all directions.
  static Reach around(double r) noexcept {
    Box<D> box;
    box.lo.fill(-r);
    box.hi.fill(r);
    return Reach(box);
  }

  /// No side is farther, and one is farther than half of it.
  [[nodiscard]] double most() const noexcept { return unit() * kParts; }
  /// How far the farthest side is.
  [[nodiscard]] double farthest() const noexcept {
    const Box<D> b = box();
    double farthest = 0;
    for (int i = 0; i < D; ++i) farthest = std::max({farthest, -b.lo[i], b.hi[i]});
    return farthest;
  }
  [[nodiscard]] Box<D> box() const noexcept {
    Box<D> box;
    for (int i = 0; i < D; ++i) {
      box.lo[i] = -unit() * parts_at(shift(i));
      box.hi[i] = unit() * parts_at(shift(i) + kBits);
    }
    return box;
  }
  /// Whether d, relative to the vertex, is in the box.
  [[nodiscard]] bool contains(const Point<D>& d) const noexcept {
    const Box<D> b = box();
    bool contains = true;
    for (int i = 0; i < D; ++i) {
      contains &= d[i] >= b.lo[i];
      contains &= d[i] <= b.hi[i];
    }
    return contains;
  }
  /// The same of some place of a box.
  [[nodiscard]] bool meets(const Box<D>& d) const noexcept {
    const Box<D> b = box();
    bool meets = true;
    for (int i = 0; i < D; ++i) {
      meets &= d.hi[i] >= b.lo[i];
      meets &= d.lo[i] <= b.hi[i];
    }
    return meets;
  }
  [[nodiscard]] bool covers(const Reach& other) const noexcept {
    const Box<D> b = other.box();
    return contains(b.lo) && contains(b.hi);
  }
  void include(const Reach& other) noexcept {
    if (covers(other)) return;
    Box<D> b = box();
    const Box<D> more = other.box();
    for (int i = 0; i < D; ++i) {
      b.lo[i] = std::min(b.lo[i], more.lo[i]);
      b.hi[i] = std::max(b.hi[i], more.hi[i]);
    }
    *this = Reach(b);
  }
  friend bool operator==(const Reach&, const Reach&) = default;

 private:
  static constexpr int kUnitShift = 24;  // the bits above are the unit's exponent; 0: no unit
  static constexpr int kFinest = 255;    // the exponent 0 is written so
  static constexpr int kBits = kUnitShift / (2 * D);

 public:
  static constexpr int kParts = 1 << kBits;  ///< units to a side, at most

 private:
  static constexpr int shift(int axis) noexcept { return 2 * kBits * axis; }
  [[nodiscard]] double unit() const noexcept {
    const std::uint64_t exponent = bits_ >> kUnitShift;
    return exponent == 0 ? 0 : std::bit_cast<double>((exponent + 1023 - kFinest) << 52);
  }
  [[nodiscard]] int parts_at(int shift) const noexcept {
    return static_cast<int>(bits_ >> shift & (kParts - 1)) + 1;
  }
  // Units that cover x, less one.
  [[nodiscard]] std::uint32_t parts(double x) const noexcept {
    return static_cast<std::uint32_t>(std::max(std::ceil(x / unit()), 1.0)) - 1;
  }

  std::uint32_t bits_ = 0;
};

/// Where the queries below a quadtree cell look: how far beyond the cell's lower corner, downwards
/// and upwards along each axis.
template <int D>
class Area {
 public:
  /// Nothing.
  Area() noexcept {
    below_.fill(kNone);
    above_.fill(kNone);
  }
  /// `box`, relative to u, which is in units of the cell's side; the box: in `across`-ths of it.
  Area(const Point<D>& u, const Box<D>& box, double across) noexcept {
    for (int i = 0; i < D; ++i) {
      below_[i] = outward(static_cast<float>(-box.lo[i] * across - u[i]));
      above_[i] = outward(static_cast<float>(box.hi[i] * across + u[i]));
    }
  }
  /// The same area for the cell of which this one is child `c`: bit i is the half along axis i.
  [[nodiscard]] Area in_parent(int c) const noexcept {
    Area area;
    for (int i = 0; i < D; ++i) {
      const auto bit = static_cast<float>(c >> i & 1);
      area.below_[i] = outward((below_[i] - bit) / 2);
      area.above_[i] = outward((above_[i] + bit) / 2);
    }
    return area;
  }
  void include(const Area& other) noexcept {
    for (int i = 0; i < D; ++i) {
      below_[i] = std::max(below_[i], other.below_[i]);
      above_[i] = std::max(above_[i], other.above_[i]);
    }
  }
  /// No query of a vertex in the cell looks farther, in units of the cell's side.
  [[nodiscard]] double farthest() const noexcept {
    float farthest = 0;
    for (int i = 0; i < D; ++i) farthest = std::max({farthest, below_[i] + 1, above_[i]});
    return double{farthest} * (1 + 0x1p-20);
  }
  [[nodiscard]] bool covers(const Area& other) const noexcept {
    bool covers = true;
    for (int i = 0; i < D; ++i) {
      covers &= below_[i] >= other.below_[i];
      covers &= above_[i] >= other.above_[i];
    }
    return covers;
  }
  /// Whether u is inside, or within `slack` of it.
  [[nodiscard]] bool contains(const Point<D>& u, double slack) const noexcept {
    bool contains = true;
    for (int i = 0; i < D; ++i) {
      contains &= -u[i] <= below_[i] + slack;
      contains &= u[i] <= above_[i] + slack;
    }
    return contains;
  }
  /// The same of some place of a box.
  [[nodiscard]] bool meets(const Box<D>& u, double slack) const noexcept {
    bool meets = true;
    for (int i = 0; i < D; ++i) {
      meets &= -u.hi[i] <= below_[i] + slack;
      meets &= u.lo[i] <= above_[i] + slack;
    }
    return meets;
  }

 private:
  // No place in the mesh's box is so far from a cell; and no infinity, to calculate with.
  static constexpr float kNone = -1e30f;
  static float outward(float x) noexcept { return x + std::abs(x) * 0x1p-22f; }

  std::array<float, D> below_;
  std::array<float, D> above_;
};

}  // namespace mesher::detail
