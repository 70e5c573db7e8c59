// The triangles of least area that go around as a loop of places in space does.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

#include "mesher/mesh.hpp"

namespace mesher::detail {

struct LeastSurface {
  std::vector<std::array<std::size_t, 3>> triangles;  // by corners of the loop
  std::size_t faults = 0;                             // of all of them
};

/// Of the least faults, and then of the least area. `fault(i, k, j)`: of a triangle, i < k < j.
/// Requires: three corners or more. Cost: O(n^3). Source: Barequet, Sharir 1995.
[[nodiscard]] LeastSurface least_surface(
    const std::vector<Point<3>>& loop,
    const std::function<std::size_t(std::size_t, std::size_t, std::size_t)>& fault);

}  // namespace mesher::detail
