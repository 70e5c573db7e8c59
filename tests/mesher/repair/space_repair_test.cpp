// Repaired complexes: what each rule does.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "feature_ids.hpp"
#include "mesher/meshing.hpp"
#include "mesher/repair.hpp"
#include "random_soup.hpp"
#include "repaired_complex.hpp"

namespace {

using mesher::Error;
using mesher::Graph;
using mesher::Point;
using mesher::Repaired;
using mesher::RepairKind;
using mesher::detail::PlcBuilder;
using support::area;
using support::id;
using support::ids;
using support::notes_of;
using support::repaired;
using support::square;

}  // namespace

TEST_CASE("a complex without faults comes back as it is, in its order, and so does none") {
  Graph<3> plc;
  plc.points = {{id(9), {0, 0, 0}, 3}, {id(2), {4, 0, 0}}, {id(5), {4, 4, 0}}, {id(1), {0, 4, 0}},
                {id(7), {1, 1, 0}},    {id(8), {2, 1, 0}}, {id(3), {3, 3, 0}}, {id(4), {1, 1, 2}}};
  plc.attributes_per_point = 1;
  plc.attributes = {1, 2, 3, 4, 5, 6, 7, 8};
  plc.polygons = {{id(6), {ids({5, 1, 9, 2})}, {{id(8), id(7)}}, ids({3}), 4}};
  plc.segments = {{id(3), id(7), id(4), 1}, {id(1), id(8), id(4), 2}};
  plc.seeds = {mesher::hole_seed<3>(1, {1, 2, 3})};
  const Repaired<3> r = repaired(plc);
  REQUIRE(r.file.graph == plc);
  REQUIRE(r.notes.empty());
  REQUIRE(r.deviation == 0);
  REQUIRE(mesher::repair(Graph<3>{}).file.graph == Graph<3>{});
}

TEST_CASE("a bent quadrilateral becomes two triangles, of which the first keeps the id") {
  PlcBuilder b;
  b.polygon({{{0, 0, 0}, {2, 0, 0}, {2, 2, 0.5}, {0, 2, 0}}});
  Graph<3> plc = b.finish();
  plc.polygons[0].marker = 7;
  const Repaired<3> r = repaired(plc);
  REQUIRE(r.file.graph.polygons.size() == 2);
  REQUIRE(r.file.graph.polygons[0].id == id(1));
  REQUIRE(r.file.graph.polygons[1].id == id(2));
  for (const auto& f : r.file.graph.polygons) {
    REQUIRE(f.loops[0].size() == 3);
    REQUIRE(f.marker == 7);
  }
  REQUIRE(r.notes.size() == 1);
  REQUIRE(r.notes[0].kind == RepairKind::bent_polygon);
  REQUIRE(r.notes[0].polygons == ids({1, 2}));
  REQUIRE(r.notes[0].deviation > 0.1);
  REQUIRE(r.file.graph.points == plc.points);
}

TEST_CASE("a bent polygon keeps its hole, the edge and the point that lie in it") {
  PlcBuilder b;
  b.polygon(
      {{{0, 0, 0}, {6, 0, 0}, {6, 6, 1}, {0, 6, 0}}, {{1, 1, 0}, {2, 1, 0}, {2, 2, 0}, {1, 2, 0}}},
      {{Point<3>{4, 1, 0}, Point<3>{5, 2, 0}}});
  Graph<3> plc = b.finish();
  plc.points.push_back({id(99), {1, 4, 0}});
  plc.polygons[0].points = {id(99)};
  const Repaired<3> r = repaired(plc);
  REQUIRE(r.file.graph.points == plc.points);
  REQUIRE(area(r.file.graph) == Approx(35).epsilon(0.05));
  bool has_edge = false, has_point = false;
  for (const auto& f : r.file.graph.polygons) {
    const auto& loop = f.loops[0];
    const auto on = [&](mesher::PointId v) {
      return std::find(loop.begin(), loop.end(), v) != loop.end();
    };
    has_edge = has_edge || (on(plc.polygons[0].edges[0][0]) && on(plc.polygons[0].edges[0][1]));
    has_point = has_point || on(id(99));
  }
  REQUIRE(has_edge);
  REQUIRE(has_point);
}

