// A mesher with its domain: announcing, failing, stopping, and memory that runs out.
#include <catch2/catch.hpp>
#include <stop_token>

#include "any_id.hpp"
#include "facade/box_mesher.hpp"
#include "failing_new.hpp"
#include "failing_update.hpp"
#include "mesher/mesher.hpp"
#include "sac/check.hpp"
#include "scratch_file.hpp"

namespace {

using mesher::DomainMesh;
using mesher::DomainUpdate;
using mesher::Graph;
using mesher::Mesher;
using mesher::Point;
using mesher::PointId;
using support::fails;
using support::failure_of;

const mesher::Options<2> kOptions{.domain = {{0, 0}, {16, 16}}};

AnyId id(std::int64_t i) { return AnyId{i}; }

// A square with a wall from side to side, a hole on one side and a region on the other.
struct Parted {
  Mesher<2> m{kOptions};

  Parted() {
    const std::vector<Point<2>> places{{2, 2}, {8, 2}, {14, 2}, {14, 14}, {8, 14}, {2, 14}, {5, 5}};
    for (std::size_t i = 0; i < places.size(); ++i) {
      m.insert(id(static_cast<std::int64_t>(i) + 1), places[i], 3);
    }
    m.insert_polyline(id(1), {id(1), id(2), id(3), id(4), id(5), id(6), id(1)}, 4);
    m.insert_segment(id(2), id(2), id(5), 5);
    m.insert_hole(1, {4, 8});
    m.insert_region(1, {12, 8}, 7, 0.5);
    m.update();
  }
  // Of everything something.
  void announce() {
    m.insert(id(9), {10, 3}, 6);
    m.insert_segment(id(3), id(9), id(4), 8);
    m.remove_line(id(2));
    m.move(id(7), {5, 5.5});
    m.remove_hole(1);
    m.insert_hole(2, {8, 9});
    m.insert_region(2, {8, 8}, 9);
  }
};

struct Seen {
  Graph<2> input;
  mesher::Mesh<2> mesh;
  mesher::MeshData<2> kept;
  std::vector<mesher::SeedFault<2>> faults;

  explicit Seen(const Mesher<2>& m)
      : input(m.input()), mesh(m.box_mesh()), kept(m.domain_mesh().mesh), faults(m.faults()) {}
  friend bool operator==(const Seen& a, const Seen& b) {
    return a.input == b.input && a.mesh == b.mesh && a.kept.features == b.kept.features &&
           static_cast<const mesher::Mesh<2>&>(a.kept) == b.kept && a.faults == b.faults;
  }
};

std::size_t triangles(const Mesher<2>& m) { return m.domain_mesh().mesh.simplices.size(); }

}  // namespace

TEST_CASE(
    "a hole's part is left out, a region's has its attribute, and a wall that goes joins them") {
  Parted p;
  const DomainMesh<2> parted = p.m.domain_mesh();
  REQUIRE(parted.regions.size() == 3);
  for (const auto& v : parted.mesh.vertices) CHECK(v[0] >= 8);
  for (const double attribute : parted.mesh.features.regions) CHECK(attribute == 7);
  CHECK(parted.regions[2].max_measure == 0.5);

  p.m.remove_line(id(2));
  const DomainUpdate<2> joined = p.m.update();
  CHECK(triangles(p.m) == 0);  // the hole's, all of it
  CHECK(joined.domain.kept_added.empty());
  REQUIRE(p.m.faults().size() == 1);
  CHECK(p.m.faults()[0].other == mesher::hole_id(1));

  p.m.remove_hole(1);
  const DomainUpdate<2> filled = p.m.update();
  CHECK(filled.calls.executed == 0);
  CHECK(filled.domain.kept_added.size() == triangles(p.m));
  CHECK(filled.simplices_added.empty());
}

TEST_CASE("a mesh of points alone follows its first line, and its first seed") {
  Mesher<2> m(kOptions);
  m.insert(id(1), {2, 2});
  m.insert(id(2), {14, 2});
  m.insert(id(3), {8, 14});
  const DomainUpdate<2> first = m.update();
  CHECK(first.domain.kept_added.size() == m.stats().simplices);
  CHECK(m.domain_mesh().mesh.features.empty());
  m.insert_region(5, {8, 5}, 2);
  const DomainUpdate<2> labelled = m.update();
  CHECK(labelled.domain.relabelled.size() == m.stats().simplices);
  CHECK(m.faults().empty());
  m.insert_polyline(id(1), {id(1), id(2), id(3), id(1)});
  const DomainUpdate<2> enclosed = m.update();
  CHECK(triangles(m) < m.stats().simplices);
  CHECK_FALSE(enclosed.domain.kept_removed.empty());
  m.check_invariants();
}

