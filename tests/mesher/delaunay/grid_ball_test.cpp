// What is found to be on a grid's ball is on it, and on a grid whatever is on a ball is found.
#include "delaunay/grid_ball.hpp"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "delaunay/ball_filter.hpp"
#include "delaunay_case.hpp"

namespace {

using mesher::Point;
using mesher::SplitMix64;
using mesher::detail::exact_reach;
using mesher::detail::side_on_grid;

template <int D>
using Corners = std::array<Point<D>, D + 1>;

template <int D>
int found(const Corners<D>& q, const Point<D>& centre, const Point<D>& p) {
  double reach = exact_reach(p);
  std::array<const Point<D>*, D + 1> places;
  for (std::size_t i = 0; i <= D; ++i) {
    places[i] = &q[i];
    reach = std::min(reach, exact_reach(q[i]));
  }
  return side_on_grid<D>(places, centre, p, reach);
}

// All points with whole coordinates whose distance from a centre of halves is `square / 4`.
template <int D>
std::vector<Point<D>> points_on_ball(const Point<D>& centre, int square) {
  std::vector<Point<D>> on;
  const int most = static_cast<int>(std::sqrt(square)) + 2;
  Point<D> p;
  const auto choose = [&](auto&& self, std::size_t axis, double left) -> void {
    if (axis == D) {
      if (left == 0) on.push_back(p);
      return;
    }
    for (int i = -most; i <= most; ++i) {
      p[axis] = std::floor(centre[axis]) + i;
      const double d = 2 * (p[axis] - centre[axis]);
      if (d * d <= left) self(self, axis + 1, left - d * d);
    }
  };
  choose(choose, 0, square);
  return on;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("points of a grid on one ball are found to be, and ties broken as always",
                       "[template]", ((int D), D), 2, 3) {
  SplitMix64 random(5);
  std::size_t balls = 0, above = 0, below = 0;
  for (int round = 0; round < 3000; ++round) {
    Point<D> centre;
    const double far = static_cast<double>(random.below(1u << 19));
    for (double& x : centre) x = far + 0.5 * static_cast<double>(random.below(30));
    auto on = points_on_ball<D>(centre, 1 + static_cast<int>(random.below(200)));
    if (on.size() < D + 2) continue;
    const int exponent = static_cast<int>(random.below(100)) - 50;
    for (double& x : centre) x = std::ldexp(x, exponent);
    for (int k = 0; k < 20; ++k) {
      for (std::size_t i = on.size() - 1; i > 0; --i) {
        std::swap(on[i], on[random.below(i + 1)]);
      }
      Corners<D> q;
      Point<D> p = on[D + 1];
      for (std::size_t i = 0; i <= D; ++i) q[i] = on[i];
      if (support::orientation(q) == 0) continue;
      if (support::orientation(q) < 0) std::swap(q[0], q[1]);
      for (double& x : p) x = std::ldexp(x, exponent);
      for (auto& corner : q) {
        for (double& x : corner) x = std::ldexp(x, exponent);
      }
      ++balls;
      const int side = support::in_ball(q, p);
      REQUIRE(found<D>(q, centre, p) == side);
      std::array<const Point<D>*, D + 1> places;
      for (std::size_t i = 0; i <= D; ++i) places[i] = &q[i];
      REQUIRE(mesher::detail::break_tie<D>(places, p) == side);
      (side > 0 ? above : below) += 1;
    }
  }
  CHECK(balls > 5000);
  CHECK(above > 1000);
  CHECK(below > 1000);
}

TEMPLATE_TEST_CASE_SIG("what is found to be on a ball is, however near to it others are",
                       "[template]", ((int D), D), 2, 3) {
  SplitMix64 random(6);
  std::size_t claimed = 0, denied = 0;
  for (int round = 0; round < 200000; ++round) {
    const int exponent = static_cast<int>(random.below(180)) - 90;
    const double far = random.below(2) == 0 ? 0 : std::ldexp(1, static_cast<int>(random.below(52)));
    Point<D> centre;
    for (double& x : centre) {
      x = far +
          std::ldexp(static_cast<double>(random.below(64)), -static_cast<int>(random.below(20)));
    }
    // Corners of a box around the centre, all on one ball but for rounding and what is moved.
    Corners<D> q;
    Point<D> p, half;
    for (double& x : half) {
      x = std::ldexp(1 + static_cast<double>(random.below(random.below(2) == 0 ? 8 : 1000)),
                     -static_cast<int>(random.below(12)));
    }
    const auto corner = [&](std::size_t signs) {
      Point<D> x;
      for (std::size_t i = 0; i < D; ++i) {
        x[i] = centre[i] + ((signs >> i & 1) != 0 ? half[i] : -half[i]);
      }
      return x;
    };
    const std::array<std::size_t, 5> signs = D == 2 ? std::array<std::size_t, 5>{0, 1, 3, 2, 0}
                                                    : std::array<std::size_t, 5>{0, 1, 2, 4, 7};
    for (std::size_t i = 0; i <= D; ++i) q[i] = corner(signs[i]);
    p = corner(signs[D + 1]);
    if (random.below(2) == 0) {
      Point<D>& moved = random.below(2) == 0 ? p : q[random.below(D + 1)];
      double& x = moved[random.below(D)];
      x = random.below(2) == 0 ? std::nextafter(x, 1e9)
                               : x + std::ldexp(1.0, -static_cast<int>(random.below(30)));
    }
    const auto scale = [&](Point<D>& x) {
      for (double& c : x) c = std::ldexp(c, exponent);
    };
    for (auto& x : q) scale(x);
    scale(p), scale(centre);
    if (found<D>(q, centre, p) == 0) {
      ++denied;
      continue;
    }
    ++claimed;
    if constexpr (D == 2) {
      REQUIRE(mesher::predicates::incircle(q[0], q[1], q[2], p) == 0);
    } else {
      REQUIRE(mesher::predicates::insphere(q[0], q[1], q[2], q[3], p) == 0);
    }
  }
  CHECK(claimed > 5000);
  CHECK(denied > 10000);
}

TEST_CASE("points whose squares are no normal numbers are not found to be on a ball") {
  for (const int exponent : {-1040, -600, -520, -260, -210}) {
    const double u = std::ldexp(1.0, exponent);
    CHECK(0 == found<2>({Point<2>{0, 0}, {u, 0}, {0, u}}, {u / 2, u / 2}, {u, u}));
    CHECK(0 == found<3>({Point<3>{0, 0, 0}, {u, 0, 0}, {0, u, 0}, {0, 0, u}}, {u / 2, u / 2, u / 2},
                        {u, u, u}));
    CHECK(mesher::detail::in_ball_quickly({0, 0}, {u, 0}, {0, u}, {u, u},
                                          exact_reach(Point<2>{u, u})) ==
          mesher::detail::BallSide::unsure);
  }
}

TEST_CASE("a centre that is no number is no ball's") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(0 == found<2>({Point<2>{0, 0}, {1, 0}, {0, 1}}, {nan, nan}, {1, 1}));
  CHECK(0 == found<2>({Point<2>{nan, nan}, {1, 0}, {0, 1}}, {0.5, 0.5}, {1, 1}));
}
