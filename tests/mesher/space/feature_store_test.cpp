// What is near a place, crowds a piece, or is shared, against a look at all features.
#include "space/feature_store.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <type_traits>
#include <vector>

#include "cell_scene.hpp"
#include "failing_new.hpp"
#include "feature_scene.hpp"

namespace {

using namespace mesher::detail;
using mesher::Point;
using support::all_near;
using support::FeaturesNear;
using Scene = support::FeatureScene<sac::PlainScope>;

struct Plain {
  explicit Plain(std::uint64_t seed) : scene(seed, scope) {}
  sac::PlainScope scope;
  Scene scene;
  std::vector<const Edge*> edges;
  std::vector<const Polygon*> polygons;

  void add() {
    if (scene.random().below(3) != 0) {
      edges.push_back(&scene.add_edge());
    } else {
      polygons.push_back(&scene.add_polygon());
    }
  }
  void remove() {
    auto& random = scene.random();
    auto& store = scene.features().store();
    if (random.below(2) == 0 && !edges.empty()) {
      std::swap(edges[random.below(edges.size())], edges.back());
      store.leave(store.record(edges.back()->a, edges.back()->b));
      edges.pop_back();
    } else if (!polygons.empty()) {
      std::swap(polygons[random.below(polygons.size())], polygons.back());
      store.take(store.polygons()[polygons.back()->self]);
      polygons.pop_back();
    }
  }
  void edit() {
    scene.random().below(3) != 0 || edges.size() + polygons.size() < 3 ? add() : remove();
    if (scene.random().below(4) == 0) scene.features().store().commit();
  }
};

EdgePiece some_piece(Plain& plain) {
  auto& random = plain.scene.random();
  EdgePiece piece{plain.edges[random.below(plain.edges.size())]};
  for (std::uint64_t depth = random.below(6); depth > 0; --depth) {
    (random.below(2) == 0 ? piece.lo : piece.hi) = piece.middle();
  }
  return piece;
}

}  // namespace

TEST_CASE("What is near, or crowds a piece, is found as by looking at all") {
  const std::uint64_t seed = GENERATE(1, 2, 3, 4, 5, 6);
  CAPTURE(seed);
  Plain plain(seed);
  Scene& scene = plain.scene;
  std::size_t crowded = 0, near_some = 0;
  for (int edit = 0; edit < 150; ++edit) {
    plain.edit();
    scene.store().check_invariants();
    for (int ask = 0; ask < 10; ++ask) {
      const Point<3> place = scene.place();
      const double radius = scene.radius();
      const FeaturesNear near = all_near(place, radius, scene.features().store());
      REQUIRE(near == scene.naive_near(place, radius));
      near_some += !near.polygons.empty();
    }
    if (!plain.edges.empty()) {
      const EdgePiece piece = some_piece(plain);
      REQUIRE(scene.features().crowded(plain.scope, piece) == scene.naive_crowded(piece));
      crowded += scene.naive_crowded(piece);
    }
  }
  REQUIRE(crowded > 5);
  REQUIRE(near_some > 50);
}

