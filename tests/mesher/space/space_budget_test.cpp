// Meshes of complexes in space that may have so many vertices and no more.
#include <catch2/catch.hpp>
#include <regex>
#include <set>
#include <string>

#include "facade/box_mesher.hpp"
#include "facade/graph_runs.hpp"
#include "feature_ids.hpp"
#include "graph/plc_builder.hpp"
#include "mesher/meshing.hpp"

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