TEST_CASE("a polygon whose edges cross from every side is cut into triangles between its corners") {
  PlcBuilder b;
  b.polygon({{{0, 0, 0}, {1, 1, 1}, {1, 0, 0.1}, {0.1, 1, 0.9}}});
  const Repaired<3> r = repaired(b.finish());
  REQUIRE(r.file.graph.polygons.size() == 2);
  REQUIRE(r.file.graph.points.size() == 4);
}

TEST_CASE("points in one place are one, also for polygons, which may lose all of their area") {
  PlcBuilder b;
  b.polygon({square(0, 0, 0)});
  b.polygon({{{0, 0, 0}, {1, 0, 0}, {0.5, 1e-16, 0}}});
  Graph<3> plc = b.finish();
  plc.points.push_back({id(50), {1, 1, 1e-16}, 6});
  plc.points.push_back({id(51), {1, 2, 0}});
  plc.segments = {{id(4), id(50), id(51)}, {id(5), id(50), plc.polygons[0].loops[0][2]}};
  const Repaired<3> r = repaired(plc);
  const auto& out = r.file.graph;
  REQUIRE(out.segments.size() == 1);
  REQUIRE(out.segments[0].from == plc.polygons[0].loops[0][2]);
  REQUIRE(out.polygons.size() == 1);
  REQUIRE(out.polygons[0].loops[0].size() == 5);
  REQUIRE(notes_of(r) == std::vector<std::string>{
                             "point 50 is point 3 at (1, 1, 0)",
                             "segment 5: a piece without length is dropped, at point 3 (1, 1, 0)",
                             "polygon 1 has point 5 (0.5, 1e-16, 0) on it",
                             "segment 5 is dropped: nothing is left of it",
                             "polygon 2 is dropped: nothing is left of it"});
  REQUIRE(out.points[2].marker == 6);
}

TEST_CASE("segments are split at points and where they cross, and go on under new ids") {
  PlcBuilder b;
  b.segment({0, 0, 0}, {4, 4, 4});
  b.segment({0, 4, 2}, {4, 0, 2});
  Graph<3> plc = b.finish();
  plc.points.push_back({id(9), {1, 1, 1}});
  plc.segments[0].marker = 5;
  plc.segments[1].marker = 8;
  plc.attributes_per_point = 1;
  plc.attributes = {0, 4, 10, 20, 100};
  const auto& out = repaired(plc).file.graph;
  REQUIRE(out.segments.size() == 5);
  REQUIRE(out.segments[0] == mesher::Segment{id(1), id(1), id(9), 5});
  REQUIRE(out.segments[2] == mesher::Segment{id(3), id(9), id(10), 5});
  REQUIRE(out.segments[4] == mesher::Segment{id(5), id(10), id(4), 8});
  REQUIRE(out.points.back() == mesher::GraphPoint<3>{id(10), {2, 2, 2}, 5});
}

TEST_CASE("what goes through a polygon, or lies on it, is declared to") {
  PlcBuilder b;
  b.polygon({square(0, 0, 0, 4)});
  b.segment({1, 1, -1}, {1, 1, 1});
  b.segment({2, 3, 0}, {3, 3, 0});
  Graph<3> plc = b.finish();
  plc.points.push_back({id(90), {3, 1, 0}});
  const Repaired<3> r = repaired(plc);
  const auto& f = r.file.graph.polygons[0];
  REQUIRE(f.edges.size() == 1);
  REQUIRE(f.points == ids({91, 90}));
  REQUIRE(r.file.graph.points.back().at == Point<3>{1, 1, 0});
  REQUIRE(r.file.graph.segments.size() == 3);
  REQUIRE(notes_of(r) ==
          std::vector<std::string>{"polygon 1 has point 7 (2, 3, 0) on it",
                                   "polygon 1 has point 8 (3, 3, 0) on it",
                                   "polygon 1 has point 90 (3, 1, 0) on it",
                                   "segment 1 and polygon 1 cross at (1, 1, 0), point 91 now",
                                   "segment 1 goes on as segment 3 from (1, 1, 0) on"});
}