TEST_CASE("What has changed, and edges that are no sides, are found by place") {
  const std::uint64_t seed = GENERATE(1, 2, 3, 4);
  CAPTURE(seed);
  Plain plain(seed);
  Scene& scene = plain.scene;
  FeatureStore& store = scene.features().store();
  std::size_t changed = 0, sides = 0;
  for (int edit = 0; edit < 200; ++edit) {
    plain.edit();
    const Point<3> place = scene.place();
    const double radius = scene.radius();
    const auto is_outside = [&](const Point<3>& x, double r) {
      return squared_distance(x, place) > (radius + r) * (radius + r);
    };
    std::vector<EdgeHandle> edges, free;
    std::vector<PolygonHandle> polygons;
    store.visit_changed_in(is_outside, [&](const auto& f) {
      if constexpr (std::is_same_v<std::decay_t<decltype(f)>, Edge>) {
        edges.push_back(f.self);
      } else {
        polygons.push_back(f.self);
      }
      return false;
    });
    store.visit_free_edges_in(place, radius, is_outside,
                              [&](const Edge& e) { return free.push_back(e.self), false; });
    const auto has = [](const auto& all, std::uint32_t h) {
      return std::find(all.begin(), all.end(), h) != all.end();
    };
    store.edges().for_each([&](const Edge& e) {
      const bool is_near = distance2_to(place, e) <= radius * radius;
      REQUIRE((!has(edges, e.self) || e.changed));
      REQUIRE((!e.changed || !is_near || has(edges, e.self)));
      REQUIRE((!has(free, e.self) || e.alive));
      changed += e.changed && is_near;
      if (!e.alive || !is_near) return;
      REQUIRE((has(free, e.self) || !store.polygons_at(e).empty()));
      sides += !has(free, e.self);
      // Who uses it otherwise is told by the count.
      if (store.users(e) > store.polygons_at(e).size()) REQUIRE(has(free, e.self));
    });
    store.polygons().for_each([&](const Polygon& f) {
      const bool is_near = distance2_to(place, f) <= radius * radius;
      REQUIRE((!has(polygons, f.self) || f.changed));
      REQUIRE((!f.changed || !is_near || has(polygons, f.self)));
    });
  }
  REQUIRE(changed > 20);
  REQUIRE(sides > 20);
}

TEST_CASE("An edge is there while a segment or a polygon uses it") {
  Plain plain(1);
  Scene& scene = plain.scene;
  FeatureStore& store = scene.features().store();
  const auto at = [&](double x, double y) { return scene.add_point({x, y, 0.5})->self; };
  const VertexHandle a = at(0, 0), b = at(1, 0), c = at(1, 1), d = at(0, 1);
  const VertexHandle p = at(0.25, 0.25), q = at(0.5, 0.25);
  const Edge& segment = scene.features().insert(a, b);
  const Polygon& square = scene.features().insert({{{a, b, c, d}}, {{p, q}}, {}});
  const Polygon& corner = scene.features().insert({{{a, b, d}}, {}, {}});
  REQUIRE(store.users(segment) == 3);
  REQUIRE(!segment.bounds);
  REQUIRE(store.find_edge(b, c)->bounds);
  REQUIRE(store.live_edges() == 6);  // the diagonal and pq among them
  REQUIRE(square.has_edge(store.find_edge(q, p)->self));
  REQUIRE(square.has(p));
  store.take(store.polygons()[square.self]);
  REQUIRE(store.find_edge(p, q) == nullptr);
  REQUIRE(store.find_edge(b, c) == nullptr);
  REQUIRE(store.live_edges() == 3);
  store.leave(store.record(a, b));
  REQUIRE(store.find_edge(a, b) == &segment);
  store.take(store.polygons()[corner.self]);
  REQUIRE(store.live_edges() == 0);
  store.commit();
  store.check_invariants();
}

TEST_CASE("A polygon that comes again before its record is freed is the same record") {
  Plain plain(1);
  Scene& scene = plain.scene;
  FeatureStore& store = scene.features().store();
  const auto at = [&](double x, double y) { return scene.add_point({x, y, 0.5})->self; };
  const VertexHandle a = at(0, 0), b = at(1, 0), c = at(1, 1), p = at(0.75, 0.5);
  const Polygon& f = scene.features().insert({{{a, b, c}}, {}, {}});
  store.take(store.polygons()[f.self]);
  REQUIRE(&store.record(PolygonParts{{{c, b, a}}, {}, {}}) == &f);
  REQUIRE(&store.record(PolygonParts{{{a, b, c}}, {}, {p}}) != &f);
  store.commit();
  REQUIRE(store.live_polygons() == 0);
  store.check_invariants();
}

