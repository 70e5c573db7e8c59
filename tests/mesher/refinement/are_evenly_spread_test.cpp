// Which points refine() takes as soon as svr().
#include <catch2/catch.hpp>
#include <cstddef>
#include <limits>
#include <vector>

#include "mesher/extra/generate.hpp"
#include "refinement/refine.hpp"

using mesher::are_evenly_spread;
using mesher::generate_points;
using mesher::Point;
using mesher::PointKind;

TEMPLATE_TEST_CASE_SIG("points are even at random and on a grid, not on lines or in clusters", "",
                       ((int D), D), 2, 3) {
  for (const std::size_t n : {200, 1000, 30000}) {
    INFO(n << " points");
    CHECK(are_evenly_spread<D>(generate_points<D>(PointKind::uniform, n, 1)));
    CHECK(are_evenly_spread<D>(generate_points<D>(PointKind::grid, n, 1)));
    CHECK_FALSE(are_evenly_spread<D>(generate_points<D>(PointKind::line_circle, n, 1)));
    CHECK_FALSE(are_evenly_spread<D>(generate_points<D>(PointKind::spread, n, 1)));
  }
  CHECK_FALSE(are_evenly_spread<D>(generate_points<D>(PointKind::clusters, 30000, 1)));
}

TEMPLATE_TEST_CASE_SIG("the size and the sides of the box do not count, nor do a few holes", "",
                       ((int D), D), 2, 3) {
  auto points = generate_points<D>(PointKind::uniform, 5000, 1);
  for (Point<D>& p : points) p[0] *= 0x1p60, p[1] = 0x1p50 + p[1] * 0x1p57;
  if constexpr (D == 3) {
    for (Point<D>& p : points) p[2] *= 0x1p59;
  }
  CHECK(are_evenly_spread<D>(points));
  std::erase_if(points, [](const Point<D>& p) { return p[0] < 0x1p57; });
  points.push_back({});
  CHECK(are_evenly_spread<D>(points));
}

TEST_CASE("a part of the points on a line and a circle is not even beside any number of others") {
  auto points = generate_points<3>(PointKind::uniform, 20000, 1);
  for (const Point<3>& p : generate_points<3>(PointKind::line_circle, 4000, 1)) {
    points.push_back({0.4 + p[0] * 0x1p-6, 0.4 + p[1] * 0x1p-6, 0.4 + p[2] * 0x1p-6});
  }
  CHECK_FALSE(are_evenly_spread<3>(points));
}

TEST_CASE("what has no box, a thin one, or one beyond all numbers is not even") {
  CHECK_FALSE(are_evenly_spread<3>({}));
  CHECK_FALSE(are_evenly_spread<3>({{1, 2, 3}}));
  std::vector<Point<3>> points;
  for (int i = 0; i < 100; ++i) points.push_back({i % 10 * 1.0, i / 10 * 1.0, 0});
  CHECK_FALSE(are_evenly_spread<3>(points));
  points[7][2] = 1e-9;
  CHECK_FALSE(are_evenly_spread<3>(points));
  points[7][2] = std::numeric_limits<double>::quiet_NaN();
  CHECK_FALSE(are_evenly_spread<3>(points));
  points[7][2] = std::numeric_limits<double>::infinity();
  CHECK_FALSE(are_evenly_spread<3>(points));
  points[7][2] = 1e300, points[8][1] = 1e300;
  CHECK_FALSE(are_evenly_spread<3>(points));
}
