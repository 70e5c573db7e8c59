// Sums of two doubles [Dekker 1971; Knuth, TAOCP 2, 4.2.2].
#include "repair/crossing_place.hpp"

#include <algorithm>
#include <cmath>

namespace mesher::detail {

namespace {

// hi + lo, with |lo| at most half a unit in the last place of hi.
struct Twofold {
  double hi = 0, lo = 0;
};

Twofold sum(double a, double b) {
  const double s = a + b;
  const double v = s - a;
  return {s, (a - (s - v)) + (b - v)};
}

Twofold normal(double hi, double lo) {
  const double s = hi + lo;
  return {s, lo - (s - hi)};
}

Twofold operator+(const Twofold& a, const Twofold& b) {
  const Twofold s = sum(a.hi, b.hi);
  return normal(s.hi, s.lo + (a.lo + b.lo));
}

Twofold operator-(const Twofold& a) { return {-a.hi, -a.lo}; }

Twofold operator*(const Twofold& a, const Twofold& b) {
  const double p = a.hi * b.hi;
  return normal(p, std::fma(a.hi, b.hi, -p) + (a.hi * b.lo + a.lo * b.hi));
}

Twofold operator/(const Twofold& a, const Twofold& b) {
  const double q = a.hi / b.hi;
  const Twofold rest = a + -(Twofold{q, 0} * b);
  return normal(q, rest.hi / b.hi);
}

using Vector = std::array<Twofold, 2>;

Vector from_to(const Point<2>& a, const Point<2>& b) {
  return {sum(b[0], -a[0]), sum(b[1], -a[1])};
}

Twofold cross(const Vector& u, const Vector& w) { return u[0] * w[1] + -(u[1] * w[0]); }

// The nearest coordinate that an input may have: 0, or of magnitude 2^-100 and more.
double allowed(double x) {
  if (std::abs(x) >= 0x1p-100) return x;
  return std::abs(x) > 0x1p-101 ? std::copysign(0x1p-100, x) : 0.0;
}

}  // namespace

Point<2> crossing_place(const Point<2>& a, const Point<2>& b, const Point<2>& c,
                        const Point<2>& d) {
  const Vector u = from_to(a, b), w = from_to(c, d);
  const Twofold along = cross(from_to(a, c), w) / cross(u, w);
  Point<2> x;
  for (int i = 0; i < 2; ++i) {
    const Twofold place = Twofold{a[i], 0} + along * u[i];
    const double lo = std::max(std::min(a[i], b[i]), std::min(c[i], d[i]));
    const double hi = std::min(std::max(a[i], b[i]), std::max(c[i], d[i]));
    x[i] = allowed(std::clamp(place.hi, lo, hi)) + 0.0;  // zero has no sign
  }
  return x;
}

}  // namespace mesher::detail
