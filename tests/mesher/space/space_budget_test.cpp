// Meshes of complexes in space that may have so many vertices and no more.
#include <catch2/catch.hpp>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "facade/box_mesher.hpp"
#include "facade/graph_runs.hpp"
#include "feature_ids.hpp"
#include "graph/plc_builder.hpp"
#include "mesher/meshing.hpp"
#include "refinement/narrow_gaps.hpp"

namespace {

using mesher::ErrorCode;
using mesher::Graph;
using mesher::Point;
using mesher::PointId;
using mesher::PolygonId;

// Two triangles with a common side of length 1 along x from `at`, 0.1 degrees apart, and far from
// them a square and a point.
Graph<3> wedge_at(const Point<3>& at) {
  mesher::detail::PlcBuilder b;
  const auto [x, y, z] = at;
  b.polygon({{{x, y, z}, {x + 1, y, z}, {x + 0.5, y + 0.8, z}}});
  b.polygon({{{x, y, z}, {x + 1, y, z}, {x + 0.5, y + 0.8, z + 0.0014}}});
  b.polygon({{{x + 2, y + 2, z}, {x + 3, y + 2, z}, {x + 3, y + 3, z}, {x + 2, y + 3, z}}});
  b.point({x + 2, y, z + 1});
  return b.finish();
}

mesher::Options<3> options_for(const Graph<3>& plc, std::size_t most) {
  return {.domain = mesher::snapped_domain<3>(places_of(plc)), .rho = 2, .max_vertices = most};
}

template <class Run>
mesher::Error refusal_of(Run&& run) {
  try {
    run();
  } catch (const mesher::Error& error) {
    return error;
  }
  return {ErrorCode::bad_option, "not refused"};
}

void check_names(const mesher::Error& error, const Point<3>& at, const std::set<PolygonId>& ids) {
  REQUIRE(error.code() == ErrorCode::too_many);
  const std::vector<PolygonId> named = support::ids_of(error);
  CHECK(std::set(named.begin(), named.end()) == ids);
  const std::regex form(
      "more than 1000 vertices are needed; so far ([0-9]+) are on polygon [12] and "
      "([0-9]+) on polygon [12], the closest to each other near \\(([^,]*), ([^,]*), "
      "([^)]*)\\)");
  std::smatch said;
  const std::string message = error.message();
  REQUIRE(std::regex_match(message, said, form));
  CHECK(std::stoi(said[1]) >= std::stoi(said[2]));
  const Point<3> near{std::stod(said[3]), std::stod(said[4]), std::stod(said[5])};
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(near[i] >= at[i] - 1e-9);
    CHECK(near[i] <= at[i] + (i == 2 ? 0.01 : 1));
  }
}

}  // namespace

TEST_CASE(
    "where a small angle between polygons needs too many vertices both are named, and where") {
  for (const Point<3>& at : {Point<3>{0, 0, 0}, {-7, 3, 5}}) {
    const Graph<3> plc = wedge_at(at);
    const auto ids = std::set{plc.polygons[0].id, plc.polygons[1].id};
    const auto options = options_for(plc, 1000);
    check_names(refusal_of([&] { (void)mesh_statically(plc, options); }), at, ids);
  }
}

TEST_CASE("an update that needs too many vertices names the polygons, and changes nothing") {
  const Graph<3> plc = wedge_at({0, 0, 0});
  mesher::BoxMesher<3> m(options_for(plc, 1000));
  Graph<3> without = plc;
  without.polygons.erase(without.polygons.begin() + 1);
  announce(without, m);
  m.update();
  const auto before = m.mesh();
  m.insert_polygon(plc.polygons[1]);
  const auto ids = std::set{plc.polygons[0].id, plc.polygons[1].id};
  check_names(refusal_of([&] { m.update(); }), {0, 0, 0}, ids);
  CHECK(m.mesh() == before);
  m.check_invariants();
}

