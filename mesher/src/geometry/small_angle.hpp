// Angles between directions in the plane, and a test whether they are small.
#pragma once

#include <cmath>

#include "mesher/mesh.hpp"

namespace mesher::detail {

/// Angles between lines below this, in degrees, are small.
inline constexpr double kSmall = 60;
/// In one radian.
inline constexpr double kDegrees = 180 / 3.141592653589793;

/// The angle of two directions.
[[nodiscard]] inline double degrees_between(const Point<2>& u, const Point<2>& w) {
  return std::atan2(std::abs(u[0] * w[1] - u[1] * w[0]), u[0] * w[0] + u[1] * w[1]) * kDegrees;
}

}  // namespace mesher::detail
