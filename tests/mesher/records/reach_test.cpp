// Boxes around vertices and cells: what they are made from is in them, at any scale.
#include "records/reach.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "edit_sequence.hpp"
#include "index/quadtree.hpp"

namespace {

using mesher::Box;
using mesher::Point;
using mesher::SplitMix64;
using mesher::detail::Area;
using mesher::detail::MeshBox;
using mesher::detail::Quadtree;
using mesher::detail::Reach;
using mesher::detail::Vertex;
using mesher::detail::VertexPool;

template <int D>
Box<D> random_box(SplitMix64& random) {
  const double scale = std::ldexp(1, -static_cast<int>(random.below(60)));
  const auto length = [&] { return random.below(5) == 0 ? 0 : scale * random.unit(); };
  Box<D> box;
  for (int i = 0; i < D; ++i) {
    box.lo[i] = -length();
    box.hi[i] = length();
  }
  return box;
}

template <int D>
bool is_within(const Box<D>& inner, const Box<D>& outer) {
  bool within = true;
  for (int i = 0; i < D; ++i) {
    within = within && inner.lo[i] >= outer.lo[i] && inner.hi[i] <= outer.hi[i];
  }
  return within;
}

template <int D>
double farthest(const Box<D>& box) {
  double most = 0;
  for (int i = 0; i < D; ++i) most = std::max({most, -box.lo[i], box.hi[i]});
  return most;
}

template <int D>
void check_reaches() {
  SplitMix64 random(11);
  INFO("seed 11");
  for (int i = 0; i < 20000; ++i) {
    const Box<D> box = random_box<D>(random);
    const Reach<D> reach(box);
    REQUIRE(is_within(box, reach.box()));
    REQUIRE((reach.contains(box.lo) && reach.contains(box.hi)));
    // Not much larger: a side goes up to the next unit, of which the farthest is half of kParts.
    const double unit = farthest(box) / (Reach<D>::kParts / 2);
    REQUIRE((reach.most() >= farthest(box) && reach.most() <= 2 * farthest(box)));
    for (int k = 0; k < D; ++k) {
      REQUIRE(-reach.box().lo[k] + box.lo[k] <= unit);
      REQUIRE(reach.box().hi[k] - box.hi[k] <= unit);
    }
    REQUIRE(Reach<D>(reach.box()) == reach);
    const double r = farthest(box);
    REQUIRE(Reach<D>::around(r).covers(Reach<D>::around(r / 2)));
    REQUIRE(Reach<D>::around(r).covers(reach));
  }
  for (int i = 0; i < 2000; ++i) {
    std::vector<Reach<D>> all;
    while (all.size() < 4) all.emplace_back(random_box<D>(random));
    Reach<D> forth, back;
    for (const auto& r : all) forth.include(r);
    std::reverse(all.begin(), all.end());
    for (const auto& r : all) back.include(r);
    REQUIRE(forth == back);
    for (const auto& r : all) REQUIRE(forth.covers(r));
    all.pop_back();
    Reach<D> fewer;
    for (const auto& r : all) fewer.include(r);
    REQUIRE(forth.covers(fewer));
  }
  REQUIRE(Reach<D>().contains(Point<D>{}));
  Point<D> beside{};
  beside[0] = 0x1p-100;
  REQUIRE_FALSE(Reach<D>().contains(beside));
}

}  // namespace

TEST_CASE("a reach holds what it is made from and little more, and several come in any order") {
  SECTION("in the plane") { check_reaches<2>(); }
  SECTION("in space") { check_reaches<3>(); }
}

TEST_CASE("an area holds what lies in it, in the cell and in all cells above") {
  SplitMix64 random(12);
  INFO("seed 12");
  for (int i = 0; i < 5000; ++i) {
    Point<2> u{random.unit(), random.unit()};
    const double across = std::ldexp(1, static_cast<int>(random.below(51)));
    const Box<2> box = random_box<2>(random);
    Area<2> area(u, box, across);
    Point<2> inside = u;
    for (std::size_t k = 0; k < 2; ++k) {
      inside[k] += across * (box.lo[k] + random.unit() * (box.hi[k] - box.lo[k]));
    }
    REQUIRE_FALSE(Area<2>().contains(inside, 0));
    REQUIRE((area.covers(Area<2>()) && !Area<2>().covers(area)));
    for (int level = 0; level < 50; ++level) {
      REQUIRE(area.contains(inside, 0x1p-40 * (1 + std::abs(inside[0]) + std::abs(inside[1]))));
      const int c = static_cast<int>(random.below(4));
      for (std::size_t k = 0; k < 2; ++k) inside[k] = (inside[k] + (c >> k & 1)) / 2;
      area = area.in_parent(c);
      REQUIRE_FALSE(Area<2>().in_parent(c).contains(inside, 0));
    }
  }
}

// Clusters of clusters: cells of all levels, with queries that look far beyond them and not at all.
TEST_CASE(
    "queries in the smallest of cells are found by where they look, and few cells are asked") {
  const MeshBox<2> box{.lo = {-16, -16}, .side = 32};
  SplitMix64 random(13);
  INFO("seed 13");
  VertexPool<2> pool;
  Quadtree<2> tree(box, pool);
  std::vector<Vertex<2>*> all;
  const auto place = [&] {
    const double scale = std::ldexp(1, -static_cast<int>(random.below(44)));
    return Point<2>{scale * random.unit(), scale * random.unit()};
  };
  for (int i = 0; i < 1500; ++i) {
    const Point<2> p = place();
    if (tree.find(p) != nullptr) continue;
    Vertex<2>& v = pool.create(p);
    tree.insert(v);
    v.reach = Reach<2>(random_box<2>(random));
    tree.raise_reach(v);
    all.push_back(&v);
  }
  tree.check_invariants();
  int met = 0;
  for (int i = 0; i < 3000; ++i) {
    const Point<2> p = place();
    std::vector<const Vertex<2>*> found;
    tree.visit_reaching(p, [&](const Vertex<2>& v, const auto&) { found.push_back(&v); });
    for (const auto* v : all) {
      const Point<2> d{(p[0] - v->p[0]) / 32, (p[1] - v->p[1]) / 32};
      REQUIRE(std::count(found.begin(), found.end(), v) == (v->reach.contains(d) ? 1 : 0));
    }
    met += static_cast<int>(found.size());
    auto& v = *all[random.below(all.size())];
    v.reach = Reach<2>(random_box<2>(random));
    tree.raise_reach(v);
    if (i % 100 == 0) tree.check_invariants();
  }
  CHECK(met > 3000);
}
