// Records, and what is asked about them.
#include <catch2/catch.hpp>

#include "edit_sequence.hpp"
#include "mesher/extra/generate.hpp"
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
    const mesher::PointId fresh{id};
    world.insert(fresh, p);
    world.update();
    auto& record = *world.inputs().at(fresh);
    CHECK(static_cast<bool>(record.locator));
    world.remove(fresh);
    world.update();
    REQUIRE(record.alive);
    CHECK_FALSE(record.input);
    CHECK_FALSE(record.locator);  // the call is gone; its memory belongs to others
    world.insert(fresh, p);
    world.update();
    world.remove(fresh);
    world.update();
    world.world().vertices.check_invariants();
  }
  CHECK(looked > 5);
}

TEST_CASE("a vertex of the boundary grid reaches no farther than the triangles around it") {
  const mesher::Options<2> options{.domain = {{0, 0}, {1, 1}}};
  support::TracedWorld world(options);
  SECTION("without a point") {}
  SECTION("with points") {
    std::int64_t id = 1;
    for (const auto& p : mesher::generate_points<2>(mesher::PointKind::uniform, 40, 3)) {
      world.insert(mesher::PointId{id++}, p);
    }
    world.update();
  }
  int looked = 0;
  world.world().vertices.pool().for_each([&](const auto& v) {
    if (!v.boundary) return;
    ++looked;
    CHECK(v.reach != mesher::detail::Reach<2>());
    const auto [lo, hi] = v.reach.box();
    // In sides of the box: twice a circumradius, at most its diagonal, and rounded.
    CHECK(std::max({-lo[0], -lo[1], hi[0], hi[1]}) <= 1.5);
  });
  CHECK(looked > 4);
}

TEST_CASE("two cells can be looked at together") {
  struct Search : mesher::detail::VertexSearch<2> {
    using VertexSearch::cut_around;
    using VertexSearch::VertexSearch;
  };
  const mesher::detail::MeshBox<2> box{.lo = {-1.5, -1.5}, .side = 4};
  Search search(box);
  auto& a = search.add_input({0.25, 0.5}, true);
  auto& b = search.add_input({0.5, 0.5}, true);
  const auto all = [](mesher::detail::VertexHandle) { return true; };
  const auto first = search.cut_around(a, 1, all);
  const auto second = search.cut_around(b, 1, all);
  CHECK(&*first != &*second);
  CHECK(&first->center() == &a);
  CHECK(&second->center() == &b);
  first->check_invariants();
  second->check_invariants();
}
