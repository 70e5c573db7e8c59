// Families of points: distinct, fit to be input, and the same on every machine.
#include "mesher/extra/generate.hpp"

#include <algorithm>
#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <set>

namespace {

using mesher::Point;
using mesher::PointKind;

constexpr PointKind kKinds[] = {PointKind::uniform, PointKind::gaussian,    PointKind::clusters,
                                PointKind::grid,    PointKind::line_circle, PointKind::spiral,
                                PointKind::sphere,  PointKind::spread};

// A digest of the bits of all coordinates in order.
template <int D>
std::uint64_t digest(const std::vector<Point<D>>& points) {
  std::uint64_t h = 0;
  for (const auto& p : points) {
    for (const double x : p) h = mesher::SplitMix64(h ^ std::bit_cast<std::uint64_t>(x)).bits();
  }
  return h;
}

template <int D>
bool fit_for_input(const std::vector<Point<D>>& points) {
  return std::all_of(points.begin(), points.end(), [](const Point<D>& p) {
    return std::all_of(p.begin(), p.end(), [](double x) {
      return x == 0 ? !std::signbit(x) : std::abs(x) >= 0x1p-100 && std::abs(x) <= 0x1p100;
    });
  });
}

template <int D>
void require_family(PointKind kind, std::size_t n) {
  const auto points = mesher::generate_points<D>(kind, n, 1);
  CHECK(points.size() == n);
  CHECK(std::set<Point<D>>(points.begin(), points.end()).size() == n);
  CHECK(fit_for_input<D>(points));
  CHECK(points == mesher::generate_points<D>(kind, n, 1));
}

}  // namespace

TEST_CASE("every family has n distinct points that are fit to be input") {
  const PointKind kind = GENERATE(from_range(std::begin(kKinds), std::end(kKinds)));
  const std::size_t n = GENERATE(0, 1, 2, 3, 7, 1000, 20001);
  INFO("kind " << static_cast<int>(kind) << ", n " << n);
  require_family<2>(kind, n);
  require_family<3>(kind, n);
}

TEST_CASE("the random families follow the seed") {
  for (const PointKind kind :
       {PointKind::uniform, PointKind::gaussian, PointKind::clusters, PointKind::sphere}) {
    CHECK(mesher::generate_points<2>(kind, 100, 1) != mesher::generate_points<2>(kind, 100, 2));
  }
}

TEST_CASE("the bits of every family are fixed") {
  CHECK(digest<2>(mesher::generate_points<2>(PointKind::uniform, 1000, 7)) == 0x1c82f7c0bfe614d);
  CHECK(digest<2>(mesher::generate_points<2>(PointKind::gaussian, 1000, 7)) == 0xa9ca2af4058aeb04);
  CHECK(digest<2>(mesher::generate_points<2>(PointKind::clusters, 1000, 7)) == 0x32b562ba57128246);
  CHECK(digest<3>(mesher::generate_points<3>(PointKind::line_circle, 1000, 7)) ==
        0xb17b196a28399749);
  CHECK(digest<3>(mesher::generate_points<3>(PointKind::spiral, 1000, 7)) == 0x8a76001616891620);
}

TEST_CASE("uniform points fill the unit box evenly") {
  const auto points = mesher::generate_points<2>(PointKind::uniform, 40000, 3);
  int quarter[4] = {};
  for (const auto& [x, y] : points) ++quarter[(x < 0.5 ? 0 : 1) + (y < 0.5 ? 0 : 2)];
  for (const int count : quarter) CHECK(std::abs(count - 10000) < 500);  // over 5 deviations
}

TEST_CASE("gaussian points have mean 0, deviation 1 and the normal tails") {
  const auto points = mesher::generate_points<2>(PointKind::gaussian, 50000, 3);
  double sum = 0, squares = 0, beyond_two = 0;
  for (const auto& p : points) {
    for (const double x : p) {
      sum += x;
      squares += x * x;
      beyond_two += std::abs(x) > 2 ? 1 : 0;
    }
  }
  CHECK(sum / 1e5 == Approx(0).margin(0.02));
  CHECK(squares / 1e5 == Approx(1).margin(0.03));
  CHECK(beyond_two / 1e5 == Approx(0.0455).margin(0.005));
}

TEST_CASE("a circle's points are on it to the last bits") {
  const auto points = mesher::generate_points<2>(PointKind::line_circle, 2000, 1);
  for (std::size_t i = 1000; i < points.size(); ++i) {
    const auto& [x, y] = points[i];
    const double angle = 2 * 3.14159265358979323846 * static_cast<double>(i - 1000) / 1000;
    CHECK(x == Approx(std::cos(angle)).margin(1e-14));
    CHECK(y == Approx(std::sin(angle)).margin(1e-14));
    CHECK(std::abs(x * x + y * y - 1) < 1e-15);
  }
}

TEST_CASE("families are named as on the command line") {
  CHECK(mesher::point_kind("line-circle") == PointKind::line_circle);
  CHECK(mesher::point_kind("spiral") == PointKind::spiral);
  CHECK_FALSE(mesher::point_kind("Uniform").has_value());
}

namespace {

// The least distance of two points, of those nearest to 0.
template <int D>
double least_distance(std::vector<Point<D>> points, std::size_t looked_at) {
  const auto square = [](const Point<D>& p, const Point<D>& q) {
    double sum = 0;
    for (int i = 0; i < D; ++i) sum += (p[i] - q[i]) * (p[i] - q[i]);
    return sum;
  };
  std::sort(points.begin(), points.end(),
            [&](const Point<D>& p, const Point<D>& q) { return square(p, {}) < square(q, {}); });
  points.resize(std::min(points.size(), looked_at));
  double least = INFINITY;
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) least = std::min(least, square(points[i], points[k]));
  }
  return std::sqrt(least);
}

template <int D>
void require_spread(std::size_t n) {
  INFO("n " << n << ", dimension " << D);
  const auto points = mesher::generate_points<D>(PointKind::spread, n, 1);
  const double least = least_distance<D>(points, 2000);
  CHECK(2 / least >= 1e12);
  CHECK(2 / least <= 1e14);  // a mesh has room for it
}

}  // namespace

TEST_CASE("distances of the family spread differ by a factor of 10^12, and not by much more") {
  for (const std::size_t n : {100, 1000, 30000, 1000000}) {
    require_spread<2>(n);
    require_spread<3>(n);
  }
}

TEST_CASE("points of the family sphere are on the unit sphere, in all octants") {
  int octants[8] = {};
  for (const auto& p : mesher::generate_points<3>(PointKind::sphere, 8000, 5)) {
    CHECK(std::abs(p[0] * p[0] + p[1] * p[1] + p[2] * p[2] - 1) < 1e-15);
    ++octants[(p[0] < 0 ? 1 : 0) + (p[1] < 0 ? 2 : 0) + (p[2] < 0 ? 4 : 0)];
  }
  for (const int count : octants) CHECK(std::abs(count - 1000) < 160);  // over 5 deviations
}
