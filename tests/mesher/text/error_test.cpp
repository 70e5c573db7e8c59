// What the mesher refuses, how it says so, and that nothing has changed afterwards.
#include <algorithm>
#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <set>
#include <string>

#include "edit_sequence.hpp"
#include "facade/box_mesher.hpp"
#include "facade/graph_runs.hpp"
#include "feature_ids.hpp"
#include "io/point_file.hpp"
#include "mesher/check.hpp"
#include "mesher/mesher.hpp"
#include "mesher/read.hpp"
#include "scratch_file.hpp"

namespace {

using mesher::BoxMesher;
using mesher::Error;
using mesher::ErrorCode;
using mesher::LineId;
using mesher::Mesh;
using mesher::Options;
using mesher::Point;
using mesher::PointId;
using mesher::PolygonId;
using support::error_of;

const Options<2> kUnit{.domain = {{0, 0}, {1, 1}}};

// Far from the origin doubles are sparse: neighbouring ones leave no room for new vertices.
constexpr double kFar = 0x1p30;
constexpr double kStep = 0x1p-22;  // between doubles there
const Options<2> kFarAway{.domain = {{kFar, kFar}, {kFar + 1, kFar + 1}}, .rho = 1.1};
const Point<2> kA{kFar + 0.5, kFar + 0.5};
const Point<2> kBesideA{kFar + 0.5 + kStep, kFar + 0.5};

// The error's code and words, after a look that the mesher is as before.
template <class Run>
std::string refused(BoxMesher<2>& m, Run run) {
  const Mesh<2> before = m.mesh();
  const std::size_t size = m.size();
  const Error error = error_of(run);
  CHECK(m.size() == size);
  const auto change = m.update();
  CHECK(change.calls.executed == 0);
  CHECK(change.vertices_added.empty());
  CHECK(change.simplices_removed.empty());
  CHECK(m.mesh() == before);
  m.check_invariants();
  return std::string(code_name(error.code())) + ": " + error.message();
}

BoxMesher<2> with(const Options<2>& options, const std::vector<Point<2>>& points) {
  BoxMesher<2> m(options);
  std::int64_t id = 1;
  for (const auto& p : points) m.insert(PointId{id++}, p);
  m.update();
  return m;
}

}  // namespace

TEST_CASE("an edit that is refused names ids and values and changes nothing") {
  BoxMesher<2> m = with(kUnit, {{0.25, 0.5}, {0.5, 0.25}});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  const auto insert = [&](Point<2> p) { return refused(m, [&] { m.insert(PointId{7}, p); }); };
  const auto move = [&](Point<2> p) {  // whether a place is free when all have moved, update() says
    return refused(m, [&] {
      m.move(PointId{2}, p);
      m.update();
    });
  };

  CHECK(insert({0.25, 0.5}) == "duplicate_point: point 7 (0.25, 0.5) lies on point 1");
  CHECK(move({0.25, 0.5}) == "duplicate_point: point 2 (0.25, 0.5) lies on point 1");
  CHECK(
      insert({0.25, 0.5 + 0x1p-52})
          .starts_with(
              "too_close: point 7 (0.25, 0.5000000000000002) is too close to point 1 (0.25, 0.5)"));
  CHECK(move({0.25 + 0x1p-54, 0.5}).starts_with("too_close: point 2 "));
  CHECK(insert({1.5, 0.5}) ==
        "outside_domain: point 7 (1.5, 0.5) lies outside the domain [0, 1] x [0, 1]");
  CHECK(move({0.5, -1}) ==
        "outside_domain: point 2 (0.5, -1) lies outside the domain [0, 1] x [0, 1]");
  CHECK(insert({nan, 0}).starts_with("not_finite: point 7 (nan, 0)"));
  CHECK(insert({0, -infinity}).starts_with("not_finite: point 7 (0, -inf)"));
  CHECK(insert({1e-40, 0.5}).starts_with("magnitude: point 7 (1e-40, 0.5)"));
  CHECK(refused(m, [&] {
          m.insert(PointId{1}, {0.75, 0.75});
        }) == "repeated_id: point 1 is there already");
  CHECK(refused(m, [&] { m.remove(PointId{9}); }) == "unknown_id: point 9 is not there");
  CHECK(refused(m, [&] { m.move(PointId{9}, {0.5, 0.5}); }) == "unknown_id: point 9 is not there");
}

