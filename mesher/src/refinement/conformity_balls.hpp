// What the parts of Conformity share: when something is in a ball, and names of faces.
#pragma once

#include <array>
#include <cstdint>
#include <limits>

#include "mesher/mesh.hpp"
#include "refinement/tiles.hpp"

namespace mesher::detail {

/// Balls are open, and somewhat smaller: what is on them but for rounding does not encroach.
inline constexpr double kOpen = 1 - 0x1p-30;

/// How far features are looked for: as far as it takes.
inline constexpr double kEverywhere = std::numeric_limits<double>::infinity();

using Facet = std::array<std::uint32_t, 3>;
[[nodiscard]] inline Face face_across(const Facet& facet) {
  return face_of(facet[0], facet[1], facet[2]);
}

/// Whether p is in the ball of squared radius r2 around the centre.
[[nodiscard]] inline bool is_in_ball(const Point<3>& centre, double r2, const Point<3>& p) {
  return squared_distance(centre, p) < r2 * kOpen;
}

}  // namespace mesher::detail
