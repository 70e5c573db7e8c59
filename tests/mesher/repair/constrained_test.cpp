// Triangulations with given edges: they have these, cover what they should, and are as near to
// Delaunay as they can be.
#include "repair/constrained.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "mesher/extra/generate.hpp"
#include "mesher/predicates.hpp"

namespace {

using mesher::Point;
using mesher::detail::Constrained;
using mesher::detail::link;
using mesher::detail::Links;
using mesher::detail::loops_around;
using Places = std::vector<Point<2>>;
using Triangle = Constrained::Triangle;

double area(const Triangle& t, const Places& p) {
  const auto &a = p[t[0]], &b = p[t[1]], &c = p[t[2]];
  return ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2;
}

double area(const std::vector<std::vector<Triangle>>& parts, const Places& p) {
  double sum = 0;
  for (const auto& part : parts) {
    for (const Triangle& t : part) {
      REQUIRE(area(t, p) > 0);
      sum += area(t, p);
    }
  }
  return sum;
}

Links ring(std::uint32_t from, std::uint32_t n) {
  Links links;
  for (std::uint32_t i = 0; i < n; ++i) links.insert(link(from + i, from + (i + 1) % n));
  return links;
}

// Everything is an edge of the triangles, and no triangle that can be is not Delaunay.
void require_constrained(const std::vector<std::vector<Triangle>>& parts, const Links& given,
                         const Places& p) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> apexes;
  for (const auto& part : parts) {
    for (const Triangle& t : part) {
      for (std::size_t i = 0; i < 3; ++i) {
        REQUIRE(apexes.emplace(std::pair(t[i], t[(i + 1) % 3]), t[(i + 2) % 3]).second);
      }
    }
  }
  for (const auto& [a, b] : given) REQUIRE(apexes.count({a, b}) + apexes.count({b, a}) > 0);
  for (const auto& [edge, apex] : apexes) {
    const auto [u, w] = edge;
    const auto other = apexes.find({w, u});
    if (other == apexes.end() || given.count(link(u, w)) > 0) continue;
    REQUIRE(mesher::predicates::incircle(p[u], p[w], p[apex], p[other->second]) <= 0);
  }
}

}  // namespace

TEST_CASE("a square with a hole and a crack inside is triangulated in one part") {
  const Places p{{0, 0}, {4, 0}, {4, 4}, {0, 4}, {1, 1}, {2, 1}, {2, 2}, {1, 2}, {3, 1}, {3, 3}};
  Constrained t(p);
  Links borders = ring(0, 4);
  borders.merge(ring(4, 4));
  for (const auto& [a, b] : borders) REQUIRE(t.add(a, b));
  REQUIRE(t.add(8, 9));
  t.settle();
  const auto parts = t.inside(borders);
  REQUIRE(parts.size() == 1);
  REQUIRE(area(parts, p) == 15);
  auto given = borders;
  given.insert(link(8, 9));
  require_constrained(parts, given, p);
  const auto loops = loops_around(parts[0], borders, p);
  REQUIRE(loops.size() == 2);
  REQUIRE(std::set<std::uint32_t>(loops[0].begin(), loops[0].end()) ==
          std::set<std::uint32_t>{0, 1, 2, 3});
}

TEST_CASE(
    "loops that touch are parted where what they go around is, and cut at points they share") {
  // A bow-tie around 0, and a square with a hole that touches it in a corner.
  const Places tie{{0, 0}, {2, -1}, {2, 1}, {-2, 1}, {-2, -1}};
  Constrained t(tie);
  const Links borders{{0, 1}, {1, 2}, {0, 2}, {0, 3}, {3, 4}, {0, 4}};
  for (const auto& [a, b] : borders) REQUIRE(t.add(a, b));
  const auto parts = t.inside(borders);
  REQUIRE(parts.size() == 2);
  REQUIRE(area(parts, tie) == 4);

  const Places square{{0, 0}, {4, 0}, {4, 4}, {0, 4}, {2, 1}, {1, 2}};
  Constrained u(square);
  Links around = ring(0, 4);
  around.insert({{0, 4}, {4, 5}, {0, 5}});
  for (const auto& [a, b] : around) REQUIRE(u.add(a, b));
  const auto part = u.inside(around);
  REQUIRE(part.size() == 1);
  const auto loops = loops_around(part[0], around, square);
  REQUIRE(loops.size() == 2);
  REQUIRE(loops[0].size() == 4);
  REQUIRE(loops[1].size() == 3);
}

TEST_CASE("an edge through a point, or across one that stays, is refused") {
  const Places p{{0, 0}, {4, 0}, {4, 4}, {0, 4}, {2, 2}};
  Constrained t(p);
  REQUIRE_FALSE(t.add(0, 2));
  Constrained u({{0, 0}, {4, 0}, {4, 4}, {0, 4}});
  REQUIRE(u.add(0, 2));
  REQUIRE_FALSE(u.add(1, 3));
}

TEST_CASE("random stars get random edges, and are covered") {
  mesher::SplitMix64 random(7);
  for (int round = 0; round < 200; ++round) {
    Places p;
    const auto n = static_cast<std::uint32_t>(3 + random.below(30));
    for (std::uint32_t i = 0; i < n; ++i) {
      const double r = 0.2 + random.unit(), at = 6.283185307179586 * i / n;
      p.push_back({r * std::cos(at), r * std::sin(at)});
    }
    double expected = 0;
    for (std::uint32_t i = 0; i < n; ++i) {
      const auto &a = p[i], &b = p[(i + 1) % n];
      expected += (a[0] * b[1] - a[1] * b[0]) / 2;
    }
    for (std::uint64_t k = random.below(20); k > 0; --k) {
      p.push_back({0.1 * random.unit(), 0.1 * random.unit()});
    }
    Constrained t(p);
    const Links borders = ring(0, n);
    for (const auto& [a, b] : borders) REQUIRE(t.add(a, b));
    Links given = borders;
    if (p.size() > n + 1 && t.add(n, n + 1)) given.insert(link(n, n + 1));
    t.settle();
    const auto parts = t.inside(borders);
    REQUIRE(parts.size() == 1);
    REQUIRE(area(parts, p) == Approx(expected));
    require_constrained(parts, given, p);
    REQUIRE(loops_around(parts[0], borders, p).size() == 1);
  }
}