TEST_CASE("of many points to insert, all are or none is") {
  BoxMesher<2> m = with(kUnit, {{0.25, 0.5}});
  const std::vector<PointId> ids{PointId{2}, PointId{3}, PointId{4}};
  CHECK(error_of([&] {
          m.insert(ids, {{0.1, 0.1}, {0.9, 0.9}, {0.25, 0.5}});
        }).code() == ErrorCode::duplicate_point);
  CHECK(error_of([&] {
          m.insert(ids, {{0.1, 0.1}, {0.9, 0.9}, {2, 2}});
        }).code() == ErrorCode::outside_domain);
  CHECK(error_of([&] {
          m.insert({PointId{2}, PointId{2}}, {{0.1, 0.1}, {0.9, 0.9}});
        }).code() == ErrorCode::repeated_id);
  CHECK(m.size() == 1);
  CHECK_FALSE(m.contains(PointId{2}));
  m.update();
  CHECK(m.mesh() == mesher::mesh_statically<2>({{0.25, 0.5}}, kUnit));
  m.check_invariants();
}

TEST_CASE("options that make no sense are refused") {
  const auto code = [](Options<2> options) {
    return error_of([&] { BoxMesher<2> m(options); }).code();
  };
  CHECK(code({.domain = {{0, 0}, {0, 0}}}) == ErrorCode::bad_option);
  CHECK(code({.domain = {{1, 0}, {0, 1}}}) == ErrorCode::bad_option);
  CHECK(code({.domain = {{0, 0}, {1, 1}}, .rho = 1}) == ErrorCode::bad_option);
  CHECK(code({.domain = {{0, 0}, {1, std::nan("")}}}) == ErrorCode::bad_option);
  CHECK(code({.domain = {{0x1p60, 0}, {0x1p60 + 512, 1}}}) == ErrorCode::bad_option);
  CHECK(code({.domain = {{0, 0}, {0x1p101, 1}}}) == ErrorCode::bad_option);
}

TEST_CASE("edits taken back leave the mesh, and edits after them work") {
  BoxMesher<2> m = with(kUnit, {{0.25, 0.5}, {0.5, 0.25}});
  const Mesh<2> before = m.mesh();
  m.insert(PointId{3}, {0.75, 0.75});
  m.remove(PointId{1});
  m.move(PointId{2}, {0.1, 0.1});
  m.discard_edits();
  CHECK(m.size() == 2);
  CHECK(m.mesh() == before);
  m.insert(PointId{3}, {0.75, 0.75});
  m.update();
  CHECK(m.mesh() == mesher::mesh_statically<2>({{0.25, 0.5}, {0.5, 0.25}, {0.75, 0.75}}, kUnit));
  m.remove(PointId{3});
  m.update();
  CHECK(m.mesh() == before);
  m.check_invariants();
}

TEST_CASE("an update that fails leaves mesh and points as before its edits") {
  BoxMesher<2> m = with(kFarAway, {kA, {kFar + 0.25, kFar}, {kFar + 0.75, kFar + 0.25}});
  const Mesh<2> before = m.mesh();
  const auto fails = [&](auto edits) {
    edits();
    CHECK(error_of([&] { m.update(); }).code() == ErrorCode::too_close);
    CHECK(m.size() == 3);
    CHECK(m.mesh() == before);
    m.check_invariants();
    CHECK(m.update().calls.executed == 0);
    CHECK(m.mesh() == before);
    m.check_invariants();
  };
  SECTION("an insertion") {
    fails([&] { m.insert(PointId{4}, kBesideA); });
  }
  SECTION("a removal and an insertion: what the removal discarded comes back") {
    fails([&] {
      m.remove(PointId{2});
      m.insert(PointId{4}, kBesideA);
    });
  }
  SECTION("a move") {
    fails([&] { m.move(PointId{2}, kBesideA); });
  }
  SECTION("a removed point inserted again, and a good insertion") {
    fails([&] {
      m.remove(PointId{3});
      m.insert(PointId{5}, {kFar + 0.75, kFar + 0.25});
      m.insert(PointId{4}, kBesideA);
      m.insert(PointId{6}, {kFar + 1, kFar + 1});
      m.remove(PointId{2});
    });
  }
  // It goes on from there.
  m.insert(PointId{4}, {kFar + 0.5, kFar + 0.875});
  m.remove(PointId{2});
  m.update();
  CHECK(m.mesh() == mesher::mesh_statically<2>(
                        {kA, {kFar + 0.75, kFar + 0.25}, {kFar + 0.5, kFar + 0.875}}, kFarAway));
  m.check_invariants();
}

