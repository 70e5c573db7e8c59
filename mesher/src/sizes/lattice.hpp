// The lattice that places are filled from where triangles must not be large [rules A7.2].
//
// L(t), t its *pitch*: the points (t (i + 1/2 (j odd)), 7/8 t j), from the origin of coordinates.
// No four of them are on a circle, so their Delaunay triangulation is one, and each triangle has
// the area 7/16 t^2. A pitch has so few bits that all points near the domain are exact: those of
// one pitch fit together wherever they are computed.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "mesher/mesh.hpp"

namespace mesher::detail {

struct LatticePoint {
  std::int64_t i = 0, j = 0;
};

class Lattice {
 public:
  static constexpr double kRow = 0.875;      // between rows, in pitches
  static constexpr double kArea = kRow / 2;  // of a triangle, in squared pitches
  /// Of a triangle, in pitches: (1/4 + kRow^2) / (4 kArea), rounded up.
  static constexpr double kCircumradius = 0.581;

  explicit Lattice(double pitch) : pitch_(pitch) {}

  [[nodiscard]] double pitch() const noexcept { return pitch_; }
  [[nodiscard]] Point<2> place(const LatticePoint& q) const noexcept {
    return {pitch_ / 2 * static_cast<double>(2 * q.i + (q.j & 1)),
            pitch_ / 8 * static_cast<double>(7 * q.j)};
  }
  /// The six around q, counterclockwise.
  [[nodiscard]] static std::array<LatticePoint, 6> around(const LatticePoint& q) noexcept {
    const std::int64_t left = q.i - 1 + (q.j & 1);  // in the next rows
    return {{{q.i + 1, q.j},
             {left + 1, q.j + 1},
             {left, q.j + 1},
             {q.i - 1, q.j},
             {left, q.j - 1},
             {left + 1, q.j - 1}}};
  }
  /// Calls visit(point) for those in the closed box, and some just outside, by rows, until it
  /// returns true; returns whether it did.
  template <class Visit>
  bool visit_in(const Box<2>& box, Visit&& visit) const {
    const auto floor_of = [](double x) { return static_cast<std::int64_t>(std::floor(x)); };
    const double row = pitch_ / 8 * 7;
    for (std::int64_t j = floor_of(box.lo[1] / row); j <= floor_of(box.hi[1] / row) + 1; ++j) {
      const double shift = (j & 1) != 0 ? 0.5 : 0;
      const std::int64_t last = floor_of(box.hi[0] / pitch_ - shift) + 1;
      for (std::int64_t i = floor_of(box.lo[0] / pitch_ - shift); i <= last; ++i) {
        if (visit(LatticePoint{i, j})) return true;
      }
    }
    return false;
  }

 private:
  double pitch_;
};

}  // namespace mesher::detail
