// Planes, what is inside, and distances, against the same in the plane and against many places.
#include "space/polygon_shape.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "polygons.hpp"

namespace {

using namespace mesher::detail;
using mesher::Point;
using mesher::SplitMix64;
using support::Loops;
using support::Motion;
using support::polygon_of;
using support::random_motion;
using support::random_star;

const Loops kSquareWithHole = {{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}},
                               {{1, 1, 0}, {2, 1, 0}, {2, 3, 0}, {1, 3, 0}}};

bool same_plane(const Plane& a, const Plane& b) {
  return a.origin == b.origin && a.normal == b.normal && a.eu == b.eu && a.ev == b.ev;
}

// A loop of many corners and maybe a hole around the middle, somewhere in space.
Loops random_loops(SplitMix64& random) {
  Loops loops = {random_star(random, {0, 0}, 1, 3 + random.below(9))};
  if (random.below(2) == 0) loops.push_back(random_star(random, {0, 0}, 0.1, 3 + random.below(4)));
  return loops;
}

// Parity of the edges that a ray to the right crosses, of loops in the plane of z = 0.
bool inside_flat(const Loops& loops, double x, double y) {
  bool inside = false;
  for (const auto& loop : loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Point<3>&a = loop[i], &b = loop[(i + 1) % loop.size()];
      if ((a[1] > y) == (b[1] > y)) continue;
      inside ^= x < a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0]);
    }
  }
  return inside;
}

double from_border(const Loops& loops, const Point<3>& x) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& loop : loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      least = std::min(least, distance2(x, loop[i], loop[(i + 1) % loop.size()]));
    }
  }
  return std::sqrt(least);
}

// The least distance of places of the segments, by golden sections within golden sections.
double searched_distance(const Point<3>& a, const Point<3>& b, const Point<3>& c,
                         const Point<3>& d) {
  double lo = 0, hi = 1;
  const auto at = [&](double t) {
    return std::sqrt(distance2(plus(a, scaled(t, minus(b, a))), c, d));
  };
  for (int i = 0; i < 100; ++i) {
    const double s = lo + (hi - lo) / 3, t = hi - (hi - lo) / 3;
    (at(s) < at(t) ? hi : lo) = at(s) < at(t) ? t : s;
  }
  return at(lo);
}

Point<3> random_place(SplitMix64& random) {
  return {3 * random.unit() - 1.5, 3 * random.unit() - 1.5, 3 * random.unit() - 1.5};
}

}  // namespace

TEST_CASE("A plane and its frame do not depend on how a polygon is entered [C2]") {
  const std::uint64_t seed = GENERATE(1, 2, 3);
  CAPTURE(seed);
  SplitMix64 random(seed);
  for (int round = 0; round < 200; ++round) {
    Loops loops = support::moved(random_loops(random), random_motion(random));
    const Polygon f = polygon_of(loops);
    for (auto& loop : loops) {
      const auto by = static_cast<std::ptrdiff_t>(random.below(loop.size()));
      std::rotate(loop.begin(), loop.begin() + by, loop.end());
      if (random.below(2) == 0) std::reverse(loop.begin(), loop.end());
    }
    const Polygon g = polygon_of(loops);
    REQUIRE(same_plane(f.plane, g.plane));
    REQUIRE(f.places == g.places);
    REQUIRE(f.outline == g.outline);
  }
}

TEST_CASE("Frames are orthogonal, of length one, and hold the corners [C2]") {
  const std::uint64_t seed = GENERATE(1, 2, 3);
  CAPTURE(seed);
  SplitMix64 random(seed);
  for (int round = 0; round < 200; ++round) {
    const Polygon f = polygon_of(support::moved(random_loops(random), random_motion(random)));
    const Plane& p = f.plane;
    for (const auto* e : {&p.normal, &p.eu, &p.ev}) {
      REQUIRE(squared(*e) == Approx(1).epsilon(1e-14));
    }
    REQUIRE(std::abs(dot(p.eu, p.ev)) + std::abs(dot(p.eu, p.normal)) < 1e-15);
    const auto [least, most] = std::minmax_element(p.normal.begin(), p.normal.end());
    REQUIRE(*most >= -*least);  // the largest coordinate is positive
    for (std::size_t i = 0; i < f.places.size(); ++i) {
      REQUIRE(std::sqrt(squared_distance(p.at(f.outline[i]), f.places[i])) < 1e-14);
      REQUIRE(std::abs(p.height(f.places[i])) <= f.thickness);
      REQUIRE(std::sqrt(squared_distance(f.places[i], f.middle)) <= f.reach);
    }
    REQUIRE(is_flat(f));
  }
}

