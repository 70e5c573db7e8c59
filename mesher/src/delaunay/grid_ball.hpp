// In-ball tests on grids, where most points near a sphere are exactly on it: the side of the
// sphere, with ties broken.
//
// With p as the origin a corner at r is as far from the centre e as p is if r (r - 2e) is 0. The
// centre is the one that is kept with the simplex: of a grid's cells it is not rounded. Nor is
// anything here: let points be multiples of some 2^low, the centre of 2^(low - 16), and p nearer to
// it than the reach of 2^9 units (plane: 2^(low - 13), 2^12). If a corner is on the sphere, then
// coordinates of r have 10 bits (13), of 2e 26, sums of products 40 (42), the minors of r 33 (28).
// Farther corners may be rounded, and yet are not found to be on it.
#pragma once

#include <array>
#include <cstddef>

#include "mesher/mesh.hpp"

namespace mesher::detail {

/// Of points on one sphere, relative to p: its corners, and each a number that is the greater the
/// later it comes in lexicographic order, 0 for p.
template <std::size_t D>
struct GridBall {
  std::array<std::array<double, D>, D + 1> corner;
  std::array<double, D + 1> key;

  void set(std::size_t k, const std::array<double, D>& q, const std::array<double, D>& p) noexcept {
    key[k] = 0;
    for (std::size_t i = 0; i < D; ++i) {
      corner[k][i] = q[i] - p[i];
      key[k] = key[k] * 0x1p15 + corner[k][i];
    }
  }
  /// insphere_perturbed(corners, p), or incircle_perturbed. Requires: the corners are positively
  /// oriented.
  [[nodiscard]] int side() noexcept {
    // The heights of the greatest points come first; that of p has a negative cofactor.
    for (;;) {
      std::size_t greatest = 0;
      for (std::size_t k = 1; k <= D; ++k) greatest = key[k] > key[greatest] ? k : greatest;
      if (!(key[greatest] > 0)) return -1;
      const double cofactor = cofactor_of(greatest);
      if (cofactor != 0) return cofactor > 0 ? 1 : -1;
      key[greatest] = 0;
    }
  }

 private:
  /// Of the height of corner k: see predicates::detail::first_cofactor.
  [[nodiscard]] double cofactor_of(std::size_t k) const noexcept {
    if constexpr (D == 2) {
      const auto &a = corner[k == 2 ? 0 : k + 1], &b = corner[k == 0 ? 2 : k - 1];
      return a[0] * b[1] - a[1] * b[0];
    } else {
      const auto &a = corner[k == 0 ? 1 : 0], &b = corner[k <= 1 ? 2 : 1],
                 &c = corner[k <= 2 ? 3 : 2];
      const double minor =
          (a[2] * (b[0] * c[1] - c[0] * b[1]) + b[2] * (c[0] * a[1] - a[0] * c[1])) +
          c[2] * (a[0] * b[1] - b[0] * a[1]);
      return k % 2 == 0 ? minor : -minor;
    }
  }
};

/// The same of points that are known to be on one sphere, none farther from p than its reach.
template <std::size_t D>
[[nodiscard]] inline int break_tie(const std::array<const std::array<double, D>*, D + 1>& q,
                                   const std::array<double, D>& p) noexcept {
  GridBall<D> ball;
  for (std::size_t k = 0; k <= D; ++k) ball.set(k, *q[k], p);
  return ball.side();
}

/// insphere_perturbed(q, p) or incircle_perturbed(q, p) if the corners q and p are found to be on
/// one sphere around c, else 0. `reach`: the least exact_reach of q and p (ball_filter.hpp).
/// Requires: q is positively oriented.
template <std::size_t D>
[[nodiscard]] inline int side_on_grid(const std::array<const std::array<double, D>*, D + 1>& q,
                                      const std::array<double, D>& c,
                                      const std::array<double, D>& p, double reach) noexcept {
  // Adding this rounds to multiples of 2^-25 reach; more of farther ones.
  const double rounding = reach * 0x1.8p27;
  std::array<double, D> diameter;
  double radius2 = 0;
  bool exact = true;
  for (std::size_t i = 0; i < D; ++i) {
    exact &= (c[i] + rounding) - rounding == c[i];
    radius2 += (c[i] - p[i]) * (c[i] - p[i]);
    diameter[i] = 2 * (c[i] - p[i]);
  }
  exact &= radius2 < reach * reach;
  GridBall<D> ball;
  for (std::size_t k = 0; k <= D; ++k) {
    ball.set(k, *q[k], p);
    double off = 0;
    for (std::size_t i = 0; i < D; ++i) {
      off += ball.corner[k][i] * (ball.corner[k][i] - diameter[i]);
    }
    exact &= off == 0;
  }
  return exact ? ball.side() : 0;
}

}  // namespace mesher::detail