TEST_CASE("What two features share is the nearest edge, else the nearest point, else nothing") {
  Plain plain(1);
  Scene& scene = plain.scene;
  const FeatureStore& store = scene.store();
  const auto at = [&](double x, double y, double z) { return scene.add_point({x, y, z})->self; };
  const VertexHandle a = at(0, 0, 0), b = at(1, 0, 0), c = at(1, 1, 0), d = at(0, 1, 0);
  const VertexHandle e = at(0, 0, 1), f = at(1, 0, 1), g = at(1, 1, 1);
  const Polygon& floor = scene.features().insert({{{a, b, c, d}}, {}, {}});
  const Polygon& front = scene.features().insert({{{a, b, f, e}}, {}, {}});
  const Polygon& corner = scene.features().insert({{{c, f, g}}, {}, {}});
  const Polygon& all = scene.features().insert({{{a, b, c}}, {{b, d}}, {d}});
  const Edge& up = scene.features().insert(c, g);
  const Edge& across = scene.features().insert(a, g);
  const auto edge = [&](VertexHandle p, VertexHandle q) { return Feature(*store.find_edge(p, q)); };
  const auto point = [&](VertexHandle p) { return Feature(scene.pool()[p]); };
  const Point<3> at_a{0, 0, 0.1}, at_c{1, 1, 0.1};
  REQUIRE(common(floor, front, at_c, store) == edge(a, b));
  REQUIRE(common(floor, corner, at_a, store) == point(c));
  REQUIRE(common(floor, all, at_a, store) == edge(a, b));
  REQUIRE(common(floor, all, at_c, store) == edge(b, c));
  REQUIRE(common(corner, up, at_a, store) == edge(c, g));
  REQUIRE(common(up, floor, at_a, store) == point(c));
  REQUIRE(common(up, across, at_a, store) == point(g));
  REQUIRE(common(all, across, at_c, store) == point(a));
  REQUIRE_FALSE(common(front, up, at_a, store));
}

TEST_CASE("A polygon for which there is no memory is not there, nor are its edges") {
  Plain plain(5);
  FeatureStore& store = plain.scene.features().store();
  for (int round = 0; round < 20; ++round) {
    const Polygon* added = &plain.scene.add_polygon();
    Polygon& f = store.polygons()[added->self];
    store.take(f);
    const std::size_t edges = store.live_edges();
    for (std::uint64_t count = 1; !f.alive; ++count) {
      support::allocation_fuse.left = count;
      try {
        store.put(f);
      } catch (const std::bad_alloc&) {
        REQUIRE(!f.alive);
      }
      support::allocation_fuse.left = 0;
      store.check_invariants();
      if (!f.alive) REQUIRE(store.live_edges() == edges);
    }
  }
}

TEST_CASE("A record of a polygon for which there is no memory is not made") {
  Plain plain(6);
  Scene& scene = plain.scene;
  FeatureStore& store = scene.features().store();
  for (int round = 0; round < 20; ++round) {
    PolygonParts parts;
    auto& loop = parts.loops.emplace_back();
    for (int i = 0; i < 3; ++i) loop.push_back(scene.add_point(scene.place())->self);
    const Polygon* made = nullptr;
    for (std::uint64_t count = 1; made == nullptr; ++count) {
      support::allocation_fuse.left = count;
      try {
        made = &store.record(parts);
      } catch (const std::bad_alloc&) {
      }
      support::allocation_fuse.left = 0;
      store.check_invariants();
    }
    store.commit();
    store.check_invariants();
  }
}

TEST_CASE("A look for what is near for which there is no memory throws, and finds all later") {
  Plain plain(8);
  for (int i = 0; i < 40; ++i) plain.add();
  const Point<3> place{0.5, 0.5, 0.5};
  const FeaturesNear all = plain.scene.naive_near(place, 2);
  bool burnt = true;
  int failures = 0;
  for (std::uint64_t count = 1; burnt; ++count) {
    FeaturesNear found;
    if (support::fails(count, burnt,
                       [&] { found = all_near(place, 2, plain.scene.features().store()); })) {
      ++failures;
      found = all_near(place, 2, plain.scene.features().store());
    }
    REQUIRE(found == all);
  }
  CHECK(failures > 5);
}
