// Updates with limits of size in space that fail in the middle: out of memory, cancelled. All is as
// it was, and the next update works.
#include <catch2/catch.hpp>

#include "any_id.hpp"
#include "facade/graph_runs.hpp"
#include "failing_new.hpp"
#include "mesher/error.hpp"
#include "mesher/mesher.hpp"
#include "mesher/sizes.hpp"

namespace {

using mesher::Mesh;
using mesher::Options;
using mesher::Point;
using Mesher = mesher::Mesher<3>;

constexpr AnyId id(std::int64_t i) { return AnyId{i}; }

// A room with a wall. Its limit becomes another in a box and varies in one beside; a point comes in
// what is filled, and the wall goes.
struct Room {
  Room() {
    m.insert(id(1), {0.5, 0.5, 1});
    m.insert(id(2), {1.5, 0.5, 1});
    m.insert(id(3), {1.5, 1.5, 1});
    m.insert(id(4), {0.5, 1.5, 1});
    m.insert(id(5), {0.3, 0.4, 0.5});
    m.insert_polygon({.id = id(1), .loops = {{id(1), id(2), id(3), id(4)}}});
    m.limit({.max_measure = 0.1});
    m.update();
    before = m.box_mesh();
    limits = m.options().box_limits;
  }
  void announce() {
    m.limit({{1, 1, 0}, {2, 2, 2}}, {.max_measure = 0.02});
    m.limit({{0, 0, 0}, {1, 1, 1}},
            {.sizes = mesher::sampled_sizes<3>({{{0, 0, 0}, 0.5}, {{1, 1, 1}, 1}})});
    m.insert(id(6), {1.6, 1.7, 0.5});
    m.remove_polygon(id(1));
  }
  void check_kept() {
    m.check_invariants();
    REQUIRE(m.box_mesh() == before);
    REQUIRE(m.options().box_limits == limits);
    REQUIRE(m.input().polygons.size() == 1);
  }
  void check_works() {
    m.update();
    m.check_invariants();
    REQUIRE(m.box_mesh() == mesh_statically(m.input(), m.options()));
    REQUIRE(m.box_mesh().vertices.size() > before.vertices.size());
  }

  Mesher m{Options<3>{.domain = {{0, 0, 0}, {2, 2, 2}}, .extent = mesher::Extent::box}};
  Mesh<3> before;
  mesher::AllBoxLimits<3> limits;
};

}  // namespace

// All of the first ones, and then fewer and fewer: there are thousands.
TEST_CASE("an update with limits in space in which an allocation fails leaves all, works again") {
  bool burnt = true;
  int failures = 0;
  for (std::uint64_t count = 1; burnt; count += 1 + count / 5) {
    CAPTURE(count);
    Room room;  // another: what it has allocated once it keeps
    room.announce();
    if (!support::fails(count, burnt, [&] { room.m.update(); })) continue;
    room.check_kept();
    if (++failures % 8 != 0) continue;
    room.announce();
    room.check_works();
  }
  CHECK(failures > 20);
}

TEST_CASE("an update with limits in space that is cancelled on its way leaves all, works again") {
  Room room;
  room.announce();
  int cancelled = 0;
  for (int most = 1; most <= 16; most *= 2) {
    int told = 0;
    const mesher::RunControl stop{
        .progress = [&](const mesher::Progress&) { return ++told < most; }, .stop = {}};
    try {
      room.m.update(stop);
      break;
    } catch (const mesher::Error& error) {
      REQUIRE(error.code() == mesher::ErrorCode::cancelled);
      ++cancelled;
      room.check_kept();
    }
  }
  CHECK(cancelled > 0);
  room.check_works();
}