TEST_CASE("polygons that cross have the edges along their line, also across each other's borders") {
  PlcBuilder b;
  b.polygon({square(0, 0, 0, 4)});
  b.polygon({{{1, 2, -1}, {6, 2, -1}, {6, 2, 1}, {1, 2, 1}}});
  const auto& out = repaired(b.finish()).file.graph;
  REQUIRE(out.polygons.size() == 2);
  REQUIRE(out.polygons[0].edges.size() == 1);
  REQUIRE(out.polygons[0].edges == out.polygons[1].edges);
  REQUIRE(area(out) == Approx(26));
}

TEST_CASE("a polygon that is thinner than doubles tell, but not than the tolerance, stays flat") {
  PlcBuilder b;
  b.polygon({{{0.1, 0.2, 0.3}, {0.9, 0.8, 0.7}, {0.5, 0.5 + 1e-9, 0.5}}});
  REQUIRE(repair(b.finish()).file.graph.polygons.size() == 1);
}

TEST_CASE("what cannot be repaired in space is an error with its place") {
  mesher::GraphFile<3> file;
  file.file = file.point_file = "x.poly";
  file.graph.points = {{id(1), {0, 0, 0}}, {id(2), {1, 0, 0}}};
  file.points = {{2, 1}, {3, 1}};
  file.graph.segments = {{id(4), id(1), id(7)}};
  file.segments = {{5, 1}};
  const auto said = [&](const mesher::GraphFile<3>& f, std::optional<mesher::Box<3>> domain = {}) {
    try {
      static_cast<void>(repair(f, {.domain = domain}));
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  REQUIRE(said(file) ==
          "x.poly:5:1: error[unknown_id]: point 7, an end of segment 4, is not there");
  file.graph.segments[0].to = id(2);
  REQUIRE(said(file).empty());
  REQUIRE(said(file, mesher::Box<3>{{-1, -1, -1}, {0.5, 1, 1}}).find("x.poly:3:1") == 0);
  file.graph.polygons = {{id(3), {ids({1, 2, 5})}}};
  file.polygons = {{7, 1}};
  REQUIRE(said(file) ==
          "x.poly:7:1: error[unknown_id]: point 5, a corner of polygon 3, is not there");
  file.graph.polygons = {{id(3), {}}, {id(3), {}}};
  file.polygons = {{7, 1}, {8, 1}};
  REQUIRE(said(file).find("x.poly:8:1: error[repeated_id]") == 0);
  file.graph.polygons = {};
  file.graph.points[1].at[1] = std::numeric_limits<double>::infinity();
  REQUIRE(said(file).find("x.poly:3:1: error[not_finite]") == 0);
}

TEST_CASE("a complex that was made by hand, without positions, is repaired in its file as well") {
  PlcBuilder b;
  b.polygon({square(0, 0, 0, 4)});
  b.polygon({{{1, 2, -1}, {6, 2, -1}, {6, 2, 1}, {1, 2, 1}}});
  mesher::GraphFile<3> file;
  file.graph = b.finish();
  file.graph.points.push_back({id(70), {1, 1, 0}});
  file.graph.points.push_back({id(71), {1, 1, 3}});
  file.graph.points.push_back({id(72), {1, 1, 0}});
  file.graph.segments = {{id(1), id(70), id(71)}, {id(2), id(72), id(71)}};
  file.graph.seeds = {mesher::hole_seed<3>(1, {2, 3, 1})};
  const Repaired<3> r = repair(file);
  REQUIRE(r.file.graph == repair(file.graph).file.graph);
  REQUIRE(!r.notes.empty());
  REQUIRE(r.file.points.size() == r.file.graph.points.size());
  REQUIRE(r.file.segments.size() == r.file.graph.segments.size());
  REQUIRE(r.file.polygons.size() == r.file.graph.polygons.size());
  REQUIRE(r.file.seeds.size() == 1);
  file.polygons = {{7, 1}};  // of the first alone
  REQUIRE(repair(file).file.graph == r.file.graph);
  file.graph.attributes_per_point = 2;
  REQUIRE_THROWS_WITH(repair(file),
                      "error[wrong_count]: 0 attributes are there, of 11 points with 2 each");
}

namespace {

// A block of triangles, whose top or bottom is a grid with heights that are rounding.
void add_block(PlcBuilder& b, double lo, double hi, int n, bool top, std::uint64_t seed) {
  mesher::SplitMix64 random(seed);
  const auto at = [&](int i) { return i == n ? 4 : 4.0 * i / n; };
  std::vector<std::vector<Point<3>>> grid;
  for (int i = 0; i <= n; ++i) {
    auto& row = grid.emplace_back();
    for (int j = 0; j <= n; ++j) {
      const double noise = 4e-7 * (random.unit() - 0.5);
      row.push_back({at(i), at(j), (top ? hi : lo) + noise});
    }
  }
  const auto triangle = [&](const Point<3>& p, const Point<3>& q, const Point<3>& r) {
    b.polygon({{p, q, r}});
  };
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      triangle(grid[i][j], grid[i + 1][j], grid[i + 1][j + 1]);
      triangle(grid[i][j], grid[i + 1][j + 1], grid[i][j + 1]);
    }
  }
  const Point<3> apex{2, 2, top ? lo : hi};
  for (int i = 0; i < n; ++i) {
    triangle(grid[i][0], grid[i + 1][0], apex);
    triangle(grid[i][n], grid[i + 1][n], apex);
    triangle(grid[0][i], grid[0][i + 1], apex);
    triangle(grid[n][i], grid[n][i + 1], apex);
  }
}

}  // namespace

