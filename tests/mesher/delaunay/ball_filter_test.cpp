// The kernel's filters never contradict the exact predicates, however near to a tie.
#include "delaunay/ball_filter.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "delaunay_case.hpp"

namespace {

using mesher::Point;
using mesher::SplitMix64;
using mesher::detail::in_ball_quickly;

// On a circle or sphere around a middle, but for rounding and a few last bits.
template <int D>
Point<D> near_ball(SplitMix64& random, const Point<D>& middle, double radius, bool nudged) {
  Point<D> p;
  double square = 0;
  for (double& x : p) x = random.unit() - 0.5, square += x * x;
  for (std::size_t i = 0; i < D; ++i) p[i] = middle[i] + radius * p[i] / std::sqrt(square);
  if (nudged) p[0] *= 1 + 0x1p-52 * static_cast<double>(random.below(64));
  return p;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("near a ball, at each scale, the filter is right or not sure", "[template]",
                       ((int D), D), 2, 3) {
  SplitMix64 random(1);
  std::size_t sure = 0, all = 0;
  for (int i = 0; i < 200000; ++i) {
    const double scale = std::ldexp(1, static_cast<int>(random.below(190)) - 95);
    const double apart = std::ldexp(1, static_cast<int>(random.below(30)));
    Point<D> middle;
    for (double& x : middle) x = scale * random.unit() * apart;
    std::array<Point<D>, D + 2> q;
    for (auto& p : q) p = near_ball<D>(random, middle, scale, random.below(2) == 0);
    int quick, exact;
    if constexpr (D == 2) {
      quick = in_ball_quickly(q[0], q[1], q[2], q[3]);
      exact = mesher::predicates::incircle(q[0], q[1], q[2], q[3]);
    } else {
      quick = in_ball_quickly(q[0], q[1], q[2], q[3], q[4]);
      exact = mesher::predicates::insphere(q[0], q[1], q[2], q[3], q[4]);
    }
    REQUIRE((quick == 0 || quick == exact));
    sure += quick != 0 ? 1 : 0;
    ++all;
  }
  CHECK(sure > all / 100);  // not vacuous
  CHECK(sure < all);
}

TEMPLATE_TEST_CASE_SIG("for random points the filter is nearly always sure", "[template]",
                       ((int D), D), 2, 3) {
  SplitMix64 random(2);
  int unsure = 0;
  for (int i = 0; i < 100000; ++i) {
    std::array<Point<D>, D + 2> q;
    for (auto& p : q) {
      for (double& x : p) x = random.unit();
    }
    if constexpr (D == 2) {
      unsure += in_ball_quickly(q[0], q[1], q[2], q[3]) == 0 ? 1 : 0;
    } else {
      unsure += in_ball_quickly(q[0], q[1], q[2], q[3], q[4]) == 0 ? 1 : 0;
    }
  }
  CHECK(unsure <= 2);
}

TEST_CASE("the filter is not sure of what is no number") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(in_ball_quickly(Point<2>{nan, nan}, {1, 0}, {0, 1}, {0, 0}) == 0);
  CHECK(in_ball_quickly({1, 0}, {0, 1}, Point<2>{nan, nan}, {0, 0}) == 0);
  CHECK(in_ball_quickly(Point<3>{nan, nan, nan}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}) == 0);
  CHECK(in_ball_quickly({1, 0, 0}, {0, 1, 0}, {0, 0, 1}, Point<3>{nan, nan, nan}, {0, 0, 0}) == 0);
}