TEST_CASE("The frame of a plane across an axis is of axes, and exact") {
  for (int axis = 0; axis < 3; ++axis) {
    Loops loops = {{{0.1, 0.3, 0.7}, {0.9, 0.3, 0.7}, {0.9, 0.8, 0.7}, {0.1, 0.8, 0.7}}};
    for (Point<3>& p : loops[0]) std::rotate(p.begin(), p.begin() + axis, p.end());
    const Polygon f = polygon_of(loops);
    REQUIRE(deviation(f).height == 0);
    for (const auto* e : {&f.plane.normal, &f.plane.eu, &f.plane.ev}) {
      REQUIRE(std::count(e->begin(), e->end(), 0.0) == 2);
    }
  }
}

TEST_CASE("A polygon is flat up to 1e-8 of its reach, and says where it is least so") {
  const auto bent = [](double by) {
    return polygon_of({{{0, 0, 0}, {1, 0, 0}, {1, 1, by}, {0, 1, 0}}});
  };
  REQUIRE(is_flat(bent(1e-9)));
  REQUIRE_FALSE(is_flat(bent(1e-7)));
  REQUIRE(deviation(bent(0.01)).height > 0.001);
  const Polygon with_inside =
      polygon_of({{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}}, {{0.5, 0.5, -0.25}});
  REQUIRE(deviation(with_inside).height == 0.25);
  REQUIRE(deviation(with_inside).at == Point<3>{0.5, 0.5, -0.25});
}

TEST_CASE("Far from the origin a small polygon is flat up to the rounding of its corners") {
  SplitMix64 random(7);
  const Motion motion = random_motion(random);
  Loops loops = {random_star(random, {0, 0}, 1e-8, 7)};
  REQUIRE(is_flat(polygon_of(support::moved(loops, motion))));
}

TEST_CASE("A polygon without area has no shape") {
  REQUIRE(polygon_of({{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}}).loop_end.empty());
  REQUIRE(polygon_of({{{0, 0, 0}, {1, 0, 0}, {0, 0, 0.5}}}).loop_end.size() == 1);
}

TEST_CASE("What is inside is what is inside in the plane, holes left out, wherever it is moved") {
  const std::uint64_t seed = GENERATE(1, 2, 3);
  CAPTURE(seed);
  SplitMix64 random(seed);
  for (int round = 0; round < 300; ++round) {
    const Loops flat = random_loops(random);
    const Motion motion = random_motion(random);
    const Polygon f = polygon_of(support::moved(flat, motion));
    const Point<3> x{3 * random.unit() - 1.5, 3 * random.unit() - 1.5, 0};
    if (from_border(flat, x) < 1e-9) continue;
    const Point<3> above{x[0], x[1], random.unit()};
    REQUIRE(contains(f, motion(above)) == inside_flat(flat, x[0], x[1]));
  }
}

TEST_CASE("A hole is outside, an island in a hole inside") {
  Loops loops = kSquareWithHole;
  loops.push_back({{1.25, 1.5, 0}, {1.75, 1.5, 0}, {1.75, 2.5, 0}, {1.25, 2.5, 0}});
  const Polygon f = polygon_of(loops);
  REQUIRE(contains(f, Point<3>{0.5, 0.5, 0}));
  REQUIRE_FALSE(contains(f, Point<3>{1.1, 1.1, 0}));
  REQUIRE(contains(f, Point<3>{1.5, 2, 0}));
  REQUIRE_FALSE(contains(f, Point<3>{5, 2, 0}));
}

TEST_CASE("Inward points into the polygon from every edge, of holes and islands as well") {
  SplitMix64 random(3);
  Loops loops = kSquareWithHole;
  loops.push_back({{1.25, 1.5, 0}, {1.75, 1.5, 0}, {1.75, 2.5, 0}, {1.25, 2.5, 0}});
  for (int round = 0; round < 50; ++round) {
    const Polygon f = polygon_of(support::moved(loops, random_motion(random)));
    for (std::uint32_t i = 0; i < f.places.size(); ++i) {
      const Point<3> middle = scaled(0.5, plus(f.places[i], f.places[f.next(i)]));
      REQUIRE(contains(f, plus(middle, scaled(0.01, inward(f, i)))));
      REQUIRE_FALSE(contains(f, minus(middle, scaled(0.01, inward(f, i)))));
    }
  }
}

TEST_CASE("The distance of two segments is the least of their places'") {
  const std::uint64_t seed = GENERATE(1, 2, 3, 4);
  CAPTURE(seed);
  SplitMix64 random(seed);
  for (int round = 0; round < 300; ++round) {
    const auto place = [&] {
      Point<3> p = random_place(random);
      if (random.below(3) == 0) p = {std::round(p[0]), std::round(p[1]), std::round(p[2])};
      return p;
    };
    const Point<3> a = place(), b = place(), c = place(), d = place();
    const double d2 = distance2(a, b, c, d);
    REQUIRE(d2 >= 0);
    REQUIRE(std::sqrt(d2) == Approx(searched_distance(a, b, c, d)).margin(1e-7));
    REQUIRE(std::sqrt(distance2(c, d, b, a)) == Approx(std::sqrt(d2)).margin(1e-12));
  }
}

