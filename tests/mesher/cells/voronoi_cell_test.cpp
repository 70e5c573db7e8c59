// The clipped Voronoi cell against brute force in exact arithmetic, in any order of cuts.
#include "cells/voronoi_cell.hpp"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <vector>

#include "cell_scene.hpp"
#include "mesher/extra/generate.hpp"
#include "mesher/predicates.hpp"

namespace {

using mesher::Point;
using mesher::SplitMix64;
using mesher::detail::Vertex;
using mesher::detail::VertexHandle;
using mesher::detail::VoronoiCell;

using Ring = std::vector<std::uint32_t>;  // codes counterclockwise, the smallest first

Ring canonical(Ring ring) {
  std::rotate(ring.begin(), std::min_element(ring.begin(), ring.end()), ring.end());
  return ring;
}

Ring ring_of(const VoronoiCell& cell) {
  Ring ring;
  for (int i = 0; i < cell.size(); ++i) ring.push_back(cell.code(i));
  return canonical(ring);
}

using Scene = CellScene<2>;
using Site = Scene::Site;

// The star of v among `sites` by the definition: (a, b) follow each other if no other site is
// inside the circle of v, a, b.
Ring brute_force(const Point<2>& v, const std::vector<Site>& sites) {
  std::map<std::uint32_t, std::uint32_t> next;
  for (const Site& a : sites) {
    for (const Site& b : sites) {
      if (a.code == b.code || mesher::predicates::orient2d(v, a.p, b.p) <= 0) continue;
      const bool empty = std::none_of(sites.begin(), sites.end(), [&](const Site& c) {
        return c.code != a.code && c.code != b.code &&
               mesher::predicates::incircle_perturbed(v, a.p, b.p, c.p) > 0;
      });
      if (!empty) continue;
      REQUIRE(next.emplace(a.code, b.code).second);
    }
  }
  Ring ring;
  std::uint32_t code = next.begin()->first;
  do {
    ring.push_back(code);
    code = next.at(code);
  } while (code != ring.front() && ring.size() <= next.size());
  REQUIRE(ring.size() == next.size());
  return canonical(ring);
}

enum class Kind { uniform, lattice, circle, line, near_circle, on_clip, kinds };

Scene make_scene(SplitMix64& random, Kind kind) {
  Scene scene;
  const double unit = std::ldexp(1.0, -static_cast<int>(random.below(30)));
  const auto at = [&](double x, double y) { scene.add({0.375 + unit * x, -0.25 + unit * y}); };
  const std::size_t n = 1 + random.below(24);
  at(0, 0);
  scene.radius = unit * (0.5 + 4 * random.unit());
  // Integer points on one circle around the origin, radius^2 = 325.
  constexpr int kOnCircle[][2] = {{1, 18}, {6, 17}, {10, 15}, {15, 10}, {17, 6}, {18, 1}};
  for (std::size_t i = 0; i < n; ++i) {
    const auto small = [&] { return static_cast<double>(random.below(9)) - 4; };
    const auto sign = [&] { return random.below(2) == 0 ? 1.0 : -1.0; };
    switch (kind) {
      case Kind::uniform:
        at(8 * random.unit() - 4, 8 * random.unit() - 4);
        break;
      case Kind::lattice:
        at(small(), small());
        break;
      case Kind::circle:
      case Kind::near_circle: {  // around (1, 2), through v if i is even
        const auto& c = kOnCircle[random.below(6)];
        double x = sign() * c[0], y = sign() * c[1];
        x = (x + 18) / 8, y = (y + 1) / 8;
        if (kind == Kind::near_circle) x = std::nextafter(x, sign() * 100);
        at(x, y);
        break;
      }
      case Kind::line:
        random.below(3) == 0 ? at(small(), small() / 2) : at(small(), 2 * (random.below(2) + 0.0));
        break;
      case Kind::on_clip: {
        VoronoiCell clip;
        clip.reset(*scene.v, scene.radius);
        scene.add(random.below(2) == 0
                      ? clip.place(static_cast<int>(random.below(8)))
                      : Point<2>{scene.v->p[0] + unit * small(), scene.v->p[1] + unit * small()});
        break;
      }
      case Kind::kinds:
        break;
    }
  }
  return scene;
}

}  // namespace

TEST_CASE(
    "a cell is that of brute force with exact signs, whatever the order of cuts; ties included") {
  SplitMix64 random(31);
  INFO("seed 31");
  VoronoiCell cell;
  for (int i = 0; i < 3000; ++i) {
    const auto kind = static_cast<Kind>(i % static_cast<int>(Kind::kinds));
    INFO("scene " << i);
    Scene scene = make_scene(random, kind);
    const Ring expected = brute_force(scene.v->p, scene.sites());
    for (int order = 0; order < 4; ++order) {
      scene.shuffle(random);
      scene.cut_by_all(cell);
      REQUIRE(ring_of(cell) == expected);
      for (const auto* w : scene.others) REQUIRE_FALSE(cell.cuts(w->p));  // once is enough
    }
    for (int k = 0; k < cell.size(); ++k) {
      CHECK(cell.corner2(k) <= cell.reach2());
      CHECK(cell.corner2(k) <= 1.2 * scene.radius * scene.radius);
    }
  }
}

