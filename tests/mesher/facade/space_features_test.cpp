// Segments and polygons in space through the facade: every update leaves the mesh of a run from
// scratch, or an error that names the features, and then the mesh as it was.
#include <algorithm>
#include <catch2/catch.hpp>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "facade/box_mesher.hpp"
#include "facade/graph_runs.hpp"
#include "failing_new.hpp"
#include "feature_ids.hpp"
#include "mesher/error.hpp"
#include "mesher/extra/generate.hpp"

namespace {

using mesher::BoxMesher;
using mesher::Error;
using mesher::ErrorCode;
using mesher::Mesh;
using mesher::Options;
using mesher::Point;
using mesher::PointId;
using mesher::Polygon;
using mesher::PolygonId;
using support::id;
using support::ids;

const Options<3> kOptions{.domain = {{0, 0, 0}, {1, 1, 1}}};

// A square on the floor with points 1 to 4 at its corners, 5 over it, 6 under it, 7 beside it; as
// polygon 1. Point 8 is in its plane and inside, where pending.
struct Scene {
  BoxMesher<3> m{kOptions};
  Scene() {
    m.insert(ids({1, 2, 3, 4, 5, 6, 7}), {{0.25, 0.25, 0.5},
                                          {0.75, 0.25, 0.5},
                                          {0.75, 0.75, 0.5},
                                          {0.25, 0.75, 0.5},
                                          {0.5, 0.5, 0.75},
                                          {0.5, 0.5, 0.25},
                                          {0.875, 0.5, 0.5}});
    m.insert_polygon({id(1), {ids({1, 2, 3, 4})}});
  }
};

// What update() throws, and that mesh and features stay.
struct Refused {
  ErrorCode code{};
  support::Ids ids;
  std::string message;
};
Refused refused(BoxMesher<3>& m) {
  const Mesh<3> before = m.mesh();
  const auto polygons = m.polygons();
  const auto lines = m.lines();
  try {
    m.update();
  } catch (const Error& e) {
    CHECK(m.mesh() == before);
    CHECK(m.polygons() == polygons);
    CHECK(m.lines() == lines);
    m.check_invariants();
    return {e.code(), support::ids_of(e), e.message()};
  }
  FAIL("update() has not thrown");
  return {};
}

// The mesh of a mesher of its own with the same input.
Mesh<3> mesh_of_input(const BoxMesher<3>& m) {
  BoxMesher<3> fresh(m.options());
  for (const auto& [point, at, marker] : m.points()) fresh.insert(point, at);
  for (const auto& line : m.lines()) fresh.insert_polyline(line.id, line.points);
  for (const Polygon& polygon : m.polygons()) fresh.insert_polygon(polygon);
  fresh.update();
  return fresh.mesh();
}
Mesh<3> static_mesh(const BoxMesher<3>& m) {
  std::vector<PointId> names;
  std::vector<Point<3>> points;
  for (const auto& [point, at, marker] : m.points()) {
    names.push_back(point);
    points.push_back(at);
  }
  std::vector<mesher::Segment> segments;
  for (const auto& line : m.lines()) {
    for (std::size_t i = 1; i < line.points.size(); ++i) {
      segments.push_back({line.id, line.points[i - 1], line.points[i]});
    }
  }
  return mesh_statically(points, segments, m.polygons(), m.options(), names);
}

}  // namespace

