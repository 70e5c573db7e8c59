// The clipped Voronoi cell in space against brute force in exact arithmetic, in any order of cuts.
#include "cells/voronoi_cell3.hpp"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <set>
#include <vector>

#include "cell_scene.hpp"
#include "mesher/extra/generate.hpp"
#include "mesher/predicates.hpp"

namespace {

using mesher::Point;
using mesher::SplitMix64;
using mesher::detail::LinkRecord;
using mesher::detail::Vertex;
using Cell = mesher::detail::VoronoiCell3;

using Triangle = std::array<std::uint32_t, 3>;  // codes, the smallest first
using Link = std::set<Triangle>;

Triangle canonical(Triangle t) {
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  return t;
}

Link link_of(const Cell& cell) {
  Link link;
  for (int t = 0; t < cell.corners(); ++t) {
    const auto& [a, b, c] = cell.ends(t);
    REQUIRE(link.insert(canonical({cell.code(a), cell.code(b), cell.code(c)})).second);
  }
  return link;
}

Link link_of(const std::vector<std::uint32_t>& words) {
  const LinkRecord record(words);
  Link link;
  for (std::size_t t = 0; t < record.triangles(); ++t) link.insert(canonical(record.codes(t)));
  return link;
}

using Scene = CellScene<3>;
using Site = Scene::Site;

// The star of v among `sites` by the definition: abc is a triangle of its link if no other site is
// inside the sphere of v, a, b, c.
Link brute_force(const Point<3>& v, const std::vector<Site>& sites) {
  Link link;
  const std::size_t n = sites.size();
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      for (std::size_t k = i + 1; k < n; ++k) {
        if (j <= i || j == k) continue;  // i is the smallest: any order of the others
        const Site &a = sites[i], &b = sites[j], &c = sites[k];
        if (mesher::predicates::orient3d(v, a.p, b.p, c.p) <= 0) continue;
        const bool empty = std::none_of(sites.begin(), sites.end(), [&](const Site& d) {
          return d.code != a.code && d.code != b.code && d.code != c.code &&
                 mesher::predicates::insphere_perturbed(v, a.p, b.p, c.p, d.p) > 0;
        });
        if (empty) link.insert(canonical({a.code, b.code, c.code}));
      }
    }
  }
  return link;
}

enum class Kind { uniform, lattice, sphere, near_sphere, plane, near_plane, on_clip, kinds };

Scene make_scene(SplitMix64& random, Kind kind) {
  Scene scene;
  const double unit = std::ldexp(1.0, -static_cast<int>(random.below(30)));
  const auto at = [&](double x, double y, double z) {
    scene.add({0.375 + unit * x, -0.25 + unit * y, 0.125 + unit * z});
  };
  const std::size_t n = 1 + random.below(16);
  at(0, 0, 0);
  scene.radius = unit * (0.5 + 4 * random.unit());
  // Integer points on one sphere around the origin, radius^2 = 27, are those of |x|, |y|, |z| here.
  constexpr int kOnSphere[][3] = {{3, 3, 3}, {1, 1, 5}, {1, 5, 1}, {5, 1, 1}};
  for (std::size_t i = 0; i < n; ++i) {
    const auto small = [&] { return static_cast<double>(random.below(7)) - 3; };
    const auto sign = [&] { return random.below(2) == 0 ? 1.0 : -1.0; };
    const auto wide = [&] { return 8 * random.unit() - 4; };
    switch (kind) {
      case Kind::uniform:
        at(wide(), wide(), wide());
        break;
      case Kind::lattice:
        at(small(), small(), small());
        break;
      case Kind::sphere:
      case Kind::near_sphere: {  // through v
        const auto& c = kOnSphere[random.below(4)];
        double x = (sign() * c[0] + 1) / 4, y = (sign() * c[1] + 1) / 4;
        const double z = (sign() * c[2] + 5) / 4;
        if (kind == Kind::near_sphere) x = std::nextafter(x, sign() * 9), y += sign() * 0x1p-50;
        at(x, y, z);
        break;
      }
      case Kind::plane:  // many in the plane of v
        at(small(), small(), random.below(4) == 0 ? small() : 0.0);
        break;
      case Kind::near_plane: {  // flat tetrahedra: of no height but for rounding
        const double x = wide(), y = wide();
        at(x, y, random.below(4) == 0 ? wide() : 0.3 * x + 0.7 * y + 0x1p-49 * small());
        break;
      }
      case Kind::on_clip: {
        Cell clip;
        clip.reset(*scene.v, scene.radius);
        scene.add(random.below(2) == 0
                      ? clip.place(static_cast<int>(random.below(6)))
                      : Point<3>{scene.v->p[0] + unit * small(), scene.v->p[1] + unit * small(),
                                 scene.v->p[2] + unit * small()});
        break;
      }
      case Kind::kinds:
        break;
    }
  }
  return scene;
}

