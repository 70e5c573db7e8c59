// Watching runs and updates, and stopping them from the callback and from another thread.
#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <stdexcept>
#include <thread>
#include <vector>

#include "facade/box_mesher.hpp"
#include "facade/graph_runs.hpp"
#include "mesher/extra/generate.hpp"
#include "sac/check.hpp"
#include "scratch_file.hpp"

namespace {

using mesher::BoxMesher;
using mesher::ErrorCode;
using mesher::LineId;
using mesher::Mesh;
using mesher::Options;
using mesher::Phase;
using mesher::Point;
using mesher::PointId;
using mesher::Progress;
using mesher::RunControl;
using support::error_of;

const Options<2> kUnit{.domain = {{0, 0}, {1, 1}}};

std::vector<Point<2>> some_points(std::size_t n) {
  return mesher::generate_points<2>(mesher::PointKind::uniform, n, 3);
}

void announce(BoxMesher<2>& m, const std::vector<Point<2>>& points) {
  std::vector<PointId> ids;
  for (std::size_t i = 0; i < points.size(); ++i) ids.push_back(PointId(i + 1));
  m.insert(ids, points);
}

// Moves the first `n` points a little.
void shake(BoxMesher<2>& m, const std::vector<Point<2>>& points, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) {
    m.move(PointId(i + 1), {points[i][0] * 0.999, points[i][1]});
  }
}

// What the callback is told in one run.
struct Log {
  std::vector<Progress> all;
  RunControl control() {
    return {.progress = [this](const Progress& p) { return all.push_back(p), true; }, .stop = {}};
  }
};

void require_three_phases(const std::vector<Progress>& told, std::size_t points,
                          std::size_t vertices) {
  REQUIRE(told.size() > 10);
  REQUIRE(told.front().phase == Phase::quadtree);
  REQUIRE(told.front().of >= points);
  for (std::size_t i = 1; i < told.size(); ++i) {
    REQUIRE(told[i - 1].phase <= told[i].phase);
    if (told[i - 1].phase == told[i].phase) REQUIRE(told[i - 1].done < told[i].done);
    REQUIRE((told[i].of == 0 || told[i].done <= told[i].of));
    if (told[i].phase == Phase::triangulate) REQUIRE(told[i].of == vertices);
  }
  REQUIRE(told.back().phase == Phase::triangulate);
  REQUIRE(told.back().done + 2 * RunControl::kCallsBetween > vertices);
}

// Stops at the n-th report.
RunControl stopping_at(int n) {
  return {.progress = [n](const Progress&) mutable { return --n > 0; }, .stop = {}};
}

}  // namespace

TEST_CASE("a first run and a static run report their three phases in order, an update its calls") {
  const auto points = some_points(2000);
  Log log;
  BoxMesher<2> m(kUnit);
  announce(m, points);
  m.update(log.control());
  require_three_phases(log.all, points.size(), m.stats().vertices);

  Log plain;
  const Mesh<2> mesh = mesher::mesh_statically<2>(points, kUnit, {}, nullptr, plain.control());
  require_three_phases(plain.all, points.size(), mesh.vertices.size());
  CHECK(mesh == m.mesh());

  Log update;
  shake(m, points, 200);
  m.update(update.control());
  REQUIRE(update.all.size() > 10);
  for (const Progress& p : update.all) {
    CHECK(p.phase == Phase::update);
    CHECK(p.of >= p.done);
  }
}

TEST_CASE("a first run that is stopped leaves a mesher whose points wait for the next update") {
  const auto points = some_points(1000);
  const Mesh<2> expected = mesher::mesh_statically<2>(points, kUnit);
  for (const int n : {1, 2, 5, 15}) {
    BoxMesher<2> m(kUnit);
    announce(m, points);
    CHECK(error_of([&] { m.update(stopping_at(n)); }).code() == ErrorCode::cancelled);
    CHECK(m.mesh() == Mesh<2>());
    CHECK(m.size() == points.size());
    m.update();
    CHECK(m.mesh() == expected);
    m.check_invariants();
    CHECK(error_of([&] {
            (void)mesher::mesh_statically<2>(points, kUnit, {}, nullptr, stopping_at(n));
          }).code() == ErrorCode::cancelled);
  }
}