TEST_CASE("What does not fit together in space is refused with both ids, and nothing is lost") {
  struct Case {
    std::function<void(BoxMesher<3>&)> edit;
    ErrorCode code;
    support::Ids ids;
  };
  const Case cases[] = {
      {[](auto& m) { m.insert_segment(id(9), id(5), id(6)); }, ErrorCode::segment_through_polygon,
       ids({9, 1})},
      {[](auto& m) {
         m.insert(id(8), {0.5, 0.5, 0.5});
       },
       ErrorCode::point_on_polygon, ids({8, 1})},
      {[](auto& m) {
         m.insert(id(8), {0.5, 0.25, 0.5});
       },
       ErrorCode::point_on_segment, ids({8, 1})},
      {[](auto& m) { m.insert_segment(id(9), id(1), id(3)); }, ErrorCode::segment_on_polygon,
       ids({9, 1})},
      {[](auto& m) {
         m.insert_polygon({id(2), {ids({3, 2, 1, 4})}});
       },
       ErrorCode::repeated_polygon, ids({2, 1})},
      {[](auto& m) {
         m.insert_polygon({id(2), {ids({5, 6, 7})}});
       },
       ErrorCode::segment_through_polygon, ids({2, 1})},
      {[](auto& m) {
         m.insert_polygon({id(2), {ids({1, 2, 3, 5})}});
       },
       ErrorCode::not_flat, ids({2})},
      {[](auto& m) {
         m.insert_polygon({id(2), {ids({1, 2, 99})}});
       },
       ErrorCode::unknown_id, ids({99, 2})},
      {[](auto& m) { m.insert_segment(id(9), id(1), id(99)); }, ErrorCode::unknown_id,
       ids({99, 9})},
      {[](auto& m) { m.remove(id(2)); }, ErrorCode::point_in_use, ids({2, 1})},
      {[](auto& m) {
         m.move(id(2), {0.75, 0.25, 0.625});
       },
       ErrorCode::not_flat, ids({1})},
      {[](auto& m) {
         m.insert_segment(id(9), id(5), id(7));
         m.insert_segment(id(8), id(7), id(5));
       },
       ErrorCode::repeated_segment, ids({9, 8})},
  };
  Scene scene;
  scene.m.update();
  for (const Case& c : cases) {
    c.edit(scene.m);
    const Refused r = refused(scene.m);
    INFO(r.message);
    CHECK(r.code == c.code);
    CHECK(r.ids == c.ids);
  }
  scene.m.insert_segment(id(9), id(5), id(7));
  scene.m.update();
  CHECK(scene.m.mesh() == mesh_of_input(scene.m));
}

TEST_CASE("A first run refuses what an update does, in the same words") {
  Scene scene;
  scene.m.insert_segment(id(9), id(5), id(6));
  const Refused first = refused(scene.m);
  Scene other;
  other.m.update();
  other.m.insert_segment(id(9), id(5), id(6));
  CHECK(refused(other.m).message == first.message);
  CHECK(first.code == ErrorCode::segment_through_polygon);
}

TEST_CASE("What the ids alone say of a polygon is refused when it is announced") {
  Scene scene;
  const auto code = [&](const Polygon& polygon) {
    try {
      scene.m.insert_polygon(polygon);
    } catch (const Error& e) {
      return e.code();
    }
    return ErrorCode::cancelled;
  };
  CHECK(code({id(1), {ids({5, 6, 7})}}) == ErrorCode::repeated_id);
  CHECK(code({id(2), {}}) == ErrorCode::bad_polygon);
  CHECK(code({id(2), {ids({5, 6})}}) == ErrorCode::bad_polygon);
  CHECK(code({id(2), {ids({5, 6, 7, 6})}}) == ErrorCode::bad_polygon);
  CHECK(code({id(2), {ids({5, 6, 7})}, {{id(5), id(5)}}}) == ErrorCode::zero_length);
  CHECK_FALSE(scene.m.contains_polygon(id(2)));
  CHECK(scene.m.contains_polygon(id(1)));
  scene.m.remove_polygon(id(1));
  CHECK_FALSE(scene.m.contains_polygon(id(1)));
  CHECK_THROWS_AS(scene.m.remove_polygon(id(1)), Error);
  BoxMesher<2> plane(Options<2>{.domain = {{0, 0}, {1, 1}}});
  CHECK_THROWS_AS(plane.insert_polygon({id(1), {ids({1, 2, 3})}}), Error);
}

TEST_CASE("What the ids alone say is said with the place, where it is known") {
  using Places = std::vector<mesher::Position>;
  Scene scene;
  scene.m.insert(id(20), {0.1, 0.2, 0.3});  // not there yet
  const auto places = [&](auto&& edit) {
    try {
      edit(scene.m);
    } catch (const Error& e) {
      return e.places();
    }
    return Places{{-1, -1, -1}};
  };
  const auto of_polygon = [&](const Polygon& polygon) {
    return places([&](auto& m) { m.insert_polygon(polygon); });
  };
  for (const bool updated : {false, true}) {
    INFO(updated);
    CHECK(of_polygon({id(2), {ids({5, 6, 7, 6})}}) == Places{{0.5, 0.5, 0.25}});
    CHECK(of_polygon({id(2), {ids({1, 2, 3}), ids({5, 20, 6, 20})}}) == Places{{0.1, 0.2, 0.3}});
    CHECK(of_polygon({id(2), {ids({99, 5})}}) == Places{{0.5, 0.5, 0.75}});
    CHECK(of_polygon({id(2), {ids({5, 6, 7})}, {{id(5), id(5)}}}) == Places{{0.5, 0.5, 0.75}});
    CHECK(of_polygon({id(2), {ids({5, 99, 7, 99})}}).empty());
    CHECK(of_polygon({id(2), {}}).empty());
    CHECK(places([](auto& m) { m.insert_segment(id(9), id(20), id(20)); }) ==
          Places{{0.1, 0.2, 0.3}});
    scene.m.update();
  }
  CHECK(places([](auto& m) {
          m.remove(id(3));
          m.update();
        }) == Places{{0.75, 0.75, 0.5}});
  const Places points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  CHECK(places([&](auto&) {
          static_cast<void>(mesher::mesh_statically(points, {}, {{id(1), {ids({1, 2, 3, 2})}}},
                                                    kOptions, ids({1, 2, 3})));
        }) == Places{{1, 0, 0}});
  CHECK(places([&](auto&) {
          static_cast<void>(mesher::mesh_statically(points, {{id(1), id(3), id(3)}}, {}, kOptions,
                                                    ids({1, 2, 3})));
        }) == Places{{0, 1, 0}});
}