Kind kind_of(int i) { return static_cast<Kind>(i % static_cast<int>(Kind::kinds)); }

}  // namespace

TEST_CASE(
    "a cell in space is that of brute force, whatever the order of cuts; ties included [B1]") {
  SplitMix64 random(51);
  INFO("seed 51");
  Cell cell;
  for (int i = 0; i < 1400; ++i) {
    INFO("scene " << i);
    Scene scene = make_scene(random, kind_of(i));
    const Link expected = brute_force(scene.v->p, scene.sites());
    for (int order = 0; order < 3; ++order) {
      scene.shuffle(random);
      scene.cut_by_all(cell);
      REQUIRE(link_of(cell) == expected);
      for (const auto* w : scene.others) REQUIRE_FALSE(cell.cuts(w->p));  // once is enough
    }
    cell.check_invariants();
    for (int k = 0; k < cell.corners(); ++k) {
      CHECK(cell.corner2(k) <= cell.reach2());
      CHECK(cell.corner2(k) <= 3.001 * scene.radius * scene.radius);  // far corners are clipped
    }
  }
}

TEST_CASE("a new vertex that cuts is in reach, in an entered cube, and may_cut says so, in space") {
  SplitMix64 random(53);
  INFO("seed 53");
  Cell cell;
  int cut = 0, spared = 0;
  for (int i = 0; i < 6000; ++i) {
    INFO("scene " << i);
    Scene scene = make_scene(random, kind_of(i));
    if (scene.others.empty()) continue;
    const Vertex<3>* fresh = scene.others.back();
    scene.others.pop_back();
    scene.cut_by_all(cell);
    std::vector<std::uint32_t> record;
    cell.write(record);
    REQUIRE(link_of(record) == link_of(cell));
    const bool may = Cell::may_cut(scene.pool, *scene.v, scene.radius, record, fresh->p);
    Point<3> rel;
    double d2 = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      rel[k] = fresh->p[k] - scene.v->p[k];
      d2 += rel[k] * rel[k];
    }
    const double side = std::ldexp(scene.radius, -static_cast<int>(random.below(20)));
    Point<3> corner;
    for (std::size_t k = 0; k < 3; ++k) corner[k] = rel[k] - side * random.unit();
    const bool entered = cell.enters(corner, side, side * 0x1p-40);
    const bool in_reach = cell.in_reach(d2);
    const auto extent = cell.open_extent();
    spared += !may;
    if (!cell.cuts(fresh->p)) continue;
    ++cut;
    CHECK(may);
    CHECK(entered);
    CHECK(in_reach);
    for (std::size_t k = 0; k < 3; ++k) CHECK((rel[k] >= extent.lo[k] && rel[k] <= extent.hi[k]));
  }
  CHECK(cut > 1500);
  CHECK(spared > 1000);
}

TEST_CASE("a cell in space restored after some went and some came is that of brute force [B5]") {
  SplitMix64 random(57);
  INFO("seed 57");
  Cell cell;
  int closed = 0, whole = 0;
  for (int i = 0; i < 2100; ++i) {
    INFO("scene " << i);
    Scene scene = make_scene(random, kind_of(i));
    std::vector<Vertex<3>*> arrivals;
    for (std::size_t k = random.below(3); k > 0 && scene.others.size() > 1; --k) {
      arrivals.push_back(scene.others.back());
      scene.others.pop_back();
    }
    scene.cut_by_all(cell);
    std::vector<std::uint32_t> before;
    cell.write(before);
    std::set<std::uint32_t> gone;
    const bool any_goes = random.below(3) != 0;
    std::erase_if(scene.others, [&](const auto* w) {
      return any_goes && random.below(6) == 0 && gone.insert(w->self).second;
    });
    const auto left = [&](std::uint32_t code) { return !gone.contains(code); };
    cell.restore(scene.pool, *scene.v, scene.radius, before, left, true);
    cell.check_invariants();
    if (gone.empty()) {
      CHECK(cell.open2() == 0);
      ++whole;
    }
    for (const auto* w : arrivals) Scene::cut_by(cell, *w);
    for (int k = 0; k < cell.corners(); ++k) closed += cell.corner2(k) > cell.open2();
    // Who takes what is left can be found in the gap balls of open corners.
    for (const auto* w : scene.others) {
      if (!cell.cuts(w->p)) continue;
      REQUIRE(cell.cuts_open(w->p));
      Point<3> rel;
      for (std::size_t k = 0; k < 3; ++k) rel[k] = w->p[k] - scene.v->p[k];
      CHECK(cell.in_reach(rel[0] * rel[0] + rel[1] * rel[1] + rel[2] * rel[2]));
      CHECK(cell.enters(rel, 0, 0x1p-40 * scene.radius));
      cell.cut(w->self);
    }
    for (auto* w : arrivals) scene.others.push_back(w);
    REQUIRE(link_of(cell) == brute_force(scene.v->p, scene.sites()));
    cell.check_invariants();
  }
  CHECK(whole > 700);
  CHECK(closed > 5000);
}

