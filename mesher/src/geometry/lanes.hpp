// Two doubles in one register, for which all supported machines have instructions. Rounding is that
// of doubles.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace mesher::detail {

using Lanes [[gnu::vector_size(16)]] = double;
using LaneMask [[gnu::vector_size(16)]] = std::int64_t;  // -1 or 0 each
inline constexpr std::size_t kLanes = 2;

[[nodiscard]] inline Lanes lanes_at(const double* p) noexcept {
  Lanes x;
  std::memcpy(&x, p, sizeof x);
  return x;
}
[[nodiscard]] inline Lanes both(double x) noexcept { return Lanes{x, x}; }
[[nodiscard]] inline Lanes greater(Lanes a, Lanes b) noexcept { return a < b ? b : a; }
[[nodiscard]] inline bool any(LaneMask mask) noexcept { return (mask[0] | mask[1]) != 0; }

}  // namespace mesher::detail
