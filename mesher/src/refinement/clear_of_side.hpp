// Balls beside the facets of simplices.
#pragma once

#include <cmath>
#include <cstdint>

#include "delaunay/facets.hpp"
#include "geometry/plane_vectors.hpp"
#include "geometry/space_vectors.hpp"

namespace mesher::detail {

/// Whether the ball around c is on the side of corner i of s of the facet across from it, by more
/// than rounding. Requires: neither is at infinity.
template <int D, class Kernel>
[[nodiscard]] bool is_clear_of_side(const Kernel& kernel, std::uint32_t s, std::uint32_t i,
                                    const Point<D>& c, double radius) {
  const auto facet = facet_across<D>(kernel.simplices().corners(s), i);
  const Point<D>& at = kernel.place(facet[0]);
  const Point<D> a = minus(kernel.place(facet[1]), at), to_c = minus(c, at);
  Point<D> normal;  // towards corner i
  double size2 = squared(a) * squared(to_c);
  if constexpr (D == 2) {
    normal = {-a[1], a[0]};
  } else {
    const Point<D> b = minus(kernel.place(facet[2]), at);
    normal = cross(a, b);
    size2 *= squared(b);
  }
  constexpr double kClear = 1 + 0x1p-20, kRounding = 0x1p-48;  // a few units of the products' sizes
  return dot(normal, to_c) >
         kClear * radius * std::sqrt(squared(normal)) + kRounding * std::sqrt(size2);
}

}  // namespace mesher::detail
