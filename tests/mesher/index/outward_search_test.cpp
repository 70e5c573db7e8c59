// Searches from a place outward, and what they leave alone.
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <set>
#include <vector>

#include "facade/box_mesher.hpp"
#include "index/quadtree.hpp"
#include "mesher/extra/generate.hpp"

namespace {

using mesher::Point;
using mesher::PointId;
using mesher::SplitMix64;
using mesher::detail::MeshBox;
using mesher::detail::VertexHandle;
using Quadtree = mesher::detail::Quadtree<2>;

const MeshBox<2> kBox{.lo = {-1.5, -1.5}, .side = 4};

// The square relative to the center meets the ball around that.
bool meets_ball(const Point<2>& corner, double side, double radius) {
  double d2 = 0;
  for (const double x : corner) {
    const double beyond = std::max({x, -x - side, 0.0});
    d2 += beyond * beyond;
  }
  return d2 <= radius * radius * (1 + 0x1p-30);
}

double distance(const Point<2>& p, const Point<2>& q) {
  return std::hypot(p[0] - q[0], p[1] - q[1]);
}

struct Tree {
  mesher::detail::VertexPool<2> pool;
  Quadtree tree{kBox, pool};
  std::vector<mesher::detail::Vertex<2>*> all;

  // Places of very different density.
  Tree(SplitMix64& random, int n) {
    for (int i = 0; i < n; ++i) {
      const double scale = std::ldexp(1, -static_cast<int>(random.below(4) * 9));
      const Point<2> p{scale * random.unit(), scale * random.unit()};
      if (tree.find(p) != nullptr) continue;
      all.push_back(&pool.create(p));
      tree.insert(*all.back());
      const Point<2> q = all[random.below(all.size())]->p;
      tree.mark(MeshBox<2>::cell(kBox.fixed(q), static_cast<int>(random.below(35))));
    }
  }
};

}  // namespace

TEST_CASE("an outward search meets once all that is in the ball, but where it has looked before") {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    INFO("seed " << seed);
    SplitMix64 random(seed);
    Tree t(random, 300);
    for (int i = 0; i < 50; ++i) {
      const Point<2> center = t.all[random.below(t.all.size())]->p;
      const double radius = distance(center, t.all[random.below(t.all.size())]->p);
      std::multiset<VertexHandle> met;
      const auto note = [&](const auto& handles, const auto&, std::uint32_t count) {
        met.insert(handles.begin(), handles.begin() + count);
      };
      Quadtree::Looked looked;
      const double r = random.below(2) == 0 ? radius / 5 : 0;
      if (r > 0) {
        REQUIRE(t.tree.visit_box(
            center, {{-r, -r}, {r, r}}, looked, [](const Point<2>&, double) { return true; },
            note));
      }
      t.tree.visit_outward(
          center, {{-radius, -radius}, {radius, radius}}, looked,
          [&](const Point<2>& corner, double side) { return meets_ball(corner, side, radius); },
          note);
      for (const auto* v : t.all) {
        REQUIRE(met.count(v->self) <= 1);
        if (distance(v->p, center) <= radius) REQUIRE(met.contains(v->self));
      }
    }
  }
}

TEST_CASE("an outward search that grows smaller as it goes looks at few of very many") {
  SplitMix64 random(1);
  Tree t(random, 20000);
  for (int i = 0; i < 100; ++i) {
    const Point<2> center{2 * random.unit() - 1, 2 * random.unit() - 1};
    double nearest = 4;  // a search for the nearest vertex
    std::size_t seen = 0;
    t.tree.visit_outward(
        center, {{-4, -4}, {4, 4}}, Quadtree::Looked(),
        [&](const Point<2>& corner, double side) { return meets_ball(corner, side, nearest); },
        [&](const auto&, const auto& places, std::uint32_t count) {
          seen += count;
          for (std::uint32_t k = 0; k < count; ++k) {
            nearest = std::min(nearest, distance(places[k], center));
          }
        });
    double expected = 4;
    for (const auto* v : t.all) expected = std::min(expected, distance(v->p, center));
    REQUIRE(nearest == expected);
    REQUIRE(seen < t.all.size() / 40);
  }
}

TEST_CASE("a box with more cells and vertices than a search may look at is left early") {
  SplitMix64 random(1);
  Tree t(random, 2000);
  std::size_t seen = 0;
  const auto everywhere = [](const Point<2>&, double) { return true; };
  const auto count_up = [&](const auto&, const auto&, std::uint32_t count) { seen += count; };
  Quadtree::Looked looked;
  REQUIRE(!t.tree.visit_box({0, 0}, {{-4, -4}, {4, 4}}, looked, everywhere, count_up, 100));
  CHECK((seen > 0 && seen < 200));
  seen = 0;
  REQUIRE(t.tree.visit_box({0, 0}, {{-4, -4}, {4, 4}}, looked, everywhere, count_up, 100000));
  CHECK(seen == t.all.size());  // nothing was looked at for good before
}

TEST_CASE("what an update looks at beside a far finer part of the mesh does not grow with that") {
  const auto work_beside = [](std::size_t n) {
    mesher::BoxMesher<2> m({.domain = {{0, 0}, {1, 1}}, .record_weights = true});
    std::int64_t id = 1;
    for (const Point<2>& p : mesher::generate_points<2>(mesher::PointKind::uniform, n, 3)) {
      m.insert(PointId{id++}, {0.5 + p[0] / 1024, 0.5 + p[1] / 1024});
    }
    m.update();
    std::uint64_t weight = 0, calls = 0;
    const auto update = [&] {
      const auto counts = m.update().calls;
      weight += counts.weight, calls += counts.executed;
    };
    SplitMix64 random(5);
    for (int i = 0; i < 40; ++i) {
      m.insert(PointId{id}, {random.unit(), random.unit()});
      update();
      m.remove(PointId{id++});
      update();
    }
    return static_cast<double>(weight) / static_cast<double>(calls);
  };
  const double coarse = work_beside(100);
  const double fine = work_beside(10000);
  INFO(coarse << " a call beside 100 points, " << fine << " beside 10000");
  CHECK(coarse < 50);
  CHECK(fine < 100);
}
