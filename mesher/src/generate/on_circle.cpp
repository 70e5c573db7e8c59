// Cosine and sine by their series.
#include "generate/on_circle.hpp"

#include <algorithm>
#include <cmath>

namespace mesher {
namespace {

constexpr double kPi = 3.141592653589793;

// cos and sin of x in [0, pi/4] by their series; the first term left out is below 2^-60.
Point<2> cos_sin(double x) {
  double term = 1, cosine = 0, sine = 0;
  for (int k = 1; k < 18; k += 2) {
    cosine += term;
    term *= x / k;
    sine += term;
    term *= -x / (k + 1);
  }
  return {cosine, sine};
}

}  // namespace

Point<2> on_circle(double turns) {
  const double whole = std::floor(4 * turns);
  const double part = turns - whole / 4;  // within [0, 1/4)
  Point<2> p = cos_sin(2 * kPi * std::min(part, 0.25 - part));
  if (part > 0.125) p = {p[1], p[0]};
  for (int quarter = static_cast<int>(std::fmod(whole, 4)); quarter > 0; --quarter) {
    p = {-p[1] + 0.0, p[0]};
  }
  return p;
}

}  // namespace mesher
