// Sums of two doubles: numbers of twice the precision [Dekker 1971; Knuth, TAOCP 2, 4.2.2].
#pragma once

#include <cmath>

namespace mesher::detail {

/// hi + lo, with |lo| at most half a unit in the last place of hi.
struct Twofold {
  double hi = 0, lo = 0;
};

[[nodiscard]] inline Twofold twofold_sum(double a, double b) {
  const double s = a + b;
  const double v = s - a;
  return {s, (a - (s - v)) + (b - v)};
}

[[nodiscard]] inline Twofold twofold(double hi, double lo) {
  const double s = hi + lo;
  return {s, lo - (s - hi)};
}

[[nodiscard]] inline Twofold operator+(const Twofold& a, const Twofold& b) {
  const Twofold s = twofold_sum(a.hi, b.hi);
  return twofold(s.hi, s.lo + (a.lo + b.lo));
}

[[nodiscard]] inline Twofold operator-(const Twofold& a) { return {-a.hi, -a.lo}; }

[[nodiscard]] inline Twofold operator*(const Twofold& a, const Twofold& b) {
  const double p = a.hi * b.hi;
  return twofold(p, std::fma(a.hi, b.hi, -p) + (a.hi * b.lo + a.lo * b.hi));
}

[[nodiscard]] inline Twofold operator/(const Twofold& a, const Twofold& b) {
  const double q = a.hi / b.hi;
  const Twofold rest = a + -(Twofold{q, 0} * b);
  return twofold(q, rest.hi / b.hi);
}

}  // namespace mesher::detail
