// The kernel's filters never contradict the exact predicates, however near to a tie.
#include "delaunay/ball_filter.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <utility>

#include "delaunay_case.hpp"

namespace {

using mesher::Point;
using mesher::SplitMix64;
using mesher::detail::BallSide;
using mesher::detail::exact_reach;
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

template <int D>
double least_reach(const std::array<Point<D>, D + 2>& q) {
  double least = std::numeric_limits<double>::max();
  for (const auto& p : q) least = std::min(least, exact_reach(p));
  return least;
}

// What the filter says of a ball and a point, and what is so.
template <int D>
std::pair<BallSide, BallSide> sides(const std::array<Point<D>, D + 2>& q, double reach) {
  if constexpr (D == 2) {
    return {
        in_ball_quickly(q[0], q[1], q[2], q[3], reach),
        BallSide{static_cast<std::int8_t>(mesher::predicates::incircle(q[0], q[1], q[2], q[3]))}};
  } else {
    return {in_ball_quickly(q[0], q[1], q[2], q[3], q[4], reach),
            BallSide{static_cast<std::int8_t>(
                mesher::predicates::insphere(q[0], q[1], q[2], q[3], q[4]))}};
  }
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
    const auto [quick, exact] = sides<D>(q, least_reach<D>(q));
    REQUIRE((quick == BallSide::unsure || quick == exact));
    sure += quick != BallSide::unsure ? 1 : 0;
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
    unsure += sides<D>(q, 0).first == BallSide::unsure ? 1 : 0;
  }
  CHECK(unsure <= 2);
}

TEMPLATE_TEST_CASE_SIG("on a grid, up to the stated size, it is always sure and right",
                       "[template]", ((int D), D), 2, 3) {
  // 2^12 and 2^9 units between all points along one axis, 2^-1/2 of that along two, and so on
  const double most = D == 2 ? 4096 : 512;
  SplitMix64 random(3);
  std::size_t ties = 0;
  for (const int exponent : {-90, 0, 60}) {
    for (int i = 0; i < 100000; ++i) {
      const auto side = 1 + random.below(random.below(2) == 0 ? 4 : 290);
      const double far = std::ldexp(static_cast<double>(random.below(1000)), exponent);
      std::array<Point<D>, D + 2> q;
      for (auto& p : q) {
        for (double& x : p) {
          x = far + std::ldexp(static_cast<double>(random.below(side + 1)), exponent);
        }
      }
      REQUIRE(least_reach<D>(q) >= std::ldexp(most, exponent));
      const auto [quick, exact] = sides<D>(q, least_reach<D>(q));
      REQUIRE(quick == exact);
      ties += quick == BallSide::tie ? 1 : 0;
    }
  }
  CHECK(ties > 1000);
}

TEMPLATE_TEST_CASE_SIG("a coarse grid's ties are not claimed of fine points", "[template]",
                       ((int D), D), 2, 3) {
  SplitMix64 random(4);
  for (int i = 0; i < 100000; ++i) {
    std::array<Point<D>, D + 2> q;
    for (auto& p : q) {
      for (double& x : p) x = static_cast<double>(random.below(1u << 20));
      if (random.below(4) == 0) p[0] += 0x1p-30;
    }
    const auto [quick, exact] = sides<D>(q, least_reach<D>(q));
    REQUIRE((quick == BallSide::unsure || quick == exact));
  }
}

TEST_CASE("the filter is not sure of what is no number") {
  const double nan = std::numeric_limits<double>::quiet_NaN(), all = 0x1p200;
  const Point<2> none{nan, nan};
  CHECK(in_ball_quickly(none, {1, 0}, {0, 1}, {0, 0}, all) == BallSide::unsure);
  CHECK(in_ball_quickly({1, 0}, {0, 1}, none, {0, 0}, all) == BallSide::unsure);
  const Point<3> nowhere{nan, nan, nan}, x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, o{0, 0, 0};
  CHECK(in_ball_quickly(nowhere, x, y, z, o, all) == BallSide::unsure);
  CHECK(in_ball_quickly(x, y, z, nowhere, o, all) == BallSide::unsure);
}
