// Trees of a polygon's edges: they say what a look at all edges says, bit for bit, and look at few.
#include "space/edge_tree.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "nasty_polygons.hpp"

namespace {

using namespace mesher::detail;
using mesher::Point;
using mesher::SplitMix64;
using support::Loops;
using support::polygon_of;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double next_to(SplitMix64& random, double x) {
  return std::nextafter(x, random.below(2) == 0 ? -kInfinity : kInfinity);
}

// A place where it is hard to say what is so: on, at, beside or in line with the border, or far.
Point<2> hard_place(SplitMix64& random, const Polygon& f) {
  const auto i = static_cast<std::uint32_t>(random.below(f.outline.size()));
  const Point<2>&a = f.outline[f.previous(i)], &b = f.outline[i];
  const double t = random.below(3) == 0 ? 0.5 : 3 * random.unit() - 1;
  const Point<2> along{a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])};
  switch (random.below(8)) {
    case 0:
      return b;
    case 1:
      return along;
    case 2:
      return {next_to(random, b[0]), next_to(random, b[1])};
    case 3:
      return {next_to(random, along[0]), along[1]};
    case 4:
      return {3 * random.unit() - 1.5, b[1]};
    case 5: {
      const double far = std::ldexp(random.unit(), static_cast<int>(random.below(300)));
      return {far * (random.unit() - 0.5), random.below(2) == 0 ? b[1] : far};
    }
    default:
      return {3 * random.unit() - 1.5, 3 * random.unit() - 1.5};
  }
}

// Of loops in the plane z = 0, somewhere, perhaps with corners that are off the plane.
Polygon somewhere(SplitMix64& random, Loops loops) {
  if (random.below(3) == 0) {
    const double off = std::ldexp(1.0, -4 * static_cast<int>(random.below(10)) - 4);
    for (auto& loop : loops) {
      for (Point<3>& p : loop) p[2] = off * random.unit();
    }
  }
  return polygon_of(random.below(4) == 0 ? loops
                                         : support::moved(loops, support::random_motion(random)));
}

}  // namespace

TEST_CASE("What loops are around a place is what a look at all edges says, of any loops") {
  const std::uint64_t seed = GENERATE(1, 2, 3, 4, 5);
  CAPTURE(seed);
  SplitMix64 random(seed);
  int inside = 0;
  for (int round = 0; round < 300; ++round) {
    const Polygon f = somewhere(random, support::nasty_loops(random));
    if (f.loop_end.empty()) continue;  // no area
    for (int ask = 0; ask < 60; ++ask) {
      const Point<2> uv = hard_place(random, f);
      REQUIRE(contains(f, uv) == support::naive::contains(f, uv));
      const std::size_t loop = random.below(f.loop_end.size());
      REQUIRE(loop_contains(f, loop, uv) == support::naive::is_around(f, uv, loop, loop + 1));
      inside += contains(f, uv);
    }
  }
  CHECK(inside > 3000);
}

TEST_CASE("Places that are no numbers, or infinite, are where a look at all edges says") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Polygon f = polygon_of({support::comb(200, 0.3)});
  for (const double u : {nan, kInfinity, -kInfinity, 0.1}) {
    for (const double v : {nan, kInfinity, -kInfinity, 0.1}) {
      REQUIRE(contains(f, Point<2>{u, v}) == support::naive::contains(f, {u, v}));
    }
  }
}

TEST_CASE("Distances and nearest places are those of a look at all edges, bit for bit") {
  const std::uint64_t seed = GENERATE(1, 2, 3, 4, 5);
  CAPTURE(seed);
  SplitMix64 random(seed);
  for (int round = 0; round < 200; ++round) {
    const Polygon f = somewhere(random, support::nasty_loops(random));
    if (f.loop_end.empty()) continue;
    for (int ask = 0; ask < 40; ++ask) {
      const double height = std::ldexp(random.unit(), -4 * static_cast<int>(random.below(14)));
      const Point<3> x = plus(f.plane.at(hard_place(random, f)), scaled(height, f.plane.normal));
      const double expected = support::naive::distance2(f, x);
      REQUIRE(distance2(x, f) == expected);
      for (const double most2 : {expected, std::nextafter(expected, 0), 2 * random.unit()}) {
        REQUIRE(is_within(x, f, most2) == (expected <= most2));
      }
      if (contains(f, x)) continue;
      REQUIRE(nearest_place(f, x) == support::naive::nearest_on_border(f, x).at);
    }
  }
}

