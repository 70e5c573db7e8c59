// The error of distances between rounded coordinates.
#pragma once

#include <algorithm>
#include <cmath>

#include "mesher/mesh.hpp"

namespace mesher::detail {

/// How far the distance of a place near p from p may be off, the place's coordinates being rounded,
/// and a good deal more: several units in their last place.
[[nodiscard]] inline double distance_rounding(const Point<2>& p) noexcept {
  return 0x1p-50 * std::max(std::abs(p[0]), std::abs(p[1]));
}

}  // namespace mesher::detail
