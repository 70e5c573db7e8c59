// Updates in space that fail in the middle: the mesh is the last update's, and the next one works.
#include <catch2/catch.hpp>
#include <stdexcept>
#include <vector>

#include "facade/box_mesher.hpp"
#include "facade/graph_runs.hpp"
#include "failing_new.hpp"
#include "mesher/extra/generate.hpp"

namespace {

using mesher::BoxMesher;
using mesher::Change;
using mesher::Mesh;
using mesher::PointId;

// A few points, and a batch in which one comes, one goes and one moves.
struct Cloud {
  Cloud() {
    std::int64_t id = 1;
    for (const auto& p : mesher::generate_points<3>(mesher::PointKind::uniform, 6, 5)) {
      m.insert(PointId{id++}, p);
    }
    m.update();
    before = m.mesh();
  }
  void announce() {
    m.insert(PointId{99}, {0.3125, 0.4375, 0.53125});
    m.remove(PointId{2});
    m.move(PointId{3}, {0.75, 0.25, 0.375});
  }
  void check_kept() {
    m.check_invariants();
    REQUIRE(m.mesh() == before);
  }
  void check_works() {
    m.update();
    m.check_invariants();
    std::vector<mesher::Point<3>> places;
    for (const auto& point : m.points()) places.push_back(point.at);
    REQUIRE(m.mesh() == mesher::mesh_statically<3>(places, m.options()));
    REQUIRE_FALSE(m.mesh() == before);
  }

  BoxMesher<3> m{{.domain = {{0, 0, 0}, {1, 1, 1}}}};
  Mesh<3> before;
};

}  // namespace

// All of the first ones, and then fewer and fewer: there are thousands.
TEST_CASE("an update in space in which an allocation fails leaves the mesh, and works again") {
  Cloud cloud;
  bool burnt = true;
  int failures = 0;
  for (std::uint64_t count = 1; burnt; count += 1 + count / 30) {
    CAPTURE(count);
    cloud.announce();
    if (!support::fails(count, burnt, [&] { cloud.m.update(); })) break;
    ++failures;
    cloud.check_kept();
  }
  CHECK(failures > 25);
  cloud.check_works();
}

TEST_CASE("an update in space that is cancelled, or refused at its end, leaves the mesh") {
  Cloud cloud;
  cloud.announce();
  SECTION("cancelled, the edits stay announced") {
    const mesher::RunControl stop{.progress = [](const mesher::Progress&) { return false; }};
    REQUIRE_THROWS_AS(cloud.m.update(stop), mesher::Error);
    cloud.check_kept();
  }
  SECTION("refused, they are taken back") {
    const auto refuse = [](const Change<3>&) { throw std::runtime_error("no"); };
    REQUIRE_THROWS_AS(cloud.m.update({}, refuse), std::runtime_error);
    cloud.check_kept();
    cloud.announce();
  }
  cloud.check_works();
}
