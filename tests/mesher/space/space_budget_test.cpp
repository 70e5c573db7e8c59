// Meshes of complexes in space that may have so many vertices and no more.
#include <catch2/catch.hpp>
#include <regex>
#include <set>
#include <string>

#include "feature_ids.hpp"
#include "graph/plc_builder.hpp"
#include "mesher/domain_mesh.hpp"
#include "mesher/mesher.hpp"

namespace {

using mesher::ErrorCode;
using mesher::FeatureId;
using mesher::Plc;
using mesher::Point;

// Two triangles with a common side of length 1 along x from `at`, 0.1 degrees apart, and far from
// them a square and a point.
Plc wedge_at(const Point<3>& at) {
  mesher::detail::PlcBuilder b;
  const auto [x, y, z] = at;
  b.polygon({{{x, y, z}, {x + 1, y, z}, {x + 0.5, y + 0.8, z}}});
  b.polygon({{{x, y, z}, {x + 1, y, z}, {x + 0.5, y + 0.8, z + 0.0014}}});
  b.polygon({{{x + 2, y + 2, z}, {x + 3, y + 2, z}, {x + 3, y + 3, z}, {x + 2, y + 3, z}}});
  b.point({x + 2, y, z + 1});
  return b.finish();
}

mesher::Options<3> options_for(const Plc& plc, std::size_t most) {
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

void check_names(const mesher::Error& error, const Point<3>& at, const std::set<FeatureId>& ids) {
  REQUIRE(error.code() == ErrorCode::too_many);
  const auto named = support::ids_of(error);
  CHECK(std::set<FeatureId>(named.begin(), named.end()) == ids);
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
    const Plc plc = wedge_at(at);
    const auto ids = std::set{plc.facets[0].polygon.id, plc.facets[1].polygon.id};
    const auto options = options_for(plc, 1000);
    check_names(refusal_of([&] { (void)mesh_statically(plc, options); }), at, ids);
  }
}

TEST_CASE("an update that needs too many vertices names the polygons, and changes nothing") {
  const Plc plc = wedge_at({0, 0, 0});
  mesher::Mesher<3> m(options_for(plc, 1000));
  Plc without = plc;
  without.facets.erase(without.facets.begin() + 1);
  announce(without, m);
  m.update();
  const auto before = m.mesh();
  m.insert_polygon(plc.facets[1].polygon);
  const auto ids = std::set{plc.facets[0].polygon.id, plc.facets[1].polygon.id};
  check_names(refusal_of([&] { m.update(); }), {0, 0, 0}, ids);
  CHECK(m.mesh() == before);
  m.check_invariants();
}

TEST_CASE("where no feature has vertices of its own none is named") {
  Plc plc;
  for (int i = 0; i < 9; ++i) {
    plc.points.push_back({FeatureId{i + 1}, {i % 3 * 0.4, i / 3 * 0.4, i * 0.1}});
  }
  const auto error = refusal_of([&] { (void)mesh_statically(plc, options_for(plc, 5)); });
  CHECK(error.message() == "more than 5 vertices are needed");
  CHECK(error.features().empty());
}