TEST_CASE("an update that is stopped leaves the old mesh, and its edits to be made or taken back") {
  const auto points = some_points(1000);
  BoxMesher<2> m(kUnit);
  announce(m, points);
  m.update();
  const Mesh<2> before = m.mesh();
  for (const int n : {1, 2, 3, 4, 5}) {
    CAPTURE(n);
    shake(m, points, 100);
    m.remove(PointId{900});
    CHECK(error_of([&] { m.update(stopping_at(n)); }).code() == ErrorCode::cancelled);
    CHECK(m.mesh() == before);
    CHECK(m.size() == points.size() - 1);
    m.check_invariants();
    m.discard_edits();
    CHECK(m.update().calls.executed == 0);
    CHECK(m.mesh() == before);
  }
  shake(m, points, 50);
  CHECK(error_of([&] { m.update(stopping_at(2)); }).code() == ErrorCode::cancelled);
  m.move(PointId{1}, points[0]);
  m.update();
  auto moved = points;
  for (std::size_t i = 1; i < 50; ++i) moved[i][0] *= 0.999;
  CHECK(m.mesh() == mesher::mesh_statically<2>(moved, kUnit));
  m.check_invariants();
}

TEST_CASE("another thread stops a run by its token, and one that is stopped before does nothing") {
  const auto points = some_points(200000);
  BoxMesher<2> m(kUnit);
  announce(m, points);
  std::stop_source source;
  std::atomic<bool> running = false;
  std::jthread stopper([&] {
    while (!running) std::this_thread::yield();
    source.request_stop();
  });
  const RunControl control{.progress = [&](const Progress&) { return running = true; },
                           .stop = source.get_token()};
  CHECK(error_of([&] { m.update(control); }).code() == ErrorCode::cancelled);
  CHECK(m.mesh() == Mesh<2>());

  int reports = 0;
  const RunControl stopped{.progress = [&](const Progress&) { return ++reports > 0; },
                           .stop = source.get_token()};
  CHECK(error_of([&] { m.update(stopped); }).code() == ErrorCode::cancelled);
  CHECK(error_of([&] {
          (void)mesher::mesh_statically<2>(points, kUnit, {}, nullptr, stopped);
        }).code() == ErrorCode::cancelled);
  CHECK(reports == 0);
}

TEST_CASE("what the callback throws leaves update(), and the edits are taken back") {
  const auto points = some_points(500);
  BoxMesher<2> m(kUnit);
  announce(m, points);
  m.update();
  const Mesh<2> before = m.mesh();
  int reports = 0;
  const RunControl control{.progress = [&](const Progress&) -> bool {
                             if (++reports == 3) throw std::runtime_error("enough");
                             return true;
                           },
                           .stop = {}};
  shake(m, points, 50);
  CHECK_THROWS_WITH(m.update(control), "enough");
  CHECK(m.mesh() == before);
  CHECK(m.update(control).calls.executed == 0);
  m.check_invariants();
}

TEST_CASE("a callback that uses the mesher is refused, and the update goes on") {
  const auto points = some_points(400);
  BoxMesher<2> m(kUnit), twin(kUnit);
  for (BoxMesher<2>* each : {&m, &twin}) {
    announce(*each, points);
    each->update();
    shake(*each, points, 100);
  }
  int refused = 0;
  const auto refuses = [&](auto&& use) {
    try {
      use();
      FAIL("not refused");
    } catch (const sac::UsageError&) {
      ++refused;
    }
  };
  const auto use_all = [&] {
    refuses([&] { m.update(); });
    refuses([&] { m.insert(PointId{1000}, {0.5, 0.5}); });
    refuses([&] { m.move(PointId{1}, {0.5, 0.5}); });
    refuses([&] { m.remove(PointId{1}); });
    refuses([&] { m.insert_segment(LineId{1}, PointId{1}, PointId{2}); });
    refuses([&] { m.remove_line(LineId{1}); });
    refuses([&] { static_cast<void>(m.mesh()); });
    refuses([&] { static_cast<void>(m.points()); });
    m.discard_edits();  // does nothing
    return true;
  };
  m.update({.progress = [&](const Progress&) { return use_all(); }, .stop = {}},
           [&](const mesher::Change<2>&) { use_all(); });
  CHECK(refused >= 2 * 8);
  twin.update();
  CHECK(m.mesh() == twin.mesh());
  m.check_invariants();
  m.insert(PointId{1000}, {0.5, 0.5});
  m.update();
}
