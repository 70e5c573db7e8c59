// Out of memory at every allocation, one after the other, of edits of lines and their updates.
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "any_id.hpp"
#include "facade/box_mesher.hpp"
#include "failing_new.hpp"
#include "failing_update.hpp"

namespace {

using mesher::BoxMesher;
using mesher::Mesh;
using mesher::Options;
using support::fails;

const Options<2> kOptions{.domain = {{0, 0}, {16, 16}}};

AnyId id(std::int64_t i) { return AnyId{i}; }

// A frame with a wall in it, and points beside the wall.
struct Walled {
  BoxMesher<2> m{kOptions};
  Mesh<2> before;

  Walled() {
    m.insert({id(1), id(2), id(3), id(4), id(5), id(6), id(7), id(8)},
             {{1, 1}, {15, 1}, {15, 15}, {1, 15}, {4, 8}, {12, 8.5}, {8, 8.01}, {8, 12}});
    m.insert_polyline(id(1), {id(1), id(2), id(3), id(4), id(1)});
    m.insert_segment(id(2), id(5), id(6));
    m.update();
    before = m.mesh();
  }
  // A point comes near the frame, one moves with its wall, a wall comes to the frame's corner, and
  // the frame gets another id.
  void announce() {
    m.insert(id(9), {8, 1.0625});
    m.move(id(6), {12, 9});
    m.remove(id(7));
    m.insert_segment(id(3), id(8), id(3));
    m.remove_line(id(1));
    m.insert_polyline(id(4), {id(1), id(2), id(3), id(4), id(1)});
  }
};

}  // namespace

TEST_CASE("an announced line that finds no memory changes nothing") {
  Walled w;
  bool burnt = true;
  for (std::uint64_t count = 1; burnt; ++count) {
    const auto insert = [&] { w.m.insert_polyline(id(3), {id(8), id(3)}); };
    if (fails(count, burnt, insert)) {
      CHECK_FALSE(w.m.contains_line(id(3)));
      CHECK(w.m.update().calls.executed == 0);
    }
  }
  w.m.discard_edits();
  burnt = true;
  for (std::uint64_t count = 1; burnt; ++count) {
    if (fails(count, burnt, [&] { w.m.remove_line(id(2)); })) CHECK(w.m.contains_line(id(2)));
  }
  CHECK_FALSE(w.m.contains_line(id(2)));
}

TEST_CASE("an update of lines in which any one allocation fails leaves the mesh, and works again") {
  support::check_failing_updates<Walled>();
}

namespace {

// A hub of twelve legs, one with a point beside it.
struct Hub {
  static constexpr int kLegs = 12;
  BoxMesher<2> m{kOptions};
  Mesh<2> before;

  Hub() {
    m.insert(id(1), {8, 8});
    for (int i = 0; i < kLegs; ++i) {
      const double x = 5 - 10.0 * i / (kLegs - 1);
      m.insert(id(2 + i), {8 + x, i % 2 == 0 ? 13 - std::abs(x) / 4 : 3 + std::abs(x) / 4});
      m.insert_segment(id(1 + i), id(1), id(2 + i));
    }
    m.insert(id(20), {1, 1});
    m.update();
    before = m.mesh();
  }
  // The hub moves with all its legs, one of these goes, and a polyline comes and ends at another.
  void announce() {
    m.move(id(1), {8.25, 8.125});
    m.remove_line(id(3));
    m.insert({id(21), id(22), id(23), id(24)}, {{1, 2}, {1.5, 3}, {1, 4}, {2, 5}});
    m.insert_polyline(id(30), {id(20), id(21), id(22), id(23), id(24)});
  }
};

}  // namespace

TEST_CASE("a hub that moves and a polyline that comes survive any one allocation that fails") {
  support::check_failing_updates<Hub>();
}

namespace {

// Nothing but two points and a line: the first of all.
struct FirstLine {
  BoxMesher<2> m{kOptions};
  Mesh<2> before;
  void announce() {
    m.insert({id(1), id(2)}, {{4, 8}, {12, 8.5}});
    m.insert_segment(id(1), id(1), id(2));
  }
};

}  // namespace

TEST_CASE("a first run with one line survives any one allocation that fails") {
  support::check_failing_updates<FirstLine>();
}
