// Sparse Voronoi refinement: what it alone has. (Its meshes: refinements_test.cpp.)
#include "refinement/svr.hpp"

#include <catch2/catch.hpp>
#include <limits>
#include <vector>

#include "mesher/delaunay.hpp"
#include "mesher/extra/generate.hpp"
#include "refined_case.hpp"

namespace {

using mesher::Error;
using mesher::ErrorCode;
using mesher::Options;
using mesher::Point;
using mesher::PointKind;
using mesher::SvrStats;

template <int D>
Options<D> options_for(const std::vector<Point<D>>& points) {
  return {.domain = mesher::snapped_domain<D>(points)};
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("an SVR mesh is what it should be for other bounds and other warps", "",
                       ((int D), D), 2, 3) {
  for (const double rho : {1.1, 1.3, 1.7, 3.0, 20.0}) {
    if (D == 3 && rho < 1.2) continue;  // too many vertices for a judge
    for (const double k : {0.3, 0.9, 0.99}) {
      INFO("rho " << rho << ", k " << k);
      const auto points = mesher::generate_points<D>(PointKind::clusters, 60, 5);
      auto options = options_for<D>(points);
      options.rho = rho;
      support::check_refined<D>(mesher::svr<D>(points, options, {.k = k}), points, rho);
    }
  }
}

TEST_CASE("SVR refuses a k that is out of range") {
  for (const double k : {0.0, 1.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    try {
      static_cast<void>(mesher::svr<3>({}, {.domain = {{0, 0, 0}, {1, 1, 1}}}, {.k = k}));
      FAIL("not refused");
    } catch (const Error& e) {
      CHECK(e.code() == ErrorCode::bad_option);
    }
  }
}

TEST_CASE("quality and degrees stay bounded while SVR runs, where those of all points do not") {
  const auto points = mesher::generate_points<3>(PointKind::line_circle, 1000, 1);
  SvrStats stats;
  const auto mesh = mesher::svr<3>(points, options_for<3>(points), {}, {}, &stats);
  CHECK(stats.vertices == mesh.vertices.size());
  CHECK(stats.simplices == mesh.simplices.size());
  CHECK(stats.warped + stats.crowded + 1 == points.size());
  CHECK(stats.on_sides == 0);
  CHECK(stats.worst_radius_edge > 2);
  CHECK(stats.worst_radius_edge < 100);
  CHECK(stats.largest_degree >= 20);
  CHECK(stats.largest_degree < 200);  // the first point's neighbours: most of the box's
  CHECK(mesher::delaunay<3>(points).simplices.size() > 200000);
  CHECK(mesh.simplices.size() < 60000);
}

TEST_CASE("SVR meshes in space have at most 0.95 of TetGen's vertices, of grids not many more") {
  const auto space = mesher::generate_points<3>(PointKind::uniform, 10000, 1);
  CHECK(mesher::svr<3>(space, options_for<3>(space)).vertices.size() < 0.95 * 17255);
  const auto grid = mesher::generate_points<3>(PointKind::grid, 27000, 1);
  CHECK(mesher::svr<3>(grid, options_for<3>(grid)).vertices.size() < 1.07 * 27000);
}
