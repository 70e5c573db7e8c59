// How many vertices meshes in space have, against those of a model of the same rule: at most 1.02
// times as many, and no tetrahedron above rho, those at the box included.
#include <catch2/catch.hpp>
#include <vector>

#include "facade/graph_runs.hpp"
#include "mesher/check.hpp"
#include "mesher/extra/generate.hpp"
#include "mesher/mesher.hpp"

namespace {

using mesher::PointKind;

struct Case {
  PointKind kind;
  std::size_t n;
  std::size_t model;  // its vertices, counted once
};

void check(const Case& c) {
  const auto points = mesher::generate_points<3>(c.kind, c.n, 1);
  const mesher::Options<3> options{.domain = mesher::snapped_domain<3>(points)};
  const auto mesh = mesher::mesh_statically<3>(points, options);
  INFO(static_cast<int>(c.kind) << ", " << c.n << " points: " << mesh.vertices.size()
                                << " vertices, the model's " << c.model);
  CHECK(static_cast<double>(mesh.vertices.size()) <= 1.02 * static_cast<double>(c.model));
  mesher::CheckOptions<3> asked;
  asked.rho = options.rho;
  asked.ties = true;
  for (const auto& finding : mesher::check_mesh(mesh, asked)) {
    INFO(finding.property << ": " << finding.detail);
    CHECK(finding.holds);
  }
}

}  // namespace

TEST_CASE("meshes in space have hardly more vertices than the model's, and no poor tetrahedra") {
  check({PointKind::uniform, 10000, 17321});
  check({PointKind::line_circle, 2000, 13713});
}

TEST_CASE("so have large ones", "[.soak]") {
  check({PointKind::uniform, 100000, 159907});
  check({PointKind::grid, 125000, 130710});
  check({PointKind::line_circle, 20000, 129663});
}
