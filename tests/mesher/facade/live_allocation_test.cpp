// Out of memory at every allocation, one after the other: slots stay those of the last update, and
// the update that works afterwards gives those that it would have given at once.
#include <catch2/catch.hpp>

#include "facade/box_mesher.hpp"
#include "failing_update.hpp"
#include "feature_ids.hpp"
#include "mesher/mesher.hpp"
#include "slot_twin.hpp"

namespace {

using mesher::BoxMesher;
using mesher::Options;
using support::id;
using support::Shown;

// Slots are free, some of them since the last update.
struct Square {
  mesher::Mesher<2> m{Options<2>{.domain = {{0, 0}, {16, 16}}}};
  Shown<2> before;

  Square() {
    m.keep_slots(true);
    m.insert(id(1), {4, 4});
    m.insert(id(2), {12, 4});
    m.insert(id(3), {12, 12});
    m.insert(id(4), {4, 12});
    m.insert_polyline(id(1), {id(1), id(2), id(3), id(4), id(1)});
    m.insert(id(5), {8, 8});
    m.insert(id(6), {8.001, 8});
    m.insert(id(7), {2, 2.001});
    m.update();
    m.remove(id(6));
    m.update();
    m.remove(id(7));
    m.update();
    before = Shown<2>(m.live());
  }
  void announce() {
    m.insert(id(9), {6, 4.03125});
    m.move(id(5), {8, 8.5});
    m.insert_segment(id(2), id(1), id(3));
    m.insert_hole(1, {10, 6});
  }
};

// From nothing.
struct Fresh {
  BoxMesher<2> m{Options<2>{.domain = {{0, 0}, {1, 1}}}};
  Shown<2> before;
  Fresh() { m.keep_slots(true); }
  void announce() {
    m.insert(id(1), {0.25, 0.5});
    m.insert(id(2), {0.75, 0.375});
    m.insert_segment(id(1), id(1), id(2));
  }
};

}  // namespace

TEST_CASE("slots survive any one allocation that fails in an update of lines and seeds") {
  support::check_failing_updates<Square>([](const auto& m) { return Shown<2>(m.live()); });
}

TEST_CASE("slots survive any one allocation that fails in a first run") {
  support::check_failing_updates<Fresh>([](const auto& m) { return Shown<2>(m.live()); });
}
