// The longest segments beside one, by direction, against looking at all.
#include "plane/leg_fan.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "mesher/extra/generate.hpp"
#include "traced_world.hpp"

namespace {

using mesher::LineId;
using mesher::Point;
using mesher::PointId;
using mesher::SplitMix64;
using mesher::detail::LegFan;
using mesher::detail::LegFans;
using mesher::detail::longest_beside;
using mesher::detail::MeshBox;
using mesher::detail::Segment;
using mesher::detail::SegmentHandle;
using mesher::detail::SegmentStore;
using mesher::detail::VertexHandle;
using mesher::detail::VertexPool;

constexpr double kDegree = 3.141592653589793 / 180;
const MeshBox<2> kBox{.lo = {-16, -16}, .side = 64};

Point<2> around(const Point<2>& o, double degrees, double length) {
  return {o[0] + length * std::cos(kDegree * degrees), o[1] + length * std::sin(kDegree * degrees)};
}

struct Hub {
  VertexPool<2> pool;
  SegmentStore store{kBox, pool};
  VertexHandle middle = pool.create({8, 8}).self;
  std::vector<SegmentHandle> legs;

  void leg(double degrees, double length) {
    Segment& s = store.record(middle, pool.create(around({8, 8}, degrees, length)).self);
    store.put(s);
    legs.push_back(s.self);
  }
  void check() const {
    const LegFan fan(store, middle);
    for (const SegmentHandle leg : legs) {
      REQUIRE(fan.beside(store[leg]) == longest_beside(store, store[leg], middle));
    }
  }
};

}  // namespace

TEST_CASE("the longest segments beside one are those among all, in any directions") {
  SplitMix64 random(1);
  for (int round = 0; round < 200; ++round) {
    CAPTURE(round);
    Hub hub;
    const std::uint64_t n = 1 + random.below(60);
    const double width = round % 2 == 0 ? 360 : 90 * random.unit();
    for (std::uint64_t i = 0; i < n; ++i) {
      hub.leg(width * random.unit() - 90, 0.5 + 7 * random.unit());
    }
    hub.check();
  }
}

TEST_CASE("so they are in directions at 20 and 60 degrees, where rounding decides") {
  SplitMix64 random(2);
  for (int round = 0; round < 100; ++round) {
    CAPTURE(round);
    Hub hub;
    const double turn = random.below(3) == 0 ? 0 : 360 * random.unit();
    for (int k = 0; k < 36; ++k) {
      const double degrees = turn + 10 * k;
      hub.leg(degrees, 0.5 + 7 * random.unit());
      hub.leg(degrees + 1e-10 * random.unit(), 0.5 + 7 * random.unit());
      hub.leg(degrees + 1e-7 * (random.unit() - 0.5), 0.5 + 7 * random.unit());
    }
    hub.check();
  }
}

TEST_CASE("fans follow the segments at a point") {
  SplitMix64 random(3);
  Hub hub;
  LegFans fans;
  for (int k = 0; k < 100; ++k) {
    hub.leg(360 * random.unit(), 0.5 + 7 * random.unit());
    fans.forget(hub.middle);
    for (const SegmentHandle leg : hub.legs) {
      const Segment& s = hub.store[leg];
      REQUIRE(fans.longest_beside(hub.store, s, hub.middle) ==
              longest_beside(hub.store, s, hub.middle));
    }
  }
  CHECK(fans.bytes() > 0);
}

// It was their square: each leg was asked for its zone again, and looked at all.
TEST_CASE("an edit of one of many segments at a point looks at a bounded number for each") {
  const int n = 300;
  support::TracedWorld world({.domain = {{0, 0}, {16, 16}}});
  const auto end = [&](double length) { return around({8, 8}, 7 * 360.0 / n, length); };
  world.insert(PointId{0}, {8, 8});
  for (int i = 1; i <= n; ++i) {
    world.insert(PointId{i}, around({8, 8}, i * 360.0 / n, 6));
    world.insert_segment(LineId{i}, PointId{0}, PointId{i});
  }
  world.update();
  const auto& store = world.world().segments.store();
  const auto move = [&](double length) {
    world.remove_segment(PointId{0}, PointId{7});
    world.move(PointId{7}, end(length));
    world.insert_segment(LineId{7}, PointId{0}, PointId{7});
    world.update();
  };
  move(5.9999);
  const auto before = store.looked_at();
  move(5.9998);
  CHECK(store.looked_at() - before < 100 * n);
  world.world().segments.check_invariants();
}