TEST_CASE("where doubles do not suffice the features around are named, points and lines") {
  const auto ids = [](const Error& error) {
    CHECK(error.code() == ErrorCode::too_close);
    std::set<std::int64_t> ids;
    for (const mesher::Feature& f : error.features()) ids.insert(f.number);
    return ids;
  };
  BoxMesher<2> m = with(kFarAway, {kA, {kFar + 0.25, kFar}, {kFar + 0.75, kFar + 0.25}});
  m.insert(PointId{4}, kBesideA);
  CHECK(ids(error_of([&] { m.update(); })) == std::set<std::int64_t>{1, 4});
  CHECK(ids(error_of([&] {
          (void)mesher::mesh_statically<2>({{kFar, kFar}, kBesideA, kA}, kFarAway,
                                           {PointId{7}, PointId{8}, PointId{9}});
        })) == std::set<std::int64_t>{8, 9});
  Options<2> options = kFarAway;
  options.rho = 1.05;
  for (int step = 0; step < 5; ++step) {
    const Point<2> beside{kA[0] + step * kStep, kA[1] + (1 + step) * kStep};
    const Error error = error_of([&] {
      (void)mesher::mesh_statically({{kFar, kFar + 0.5}, {kFar + 1, kFar + 0.5}, beside},
                                    {{LineId{5}, PointId{1}, PointId{2}}}, options);
    });
    CHECK(ids(error) == std::set<std::int64_t>{3, 5});
    CHECK(error.message().find("segment 5") != std::string::npos);
    CHECK(error.message().find("point 3") != std::string::npos);
  }
}

TEST_CASE("a first update that fails leaves a mesher without points") {
  BoxMesher<2> m(kFarAway);
  m.insert(PointId{1}, kA);
  m.insert(PointId{2}, kBesideA);
  CHECK(error_of([&] { m.update(); }).code() == ErrorCode::too_close);
  CHECK(m.size() == 0);
  m.insert(PointId{1}, kA);
  m.update();
  CHECK(m.mesh() == mesher::mesh_statically<2>({kA}, kFarAway));
}

TEST_CASE("refinement ends with an error where doubles are too sparse for it, for every rho") {
  for (const double rho : {1.05, 1.06, 1.1, 1.2, 1.4142, 2.0}) {
    for (const auto rule : {mesher::Rule::radius_edge, mesher::Rule::voronoi_aspect}) {
      for (int step = 1; step < 6; ++step) {
        Options<2> options = kFarAway;
        options.rho = rho;
        options.rule = rule;
        try {
          const Point<2> b{kA[0] + step * kStep, kA[1] + (step - 3) * kStep};
          const Mesh<2> mesh = mesher::mesh_statically<2>({kA, b}, options);
          CHECK(mesher::quality(mesh).max_radius_edge <= rho * (1 + 1e-9));
        } catch (const Error& error) {
          CHECK(error.code() == ErrorCode::too_close);
        }
      }
    }
  }
}

TEST_CASE("zero has no sign in a mesh") {
  const Options<2> options{.domain = {{-1, -1}, {1, 1}}};
  const Mesh<2> expected = mesher::mesh_statically<2>({{0.0, 0.0}, {0.5, 0.0}}, options);
  BoxMesher<2> m = with(options, {{-0.0, -0.0}, {0.5, -0.0}});
  m.move(PointId{1}, {0.0, -0.0});
  m.update();
  const Mesh<2> mesh = m.mesh();
  CHECK(mesh == expected);
  for (const auto& p : mesh.vertices) {
    for (const double x : p) CHECK((x != 0 || !std::signbit(x)));
  }
}

namespace {

using mesher::Feature;

constexpr Feature point(std::int64_t i) { return PointId{i}; }
constexpr Feature line(std::int64_t i) { return LineId{i}; }
constexpr Feature polygon(std::int64_t i) { return PolygonId{i}; }

std::vector<Feature> sorted(std::vector<Feature> features) {
  std::sort(features.begin(), features.end());
  return features;
}

}  // namespace

TEST_CASE("an error of edits in the plane says which kind its features are of, and where it is") {
  mesher::Mesher<2> m(kUnit);
  std::int64_t id = 0;
  for (const Point<2> p : {Point<2>{0.25, 0.25}, {0.75, 0.75}, {0.25, 0.75}, {0.75, 0.25}}) {
    m.insert(PointId{++id}, p);
  }
  const Error outside = error_of([&] { m.insert(PointId{7}, {1.5, 0.5}); });
  CHECK(outside.features() == std::vector{point(7)});
  CHECK(outside.places() == std::vector<mesher::Position>{{1.5, 0.5, 0}});
  CHECK(outside.locations().empty());

  m.insert_segment(LineId{1}, PointId{1}, PointId{2});
  m.update();
  // Line 2 has the id of a point: only the kind tells which is meant.
  m.insert_segment(LineId{2}, PointId{3}, PointId{4});
  const Error crossing = error_of([&] { m.update(); });
  CHECK(crossing.code() == ErrorCode::crossing_segments);
  CHECK(sorted(crossing.features()) == std::vector{line(1), line(2)});
  CHECK(crossing.places() == std::vector<mesher::Position>{{0.5, 0.5, 0}});

  m.discard_edits();
  m.insert(PointId{1000}, {0.375, 0.375});
  const Error on = error_of([&] { m.update(); });
  CHECK(on.code() == ErrorCode::point_on_segment);
  CHECK(on.features() == std::vector{point(1000), line(1)});
  CHECK(on.places() == std::vector<mesher::Position>{{0.375, 0.375, 0}});

  m.discard_edits();
  m.remove(PointId{2});
  CHECK(error_of([&] { m.update(); }).features() == std::vector{point(2), line(1)});
  m.discard_edits();
  CHECK(error_of([&] { m.remove_line(LineId{4}); }).features() == std::vector{line(4)});
  const mesher::SeedId hole = mesher::hole_id(3);
  CHECK(error_of([&] { m.remove_seed(hole); }).features() == std::vector<Feature>{hole});
}