TEST_CASE("What lies on a polygon is found by its distance from a place, all of it") {
  const std::uint64_t seed = GENERATE(1, 2, 3);
  CAPTURE(seed);
  SplitMix64 random(seed);
  for (int round = 0; round < 100; ++round) {
    std::vector<Point<3>> inside;
    for (std::uint64_t i = random.below(60); i-- > 0;) {
      inside.push_back({random.unit(), random.unit(), 0});
    }
    Polygon f = polygon_of(support::nasty_loops(random), inside);
    if (f.loop_end.empty()) continue;
    for (std::uint32_t i = 0; i < f.places.size(); ++i) f.edges.push_back(i), f.corners[i] = i;
    for (std::uint32_t i = 0; i < inside.size(); ++i) f.inner_points.push_back(1000 + i);
    const auto at = [&](VertexHandle v) { return v < 1000 ? f.places[v] : inside[v - 1000]; };
    for (int ask = 0; ask < 30; ++ask) {
      const Point<3> x{random.unit(), random.unit(), 0.1 * random.unit()};
      const double radius = 0.5 * random.unit() * random.unit();
      std::set<EdgeHandle> edges;
      visit_edges_near(f, x, radius, [&](EdgeHandle e) { return edges.insert(e), false; });
      for (std::uint32_t i = 0; i < f.places.size(); ++i) {
        const double d2 = distance2(x, f.places[i], f.places[f.next(i)]);
        if (d2 <= radius * radius) REQUIRE(edges.count(i) == 1);
      }
      std::set<VertexHandle> points, shell;
      visit_points_near(f, x, radius, [&](VertexHandle v) { return points.insert(v), false; });
      const VertexHandle some = random.below(2) == 0 || inside.empty() ? 0u : 1000u;
      const double away = std::sqrt(squared_distance(at(some), x));
      visit_points_at(f, x, away, [&](VertexHandle v) { return shell.insert(v), false; });
      REQUIRE(shell.count(some) == 1);
      const auto look = [&](VertexHandle v) {
        if (squared_distance(at(v), x) <= radius * radius) REQUIRE(points.count(v) == 1);
      };
      for (const VertexHandle v : f.corners) look(v);
      for (const VertexHandle v : f.inner_points) look(v);
    }
  }
}

namespace {

// The edges and boxes that a question looks at, in the mean, among about n corners.
struct Looks {
  double around = 0, nearest = 0, ball = 0;
};
Looks looks_of(const Loops& loops) {
  SplitMix64 random(9);
  Polygon f = polygon_of(support::moved(loops, support::random_motion(random)));
  std::uint64_t count = 0;
  f.outline_tree.count_in(count);
  const auto counted = [&](auto&& ask) {
    const std::uint64_t before = count;
    ask();
    return static_cast<double>(count - before);
  };
  constexpr int kAsks = 400;
  Looks looks;
  for (int i = 0; i < kAsks; ++i) {
    const auto corner = static_cast<std::uint32_t>(random.below(f.places.size()));
    const Point<2> uv{f.bounds.lo[0] + random.unit() * (f.bounds.hi[0] - f.bounds.lo[0]),
                      f.bounds.lo[1] + random.unit() * (f.bounds.hi[1] - f.bounds.lo[1])};
    const Point<3> x = f.plane.at(uv), beside = plus(f.places[corner], scaled(1e-4, f.plane.eu));
    looks.around += counted([&] { static_cast<void>(contains(f, uv)); }) / kAsks;
    looks.nearest += counted([&] { static_cast<void>(nearest_place(f, x)); }) / kAsks;
    looks.ball +=
        counted([&] { visit_edges_near(f, beside, 1e-5, [](EdgeHandle) { return false; }); }) /
        kAsks;
  }
  return looks;
}

}  // namespace

TEST_CASE("Questions about a polygon look at few of its edges, with 100 corners and with 10000") {
  const auto family = GENERATE(0, 1, 2, 3);
  CAPTURE(family);
  const auto loops_of = [&](std::size_t n) -> Loops {
    if (family == 0) return {support::bean(n, {0, 0}, 1)};
    if (family == 1) return {support::comb(n, 0.4)};
    if (family == 2) return support::sieve(n);
    return {support::bean(n / 2, {0, 0}, 1), support::bean(n / 2, {0, 0}, 0.99)};
  };
  const Looks few = looks_of(loops_of(100)), many = looks_of(loops_of(10000));
  CAPTURE(few.around, many.around, few.nearest, many.nearest, few.ball, many.ball);
  const double more = 8 * std::log2(100.0);  // some boxes and edges for each level
  CHECK(many.around < few.around + more);
  CHECK(many.nearest < few.nearest + 2 * more);
  CHECK(many.ball < few.ball + more);
}

TEST_CASE("Finding the shape of a polygon of many loops looks at some edges for each") {
  const auto looked_at = [](std::size_t n) {
    std::uint64_t count = 0;
    Polygon f;
    f.outline_tree.count_in(count);
    for (const auto& loop : support::sieve(n)) {
      f.places.insert(f.places.end(), loop.begin(), loop.end());
      f.loop_end.push_back(static_cast<std::uint32_t>(f.places.size()));
    }
    REQUIRE(find_shape(f));
    return static_cast<double>(count) / static_cast<double>(f.loop_end.size());
  };
  const double few = looked_at(400), many = looked_at(40000);
  CAPTURE(few, many);
  CHECK(many < 2 * few);
}