TEST_CASE("surfaces that touch up to rounding are made to touch") {
  PlcBuilder b;
  add_block(b, 0, 2, 3, true, 1);
  add_block(b, 2, 4, 4, false, 2);
  const Graph<3> plc = b.finish();
  const Repaired<3> usual = repair(plc), least = repair(plc, {.tolerance = 0});
  CHECK(usual.tolerance > 1e6 * least.tolerance);
  CHECK(usual.deviation <= 16 * usual.tolerance);
  INFO(usual.file.graph.points.size() << " and " << least.file.graph.points.size());
  CHECK(usual.file.graph.points.size() < least.file.graph.points.size());
  const auto domain = support::domain_of(plc);
  const auto made =
      mesher::mesh(usual.file.graph, mesher::Options<3>{.domain = domain, .max_vertices = 20000});
  CHECK(made.mesh.vertices.size() < 20000);
}

namespace {

// The sides of a prism around the z-axis, each of two triangles.
void add_prism(PlcBuilder& b, int sides, double radius, double turn, double lo, double hi) {
  const auto at = [&](int k, double z) {
    const double angle = 6.283185307179586 * k / sides + turn;
    return Point<3>{radius * std::cos(angle), radius * std::sin(angle), z};
  };
  for (int k = 0; k < sides; ++k) {
    b.polygon({{at(k, lo), at(k + 1, lo), at(k + 1, hi)}});
    b.polygon({{at(k, lo), at(k + 1, hi), at(k, hi)}});
  }
}

}  // namespace

// Sides are 10^-5 apart, about the tolerance, and their planes meet at 10^-4: points where edges
// are near each other bend them, and what bent sides are cut into was near other edges again.
TEST_CASE(
    "surfaces that nearly coincide get points where their own edges are near, not where cuts are") {
  constexpr int kSides = 32;
  PlcBuilder b;
  add_prism(b, kSides, 1, 0, 0, 0.25);
  add_prism(b, kSides, 1.00001, 1e-4, -0.03, 0.24);
  const Graph<3> plc = b.finish();
  const Repaired<3> r = repair(plc);
  CHECK(r.deviation <= 2 * r.tolerance);
  CHECK(r.file.graph.points.size() <= 8 * kSides);  // a new one a corner at most
  CHECK(repair(r.file).notes.empty());
}

TEST_CASE("a tolerance that cannot be is refused") {
  PlcBuilder b;
  b.polygon({square(0, 0, 0, 4)});
  b.polygon({{{1, 2, -1}, {6, 2, -1}, {6, 2, 1}, {1, 2, 1}}});
  const Graph<3> plc = b.finish();
  CHECK(repair(plc, {.tolerance = 0.125}).tolerance == 0.125);
  for (const double t : {-1.0, 100.0, std::numeric_limits<double>::quiet_NaN(),
                         std::numeric_limits<double>::infinity()}) {
    REQUIRE_THROWS_WITH(
        repair(plc, {.tolerance = t}),
        Catch::Matchers::StartsWith("error[bad_option]: the tolerance of a repair"));
  }
  REQUIRE(repair(plc, {.tolerance = 0}).file.graph == repair(plc).file.graph);
}
