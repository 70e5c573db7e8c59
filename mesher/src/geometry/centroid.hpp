// The middle of a simplex.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "mesher/mesh.hpp"

namespace mesher::detail {

/// The corners of a simplex.
template <int D>
using CornersOf = std::array<Point<D>, D + 1>;

/// The same, to the last bit, in whatever order the corners are.
template <std::size_t N>
[[nodiscard]] Point<static_cast<int>(N) - 1> centroid(
    std::array<Point<static_cast<int>(N) - 1>, N> corners) {
  std::sort(corners.begin(), corners.end());
  auto sum = corners[0];
  for (std::size_t c = 1; c < N; ++c) {
    for (std::size_t i = 0; i + 1 < N; ++i) sum[i] += corners[c][i];
  }
  for (double& x : sum) x /= static_cast<double>(N);
  return sum;
}

}  // namespace mesher::detail