TEST_CASE("A polygon takes the edges that nobody else has") {
  Scene scene;
  scene.m.insert_polygon({id(2), {ids({1, 2, 5})}});
  scene.m.insert_segment(id(3), id(2), id(3));
  scene.m.update();
  scene.m.remove_polygon(id(1));
  scene.m.update();
  CHECK(scene.m.mesh() == mesh_of_input(scene.m));
  scene.m.remove(id(4));
  scene.m.update();
  CHECK(scene.m.mesh() == mesh_of_input(scene.m));
  scene.m.remove(id(3));
  CHECK(refused(scene.m).ids == ids({3, 3}));  // the segment stays
  scene.m.remove_line(id(3));
  scene.m.remove(id(3));
  scene.m.update();
  CHECK(scene.m.mesh() == mesh_of_input(scene.m));
}

TEST_CASE("What a polygon declares may lie in it, and a wall may stand there") {
  Scene scene;
  scene.m.remove_polygon(id(1));
  scene.m.insert(ids({8, 10, 11}), {{0.375, 0.5, 0.5}, {0.625, 0.5, 0.5}, {0.375, 0.375, 0.5}});
  scene.m.insert_polygon({id(2), {ids({1, 2, 3, 4})}, {{id(8), id(10)}}, ids({11})});
  scene.m.insert_polygon({id(3), {ids({8, 10, 5})}});
  scene.m.update();
  CHECK(scene.m.mesh() == mesh_of_input(scene.m));
  scene.m.remove(id(11));
  CHECK(refused(scene.m).ids == ids({11, 2}));
}

TEST_CASE("A point moves with its segments and polygons in one update") {
  Scene scene;
  scene.m.insert_segment(id(9), id(3), id(7));
  scene.m.update();
  scene.m.move(id(3), {0.8125, 0.75, 0.5});
  scene.m.update();
  CHECK(scene.m.polygons() == std::vector{Polygon{id(1), {ids({1, 2, 3, 4})}}});
  CHECK(scene.m.mesh() == mesh_of_input(scene.m));
  for (const std::int64_t i : {1, 2, 3, 4}) {  // all of it
    const auto points = scene.m.points();
    Point<3> to = points[static_cast<std::size_t>(i - 1)].at;
    to[2] += 0.0625;
    scene.m.move(id(i), to);
  }
  scene.m.update();
  CHECK(scene.m.mesh() == mesh_of_input(scene.m));
  scene.m.check_invariants();
}

TEST_CASE("A batch is judged by where it ends, whatever the order of its edits") {
  Scene scene;
  scene.m.update();
  scene.m.insert_segment(id(9), id(5), id(6));  // through polygon 1, which goes
  scene.m.insert_polygon({id(2), {ids({20, 21, 7})}});
  scene.m.insert(ids({20, 21}), {{0.9375, 0.5, 0.75}, {0.9375, 0.75, 0.5}});
  scene.m.remove(id(4));
  scene.m.remove_polygon(id(1));
  scene.m.update();
  CHECK(scene.m.mesh() == mesh_of_input(scene.m));
  CHECK(scene.m.mesh() == static_mesh(scene.m));
}

