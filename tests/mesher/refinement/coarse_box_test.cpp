// Refinements begin in a coarse box, and anew in the whole one where a centre is beyond a side.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cstddef>
#include <vector>

#include "mesher/extra/generate.hpp"
#include "mesher/mesher.hpp"
#include "refined_complex.hpp"
#include "refinement/from_points.hpp"
#include "refinement/refinement.hpp"
#include "rules/mesh_box.hpp"

namespace {

using mesher::Mesh;
using mesher::Options;
using mesher::Point;
using mesher::VertexKind;
using mesher::detail::MeshBox;
using mesher::detail::PointRefinement;
using mesher::detail::SideReached;

// Points as far from the middle as the domain never is: a domain's own need no whole grid.
template <int D>
std::vector<Point<D>> near_sides(const MeshBox<D>& box, double share) {
  auto points = mesher::generate_points<D>(mesher::PointKind::uniform, 60, 5);
  for (Point<D>& p : points) {
    for (int i = 0; i < D; ++i) p[i] = box.lo[i] + box.side * (0.5 + share * (p[i] - 0.5));
  }
  return points;
}

template <int D>
Options<D> unit_domain() {
  Options<D> options;
  for (int i = 0; i < D; ++i) options.domain.hi[i] = 1;
  return options;
}

template <int D>
std::ptrdiff_t on_boundary(const Mesh<D>& mesh) {
  return std::count(mesh.kinds.begin(), mesh.kinds.end(), VertexKind::boundary);
}

template <int D>
std::ptrdiff_t of_grid(MeshBox<D> box, int steps) {
  box.boundary_steps = steps;
  std::ptrdiff_t count = 0;
  box.for_each_boundary_point([&](const Point<D>&) { ++count; });
  return count;
}

template <int D>
Mesh<D> mesh_in(const MeshBox<D>& box, const std::vector<Point<D>>& points, double rho) {
  typename PointRefinement<D>::Settings settings;
  settings.rho = rho;
  return mesher::detail::refined_in<PointRefinement<D>, D>(
      box, points, settings, [](const auto& run) { return mesher::detail::mesh_of<D>(run); });
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("where a centre is beyond a side of the coarse box all of it is there", "",
                       ((int D), D), 2, 3) {
  const MeshBox<D> box = mesher::detail::mesh_box(unit_domain<D>());
  const double rho = Options<D>{}.rho;
  const auto run_in = [&](const auto& points, bool coarse) {
    typename PointRefinement<D>::Settings settings;
    settings.rho = rho;
    settings.box_steps = coarse ? mesher::detail::kCoarseSteps : 0;
    PointRefinement<D> run(box, points, settings);
    run.run();
    return mesher::detail::mesh_of<D>(run);
  };
  const auto inside = near_sides<D>(box, 0.2);
  CHECK(on_boundary<D>(mesh_in<D>(box, inside, rho)) == of_grid<D>(box, 4));
  CHECK(mesh_in<D>(box, inside, rho) == run_in(inside, true));

  const auto beside = near_sides<D>(box, D == 2 ? 0.85 : 0.8);
  CHECK_THROWS_AS(run_in(beside, true), SideReached);
  CHECK(mesh_in<D>(box, beside, rho) == run_in(beside, false));
  CHECK(on_boundary<D>(mesh_in<D>(box, beside, rho)) >= of_grid<D>(box, box.boundary_steps));
}

TEMPLATE_TEST_CASE_SIG("bounds stronger than the default have the whole box from the start", "",
                       ((int D), D), 2, 3) {
  Options<D> options = unit_domain<D>();
  options.rho = D == 2 ? 1.4 : 1.9;
  const MeshBox<D> box = mesher::detail::mesh_box(options);
  const auto mesh = mesh_in<D>(box, near_sides<D>(box, 0.2), options.rho);
  CHECK(on_boundary<D>(mesh) == of_grid<D>(box, box.boundary_steps));
}

TEMPLATE_TEST_CASE_SIG("a small complex that encloses what is refined has the coarsest box", "",
                       ((support::By B), B), support::By::svr, support::By::refine) {
  const auto boundary_of = [](const mesher::Graph<3>& plc, mesher::Extent extent) {
    return on_boundary<3>(support::mesh_of<B>(plc, support::options_for(plc), extent));
  };
  const auto grid_of = [](const mesher::Graph<3>& plc, int steps) {
    return of_grid<3>(mesher::detail::mesh_box(support::options_for(plc)), steps);
  };
  const auto cube = mesher::generate_plc({mesher::PlcKind::cube});
  CHECK(boundary_of(cube, mesher::Extent::enclosed) == grid_of(cube, 2));
  CHECK(boundary_of(cube, mesher::Extent::box) == grid_of(cube, 4));

  mesher::Graph<3> open = mesher::generate_plc({mesher::PlcKind::cloud, 50});
  CHECK(boundary_of(open, mesher::Extent::enclosed) == grid_of(open, 2));
  open.polygons.pop_back();
  CHECK(boundary_of(open, mesher::Extent::enclosed) == grid_of(open, 4));
  const auto cloud = mesher::generate_plc({mesher::PlcKind::cloud, 1200});
  CHECK(boundary_of(cloud, mesher::Extent::enclosed) == grid_of(cloud, 4));
}
