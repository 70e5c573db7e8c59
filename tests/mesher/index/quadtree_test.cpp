// The quadtree that the program builds is the naive one's, whatever edits led to it.
#include "index/quadtree.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "edit_sequence.hpp"
#include "naive_quadtree.hpp"
#include "traced_world.hpp"

namespace {

using mesher::Point;
using mesher::SplitMix64;
using mesher::detail::kLevels;
using mesher::detail::MeshBox;
using mesher::detail::VertexHandle;
using support::Cell;
using Quadtree = mesher::detail::Quadtree<2>;

mesher::detail::Reach<2> random_reach(SplitMix64& random, double most) {
  return mesher::detail::Reach<2>({{-most * random.unit(), -most * random.unit()},
                                   {most * random.unit(), most * random.unit()}});
}

std::set<Cell> leaves_of(support::TracedWorld& world) {
  std::set<Cell> all;
  world.world().vertices.tree().for_each_leaf([&](const Cell& c) { all.insert(c); });
  return all;
}

// Cells that touch, corners included, differ by one level at most.
bool graded(const std::set<Cell>& leaves) {
  const auto size = [](const Cell& c) { return std::uint64_t{1} << (kLevels - c.level); };
  for (const Cell& a : leaves) {
    for (const Cell& b : leaves) {
      if (a.level <= b.level + 1) continue;
      bool touch = true;
      for (std::size_t i = 0; i < 2; ++i) {
        touch =
            touch && a.corner[i] <= b.corner[i] + size(b) && b.corner[i] <= a.corner[i] + size(a);
      }
      if (touch) return false;
    }
  }
  return true;
}

}  // namespace

TEST_CASE(
    "after every edit the quadtree is the naive one of the points, and graded 2:1 [Fig 4.3, 4.4]") {
  for (const support::Family family : support::kFamilies) {
    const auto sequence = random_sequence(family, {}, 30, 60, 19);
    INFO(name(family) << ", seed 19");
    support::TracedWorld world(sequence.options);
    support::PointSet points;
    for (const auto& step : sequence.steps) {
      for (const auto& edit : step) perform(edit, world, points);
      world.update();
      std::vector<support::Fixed> places;
      for (const auto& [id, p] : points) places.push_back(world.box().fixed(p));
      const std::set<Cell> leaves = leaves_of(world);
      REQUIRE(leaves == support::NaiveQuadtree(places).leaves());
      REQUIRE(graded(leaves));
      world.world().vertices.check_invariants();
    }
  }
}

TEST_CASE("a search meets every vertex within its radius, in trees of any depth") {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    INFO("seed " << seed);
    SplitMix64 random(seed);
    // Far from the origin coordinates are coarse against the smallest cells.
    const double far = seed % 3 == 0 ? 0x1p20 : seed % 3 == 1 ? -0x1p33 : 0;
    const MeshBox<2> box{.lo = {far - 1.5, far - 1.5}, .side = 4};
    mesher::detail::VertexPool<2> pool;
    Quadtree tree(box, pool);
    std::vector<mesher::detail::Vertex<2>*> all;
    const auto coordinate = [&] {
      const double cell = std::ldexp(static_cast<double>(random.below(65)) / 16, 0);  // on borders
      const double x = random.below(3) == 0 ? cell
                       : random.below(2) == 0
                           ? 4 * random.unit()
                           : 1 + std::ldexp(random.unit(), -static_cast<int>(random.below(40)));
      return std::clamp(box.lo[0] + x, box.lo[0], box.lo[0] + 4);
    };
    for (int i = 0; i < 200; ++i) {
      const Point<2> p{coordinate(), coordinate()};
      if (tree.find(p) != nullptr) continue;
      auto& v = pool.create(p);
      tree.insert(v);
      REQUIRE(tree.find(p) == &v);
      all.push_back(&v);
      if (random.below(2) == 0) {
        const auto& q = all[random.below(all.size())]->p;
        tree.mark(MeshBox<2>::cell(box.fixed(q), static_cast<int>(random.below(45))));
      }
    }
    for (int i = 0; i < 100; ++i) {
      const auto* center = all[random.below(all.size())];
      const auto* other = all[random.below(all.size())];
      const auto distance = [&](const Point<2>& p) {
        return std::sqrt((p[0] - center->p[0]) * (p[0] - center->p[0]) +
                         (p[1] - center->p[1]) * (p[1] - center->p[1]));
      };
      const double radius = distance(other->p);  // a vertex just on the border of the search
      std::multiset<VertexHandle> met;
      Quadtree::Looked looked;
      for (const double r : {radius / 7, radius / 3, radius}) {  // what was met is not met again
        tree.visit_box(
            center->p, {{-r, -r}, {r, r}}, looked, [](const Point<2>&, double) { return true; },
            [&](const auto& handles, const auto& places, std::uint32_t count) {
              for (std::size_t k = 0; k < handles.size(); ++k) {
                if (k < count) {
                  met.insert(handles[k]);
                  REQUIRE(pool[handles[k]].p == places[k]);
                } else {
                  REQUIRE((handles[k] == 0 && std::isinf(places[k][0])));
                }
              }
            });
      }
      for (const auto* v : all) {
        REQUIRE(met.count(v->self) <= 1);
        if (distance(v->p) <= radius) REQUIRE(met.contains(v->self));
      }
    }
    for (auto* v : all) {
      v->reach = random_reach(random, 0.25);
      tree.raise_reach(*v);
    }
    tree.check_invariants();
    for (int i = 0; i < 100; ++i) {
      const Point<2> p{coordinate(), coordinate()};
      std::set<VertexHandle> met;
      tree.visit_reaching(p, [&](auto& v, const auto& d) {
        REQUIRE((d == Point<2>{(p[0] - v.p[0]) / 4, (p[1] - v.p[1]) / 4}));
        met.insert(v.self);
      });
      for (const auto* v : all) {
        const auto reach = v->reach.box();
        const double x = (p[0] - v->p[0]) / 4, y = (p[1] - v->p[1]) / 4;
        REQUIRE(met.contains(v->self) ==
                (x >= reach.lo[0] && x <= reach.hi[0] && y >= reach.lo[1] && y <= reach.hi[1]));
      }
      auto& v = *all[random.below(all.size())];
      v.reach = {};
      tree.check_invariants();
    }
  }
}

