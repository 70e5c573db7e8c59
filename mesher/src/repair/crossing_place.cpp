// In twice the precision of doubles.
#include "repair/crossing_place.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/twofold.hpp"

namespace mesher::detail {

namespace {

using Vector = std::array<Twofold, 2>;

Vector from_to(const Point<2>& a, const Point<2>& b) {
  return {twofold_sum(b[0], -a[0]), twofold_sum(b[1], -a[1])};
}

Twofold cross(const Vector& u, const Vector& w) { return u[0] * w[1] + -(u[1] * w[0]); }

}  // namespace

double allowed(double x) {
  if (std::abs(x) >= 0x1p-100) return x;
  return std::abs(x) > 0x1p-101 ? std::copysign(0x1p-100, x) : 0.0;  // zero has no sign
}

Point<2> crossing_place(const Point<2>& a, const Point<2>& b, const Point<2>& c,
                        const Point<2>& d) {
  const Vector u = from_to(a, b), w = from_to(c, d);
  const Twofold along = cross(from_to(a, c), w) / cross(u, w);
  Point<2> x;
  for (int i = 0; i < 2; ++i) {
    const Twofold place = Twofold{a[i], 0} + along * u[i];
    const double lo = std::max(std::min(a[i], b[i]), std::min(c[i], d[i]));
    const double hi = std::min(std::max(a[i], b[i]), std::max(c[i], d[i]));
    x[i] = allowed(std::clamp(place.hi, lo, hi));
  }
  return x;
}

}  // namespace mesher::detail
