// Points on one line in space, where a cell has all others on two sides of it.
#include <catch2/catch.hpp>

#include "mesher/mesher.hpp"

namespace {

// The work of the first run for n points on a line, in steps inside calls per vertex of the mesh.
double work_per_vertex(int n) {
  mesher::Options<3> options{.domain = {{0, 0, 0}, {1, 1, 1}}};
  options.extent = mesher::Extent::box;
  options.record_weights = true;
  mesher::Mesher<3> m(options);
  for (int i = 0; i < n; ++i) m.insert(mesher::PointId{i}, {(i + 0.5) / n, 0.3, 0.7});
  const auto change = m.update();
  return static_cast<double>(change.calls.weight) /
         static_cast<double>(change.vertices_added.size());
}

}  // namespace

TEST_CASE("points on a line in space cost the same each, however many there are") {
  const double few = work_per_vertex(400);
  const double many = work_per_vertex(3200);
  INFO(few << " and " << many << " steps per vertex");
  REQUIRE(few > 0);
  REQUIRE(many < 1.2 * few);
}
