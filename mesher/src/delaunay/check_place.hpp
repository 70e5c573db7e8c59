// Which points a triangulation takes.
#pragma once

#include <cmath>
#include <limits>

#include "input.hpp"

namespace mesher::detail {

/// Throws: Error (not_finite, magnitude) that calls the point `id`.
template <int D>
void check_place(const Point<D>& p, std::size_t id) {
  bool good = true;
  for (const double x : p) good &= x == 0 || (std::abs(x) >= 0x1p-100 && std::abs(x) <= 0x1p100);
  if (good) return;
  Box<D> everywhere;
  everywhere.lo.fill(-std::numeric_limits<double>::infinity());
  everywhere.hi.fill(std::numeric_limits<double>::infinity());
  check_point(p, everywhere, FeatureId{static_cast<std::int64_t>(id)});
}

}  // namespace mesher::detail
