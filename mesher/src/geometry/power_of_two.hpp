// Powers of two found without logarithms, which C libraries round in different ways.
#pragma once

#include <cmath>

namespace mesher::detail {

/// The least power of two >= x. Requires: x > 0, and finite.
[[nodiscard]] inline double power_of_two_from(double x) {
  int exponent;
  const double mantissa = std::frexp(x, &exponent);
  return std::ldexp(1.0, mantissa == 0.5 ? exponent - 1 : exponent);
}

}  // namespace mesher::detail
