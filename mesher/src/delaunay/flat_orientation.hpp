// The side of a facet on which a position is, for positions in the plane of the facet or nearly so.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "geometry/space_vectors.hpp"
#include "mesher/predicates.hpp"

namespace mesher::detail {

/// orient3d of what its filter leaves. On grids nothing is rounded: of places that are multiples of
/// some 2^low and differ by less than 2^16 of these units, entries of a cross product have 33 bits,
/// the determinant 51. `reach`: 2^9 units, the least exact_reach of the places (ball_filter.hpp).
[[nodiscard, gnu::noinline]] inline int flat_orientation(const std::array<const Point<3>*, 4>& q,
                                                         double reach) {
  const Point<3> a = minus(*q[0], *q[3]), b = minus(*q[1], *q[3]), c = minus(*q[2], *q[3]);
  double most = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    most = std::max({most, std::abs(a[k]), std::abs(b[k]), std::abs(c[k])});
  }
  if (most < 0x1p7 * reach) return -predicates::detail::sign(dot(a, cross(b, c)));
  return predicates::detail::orient3d_exact(*q[0], *q[1], *q[2], *q[3]);
}

}  // namespace mesher::detail
