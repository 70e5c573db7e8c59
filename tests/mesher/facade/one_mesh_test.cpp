// One mesh: a run that searches for each cell, one that reads it from the triangulation, and one
// without the engine end with the same.
#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "facade/box_mesher.hpp"
#include "facade/graph_runs.hpp"
#include "mesher/extra/generate.hpp"

namespace {

using mesher::Options;
using mesher::Point;
using mesher::PointId;
using mesher::PointKind;

template <int D>
Options<D> wide() {
  Options<D> options;
  options.domain.lo.fill(-32);
  options.domain.hi.fill(32);
  options.rho = D == 2 ? 1.4142 : 2;
  return options;
}

template <int D>
mesher::Mesh<D> meshed(const std::vector<Point<D>>& points, const Options<D>& options) {
  mesher::BoxMesher<D> m(options);
  for (std::size_t i = 0; i < points.size(); ++i) {
    m.insert(PointId{static_cast<std::int64_t>(i + 1)}, points[i]);
  }
  m.update();
  m.check_invariants();  // each observation is what a search from nothing finds
  return m.mesh();
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("cells that are read and cells that are searched for lead to one mesh",
                       "[template]", ((int D), D), 2, 3) {
  for (const PointKind kind : {PointKind::uniform, PointKind::gaussian, PointKind::clusters,
                               PointKind::grid, PointKind::line_circle, PointKind::sphere}) {
    INFO(static_cast<int>(kind));
    const auto points = mesher::generate_points<D>(kind, D == 2 ? 400 : 120, 5);
    Options<D> searches = wide<D>();
    searches.record_weights = true;  // of searches
    const auto expected = meshed<D>(points, searches);
    CHECK(meshed<D>(points, wide<D>()) == expected);
    CHECK(mesher::mesh_statically<D>(points, wide<D>()) == expected);
  }
}

TEST_CASE("a line and a circle in space lead to one mesh though cells are searched for") {
  const auto points = mesher::generate_points<3>(PointKind::line_circle, 700, 1);
  CHECK(mesher::mesh_statically<3>(points, wide<3>()) == meshed<3>(points, wide<3>()));
}