TEST_CASE("an error of edits in space names points, polygons and segments by kind") {
  BoxMesher<3> m(Options<3>{.domain = {{0, 0, 0}, {1, 1, 1}}});
  const std::vector<Point<3>> corners{
      {0.25, 0.25, 0.5}, {0.75, 0.25, 0.5}, {0.5, 0.75, 0.5}, {0.5, 0.5, 0.25}, {0.5, 0.5, 0.75}};
  std::int64_t id = 0;
  for (const auto& p : corners) m.insert(PointId{++id}, p);
  m.insert_polygon({.id = PolygonId{4}, .loops = {{PointId{1}, PointId{2}, PointId{3}}}});
  m.insert_segment(LineId{4}, PointId{4}, PointId{5});
  const Error through = error_of([&] { m.update(); });
  CHECK(through.code() == ErrorCode::segment_through_polygon);
  CHECK(through.features() == std::vector{line(4), polygon(4)});
  REQUIRE(through.places().size() == 1);
  for (std::size_t i = 0; i < 3; ++i) CHECK(std::abs(through.places()[0][i] - 0.5) < 1e-9);

  m.discard_edits();
  CHECK(error_of([&] { m.remove_polygon(PolygonId{9}); }).features() == std::vector{polygon(9)});
  const Error loop = error_of([&] {
    m.insert_polygon({.id = PolygonId{1}, .loops = {{PointId{1}, PointId{2}, PointId{1}}}});
  });
  CHECK(loop.code() == ErrorCode::bad_polygon);
  CHECK(loop.features() == std::vector{polygon(1), point(1)});
}

TEST_CASE("an error about a file says where each of its features stands") {
  const support::ScratchFolder folder;
  const std::string path = folder.write(
      "cross.poly", "4 2 0 0\n1 0 0\n2 1 1\n3 0 1\n4 1 0\n2 0\n1 1 2\n2 3 4\n1\n5 9 9\n");
  const mesher::GraphFile<2> file = mesher::read<2>(path);
  const Error error = error_of([&] {
    (void)mesher::mesh_statically(file.graph, Options<2>{.domain = {{-1, -1}, {2, 2}}});
  });
  CHECK(error.code() == ErrorCode::crossing_segments);
  const Error found = mesher::located(error, file);
  REQUIRE(found.features().size() == 2);
  REQUIRE(found.locations().size() == 2);
  for (std::size_t i = 0; i < 2; ++i) {
    CHECK(found.locations()[i] == location_of(found.features()[i], file));
    CHECK(found.locations()[i].file == path);
    CHECK(found.locations()[i].line == (found.features()[i] == line(1) ? 7 : 8));
  }
  CHECK(found.location() == found.locations()[0]);
  CHECK(found.places() == std::vector<mesher::Position>{{0.5, 0.5, 0}});
  CHECK(location_of(point(3), file).line == 4);
  CHECK(location_of(mesher::hole_id(5), file).line == 10);
  CHECK(location_of(mesher::region_id(5), file).line == 0);
  CHECK(location_of(point(9), file).line == 0);

  // Two points in one place, in a file of points: said while it is read.
  const std::string twice = folder.write("twice.xyz", "0 0 0\n1 0 0\n0 0 0\n");
  const Error same = error_of([&] { (void)mesher::read_points<3>(twice); });
  CHECK(same.features() == std::vector{point(3), point(1)});
  REQUIRE(same.locations().size() == 2);
  CHECK(same.locations()[0].line == 3);
  CHECK(same.locations()[1].line == 1);
  CHECK(same.places() == std::vector<mesher::Position>{{0, 0, 0}});
}

TEST_CASE("a feature is written as the field's word for its kind, and its id") {
  CHECK(text_of(point(3)) == "point 3");
  CHECK(text_of(line(-5)) == "segment -5");
  CHECK(text_of(polygon(2)) == "polygon 2");
  CHECK(text_of(Feature(mesher::hole_id(1))) == "hole 1");
  CHECK(text_of(Feature(mesher::region_id(4))) == "region 4");
  CHECK(text_of(Feature{}).empty());
  CHECK(point(9) < line(1));  // by kind first
  CHECK(line(1) != point(1));
}