TEST_CASE("queries far smaller than the cells above them are found, in whatever order all came") {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    INFO("seed " << seed);
    SplitMix64 random(seed);
    const MeshBox<2> box{.lo = {-4, -4}, .side = 8};
    mesher::detail::VertexPool<2> pool;
    Quadtree tree(box, pool);
    std::vector<mesher::detail::Vertex<2>*> all;
    const auto place = [&] {  // around the origin, at all scales
      const double r = 4 * std::ldexp(1, -static_cast<int>(random.below(42)));
      return Point<2>{r * (2 * random.unit() - 1), r * (2 * random.unit() - 1)};
    };
    for (int i = 0; i < 400; ++i) {
      const Point<2> p = place();
      if (tree.find(p) != nullptr) continue;
      all.push_back(&pool.create(p));
      tree.insert(*all.back());
      auto& v = *all[random.below(all.size())];
      v.reach.include(random_reach(random, (std::abs(v.p[0]) + std::abs(v.p[1])) / 8));
      tree.raise_reach(v);
      const Point<2>& q = all[random.below(all.size())]->p;
      if (random.below(2) == 0) {
        tree.mark(MeshBox<2>::cell(box.fixed(q), static_cast<int>(random.below(45))));
      }
      std::set<VertexHandle> met, expected;
      const Point<2> at = place();
      tree.visit_reaching(at, [&](auto& u, const auto&) { met.insert(u.self); });
      for (const auto* u : all) {
        if (u->reach.contains({(at[0] - u->p[0]) / 8, (at[1] - u->p[1]) / 8})) {
          expected.insert(u->self);
        }
      }
      REQUIRE(met == expected);
      tree.check_invariants();
    }
  }
}

TEST_CASE("marks taken back leave one cell, and vertices are found all the while") {
  const MeshBox<2> box{.lo = {-1.5, -1.5}, .side = 4};
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    INFO("seed " << seed);
    SplitMix64 random(seed);
    mesher::detail::VertexPool<2> pool;
    Quadtree tree(box, pool);
    std::vector<mesher::detail::Vertex<2>*> all;
    for (int i = 0; i < 100; ++i) {
      all.push_back(&pool.create({random.unit(), random.unit() * random.unit()}));
      tree.insert(*all.back());
    }
    std::map<Cell, Quadtree::NodeIndex> marked;
    for (int i = 0; i < 300; ++i) {
      const auto& p = all[random.below(all.size())]->p;
      const Cell c = MeshBox<2>::cell(box.fixed(p), static_cast<int>(random.below(12)));
      if (const auto it = marked.find(c); it != marked.end()) {
        tree.unmark(it->second);
        marked.erase(it);
      } else {
        marked[c] = tree.mark(c);
      }
      for (const auto* v : all) REQUIRE(tree.find(v->p) == v);
      tree.check_invariants();
    }
    for (const auto& [cell, node] : marked) tree.unmark(node);
    int leaves = 0;
    tree.for_each_leaf([&](const Cell&) { ++leaves; });
    CHECK(leaves == 1);
    for (auto* v : all) tree.erase(*v);
    for (const auto* v : all) REQUIRE(tree.find(v->p) == nullptr);
  }
}

