// Records of vertices that are input points at times and Steiner vertices at others.
#include <catch2/catch.hpp>

#include "edit_sequence.hpp"
#include "mesher/generate.hpp"
#include "traced_world.hpp"

TEST_CASE("a Steiner vertex that was an input point forgets the call that located it") {
  const mesher::Options<2> options{.domain = {{0, 0}, {1, 1}}};
  support::TracedWorld world(options);
  support::PointSet points;
  std::int64_t id = 1;
  for (const auto& p : mesher::generate_points<2>(mesher::PointKind::clusters, 60, 3)) {
    perform({support::Edit::Kind::insert, id++, p}, world, points);
  }
  world.update();
  const auto mesh = support::static_mesh(points, options);
  int looked = 0;
  for (std::size_t i = 0; i < mesh.vertices.size() && looked < 20; ++i) {
    const auto& p = mesh.vertices[i];
    if (mesh.kinds[i] != mesher::VertexKind::steiner) continue;
    if (p[0] < 0 || p[0] > 1 || p[1] < 0 || p[1] > 1) continue;
    ++looked;
    const mesher::FeatureId fresh{id};
    world.insert(fresh, p);
    world.update();
    auto& record = *world.inputs().at(fresh);
    CHECK(record.locator != 0);
    world.remove(fresh);
    world.update();
    REQUIRE(record.alive);
    CHECK_FALSE(record.input);
    CHECK(record.locator == 0);  // the call is gone; its memory belongs to others
    world.insert(fresh, p);
    world.update();
    world.remove(fresh);
    world.update();
    world.world().vertices.check_invariants();
  }
  CHECK(looked > 5);
}
