// What announced edits mean: the mesh is the last update's, a batch is judged by where its points
// end, and a change says which vertices have become another kind.
#include <algorithm>
#include <catch2/catch.hpp>
#include <numeric>
#include <string>

#include "edit_sequence.hpp"
#include "facade/box_mesher.hpp"
#include "facade/graph_runs.hpp"
#include "feature_ids.hpp"
#include "scratch_file.hpp"

namespace {

using mesher::BoxMesher;
using mesher::ErrorCode;
using mesher::KindChange;
using mesher::Mesh;
using mesher::Options;
using mesher::Point;
using mesher::PointId;
using mesher::SplitMix64;
using mesher::VertexKind;
using support::error_of;
using support::PointSet;

const Options<2> kUnit{.domain = {{0, 0}, {1, 1}}};
const Point<2> kA{0.25, 0.5}, kB{0.5, 0.25}, kC{0.75, 0.75};
constexpr PointId k1{1}, k2{2}, k3{3}, k4{4};

BoxMesher<2> with(const PointSet& points) {
  BoxMesher<2> m(kUnit);
  for (const auto& [id, p] : points) m.insert(PointId{id}, p);
  m.update();
  return m;
}

void require_fresh(const BoxMesher<2>& m, const PointSet& points) {
  REQUIRE(m.mesh() == support::static_mesh(points, kUnit));
  REQUIRE(m.size() == points.size());
  for (const auto& entry : points) REQUIRE(m.contains(PointId{entry.first}));
  m.check_invariants();
}

// A Steiner vertex of `mesh` in the domain.
Point<2> steiner_vertex(const Mesh<2>& mesh) {
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const Point<2>& p = mesh.vertices[i];
    const bool inside = p[0] > 0 && p[0] < 1 && p[1] > 0 && p[1] < 1;
    if (mesh.kinds[i] == VertexKind::steiner && inside) return p;
  }
  throw std::logic_error("the mesh has no Steiner vertex in the domain");
}

}  // namespace

TEST_CASE("the mesh is empty before the first update, and the last update's after edits") {
  BoxMesher<2> m(kUnit);
  CHECK(m.mesh() == Mesh<2>());
  m.insert(k1, kA);
  m.insert(k2, {kA[0] + 0.01, kA[1]});
  CHECK(m.mesh() == Mesh<2>());
  m.update();
  const Mesh<2> one = m.mesh();
  m.insert(k3, kB);
  CHECK(m.mesh() == one);
  m.remove(k1);
  CHECK(m.mesh() == one);
  m.move(k3, steiner_vertex(one));
  CHECK(m.mesh() == one);
  CHECK(m.stats().vertices == one.vertices.size());
  m.check_invariants();
  m.discard_edits();
  CHECK(m.mesh() == one);
  CHECK(m.update().calls.executed == 0);
}

TEST_CASE("two points of one batch swap places, by moves or by removals and insertions") {
  const PointSet swapped{{1, kB}, {2, kA}, {3, kC}};
  BoxMesher<2> m = with({{1, kA}, {2, kB}, {3, kC}});
  const Mesh<2> before = m.mesh();
  SECTION("moves") {
    m.move(k1, kB);
    m.move(k2, kA);
  }
  SECTION("each removed and inserted again") {
    m.remove(k1);
    m.insert(k1, kB);
    m.remove(k2);
    m.insert(k2, kA);
  }
  SECTION("both removed first") {
    m.remove(k1);
    m.remove(k2);
    m.insert(k2, kA);
    m.insert(k1, kB);
  }
  const auto change = m.update();
  CHECK(change.vertices_added.empty());
  CHECK(change.kinds_changed.empty());
  CHECK(m.mesh() == before);
  require_fresh(m, swapped);
  m.remove(k1);  // it is the one at kB now
  m.update();
  require_fresh(m, {{2, kA}, {3, kC}});
}

TEST_CASE("points move in chains and cycles, and a place that one leaves another takes") {
  BoxMesher<2> m = with({{1, kA}, {2, kB}, {3, kC}});
  m.move(k1, kB);
  m.move(k2, kC);
  m.move(k3, kA);
  m.update();
  require_fresh(m, {{1, kB}, {2, kC}, {3, kA}});
  m.move(k1, kC);
  m.move(k2, {0.125, 0.125});
  m.remove(k3);
  m.insert(k4, kA);
  m.update();
  require_fresh(m, {{1, kC}, {2, {0.125, 0.125}}, {4, kA}});
  m.move(k1, {0.6, 0.1});
  m.move(k1, {0.7, 0.1});
  m.move(k1, kC);
  CHECK(m.update().calls.executed == 0);
  m.remove(k1);
  m.insert(k1, kC);
  CHECK(m.update().calls.executed == 0);
  m.insert(k3, kB);
  m.move(k3, {0.9, 0.9});
  m.remove(k3);
  CHECK(m.update().calls.executed == 0);
}

