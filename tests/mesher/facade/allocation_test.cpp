// Out of memory at every allocation, one after the other, of everything that edits and updates do.
//
// Each step is tried with the first allocation failing, then the second, ..., until it needs no
// more. After a failure the mesh is the last update's and the mesher works on.
#include <catch2/catch.hpp>
#include <vector>

#include "facade/box_mesher.hpp"
#include "facade/graph_runs.hpp"
#include "failing_new.hpp"
#include "mesher/extra/generate.hpp"

namespace {

using mesher::BoxMesher;
using mesher::Mesh;
using mesher::Options;
using mesher::Point;
using mesher::PointId;

const Options<2> kUnit{.domain = {{0, 0}, {1, 1}}};

enum class Outcome { enough_memory, done_without, failed };

// What becomes of run() when its `count`-th allocation fails. Some algorithms do without.
template <class Run>
Outcome with_failure(std::uint64_t count, Run run) {
  bool burnt = false;
  if (support::fails(count, burnt, run)) return Outcome::failed;
  return burnt ? Outcome::done_without : Outcome::enough_memory;
}

// run() with every allocation failing in turn, after() after each failure; how many there are.
template <class Run, class After>
std::uint64_t sweep(Run run, After after) {
  for (std::uint64_t count = 1;; ++count) {
    const Outcome outcome = with_failure(count, run);
    if (outcome == Outcome::enough_memory) return count - 1;
    CAPTURE(count);
    if (outcome == Outcome::failed) after();
  }
}

std::vector<Point<2>> some_points(std::size_t n, std::uint64_t seed) {
  return mesher::generate_points<2>(mesher::PointKind::uniform, n, seed);
}

struct Some {
  std::vector<Point<2>> points = some_points(60, 5);
  std::vector<Point<2>> near = some_points(20, 6);
  BoxMesher<2> m{kUnit};
  Mesh<2> before;

  Some() {
    for (std::size_t i = 0; i < points.size(); ++i) m.insert(PointId(i), points[i]);
    m.update();
    before = m.mesh();
  }
  // Points go, and others swap places.
  void announce_swaps() {
    for (std::size_t i = 0; i < 20; ++i) m.remove(PointId(i));
    for (std::size_t i = 20; i < 40; ++i) m.move(PointId(i), points[59 - i]);
  }
  void announce() {
    announce_swaps();
    for (std::size_t i = 0; i < near.size(); ++i) {
      m.insert(PointId(100 + i), {0.3 + near[i][0] * 0.01, 0.4 + near[i][1] * 0.01});
    }
  }
};

}  // namespace

TEST_CASE("an edit that finds no memory changes nothing") {
  Some s;
  const auto unchanged = [&] {
    CHECK(s.m.size() == 60);
    CHECK_FALSE(s.m.contains(PointId{100}));
    CHECK(s.m.contains(PointId{3}));
    CHECK(s.m.mesh() == s.before);
    CHECK(s.m.update().calls.executed == 0);
  };
  CHECK(sweep([&] { s.m.insert(PointId{100}, {0.3, 0.4}); }, unchanged) > 0);
  s.m.discard_edits();
  CHECK(sweep([&] { s.m.remove(PointId{3}); }, unchanged) > 0);
  s.m.discard_edits();
  CHECK(sweep([&] { s.m.move(PointId{3}, {0.3, 0.4}); }, unchanged) > 0);
  s.m.discard_edits();
  const std::vector<PointId> ids{PointId{100}, PointId{101}, PointId{102}};
  CHECK(sweep([&] { s.m.insert(ids, {{0.3, 0.4}, {0.4, 0.3}, {0.5, 0.5}}); }, unchanged) > 0);
  s.m.discard_edits();
  CHECK(sweep([&] { (void)s.m.mesh(); }, unchanged) > 0);
}

TEST_CASE("a first update that finds no memory leaves an empty mesh") {
  const auto points = some_points(12, 5);
  std::vector<PointId> ids;
  for (std::size_t i = 0; i < points.size(); ++i) ids.push_back(PointId(i));
  BoxMesher<2> m(kUnit);
  const auto announced = [&] {
    if (m.size() == 0) m.insert(ids, points);
  };
  announced();
  const auto count = sweep([&] { m.update(); },
                           [&] {
                             REQUIRE(m.mesh() == Mesh<2>());
                             announced();
                           });
  CHECK(count > 100);
  CHECK(m.mesh() == mesher::mesh_statically<2>(points, kUnit));
  m.check_invariants();
}

namespace {

// Edits that have nothing to do with those that failed, and back.
void update_otherwise(Some& s) {
  s.m.insert(PointId{500}, {0.77, 0.11});
  s.m.update();
  s.m.check_invariants();
  s.m.remove(PointId{500});
  s.m.update();
  REQUIRE(s.m.mesh() == s.before);
}

// announce(s) and an update, with every allocation of the update failing in turn.
template <class Announce>
std::uint64_t sweep_update(Announce announce, const mesher::RunControl& control) {
  Mesh<2> expected;
  for (std::uint64_t count = 1;; ++count) {
    Some s;
    announce(s);
    CAPTURE(count);
    const Outcome outcome = with_failure(count, [&] { s.m.update(control); });
    s.m.check_invariants();
    if (outcome == Outcome::failed) {
      REQUIRE(s.m.mesh() == s.before);
      REQUIRE(s.m.size() == 60);
      update_otherwise(s);
      announce(s);
      s.m.update();
      s.m.check_invariants();
    }
    if (expected.vertices.empty()) expected = s.m.mesh();
    REQUIRE(s.m.mesh() == expected);
    if (outcome == Outcome::enough_memory) return count - 1;
  }
}

}  // namespace

TEST_CASE("an update that finds no memory for its edits leaves the mesh, and works the next time") {
  const auto end_failures = [](const mesher::Progress&) {
    support::allocation_fuse.left = ~std::uint64_t{0};
    return true;
  };
  const auto announce = [](Some& s) { s.announce_swaps(); };
  CHECK(sweep_update(announce, {.progress = end_failures, .stop = {}}) > 20);
}

TEST_CASE(
    "an update that finds no memory leaves the mesh of the last one, and works the next time") {
  const auto announce = [](Some& s) { s.announce(); };
  CHECK(sweep_update(announce, {}) > 150);
}

TEST_CASE("a static run that finds no memory says so") {
  const auto points = some_points(12, 5);
  CHECK(sweep([&] { (void)mesher::mesh_statically<2>(points, kUnit); }, [] {}) > 100);
}