TEST_CASE("a cell in space started from a record of another clip is that of its own clip") {
  SplitMix64 random(59);
  INFO("seed 59");
  Cell cell;
  for (int i = 0; i < 1400; ++i) {
    INFO("scene " << i);
    Scene scene = make_scene(random, kind_of(i));
    scene.cut_by_all(cell);
    std::vector<std::uint32_t> record;
    cell.write(record);
    scene.radius *= std::ldexp(1.0, static_cast<int>(random.below(9)) - 4);
    const auto real = [](std::uint32_t code) { return code < Cell::kVirtual; };
    cell.restore(scene.pool, *scene.v, scene.radius, record, real, false);
    cell.check_invariants();
    for (int k = 0; k < cell.corners(); ++k) CHECK(cell.corner2(k) <= cell.open2());
    for (const auto* w : scene.others) Scene::cut_by(cell, *w);
    REQUIRE(link_of(cell) == brute_force(scene.v->p, scene.sites()));
  }
}

TEST_CASE("far from the origin, across twenty powers of two, signs in space stay exact") {
  SplitMix64 random(61);
  INFO("seed 61");
  Cell cell;
  for (int i = 0; i < 600; ++i) {
    INFO("scene " << i);
    Scene scene;
    const double step = 0x1p-22;  // between doubles at 2^30
    scene.add({0x1p30, -0x1p30, 0x1p30});
    scene.radius = step * (1 + static_cast<double>(random.below(16)));
    const auto n = 1 + random.below(14);
    for (std::uint64_t k = 0; k < n; ++k) {
      const double far = std::ldexp(1.0, static_cast<int>(random.below(20)));
      const auto off = [&] { return step * std::floor(far * (random.unit() - 0.5)); };
      scene.add({0x1p30 + off(), -0x1p30 + off(), 0x1p30 + off()});
    }
    scene.cut_by_all(cell);
    REQUIRE(link_of(cell) == brute_force(scene.v->p, scene.sites()));
  }
}

TEST_CASE("a cell of thousands of neighbours is written down and read back the same") {
  SplitMix64 random(67);
  INFO("seed 67");
  Scene scene;
  scene.add({0, 0, 0});
  scene.radius = 4;
  while (scene.others.size() < 1500) {  // near a sphere around v: all are neighbours
    const Point<3> p{random.unit() - 0.5, random.unit() - 0.5, random.unit() - 0.5};
    const double r = std::hypot(p[0], p[1], p[2]);
    if (r > 0.1) scene.add({p[0] / r, p[1] / r, p[2] / r});
  }
  Cell cell, again;
  scene.cut_by_all(cell);
  std::vector<std::uint32_t> record, rewritten;
  cell.write(record);
  REQUIRE(LinkRecord(record).size() > 1024);
  const auto all = [](std::uint32_t) { return true; };
  again.restore(scene.pool, *scene.v, scene.radius, record, all, true);
  again.check_invariants();
  again.write(rewritten);
  CHECK(rewritten == record);
  CHECK(link_of(again) == link_of(cell));
  const Vertex<3>* gone = scene.others.back();
  const auto left = [&](std::uint32_t code) { return code != gone->self; };
  again.restore(scene.pool, *scene.v, scene.radius, record, left, true);
  again.check_invariants();
  CHECK(again.open2() > 0);
}
