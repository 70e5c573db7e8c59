// Breaking ties of points on one sphere: see insphere_perturbed in mesher/predicates.hpp.
#pragma once

#include <array>
#include <cstddef>
#include <utility>

#include "mesher/mesh.hpp"

namespace mesher::predicates::detail {

/// a < b without the three-way comparison of arrays.
[[nodiscard]] inline bool is_less(const Point<3>& a, const Point<3>& b) noexcept {
  if (a[0] != b[0]) return a[0] < b[0];
  return a[1] != b[1] ? a[1] < b[1] : a[2] < b[2];
}

/// The first cofactor of a height that is not 0, the greatest point's first. The cofactor of the
/// last is minus the orientation of the others; two points that are swapped flip the sign, so that
/// of another point is the orientation with the last in its place. 0 if all are in one plane.
/// `orient(a, b, c, d)`: as orient3d.
template <class Orient>
[[nodiscard]] int first_cofactor(const std::array<const Point<3>*, 5>& points, Orient&& orient) {
  std::array<bool, 5> done{};
  for (std::size_t round = 0; round < 5; ++round) {
    std::size_t greatest = 5;
    for (std::size_t i = 0; i < 5; ++i) {
      if (done[i]) continue;
      if (greatest == 5 || is_less(*points[greatest], *points[i])) greatest = i;
    }
    done[greatest] = true;
    auto rest = points;
    std::swap(rest[greatest], rest[4]);
    const int orientation = orient(*rest[0], *rest[1], *rest[2], *rest[3]);
    if (orientation != 0) return greatest == 4 ? -orientation : orientation;
  }
  return 0;
}

}  // namespace mesher::predicates::detail