TEST_CASE("Segments that cross, or are one point, have their distances") {
  REQUIRE(distance2({0, 0, 0}, {2, 2, 0}, {0, 2, 0}, {2, 0, 0}) == 0);
  REQUIRE(distance2({0, 0, 0}, {2, 2, 0}, {0, 2, 1}, {2, 0, 1}) == 1);
  REQUIRE(distance2({1, 1, 1}, {1, 1, 1}, {0, 0, 0}, {0, 0, 0}) == 3);
  REQUIRE(distance2({0, 0, 0}, {1, 0, 0}, {3, 0, 0}, {5, 0, 0}) == 4);
}

TEST_CASE("A place's distance from a polygon is its height over it, else that from its border") {
  const std::uint64_t seed = GENERATE(1, 2, 3);
  CAPTURE(seed);
  SplitMix64 random(seed);
  for (int round = 0; round < 300; ++round) {
    const Loops flat = random_loops(random);
    const Motion motion = random_motion(random);
    const Polygon f = polygon_of(support::moved(flat, motion));
    const Point<3> x = random_place(random);
    const double expected = inside_flat(flat, x[0], x[1]) ? std::abs(x[2]) : from_border(flat, x);
    REQUIRE(std::sqrt(distance2(motion(x), f)) == Approx(expected).margin(1e-9));
    const Point<3> at = motion.back(nearest_place(f, motion(x)));
    REQUIRE(std::sqrt(squared_distance(at, x)) == Approx(expected).margin(1e-9));
    REQUIRE(std::abs(at[2]) < 1e-12);
  }
}

TEST_CASE(
    "A segment's distance from a polygon is at most that of its places, and 0 if it crosses") {
  const std::uint64_t seed = GENERATE(1, 2, 3);
  CAPTURE(seed);
  SplitMix64 random(seed);
  for (int round = 0; round < 200; ++round) {
    const Loops flat = random_loops(random);
    const Motion motion = random_motion(random);
    const Polygon f = polygon_of(support::moved(flat, motion));
    const Point<3> a = random_place(random), b = random_place(random);
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i <= 1000; ++i) {
      least = std::min(least, distance2(motion(plus(a, scaled(i * 1e-3, minus(b, a)))), f));
    }
    const double distance = std::sqrt(distance2(motion(a), motion(b), f));
    REQUIRE(distance <= std::sqrt(least) + 1e-12);
    REQUIRE(distance >= std::sqrt(least) - 5e-3);
    const auto x = crossing(motion(a), motion(b), f);
    REQUIRE((!x || distance == 0));
    if (a[2] * b[2] >= 0) continue;
    const Point<3> flat_x = plus(a, scaled(a[2] / (a[2] - b[2]), minus(b, a)));
    if (from_border(flat, flat_x) < 1e-9) continue;
    REQUIRE(x.has_value() == inside_flat(flat, flat_x[0], flat_x[1]));
  }
}

TEST_CASE("Balls are closed, with a slack of 2^-30 [C5]") {
  REQUIRE(touches(1, 1));
  REQUIRE(touches(1 + 0x1p-31, 1));
  REQUIRE_FALSE(touches(1 + 0x1p-29, 1));
}

TEST_CASE(
    "Labels of places on edges are distances from the nearer end, and places are measured so") {
  Edge e;
  e.place_a = {0.1, 0.2, 0.3};
  e.place_b = {1.1, 0.2, 0.3};
  e.length = 1;
  REQUIRE(place_at(e, Label::start()) == e.place_a);
  REQUIRE(place_at(e, Label::end()) == e.place_b);
  REQUIRE(label_at(e, 0.75) == Label(0.25, true));
  REQUIRE(label_at(e, 0.5) == Label(0.5, false));
  for (const double t : {0.0, 0x1p-40, 0.375, 0.5, 0.625, 1 - 0x1p-40, 1.0}) {
    REQUIRE(from_a(e, label_at(e, t)) == t);
  }
}

TEST_CASE(
    "Pieces of edges are split at the middle of the edge, else at round distances from ends") {
  Edge e;
  e.place_b = {2.9, 0, 0};
  e.length = 2.9;
  REQUIRE(EdgePiece{&e}.middle() == Label(1.45, false));
  const EdgePiece lower{&e, Label::start(), Label(1.45, false)};
  REQUIRE(lower.middle() == Label(0.5, false));
  const EdgePiece upper{&e, Label(1.45, false), Label::end()};
  REQUIRE(upper.middle() == Label(0.5, true));
  REQUIRE(lower < upper);
  REQUIRE(EdgePiece{&e, Label(0.5, true), Label::end()}.middle() == Label(0.25, true));
  REQUIRE(roundest(e, {0.3, 0.31}) == Label(0.875, false));
  REQUIRE(roundest(e, {0.69, 0.7}) == Label(0.875, true));
  REQUIRE(roundest(e, {0.49, 0.52}) == Label(1.45, false));
  REQUIRE_FALSE(roundest(e, {0.3, 0.3 + 0x1p-53}).has_value());
}
