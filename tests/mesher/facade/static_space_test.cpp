// Static meshes of points in space: quality everywhere, by an exact judge, and how many vertices.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "facade/graph_runs.hpp"
#include "mesher/mesher.hpp"
#include "space_points.hpp"

namespace {

using mesher::Error;
using mesher::ErrorCode;
using mesher::Mesh;
using mesher::Options;
using mesher::Point;
using mesher::Rule;
using support::SpaceFamily;

using Points = std::vector<Point<3>>;

Options<3> options_for(const Points& points) {
  return {.domain = mesher::snapped_domain<3>(points)};
}

Mesh<3> mesh_of(const Points& points, const Options<3>& options) {
  return mesher::mesh_statically<3>(points, options);
}

ErrorCode refusal(const Points& points, const Options<3>& options) {
  try {
    static_cast<void>(mesh_of(points, options));
  } catch (const Error& e) {
    return e.code();
  }
  FAIL("not refused");
  return {};
}

}  // namespace

TEST_CASE("a mesh in space is Delaunay, fills its box, and has no poor tetrahedron anywhere") {
  for (const SpaceFamily family : support::kSpaceFamilies) {
    for (const std::size_t n : {1, 2, 3, 4, 5, 30, 300}) {
      INFO(name(family) << ", " << n << " points");
      const Points points = support::space_points(family, n, 5 + n);
      const Mesh<3> mesh = mesh_of(points, options_for(points));
      CHECK(support::space_verdict(mesh, points, 2) == "");
    }
  }
}

TEST_CASE("so it is for other bounds, far below the proven one, and by the paper's rule") {
  struct Setting {
    Rule rule;
    double rho;
  };
  for (const Setting& s :
       {Setting{Rule::radius_edge, 1.7}, Setting{Rule::radius_edge, 3.0},
        Setting{Rule::voronoi_aspect, 2.0}, Setting{Rule::voronoi_aspect, 1.6}}) {
    for (const SpaceFamily family : support::kSpaceFamilies) {
      INFO(name(family) << ", rho " << s.rho << ", rule " << static_cast<int>(s.rule));
      const Points points = support::space_points(family, 40, 11);
      Options<3> options = options_for(points);
      options.rule = s.rule;
      options.rho = s.rho;
      CHECK(support::space_verdict(mesh_of(points, options), points, s.rho) == "");
    }
  }
}

TEST_CASE("a mesh in space does not depend on the order of points") {
  for (const SpaceFamily family : support::kSpaceFamilies) {
    INFO(name(family));
    Points points = support::space_points(family, 120, 17);
    const Options<3> options = options_for(points);
    const Mesh<3> mesh = mesh_of(points, options);
    std::reverse(points.begin(), points.end());
    CHECK(mesh_of(points, options) == mesh);
  }
}

TEST_CASE("meshes in space have at most 2% more vertices than the model of the rules") {
  Points line_and_circle;  // as the model's
  for (int i = 0; i < 1000; ++i) {
    const double turn = 2 * 3.14159265358979323846 * i / 1000;
    line_and_circle.push_back({0, 0, -1 + 2.0 * i / 999});
    line_and_circle.push_back({std::cos(turn), std::sin(turn), 0});
  }
  const Points uniform = support::space_points(SpaceFamily::uniform, 10000, 23);
  CHECK(mesh_of(line_and_circle, options_for(line_and_circle)).vertices.size() < 1.02 * 13713);
  CHECK(mesh_of(uniform, options_for(uniform)).vertices.size() < 1.02 * 17321);
}

TEST_CASE("what cannot be meshed in space is refused by name") {
  const Options<3> options{.domain = {{0, 0, 0}, {1, 1, 1}}};
  CHECK(options.rho == 2);
  CHECK(refusal({{0.5, 0.5, 2}}, options) == ErrorCode::outside_domain);
  CHECK(refusal({{0.5, std::numeric_limits<double>::quiet_NaN(), 0}}, options) ==
        ErrorCode::not_finite);
  CHECK(refusal({{0.5, 0.5, 0x1p-120}}, options) == ErrorCode::magnitude);
  CHECK(refusal({{0.5, 0.5, 0.5}, {0.5, 0.5, 0.5}}, options) == ErrorCode::duplicate_point);
  CHECK(refusal({{0.5, 0.5, 0.5}, {0.5, 0.5, 0.5 + 0x1p-52}}, options) == ErrorCode::too_close);
  Options<3> limited = options;
  limited.max_measure = 1e-60;
  CHECK(refusal({}, limited) == ErrorCode::bad_option);
  Options<3> few = options;
  few.max_vertices = 400;
  CHECK(refusal(support::space_points(SpaceFamily::uniform, 100, 3), few) == ErrorCode::too_many);
  try {
    static_cast<void>(mesh_of({{0.5, 0.5, 2}}, options));
  } catch (const Error& e) {
    CHECK(std::string(e.what()).find("point 1 (0.5, 0.5, 2) lies outside the domain "
                                     "[0, 1] x [0, 1] x [0, 1]") != std::string::npos);
  }
}