TEST_CASE(
    "a split cell keeps its vertices itself while they are few, and a search meets them once") {
  const MeshBox<2> box{.lo = {-1.5, -1.5}, .side = 4};
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    INFO("seed " << seed);
    SplitMix64 random(seed);
    mesher::detail::VertexPool<2> pool;
    Quadtree tree(box, pool);
    const auto place = [&] {  // some on top of each other but for the finest cells
      const double scale = std::ldexp(1, -static_cast<int>(random.below(3) * 12));
      return Point<2>{scale * random.unit(), scale * random.unit()};
    };
    for (int i = 0; i < 20; ++i) {
      tree.mark(MeshBox<2>::cell(box.fixed(place()), static_cast<int>(random.below(30))));
    }
    std::vector<mesher::detail::Vertex<2>*> all;
    for (int i = 0; i < 400; ++i) {
      if (all.empty() || random.below(i < 200 ? 4 : 2) != 0) {
        all.push_back(&pool.create(place()));
        tree.insert(*all.back());
        all.back()->reach = random_reach(random, 1);
        tree.raise_reach(*all.back());
      } else {
        std::swap(all[random.below(all.size())], all.back());
        tree.erase(*all.back());
        pool.release(*all.back());
        all.pop_back();
      }
      tree.check_invariants();  // which cells are open, and that bounds are bounds
      std::size_t met = 0;
      Quadtree::Looked looked;
      tree.visit_box(
          {0, 0}, {{-4, -4}, {4, 4}}, looked, [](const Point<2>&, double) { return true; },
          [&](const auto&, const auto&, std::uint32_t count) { met += count; });
      REQUIRE(met == all.size());
    }
  }
}

TEST_CASE(
    "a cell that nobody marks has children while many vertices lie in it, and none when few") {
  const MeshBox<2> box{.lo = {-1.5, -1.5}, .side = 4};
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    INFO("seed " << seed);
    SplitMix64 random(seed);
    mesher::detail::VertexPool<2> pool;
    Quadtree tree(box, pool);
    const auto place = [&] {  // as deep as cells go
      const double scale = std::ldexp(1, -static_cast<int>(random.below(5) * 11));
      return Point<2>{scale * random.unit(), scale * random.unit()};
    };
    const auto met_around = [&](const Point<2>& p) {
      std::size_t met = 0;
      Quadtree::Looked looked;
      tree.visit_box(
          p, {}, looked, [](const Point<2>&, double) { return true; },
          [&](const auto&, const auto&, std::uint32_t count) { met += count; });
      return met;
    };
    std::vector<mesher::detail::Vertex<2>*> all;
    std::map<Cell, Quadtree::NodeIndex> marked;
    for (int i = 0; i < 3000; ++i) {
      if (all.empty() || random.below(i < 2000 ? 5 : 2) != 0) {
        const Point<2> p = place();
        if (tree.find(p) != nullptr) continue;
        all.push_back(&pool.create(p));
        tree.insert(*all.back());
      } else {
        std::swap(all[random.below(all.size())], all.back());
        tree.erase(*all.back());
        pool.release(*all.back());
        all.pop_back();
      }
      if (random.below(20) == 0) {
        const Cell c = MeshBox<2>::cell(box.fixed(place()), static_cast<int>(random.below(40)));
        if (const auto it = marked.find(c); it != marked.end()) {
          tree.unmark(it->second);
          marked.erase(it);
        } else {
          marked[c] = tree.mark(c);
        }
      }
      if (i % 50 == 0) tree.check_invariants();  // which cells have children
    }
    for (const auto* v : all) REQUIRE(met_around(v->p) <= 4 * 32);
    for (const auto& [cell, node] : marked) tree.unmark(node);
    tree.check_invariants();
    for (auto* v : all) REQUIRE(tree.find(v->p) == v);
    for (auto* v : all) tree.erase(*v);
    tree.check_invariants();
    int leaves = 0;
    tree.for_each_leaf([&](const Cell&) { ++leaves; });
    CHECK(leaves == 1);
  }
}