TEST_CASE(
    "seeds are announced: the update before sees nothing of them, and they can be taken back") {
  Parted p;
  const Seen before(p.m);
  p.announce();
  CHECK(p.m.contains(mesher::hole_id(2)));
  CHECK_FALSE(p.m.contains(mesher::hole_id(1)));
  CHECK(Seen(p.m) == before);
  p.m.discard_edits();
  CHECK(p.m.contains(mesher::hole_id(1)));
  const DomainUpdate<2> nothing = p.m.update();
  CHECK(nothing.calls.executed == 0);
  CHECK(nothing.domain.kept_added.empty());
  CHECK(Seen(p.m) == before);
}

TEST_CASE("seeds that are not as they must be are refused, and nothing is announced") {
  Parted p;
  const Seen before(p.m);
  CHECK(failure_of([&] { p.m.insert_hole(1, {3, 3}); }) == "repeated_id@0:0");
  CHECK(failure_of([&] { p.m.insert_region(1, {3, 3}, 1); }) == "repeated_id@0:0");
  CHECK(failure_of([&] { p.m.remove_hole(7); }) == "unknown_id@0:0");
  CHECK(failure_of([&] { p.m.remove_region(7); }) == "unknown_id@0:0");
  CHECK(failure_of([&] { p.m.insert_hole(2, {3, 1e31}); }) == "magnitude@0:0");
  CHECK(failure_of([&] { p.m.insert_region(2, {3, 3}, 1, 0.0); }) == "bad_number@0:0");
  p.m.remove_hole(1);
  CHECK(failure_of([&] { p.m.remove_hole(1); }) == "unknown_id@0:0");
  p.m.insert_hole(1, {4, 8});  // back again
  CHECK(p.m.update().domain.visited == 0);
  CHECK(Seen(p.m) == before);
}

TEST_CASE("an update that fails for a line takes back the seeds and markers of its batch") {
  Parted p;
  const Seen before(p.m);
  p.announce();
  p.m.insert_segment(id(5), id(1), id(4));  // across the wall's place and along nothing
  p.m.insert_segment(id(6), id(3), id(6));  // across that
  CHECK(failure_of([&] { p.m.update(); }) == "crossing_segments@0:0");
  CHECK(Seen(p.m) == before);
  CHECK_FALSE(p.m.contains(mesher::hole_id(2)));
  CHECK(p.m.update().domain.kept_added.empty());
  p.m.check_invariants();
}

TEST_CASE("a first update that fails leaves nothing, and another can be made") {
  Mesher<2> m(kOptions);
  m.insert(id(1), {2, 2});
  m.insert(id(2), {14, 14});
  m.insert_segment(id(1), id(1), id(3));
  m.insert_hole(1, {3, 3});
  CHECK(failure_of([&] { m.update(); }) == "unknown_id@0:0");
  CHECK(m.input() == Graph<2>());
  m.insert(id(1), {2, 2});
  const DomainUpdate<2> first = m.update();
  CHECK(first.domain.kept_added.size() == m.stats().simplices);
}

TEST_CASE("a stopped update keeps its edits, seeds too, for the next") {
  Parted p;
  const Seen before(p.m);
  Parted other;
  other.announce();
  other.m.update();
  p.announce();
  std::stop_source stop;
  stop.request_stop();
  CHECK(failure_of([&] { p.m.update({.progress = {}, .stop = stop.get_token()}); }) ==
        "cancelled@0:0");
  CHECK(Seen(p.m) == before);
  p.m.update();
  CHECK(Seen(p.m) == Seen(other.m));
}

TEST_CASE("a point keeps its marker when it moves, and has another when it goes and comes") {
  Parted p;
  p.m.move(id(7), {5, 6});
  p.m.update();
  CHECK(p.m.input().points[6] == mesher::GraphPoint<2>{id(7), {5, 6}, 3});
  p.m.remove(id(7));
  p.m.insert(id(7), {5, 7});
  p.m.update();
  CHECK(p.m.input().points[6] == mesher::GraphPoint<2>{id(7), {5, 7}, 0});
  CHECK(failure_of([&] { p.m.insert(id(1), {5, 8}, 9); }) == "repeated_id@0:0");
  CHECK(failure_of([&] { p.m.insert_segment(id(2), id(1), id(5), 9); }) == "repeated_id@0:0");
  CHECK(failure_of([&] { p.m.remove_line(id(9)); }) == "unknown_id@0:0");
  p.m.update();
  CHECK(p.m.input().points[0].marker == 3);
  CHECK(p.m.input().segments[0].marker == 5);
}

