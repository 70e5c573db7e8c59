// A hash of coordinates.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "sac/label.hpp"

namespace mesher::detail {

/// Of equal points (0 and -0 are equal) the same.
template <std::size_t N>
[[nodiscard]] std::uint64_t place_hash(const std::array<double, N>& p) {
  std::uint64_t h = 0;
  for (const double x : p) h = sac::mix(h + std::bit_cast<std::uint64_t>(x + 0.0));
  return h;
}

}  // namespace mesher::detail
