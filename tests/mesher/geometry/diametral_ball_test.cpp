// Diametral balls against rational arithmetic.
#include "geometry/diametral_ball.hpp"

#include <boost/multiprecision/cpp_int.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

namespace {

using Exact = boost::multiprecision::cpp_rational;
using P = mesher::Point<2>;

int exact_angle(const P& a, const P& x, const P& b) {
  const Exact ax = Exact(a[0]) - Exact(x[0]), ay = Exact(a[1]) - Exact(x[1]);
  const Exact bx = Exact(b[0]) - Exact(x[0]), by = Exact(b[1]) - Exact(x[1]);
  const Exact dot = ax * bx + ay * by;
  return dot.sign();
}

}  // namespace

TEST_CASE("The sign of an angle's cosine is exact, nearly and just at right angles") {
  std::mt19937_64 random(7);
  const auto unit = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  int right = 0;
  for (int i = 0; i < 20000; ++i) {
    const bool lattice = i % 2 == 0;
    const double scale = std::ldexp(1.0, static_cast<int>(random() % 60) - 30);
    const auto number = [&] {
      return lattice ? static_cast<double>(random() % 9) : unit() * scale;
    };
    const P a{number(), number()}, b{number(), number()};
    P x{number(), number()};
    if (i % 4 == 1) {  // on the circle but for rounding
      const double t = 6.3 * unit();
      const double r = std::hypot(a[0] - b[0], a[1] - b[1]) / 2;
      x = {(a[0] + b[0]) / 2 + r * std::cos(t), (a[1] + b[1]) / 2 + r * std::sin(t)};
    }
    const int expected = exact_angle(a, x, b);
    right += expected == 0;
    REQUIRE(mesher::detail::angle_sign(a, x, b) == expected);
    REQUIRE(mesher::detail::in_diametral_ball(x, a, b) == (expected <= 0));
  }
  CHECK(right > 100);
}

TEST_CASE("The ends of a segment are on its ball's circle, and its middle inside") {
  const P a{0.1, 0.7}, b{0.30000000000000004, -3};
  CHECK(mesher::detail::angle_sign(a, a, b) == 0);
  CHECK(mesher::detail::angle_sign(a, b, b) == 0);
  CHECK(mesher::detail::angle_sign(a, P{0.2, -1}, b) < 0);
  CHECK(mesher::detail::angle_sign(a, P{3, 5}, b) > 0);
}