TEST_CASE("an update in which any one allocation fails leaves mesh and domain, and works again") {
  struct SeenParted : Parted {
    Seen before{m};
  };
  const auto see = [](const Mesher<2>& m) { return Seen(m); };
  CHECK(support::check_failing_updates<SeenParted>(see) > 200);
}

TEST_CASE("an announcement that finds no memory announces nothing") {
  Parted reference;
  const Seen before(reference.m);
  for (int kind = 0; kind < 6; ++kind) {
    CAPTURE(kind);
    bool burnt = true;
    for (std::uint64_t count = 1; burnt; ++count) {
      Parted p;
      const bool failed = support::fails(count, burnt, [&] {
        if (kind == 0) p.m.insert(id(9), {10, 3}, 6);
        if (kind == 1) p.m.insert_segment(id(3), id(7), id(6), 8);
        if (kind == 2) p.m.remove(id(7));
        if (kind == 3) p.m.remove_line(id(2));
        if (kind == 4) p.m.insert_hole(2, {8, 9});
        if (kind == 5) p.m.remove_hole(1);
      });
      if (!failed) continue;
      p.m.update();
      REQUIRE(Seen(p.m) == before);
    }
  }
}

TEST_CASE("the last word on a change: what it throws leaves the mesh as it was") {
  mesher::BoxMesher<2> m(kOptions);
  m.insert(id(1), {2, 2});
  const auto refuse = [](const mesher::Change<2>&) { throw 17; };
  CHECK_THROWS_AS(m.update({}, refuse), int);
  CHECK(m.mesh().vertices.empty());
  CHECK(m.size() == 0);
  m.insert(id(1), {2, 2});
  std::size_t said = 0;
  const auto change =
      m.update({}, [&](const mesher::Change<2>& c) { said = c.simplices_added.size(); });
  CHECK(said == change.simplices_added.size());
  const auto before = m.mesh();
  m.insert(id(2), {2.5, 2});
  m.insert_segment(id(1), id(1), id(2));
  CHECK_THROWS_AS(m.update({}, refuse), int);
  m.check_invariants();
  CHECK(m.mesh() == before);
  CHECK(m.points().size() == 1);
  CHECK(m.lines().empty());
  CHECK(m.update().simplices_added.empty());
}

TEST_CASE("a callback that uses a mesher with its domain is refused, and nothing is lost") {
  Parted parted, twin;
  for (int i = 0; i < 400; ++i) {  // enough for the callback to be asked
    const Point<2> p{2.5 + 0.0131 * i, 2.5 + 11 * ((i * 37) % 400) / 400.0};
    if (p == Point<2>{5, 5.5} || p[0] >= 7.9) continue;
    for (Parted* each : {&parted, &twin}) each->m.insert(id(1000 + i), p, 11);
  }
  const bool limited = GENERATE(false, true);  // there is a second mesh
  for (Parted* each : {&parted, &twin}) {
    each->announce();
    if (limited) each->m.limit({.max_measure = 4});
  }
  int refused = 0;
  const auto progress = [&](const mesher::Progress&) {
    CHECK_THROWS_AS(parted.m.update(), sac::UsageError);
    CHECK_THROWS_AS(parted.m.insert(id(9999), {3, 3}, 5), sac::UsageError);
    CHECK_THROWS_AS(parted.m.move(id(7), {3, 3}), sac::UsageError);
    CHECK_THROWS_AS(parted.m.remove(id(7)), sac::UsageError);
    CHECK_THROWS_AS(parted.m.insert_segment(id(9999), id(7), id(3)), sac::UsageError);
    CHECK_THROWS_AS(parted.m.remove_line(id(3)), sac::UsageError);
    CHECK_THROWS_AS(parted.m.limit(mesher::SizeLimits<2>()), sac::UsageError);
    CHECK_THROWS_AS(parted.m.insert_hole(77, {3, 3}), sac::UsageError);
    CHECK_THROWS_AS(parted.m.remove_hole(2), sac::UsageError);
    parted.m.discard_edits();  // does nothing
    ++refused;
    return true;
  };
  parted.m.update({.progress = progress, .stop = {}});
  REQUIRE(refused > 0);
  twin.m.update();
  CHECK(parted.m.input() == twin.m.input());
  CHECK(parted.m.box_mesh() == twin.m.box_mesh());
  CHECK_FALSE(parted.m.contains(PointId{9999}));
  parted.m.check_invariants();
}