TEST_CASE("a batch whose points end at one place is refused with their ids, and taken back") {
  const PointSet points{{1, kA}, {2, kB}, {3, kC}};
  BoxMesher<2> m = with(points);
  const auto refused = [&](ErrorCode code, std::vector<PointId> ids) {
    const mesher::Error error = error_of([&] { m.update(); });
    CHECK(error.code() == code);
    CHECK(support::ids_of(error) == ids);
    require_fresh(m, points);
    CHECK(m.update().calls.executed == 0);
  };
  m.move(k1, kB);
  refused(ErrorCode::duplicate_point, {k1, k2});
  m.move(k2, {0.9, 0.9});
  m.move(k1, {0.9, 0.9});
  refused(ErrorCode::duplicate_point, {k1, k2});
  m.move(k1, {kB[0] + 0x1p-53, kB[1]});
  refused(ErrorCode::too_close, {k1, k2});
  m.move(k1, kB);
  m.insert(k4, kA);
  m.move(k2, kA);
  refused(ErrorCode::duplicate_point, {k2, k4});
  m.move(k1, {0.1, 0.1});
  m.insert(k4, kA);
  m.move(k1, kA);
  refused(ErrorCode::duplicate_point, {k4, k1});
}

TEST_CASE("a new point needs a place that is free among those announced") {
  BoxMesher<2> m = with({{1, kA}});
  m.insert(k2, kB);
  CHECK(support::ids_of(error_of([&] { m.insert(k3, kB); })) == std::vector{k3, k2});
  CHECK(support::ids_of(error_of([&] { m.insert(k3, kA); })) == std::vector{k3, k1});
  CHECK(error_of([&] { m.insert(k2, kC); }).code() == ErrorCode::repeated_id);
  m.remove(k2);
  CHECK(error_of([&] { m.move(k2, kC); }).code() == ErrorCode::unknown_id);
  m.insert(k3, kB);
  m.remove(k1);
  m.insert(k4, kA);
  CHECK(support::ids_of(error_of([&] { m.remove(k1); })) == std::vector{k1});
  m.update();
  require_fresh(m, {{3, kB}, {4, kA}});
}

TEST_CASE("random batches of moves within a few places give the mesh of a fresh run") {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SplitMix64 random(seed);
    std::vector<Point<2>> places;
    for (int i = 0; i < 12; ++i) places.push_back({random.unit(), random.unit()});
    BoxMesher<2> m(kUnit);
    for (int step = 0; step < 30; ++step) {
      std::vector<std::size_t> order(places.size());
      std::iota(order.begin(), order.end(), std::size_t{0});
      for (std::size_t i = order.size(); i > 1; --i) {
        std::swap(order[i - 1], order[random.below(i)]);
      }
      PointSet points;  // ids 0..7, each there or not, at different places
      for (std::int64_t id = 0; id < 8; ++id) {
        if (random.below(4) != 0) points[id] = places[order[static_cast<std::size_t>(id)]];
      }
      for (std::int64_t id = 0; id < 8; ++id) {
        if (m.contains(PointId{id}) && !points.contains(id)) m.remove(PointId{id});
      }
      for (const auto& [id, p] : points) {
        if (m.contains(PointId{id})) m.move(PointId{id}, p);
      }
      for (const auto& [id, p] : points) {
        if (!m.contains(PointId{id})) m.insert(PointId{id}, p);
      }
      CAPTURE(seed, step);
      m.update();
      require_fresh(m, points);
    }
  }
}

TEST_CASE("an input point that comes to a Steiner vertex, or leaves it, changes its kind alone") {
  BoxMesher<2> m = with({{1, {0.25, 0.5}}, {2, {0.26, 0.5}}});
  const Mesh<2> before = m.mesh();
  const Point<2> p = steiner_vertex(before);
  m.insert(k3, p);
  const auto came = m.update();
  CHECK(came.kinds_changed ==
        std::vector<KindChange<2>>{{p, VertexKind::steiner, VertexKind::input}});
  CHECK_FALSE(std::binary_search(came.vertices_added.begin(), came.vertices_added.end(), p));
  m.remove(k3);
  const auto went = m.update();
  CHECK(went.kinds_changed ==
        std::vector<KindChange<2>>{{p, VertexKind::input, VertexKind::steiner}});
  CHECK(m.mesh() == before);
  m.insert(k3, p);
  m.update();
  m.remove(k3);
  m.insert(k4, p);
  CHECK(m.update().kinds_changed.empty());  // another point, the same kind
}

TEST_CASE("fewer ids than points are refused") {
  const std::vector<Point<2>> points{{.1, .1}, {.2, .2}, {.3, .3}};
  CHECK_THROWS_AS(mesher::mesh_statically<2>(points, kUnit, {k1}), std::logic_error);
  BoxMesher<2> m(kUnit);
  CHECK_THROWS_AS(m.insert({k1}, points), std::logic_error);
  CHECK(m.size() == 0);
}
