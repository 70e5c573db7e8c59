// Scores of tetrahedra by dihedral angles, and places for vertices.
#include "rules/sliver_rule.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "geometry/space_vectors.hpp"
#include "mesher/extra/generate.hpp"
#include "rules/mesh_box.hpp"

namespace {

using mesher::Point;
using mesher::detail::MeshBox;
using mesher::detail::minus;
using mesher::detail::SliverRule;
using mesher::detail::squared_distance;

using Corners = std::array<Point<3>, 4>;

double score(const Corners& c) { return SliverRule::score({&c[0], &c[1], &c[2], &c[3]}); }

// In degrees.
double least_angle(const Corners& c) {
  return std::asin(std::sqrt(1 - score(c))) * (180 / std::numbers::pi);
}

}  // namespace

TEST_CASE("a score says the smallest dihedral angle, in whatever order the corners come") {
  const Corners regular{{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}};
  CHECK(score(regular) == Approx(1.0 / 9));
  const Corners corner{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  CHECK(least_angle(corner) == Approx(std::acos(1 / std::sqrt(3.0)) * 180 / std::numbers::pi));
  // Two edges of length 2, h apart, at a right angle: at each of them the angle is 2 atan(h).
  const double h = 0.01;
  const Corners sliver{{{-1, 0, 0}, {1, 0, 0}, {0, -1, h}, {0, 1, h}}};
  CHECK(score(sliver) > score(corner));
  const Corners flat{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}};
  CHECK(score(flat) == 1);
  CHECK(score({{{0, 0, 0}, {0, 0, 0}, {0, 1, 0}, {0, 0, 1}}}) == 1);
  CHECK(score({{{1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}}}) == 1);
  for (const int power : {-1000, -540, -140, -100, 0, 100, 250}) {
    Corners scaled = sliver;
    for (auto& p : scaled) {
      for (double& x : p) x = std::scalbn(x, power);
    }
    CHECK(score(scaled) == score(sliver));
  }

  mesher::SplitMix64 random(5);
  for (int i = 0; i < 200; ++i) {
    Corners c;
    for (auto& p : c) p = {random.unit(), random.unit(), random.unit() * (i % 2 == 0 ? 1 : 1e-6)};
    const double first = score(c);
    const SliverRule rule(
        mesher::detail::mesh_box(mesher::Options<3>{.domain = {{0, 0, 0}, {1, 1, 1}}}), 12);
    const bool good = rule.is_surely_good(minus(c[1], c[0]), minus(c[2], c[0]), minus(c[3], c[0]));
    CHECK((good ? first < rule.worst() : first > rule.worst() - 1e-3));
    std::sort(c.begin(), c.end());
    do {
      REQUIRE(score(c) == first);
    } while (std::next_permutation(c.begin(), c.end()));
  }
}

TEST_CASE("places are points of a lattice, in the ball and not beside the box") {
  const MeshBox<3> box = mesher::detail::mesh_box(
      mesher::Options<3>{.domain = {{0, 0, 0}, {1, 1, 1}}, .min_dihedral = 10});
  const SliverRule rule(box, 10);
  CHECK(rule.any());
  CHECK_FALSE(SliverRule(box, 0).any());
  CHECK(SliverRule(box, 15).most() > rule.most());
  CHECK(SliverRule(box, 15).worst() < rule.worst());
  mesher::SplitMix64 random(7);
  std::size_t least = std::numeric_limits<std::size_t>::max();
  for (int i = 0; i < 200; ++i) {
    const Point<3> centre{random.unit(), random.unit(), random.unit()};
    const double radius = std::pow(2, -1 - 10 * random.unit());
    std::vector<Point<3>> places;
    rule.for_each_place(centre, radius * radius, [&](const Point<3>& p, double off2) {
      CHECK(off2 == squared_distance(p, centre));
      CHECK(off2 < radius * radius);
      places.push_back(p);
    });
    least = std::min(least, places.size());
    // A ball that is moved by rounding has the same places.
    std::vector<Point<3>> again;
    Point<3> beside = centre;
    beside[0] = std::nextafter(beside[0], 1);
    rule.for_each_place(beside, radius * radius,
                        [&](const Point<3>& p, double) { again.push_back(p); });
    CHECK(again == places);
  }
  CHECK(least >= 8);
  // On a grid each place is half a step of it from the next one along some axis.
  std::vector<Point<3>> near;
  rule.for_each_place({0.5, 0.5, 0.5}, 1.0 / 16,
                      [&](const Point<3>& p, double) { near.push_back(p); });
  for (const auto& p : near) {
    for (const double x : p) CHECK(std::fmod(x - box.lo[0], 0.0625) == 0);
  }
  std::size_t beside = 0;
  rule.for_each_place({box.lo[0], 0.5, 0.5}, 1.0 / 16, [&](const Point<3>&, double) { ++beside; });
  CHECK(beside == 0);
}