TEST_CASE("a new vertex that cuts is in reach, in an entered square, and may_cut says so") {
  SplitMix64 random(37);
  INFO("seed 37");
  VoronoiCell cell;
  int cut = 0;
  for (int i = 0; i < 4000; ++i) {
    INFO("scene " << i);
    Scene scene = make_scene(random, static_cast<Kind>(i % static_cast<int>(Kind::kinds)));
    if (scene.others.empty()) continue;
    const Vertex<2>* fresh = scene.others.back();
    scene.others.pop_back();
    scene.cut_by_all(cell);
    std::vector<std::uint32_t> codes;
    for (int k = 0; k < cell.size(); ++k) codes.push_back(cell.code(k));
    const bool may = VoronoiCell::may_cut(scene.pool, *scene.v, scene.radius, codes, fresh->p);
    const double x = fresh->p[0] - scene.v->p[0], y = fresh->p[1] - scene.v->p[1];
    const double side = std::ldexp(scene.radius, -static_cast<int>(random.below(20)));
    const Point<2> corner{x - side * random.unit(), y - side * random.unit()};
    const bool entered = cell.enters(corner, side, side * 0x1p-40);
    const bool in_reach = cell.in_reach(x * x + y * y);
    if (!cell.cuts(fresh->p)) continue;
    ++cut;
    CHECK(may);
    CHECK(entered);
    CHECK(in_reach);
  }
  CHECK(cut > 500);
}

TEST_CASE("far from the origin, and across thirty powers of two, signs stay exact") {
  SplitMix64 random(41);
  INFO("seed 41");
  VoronoiCell cell;
  for (int i = 0; i < 1000; ++i) {
    INFO("scene " << i);
    Scene scene;
    const double step = 0x1p-22;  // between doubles at 2^30
    scene.add({0x1p30, -0x1p30});
    scene.radius = step * (1 + static_cast<double>(random.below(16)));
    const auto n = 1 + random.below(20);
    for (std::uint64_t k = 0; k < n; ++k) {
      const double far = std::ldexp(1.0, static_cast<int>(random.below(25)));
      scene.add({0x1p30 + step * std::floor(far * (random.unit() - 0.5)),
                 -0x1p30 + step * std::floor(far * (random.unit() - 0.5))});
    }
    const Ring expected = brute_force(scene.v->p, scene.sites());
    scene.cut_by_all(cell);
    REQUIRE(ring_of(cell) == expected);
  }
}

TEST_CASE("a cell restored after some vertices went and some came is that of brute force [B5]") {
  SplitMix64 random(43);
  INFO("seed 43");
  VoronoiCell cell;
  int closed = 0;
  for (int i = 0; i < 4000; ++i) {
    INFO("scene " << i);
    Scene scene = make_scene(random, static_cast<Kind>(i % static_cast<int>(Kind::kinds)));
    std::vector<Vertex<2>*> arrivals;
    for (std::size_t k = random.below(3); k > 0 && scene.others.size() > 1; --k) {
      arrivals.push_back(scene.others.back());
      scene.others.pop_back();
    }
    scene.cut_by_all(cell);
    const Ring before = ring_of(cell);
    std::map<std::uint32_t, bool> gone;
    std::erase_if(scene.others,
                  [&](const auto* w) { return gone[w->self] = random.below(6) == 0; });
    cell.restore(
        scene.pool, *scene.v, scene.radius, before,
        [&](std::uint32_t code) { return !gone.contains(code) || !gone[code]; }, true);
    cell.check_invariants();
    for (const auto* w : arrivals) Scene::cut_by(cell, *w);
    for (int k = 0; k < cell.size(); ++k) closed += cell.corner2(k) > cell.open2();
    // Who takes what is left can be found in the gap balls of open corners.
    for (const auto* w : scene.others) {
      const double x = w->p[0] - scene.v->p[0], y = w->p[1] - scene.v->p[1];
      if (!cell.cuts(w->p)) continue;
      REQUIRE(cell.cuts_open(w->p));
      CHECK(cell.in_reach(x * x + y * y));
      CHECK(cell.enters({x, y}, 0, 0x1p-40 * scene.radius));
      cell.cut(w->self);
    }
    for (auto* w : arrivals) scene.others.push_back(w);
    REQUIRE(ring_of(cell) == brute_force(scene.v->p, scene.sites()));
    cell.check_invariants();
  }
  CHECK(closed > 5000);
}