TEST_CASE("where no feature has vertices of its own none is named") {
  Graph<3> plc;
  for (int i = 0; i < 9; ++i) {
    plc.points.push_back({PointId{i + 1}, {i % 3 * 0.4, i / 3 * 0.4, i * 0.1}});
  }
  const auto error = refusal_of([&] { (void)mesh_statically(plc, options_for(plc, 5)); });
  CHECK(error.message() == "more than 5 vertices are needed");
  CHECK(error.features().empty());
}

namespace {

using Quadrilaterals = std::vector<std::vector<Point<3>>>;

// The sides of a box; the last one is the upper one.
void add_box(const Point<3>& lo, const Point<3>& hi, Quadrilaterals& to) {
  const int sides[6][4] = {{0, 1, 3, 2}, {4, 6, 7, 5}, {0, 4, 5, 1},
                           {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 5, 7, 3}};
  for (const auto& side : sides) {
    auto& places = to.emplace_back();
    for (const int i : side) {
      places.push_back({(i & 4 ? hi : lo)[0], (i & 2 ? hi : lo)[1], (i & 1 ? hi : lo)[2]});
    }
  }
}

}  // namespace

TEST_CASE("a plate that is far too thin for its size is refused early, with both sides' names") {
  Quadrilaterals sides;
  add_box({0, 0, 0}, {1, 1, 1e-4}, sides);
  mesher::detail::PlcBuilder b;
  for (const auto& side : sides) b.polygon({side});
  const Graph<3> plate = b.finish();
  auto options = options_for(plate, 10'000'000);  // of 4 10^7
  options.extent = mesher::Extent::enclosed;
  const auto error = refusal_of([&] { (void)mesher::box_mesh(plate, options); });
  CHECK(error.code() == ErrorCode::too_many);
  CHECK(error.message().find("10000000 vertices are needed: polygon ") != std::string::npos);
  CHECK(error.message().find(" are 1e-04 apart near (") != std::string::npos);
  const std::vector<PolygonId> ids = support::ids_of(error);
  CHECK(std::set(ids.begin(), ids.end()) == std::set{plate.polygons[4].id, plate.polygons[5].id});
}

TEST_CASE("narrow gaps are told by their area and width, on the side that is asked about") {
  constexpr double kWidth = 1e-3, kTop = 0.5;
  Quadrilaterals sides;
  add_box({0, 0, 0}, {1, 1, kTop}, sides);
  add_box({0, 0, kTop + kWidth}, {1, 1, 1}, sides);
  const mesher::detail::MeshBox<3> box{.lo = {-4, -4, -4}, .side = 8};
  mesher::detail::VertexPool<3> points;
  mesher::detail::FeatureStore store(box, points);
  std::vector<mesher::detail::PolygonHandle> polygons;
  std::map<Point<3>, mesher::detail::VertexHandle> handles;
  for (const auto& side : sides) {
    mesher::detail::PolygonParts parts;
    auto& loop = parts.loops.emplace_back();
    for (const Point<3>& p : side) {
      auto& handle = handles[p];
      if (handle == 0) handle = points.create(p).self;
      loop.push_back(handle);
    }
    mesher::detail::Polygon& f = store.record(parts);
    store.put(f);
    polygons.push_back(f.self);
  }
  const auto squares = [&](const Point<3>& beside) {
    const mesher::detail::Polygon& top = store.polygons()[polygons[5]];
    mesher::detail::NarrowGaps gaps(store);
    gaps.add(top, {Point<3>{0, 0, kTop}, {1, 0, kTop}, {1, 1, kTop}}, beside);
    gaps.add(top, {Point<3>{0, 0, kTop}, {1, 1, kTop}, {0, 1, kTop}}, beside);
    if (const auto worst = gaps.worst()) {
      CHECK(worst->one == polygons[5]);
      if (worst->width < 2 * kWidth) CHECK(worst->other == polygons[10]);
    }
    return 2 * gaps.vertices(1);
  };
  CHECK(squares({0.5, 0.5, 1}) == Approx(1 / (kWidth * kWidth)));
  CHECK(squares({0.5, 0.5, 0.25}) < 10);
}
