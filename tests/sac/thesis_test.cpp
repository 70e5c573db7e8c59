// The thesis's programs (sac/examples/thesis): after random edits tree and mesh are those of naive
// twins, of a run without a trace and of one from scratch; and what the theorems promise holds.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <utility>
#include <vector>

#include "example_harness.hpp"
#include "thesis_app.hpp"

namespace {

using namespace support;
using thesis::Cell;
using thesis::Point;

// --- Random edits

constexpr int kSizes[] = {0, 40, 14, 6, 3};  // of the first input, by dimension

TEMPLATE_TEST_CASE_SIG("BuildQT and ChooseSteiners, run plainly, give what naive twins give",
                       "[Fig 4.3, 4.7]", ((int D), D), 1, 2, 3, 4) {
  check_example_plain<ThesisApp<D>>(D < 3 ? 100 : D == 3 ? 20 : 8, kSizes[D]);
}

TEMPLATE_TEST_CASE_SIG(
    "BuildQT-Dyn and ChooseSteiners follow random edits: as from scratch, concise and monotone",
    "[Fig 4.4, 4.10, L 4.1.14, L 4.1.19]", ((int D), D), 1, 2, 3, 4) {
  constexpr int kSeeds[] = {0, 12, 6, 4, 2}, kSteps[] = {0, 10, 10, 6, 3};
  check_example<ThesisApp<D>>(kSeeds[D], kSizes[D], kSteps[D]);
}

TEMPLATE_TEST_CASE_SIG("thesis programs under many random edits", "[.soak]", ((int D), D), 1, 2,
                       3) {
  check_example<ThesisApp<D>>(100, 3 * kSizes[D], 40);
}

// --- Theorems

template <int D>
std::vector<Point<D>> random_points(std::uint64_t seed, int n) {
  Random random(seed);
  return ThesisApp<D>::random_input(random, n);
}

// The distance to the k-th nearest of the points, from 1; lfs(x) is that to the second.
template <int D, class Points>
double kth_nearest(const Points& points, const Point<D>& x, std::size_t k) {
  std::vector<double> apart;
  for (const auto& p : points) apart.push_back(std::sqrt(thesis::squared_distance(p, x)));
  std::nth_element(apart.begin(), apart.begin() + static_cast<std::ptrdiff_t>(k - 1), apart.end());
  return apart[k - 1];
}

// Corners and middle of a cell.
template <int D>
std::vector<Point<D>> places_in(const NaiveBuildQT<D>& qt, const Cell<D>& c) {
  std::vector<Point<D>> all(1);
  for (std::size_t i = 0; i < D; ++i) all[0].x[i] = (qt.low(c, i) + qt.high(c, i)) / 2;
  for (unsigned which = 0; which < 1u << D; ++which) {
    Point<D> x;
    for (unsigned i = 0; i < D; ++i) x.x[i] = which >> i & 1 ? qt.high(c, i) : qt.low(c, i);
    all.push_back(x);
  }
  return all;
}

TEMPLATE_TEST_CASE_SIG(
    "a leaf c of BuildQT has |c| / 4 <= lfs <= 6 sqrt(d) |c|, |c| / 2 at its point",
    "[Theorem 4.1.4, L 4.1.3]", ((int D), D), 1, 2, 3) {
  for (std::uint64_t seed = 0; seed < (D == 3 ? 6 : 20); ++seed) {
    const auto points = random_points<D>(seed, 3 + static_cast<int>(seed) * 2);
    const NaiveBuildQT<D> qt(points, 1);
    CAPTURE(seed);
    for (const auto& [c, held] : qt.leaves()) {
      REQUIRE(held.size() <= 1);
      const double side = qt.side(c);
      for (const auto& p : held) REQUIRE(kth_nearest<D>(points, p, 2) >= side / 2);
      for (const auto& x : places_in(qt, c)) {
        const double lfs = kth_nearest<D>(points, x, 2);
        REQUIRE(lfs >= side / 4);
        REQUIRE(lfs <= 6 * std::sqrt(D) * side);
      }
    }
  }
}

// p and q crowd a cell that is as large as the one beside it, whose child beside them is enqueued
// before theirs is split; at its far end lfs is almost six times the side of its children. Lemma
// 4.1.3 forgets that the cell that crowded another may have been split since.
TEST_CASE("the upper bound of Lemma 4.1.3 is 6 sqrt(d) |c|: 4.5 does not hold", "[L 4.1.3]") {
  const std::vector<Point<1>> points{{{0.9375}}, {{0.9375 - 0x1p-12}}};
  const NaiveBuildQT<1> qt(points, 1);
  double most = 0;
  for (const auto& [c, held] : qt.leaves()) {
    for (const auto& x : places_in(qt, c)) {
      most = std::max(most, kth_nearest<1>(points, x, 2) / qt.side(c));
    }
  }
  CHECK(most > 4.5);
  CHECK(most <= 6);
}

// The largest gap ball on v with its centre in the box, over NN(v): by all vertices, the nearest
// first. As far as 16 NN(v).
template <int D>
double aspect_ratio(const std::vector<Point<D>>& vertices, const Point<D>& v) {
  std::vector<std::pair<double, Point<D>>> others;
  for (const auto& u : vertices) {
    if (u != v) others.emplace_back(thesis::squared_distance(u, v), u);
  }
  std::sort(others.begin(), others.end());
  const double nn = std::sqrt(others.front().first);
  thesis::GapBalls<D> gaps(v, 16 * nn, 1);
  for (const auto& [apart2, u] : others) {
    if (apart2 <= 32 * 32 * nn * nn) gaps.cut(u);
  }
  return gaps.largest(0, 16 * nn).value().radius / nn;
}

// Of those whose nearest neighbour comes while they wait the figures' order does not hold.
TEMPLATE_TEST_CASE_SIG(
    "99 of 100 vertices have no gap ball above rho NN(v), and none above 1.5 times", "[Def 4.2.3]",
    ((int D), D), 1, 2, 3, 4) {
  const thesis::Settings settings = ThesisApp<D>::kSettings;
  std::size_t all = 0, incomplete = 0;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    sac::PlainScope scope;
    thesis::PointMesh<sac::PlainScope, D> mesh(scope, settings);
    for (const auto& p : random_points<D>(seed, 2 * kSizes[D])) mesh.insert(p);
    mesh.run();
    const auto vertices = mesh.vertices();
    CAPTURE(seed, vertices.size());
    all += vertices.size();
    for (const auto& v : vertices) {
      const double ratio = aspect_ratio<D>(vertices, v) / settings.rho;
      REQUIRE(ratio <= 1.5);
      if (ratio > 1 + 1e-9) ++incomplete;
    }
  }
  CAPTURE(all, incomplete);
  CHECK(100 * incomplete <= all);
  if (D == 2) CHECK(incomplete > 0);  // Lemma 4.3.1 is not enough for the invariant of §4.3
}