TEST_CASE("A feature that goes and comes again, or changes its id, leaves the mesh") {
  Scene scene;
  scene.m.update();
  const Mesh<3> before = scene.m.mesh();
  scene.m.remove_polygon(id(1));
  scene.m.insert_polygon({id(1), {ids({3, 4, 1, 2})}});
  scene.m.update();
  CHECK(scene.m.mesh() == before);
  scene.m.remove_polygon(id(1));
  scene.m.insert_polygon({id(5), {ids({1, 2, 3, 4})}});
  scene.m.update();
  Mesh<3> renamed = before;
  for (auto& face : renamed.faces) face.polygon = id(5);
  for (auto& edge : renamed.edges) edge.feature = PolygonId{5};
  CHECK(renamed != before);
  CHECK(scene.m.mesh() == renamed);
  scene.m.insert_segment(id(9), id(5), id(6));
  CHECK(refused(scene.m).ids == ids({9, 5}));
  scene.m.remove_polygon(id(5));
  scene.m.discard_edits();
  scene.m.update();
  CHECK(scene.m.mesh() == renamed);
}

TEST_CASE(
    "After random edits of features in space, refused ones among them, the mesh is a new one") {
  const std::uint64_t seed = GENERATE(1, 2, 3);
  CAPTURE(seed);
  mesher::SplitMix64 random(seed);
  BoxMesher<3> m(kOptions);
  std::map<std::int64_t, Point<3>> points;
  std::int64_t last = 0;
  const auto place = [&]() -> Point<3> {
    const auto step = [&] { return static_cast<double>(1 + random.below(7)) / 8; };
    return {step(), step(), step()};
  };
  const auto some = [&] {
    auto it = points.begin();
    std::advance(it, static_cast<std::ptrdiff_t>(random.below(points.size())));
    return id(it->first);
  };
  std::size_t refusals = 0, updates = 0;
  const auto edit = [&] {
    const auto polygons = m.polygons();
    const auto lines = m.lines();
    switch (points.size() < 6 ? 0 : random.below(7)) {
      case 0:
        m.insert(id(++last), place());
        break;
      case 1:
        m.move(some(), place());
        break;
      case 2:
        m.insert_segment(id(++last), some(), some());
        break;
      case 3:
        m.insert_polygon({id(++last), {{some(), some(), some()}}});
        break;
      case 4:
        m.insert_polygon({id(++last), {{some(), some(), some()}}});
        break;
      case 5:
        if (!lines.empty()) m.remove_line(lines[random.below(lines.size())].id);
        break;
      default:
        if (!polygons.empty()) m.remove_polygon(polygons[random.below(polygons.size())].id);
        break;
    }
  };
  for (int round = 0; round < 60; ++round) {
    CAPTURE(round);
    const Mesh<3> before = m.mesh();
    try {
      for (auto count = 1 + random.below(2); count > 0; --count) edit();
      m.update();
      ++updates;
    } catch (const Error& e) {
      if (e.code() == ErrorCode::too_many) throw;
      m.discard_edits();
      ++refusals;
      INFO(e.what());
      REQUIRE(m.mesh() == before);
      continue;
    }
    points.clear();
    for (const auto& [point, at, marker] : m.points())
      points[static_cast<std::int64_t>(point)] = at;
    REQUIRE(mesh_of_input(m) == static_mesh(m));
    REQUIRE(m.mesh() == static_mesh(m));
    if (round % 10 == 0) m.check_invariants();
  }
  CHECK(refusals > 5);
  CHECK(updates > 15);
}

// All of the first ones, and then fewer and fewer: there are thousands. What the store of edges can
// do without is no failure.
TEST_CASE("An update of features in which an allocation fails leaves all, and works again") {
  const auto with_segment = [] {
    Scene scene;
    scene.m.insert_segment(id(9), id(5), id(7));
    scene.m.update();
    return scene;
  };
  const auto announce = [](BoxMesher<3>& m) {
    m.remove_line(id(9));
    m.insert_polygon({id(2), {ids({1, 2, 5})}});
    m.insert(id(8), {0.9375, 0.875, 0.75});
    m.insert_segment(id(3), id(8), id(7));
    m.move(id(3), {0.8125, 0.75, 0.5});
  };
  Scene scene = with_segment();
  const Mesh<3> before = scene.m.mesh();
  const auto polygons = scene.m.polygons();
  const auto lines = scene.m.lines();
  bool burnt = true;
  int failures = 0;
  for (std::uint64_t count = 1; burnt; count += 1 + count / 20) {
    CAPTURE(count);
    announce(scene.m);
    if (!support::fails(count, burnt, [&] { scene.m.update(); })) {
      if (burnt) scene = with_segment();
      continue;
    }
    ++failures;
    scene.m.check_invariants();
    REQUIRE(scene.m.mesh() == before);
    REQUIRE(scene.m.polygons() == polygons);
    REQUIRE(scene.m.lines() == lines);
  }
  CHECK(failures > 100);
  CHECK(scene.m.polygons().size() == 2);
  CHECK(scene.m.mesh() == mesh_of_input(scene.m));
}
