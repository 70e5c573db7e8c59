// Triangulations that change: after every edit the one from scratch, whatever went before.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <numeric>
#include <vector>

#include "delaunay_case.hpp"
#include "failing_new.hpp"
#include "mesher/delaunay.hpp"
#include "sac/check.hpp"

namespace {

using mesher::Delaunay;
using mesher::DynamicDelaunay;
using mesher::Point;
using support::Kind;

template <int D>
using Points = std::vector<Point<D>>;

template <int D>
support::PlacedSet<D> set_of(const DynamicDelaunay<D>& t) {
  return support::placed_set<D>(t.simplices(), [&](std::uint32_t v) { return t.place(v); });
}

// A triangulation, and what is in it.
template <int D>
struct Followed {
  DynamicDelaunay<D> t;
  std::map<Point<D>, std::uint32_t> vertices;

  Followed() = default;
  explicit Followed(const Points<D>& points) : t(points) {
    for (std::uint32_t i = 0; i < points.size(); ++i) {
      if (vertices.emplace(points[i], i).second) REQUIRE(t.has(i));
    }
  }
  void insert(const Point<D>& p) {
    const auto [vertex, is_new] = t.insert(p);
    const auto [at, fresh] = vertices.emplace(p, vertex);
    REQUIRE(is_new == fresh);
    REQUIRE(at->second == vertex);
    REQUIRE((t.has(vertex) && t.place(vertex) == p));
  }
  void remove(std::size_t i) {
    const auto at = std::next(vertices.begin(), static_cast<std::ptrdiff_t>(i));
    t.remove(at->second);
    REQUIRE_FALSE(t.has(at->second));
    vertices.erase(at);
  }
  void require_fresh() const {
    t.check_invariants();
    REQUIRE(t.size() == vertices.size());
    Points<D> points;
    for (const auto& [p, v] : vertices) points.push_back(p);
    REQUIRE(set_of<D>(t) == support::fresh_set<D>(points));
  }
};

// run() with its first, second, ... allocation failing, `after` each failure, until none fails.
template <class Make, class Run, class After>
void sweep(Make make, Run run, After after) {
  for (std::uint64_t count = 1;; ++count) {
    auto subject = make();
    bool burnt = false;
    const bool failed = support::fails(count, burnt, [&] { run(subject); });
    if (!burnt) return;
    CAPTURE(count);
    if (failed) after(subject);
  }
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("all orders of a small grid give one triangulation", "[template]",
                       ((int D), D), 2, 3) {
  // 2 x 3 points; in space 2 x 2 x 2 less one, and its middle
  Points<D> points;
  for (int i = 0; i < (D == 2 ? 6 : 7); ++i) {
    Point<D> p;
    for (std::size_t k = 0; k < D; ++k) p[k] = i >> k & 1;
    if (D == 2) p[1] = i / 2;
    points.push_back(p);
  }
  const auto expected = support::fresh_set<D>(points);
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  do {
    DynamicDelaunay<D> t;
    for (const std::size_t i : order) t.insert(points[i]);
    REQUIRE(set_of<D>(t) == expected);
  } while (std::next_permutation(order.begin(), order.end()));
}

TEMPLATE_TEST_CASE_SIG("after random edits it is the one from scratch", "[template]", ((int D), D),
                       2, 3) {
  for (const Kind kind : support::kKinds) {
    for (const std::size_t n : {6u, 15u, 60u}) {
      for (std::uint64_t seed = 1; seed <= 8; ++seed) {
        INFO(support::name(kind) << ", " << n << " points, seed " << seed);
        mesher::SplitMix64 random(seed);
        Followed<D> f;
        // Grows, shrinks to nothing, and again.
        for (std::size_t step = 0; step < 4 * n; ++step) {
          const bool growing = step / n % 2 == 0;
          if (f.vertices.empty() || random.below(5) < (growing ? 4 : 1)) {
            f.insert(support::point_of<D>(kind, n, random));
          } else {
            f.remove(random.below(f.vertices.size()));
          }
          f.require_fresh();
        }
        while (!f.vertices.empty()) {
          f.remove(random.below(f.vertices.size()));
          f.require_fresh();
        }
      }
    }
  }
}

TEMPLATE_TEST_CASE_SIG("many points at once, then edits", "[template]", ((int D), D), 2, 3) {
  for (const Kind kind : support::kKinds) {
    INFO(support::name(kind));
    mesher::SplitMix64 random(4);
    Points<D> points;
    for (int i = 0; i < 500; ++i) points.push_back(support::point_of<D>(kind, 500, random));
    Followed<D> f(points);
    f.require_fresh();
    for (int i = 0; i < 200; ++i) {
      f.insert(support::point_of<D>(kind, 500, random));
      f.remove(random.below(f.vertices.size()));
    }
    f.require_fresh();
  }
}

TEST_CASE("a vertex in the middle of many goes") {
  for (const std::size_t n : {40u, 100u, 700u}) {
    Points<3> points = support::distinct_points<3>(Kind::uniform, n, 3);
    for (auto& p : points) {
      for (double& x : p) x -= 0.5;
      const double r = std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
      for (double& x : p) x /= r;
    }
    points.push_back({0, 0, 0});
    Followed<3> f(points);
    REQUIRE(f.t.neighbours(static_cast<std::uint32_t>(n)).size() == n);
    f.t.remove(static_cast<std::uint32_t>(n));
    f.vertices.erase({0, 0, 0});
    f.require_fresh();
    f.insert({0, 0, 0});
    f.require_fresh();
  }
}

TEMPLATE_TEST_CASE_SIG("neighbours of a vertex are those it shares a simplex with", "[template]",
                       ((int D), D), 2, 3) {
  for (const Kind kind : support::kKinds) {
    Followed<D> f(support::distinct_points<D>(kind, 80, 2));
    f.remove(3);
    std::map<std::uint32_t, std::set<std::uint32_t>> expected;
    for (const auto& [p, v] : f.vertices) expected[v];
    for (const auto& s : f.t.simplices().simplices) {
      for (const auto v : s) {
        for (const auto w : s) {
          if (v != w) expected[v].insert(w);
        }
      }
    }
    for (const auto& [v, around] : expected) {
      CHECK(f.t.neighbours(v) == std::vector<std::uint32_t>(around.begin(), around.end()));
    }
  }
}

TEST_CASE("a number is given again, and what is not there is refused") {
  DynamicDelaunay<2> t;
  CHECK_THROWS_AS(t.remove(0), sac::UsageError);
  for (const Point<2>& p : Points<2>{{0, 0}, {1, 0}, {0, 1}, {1, 1}}) t.insert(p);
  t.remove(2);
  CHECK_FALSE(t.has(2));
  CHECK_FALSE(t.has(UINT32_MAX));
  CHECK_THROWS_AS(t.remove(2), sac::UsageError);
  CHECK_THROWS_AS(t.place(2), sac::UsageError);
  CHECK(t.insert({5, 5}).vertex == 2);
  CHECK_THROWS_AS(t.insert({0x1p200, 0}), mesher::Error);
  CHECK(t.size() == 4);
  t.check_invariants();
}

TEMPLATE_TEST_CASE_SIG("an edit for which memory is missing leaves everything as it was",
                       "[template]", ((int D), D), 2, 3) {
  for (const Kind kind : support::kKinds) {
    INFO(support::name(kind));
    const Points<D> points = support::distinct_points<D>(kind, 40, 6);
    mesher::SplitMix64 random(8);
    for (int i = 0; i < 12; ++i) {
      const auto n = std::min(points.size(), static_cast<std::size_t>(3 + 3 * i));
      const Points<D> some(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(n));
      const Point<D> p = support::point_of<D>(kind, 40, random);
      const auto make = [&] { return Followed<D>(some); };
      const auto unchanged = [&](const Followed<D>& f) { f.require_fresh(); };
      sweep(
          make, [&](Followed<D>& f) { f.t.insert(p); }, unchanged);
      const std::uint32_t v = static_cast<std::uint32_t>(random.below(some.size()));
      sweep(
          make, [&](Followed<D>& f) { f.t.remove(v); }, unchanged);
    }
    bool burnt = true;
    for (std::uint64_t count = 1; burnt; ++count) {
      support::fails(count, burnt, [&] { static_cast<void>(DynamicDelaunay<D>(points)); });
      if (burnt) {
        support::fails(count, burnt, [&] { static_cast<void>(mesher::delaunay<D>(points)); });
        burnt = true;
      }
    }
  }
}
