// Balls through points in any dimension, in long doubles and by elimination: a judge's own.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "mesher/mesh.hpp"

namespace support {

template <int D>
struct Ball {
  std::array<long double, D> centre{};
  long double radius2 = 0;
};

/// Of the corners of a simplex. Requires: they are not in one hyperplane.
template <int D>
[[nodiscard]] Ball<D> ball_of(const std::array<mesher::Point<D>, D + 1>& simplex) {
  constexpr auto kRows = static_cast<std::size_t>(D);
  std::array<std::array<long double, D + 1>, D> m{};
  for (std::size_t i = 0; i < kRows; ++i) {
    for (std::size_t k = 0; k < kRows; ++k) {
      m[i][k] = static_cast<long double>(simplex[i][k]) - simplex[kRows][k];
      m[i][kRows] += m[i][k] * m[i][k] / 2;
    }
  }
  for (std::size_t c = 0; c < kRows; ++c) {
    for (std::size_t i = c + 1; i < kRows; ++i) {
      if (std::abs(m[i][c]) > std::abs(m[c][c])) std::swap(m[i], m[c]);
    }
    for (std::size_t i = 0; i < kRows; ++i) {
      if (i == c) continue;
      const long double f = m[i][c] / m[c][c];
      for (std::size_t k = c; k <= kRows; ++k) m[i][k] -= f * m[c][k];
    }
  }
  Ball<D> ball;
  for (std::size_t i = 0; i < kRows; ++i) {
    const long double q = m[i][kRows] / m[i][i];
    ball.radius2 += q * q;
    ball.centre[i] = simplex[kRows][i] + q;
  }
  return ball;
}

/// Whether a point is outside of a ball or on its sphere, but for rounding.
template <int D>
[[nodiscard]] bool is_outside(const Ball<D>& ball, const mesher::Point<D>& p) {
  long double away2 = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(D); ++i) {
    away2 += (p[i] - ball.centre[i]) * (p[i] - ball.centre[i]);
  }
  return away2 >= ball.radius2 * (1 - 1e-9L);
}

}  // namespace support