TEMPLATE_TEST_CASE_SIG("lms <= lfs <= 2 (1 + c + rho) lms, c = (rho + 1) / (rho - 1)",
                       "[Theorem 4.2.5]", ((int D), D), 1, 2, 3) {
  const double rho = ThesisApp<D>::kSettings.rho;
  const double high = 2 * (1 + (rho + 1) / (rho - 1) + rho);
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    const auto points = random_points<D>(seed, 2 * kSizes[D]);
    const auto vertices = NaiveChooseSteiners<D>(points, ThesisApp<D>::kSettings).vertices();
    CAPTURE(seed);
    for (const auto& x : random_points<D>(seed + 100, 200)) {
      const double lfs = kth_nearest<D>(points, x, 2), lms = kth_nearest<D>(vertices, x, 2);
      REQUIRE(lms <= lfs);
      REQUIRE(lfs <= high * lms);
    }
  }
}

// --- What is refused, and what stays

TEST_CASE("points nearer than a deepest cell are refused, and what was there stays") {
  sac::Engine engine;
  thesis::PointMesh<sac::Engine, 2> mesh(engine, {});
  mesh.insert({{0.25, 0.25}});
  mesh.insert({{0.75, 0.5}});
  mesh.run();
  const auto before = mesh.vertices();
  mesh.insert({{0.25 + 0x1p-52, 0.25}});
  CHECK_THROWS_AS(engine.propagate(), std::length_error);
  CHECK(mesh.vertices() == before);
  engine.check_invariants();
  mesh.insert({{0.5, 0.5}});
  engine.propagate();
  CHECK(mesh.vertices().size() > before.size());
}

TEST_CASE("memory stays flat over many edits of a thesis mesh") {
  sac::Engine engine;
  thesis::PointMesh<sac::Engine, 2> mesh(engine, {});
  for (const auto& p : random_points<2>(1, 12)) mesh.insert(p);
  mesh.run();
  Random random(2);
  std::size_t at_100 = 0;
  for (int i = 0; i < 400; ++i) {
    const Point<2> p = ThesisApp<2>::random_point(random, {});
    mesh.insert(p);
    engine.propagate();
    mesh.remove(p);
    engine.propagate();
    if (i == 100) at_100 = engine.memory().held();
  }
  CHECK(engine.memory().held() <= at_100 * 3 / 2);
}

}  // namespace
