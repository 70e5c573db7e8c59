// Balls kept with simplices: what they say is so, however flat the simplex, and kernels that keep
// them make the same triangulations.
#include "delaunay/simplex_ball.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <set>
#include <vector>

#include "delaunay/build.hpp"
#include "delaunay/kernel.hpp"
#include "delaunay/spatial_order.hpp"
#include "delaunay_case.hpp"
#include "geometry/circumcentre.hpp"

namespace {

using mesher::Point;
using mesher::SplitMix64;
using mesher::detail::BallBatch;
using mesher::detail::BallLayout;
using mesher::detail::BallSide;
using mesher::detail::SimplexBall;
using support::Kind;

template <int D>
using Kernel = mesher::detail::DelaunayKernel<D, BallLayout<D>>;

double nextafter_by(double x, int steps) {
  for (; steps > 0; --steps) x = std::nextafter(x, INFINITY);
  for (; steps < 0; ++steps) x = std::nextafter(x, -INFINITY);
  return x;
}

// A simplex, positively oriented, some nearly flat, some small and far from 0; no volume is drawn
// again.
template <int D>
std::array<Point<D>, D + 1> random_simplex(SplitMix64& random) {
  std::array<Point<D>, D + 1> q;
  do {
    const double far = random.below(3) == 0 ? 1000 : 0;
    const double size = far == 0 ? 1 : std::ldexp(1.0, -static_cast<int>(random.below(32)));
    const double flat = std::ldexp(size, -static_cast<int>(random.below(50)));
    for (auto& p : q) {
      for (double& x : p) x = far + size * random.unit();
      if (random.below(2) == 0) p[D - 1] = far + flat * random.unit();
    }
  } while (support::orientation(q) == 0);
  if (support::orientation(q) < 0) std::swap(q[0], q[1]);
  return q;
}

template <int D>
SimplexBall<D> ball_of(const std::array<Point<D>, D + 1>& q) {
  Kernel<D> kernel;
  std::array<std::uint32_t, D + 1> corners;
  for (std::size_t i = 0; i <= D; ++i) corners[i] = kernel.add_place(q[i]);
  kernel.start(corners);
  for (std::uint32_t s = 0; s < kernel.simplices().places(); ++s) {
    if (!kernel.is_ghost(s)) return kernel.simplices().ball(s);
  }
  return {};
}

// On the sphere, but for rounding, or some steps of rounding beside it.
template <int D>
Point<D> near_sphere(const SimplexBall<D>& ball, double radius, SplitMix64& random) {
  Point<D> p;
  double length2 = 0;
  for (double& x : p) x = random.unit() - 0.5, length2 += x * x;
  for (std::size_t i = 0; i < D; ++i) {
    const double x = ball.centre[i] + radius / std::sqrt(length2) * p[i];
    p[i] = nextafter_by(x, static_cast<int>(random.below(7)) - 3);
  }
  return p;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("a ball is never wrong about a point near its sphere, and seldom unsure", "",
                       ((int D), D), 2, 3) {
  SplitMix64 random(41);
  int unsure = 0, asked = 0, wrong = 0;
  for (int round = 0; round < 4000; ++round) {
    const auto q = random_simplex<D>(random);
    const auto ball = ball_of<D>(q);
    double radius2 = 0;
    for (std::size_t i = 0; i < D; ++i) {
      radius2 += (q[0][i] - ball.centre[i]) * (q[0][i] - ball.centre[i]);
    }
    for (int k = 0; k < 40; ++k) {
      // A radius off by up to 1e-4, 1e-8 ... 1e-16 of it.
      const double off = std::pow(10, -4 * static_cast<double>(1 + random.below(4)));
      const double radius = std::sqrt(radius2) * (1 + off * (2 * random.unit() - 1));
      const Point<D> p = near_sphere<D>(ball, radius, random);
      if (std::find(q.begin(), q.end(), p) != q.end()) continue;
      if (!(std::abs(p[0]) < 0x1p90) || std::abs(p[0]) < 0x1p-90) continue;
      const BallSide side = ball.side(p);
      ++asked;
      if (side == BallSide::unsure) {
        ++unsure;
      } else {
        wrong += support::in_ball(q, p) != static_cast<int>(side) ? 1 : 0;
      }
    }
  }
  CHECK(wrong == 0);
  CHECK(asked > 100000);
  CHECK(unsure < asked * 9 / 10);
  CHECK(unsure > asked / 10);
}

TEMPLATE_TEST_CASE_SIG("the centre of a simplex that is nearly flat is as good as any", "",
                       ((int D), D), 2, 3) {
  SplitMix64 random(43);
  for (int round = 0; round < 3000; ++round) {
    const auto q = random_simplex<D>(random);
    const auto ball = ball_of<D>(q);
    std::array<double, D + 1> distance;
    for (std::size_t k = 0; k <= D; ++k) {
      double sum = 0;
      for (std::size_t i = 0; i < D; ++i) {
        sum += (q[k][i] - ball.centre[i]) * (q[k][i] - ball.centre[i]);
      }
      distance[k] = std::sqrt(sum);
    }
    const auto [least, most] = std::minmax_element(distance.begin(), distance.end());
    const double rounding = 2e-12;  // of coordinates about 1000
    REQUIRE(*most - *least <= 1e-6 * *most + rounding);
    CHECK(std::sqrt(ball.inner2) <= *least * (1 + 1e-6) + rounding);
    CHECK(std::sqrt(ball.outer2) >= *most * (1 - 1e-6) - rounding);
  }
}

TEST_CASE("squares beyond the range of floats leave a ball unsure, not wrong") {
  for (const int exponent : {-90, -70, 70, 90}) {
    const double unit = std::ldexp(1.0, exponent);
    const auto ball = ball_of<2>({Point<2>{0, 0}, {unit, 0}, {0, unit}});
    CHECK(ball.side({unit * 0.5, unit * 0.5}) != BallSide::outside);
    CHECK(ball.side({unit * 1.5, unit * 1.5}) != BallSide::inside);
    CHECK(ball.side({unit, unit}) == BallSide::unsure);
  }
}

TEMPLATE_TEST_CASE_SIG("a kernel that keeps balls makes the triangulation of one that does not", "",
                       ((int D), D), 2, 3) {
  for (const Kind kind : support::kKinds) {
    for (const std::size_t n : {5, 40, 400}) {
      INFO(name(kind) << ", " << n);
      const auto points = support::distinct_points<D>(kind, n, 5 + n);
      Kernel<D> kernel;
      std::vector<std::uint32_t> vertices;
      for (const auto i : mesher::detail::spatial_order<D>(points)) {
        vertices.push_back(kernel.add_place(points[i]));
      }
      if (!mesher::detail::build<D>(kernel, vertices, [](std::uint32_t, std::uint32_t) {})) {
        CHECK(mesher::delaunay<D>(points).simplices.empty());
        continue;
      }
      kernel.check_invariants();
      support::PlacedSet<D> set;
      for (std::uint32_t s = 0; s < kernel.simplices().places(); ++s) {
        if (!kernel.simplices().alive(s) || kernel.is_ghost(s)) continue;
        std::array<Point<D>, D + 1> corners;
        for (std::size_t i = 0; i <= D; ++i) {
          corners[i] = kernel.place(kernel.simplices().corners(s)[i]);
        }
        std::sort(corners.begin(), corners.end());
        set.insert(corners);
      }
      CHECK(set == support::fresh_set<D>(points));
    }
  }
}

TEMPLATE_TEST_CASE_SIG("a hole that is dug and not filled leaves nothing behind", "", ((int D), D),
                       2, 3) {
  const auto points = support::distinct_points<D>(Kind::uniform, 200, 9);
  Kernel<D> kernel;
  std::vector<std::uint32_t> vertices;
  for (const auto& p : points) vertices.push_back(kernel.add_place(p));
  REQUIRE(mesher::detail::build<D>(kernel, vertices, [](std::uint32_t, std::uint32_t) {}));
  SplitMix64 random(3);
  for (int round = 0; round < 50; ++round) {
    Point<D> p;
    for (double& x : p) x = random.unit();
    const std::uint32_t v = kernel.add_place(p), from = kernel.made().front();
    const std::uint32_t s = kernel.walk(p, from);
    REQUIRE(kernel.conflicts(s, p));
    kernel.dig(v, s);
    const auto doomed = kernel.doomed();
    std::set<std::uint32_t> link, corners;
    kernel.for_each_in_link([&](std::uint32_t w) { link.insert(w); });
    for (const auto t : doomed) {
      CHECK(kernel.conflicts(t, p));
      for (const auto w : kernel.simplices().corners(t)) corners.insert(w);
    }
    CHECK(std::includes(corners.begin(), corners.end(), link.begin(), link.end()));
    kernel.undo_dig();
    kernel.check_invariants();
    CHECK(!kernel.has(v));
    if (round % 2 == 0) {
      kernel.dig(v, s);
      kernel.fill(v);
      std::vector<std::uint32_t> star;
      const auto nobody = [](std::uint32_t) { return false; };
      CHECK(kernel.find_in_star(v, star, nobody) == mesher::detail::kNone);
      std::sort(star.begin(), star.end());
      auto made = kernel.made();
      std::sort(made.begin(), made.end());
      CHECK(star == made);
      const auto one = [&](std::uint32_t t) { return t == made[made.size() / 2]; };
      CHECK(kernel.find_in_star(v, star, one) == made[made.size() / 2]);
      kernel.check_invariants();
    } else {
      kernel.drop_place();
    }
  }
}
