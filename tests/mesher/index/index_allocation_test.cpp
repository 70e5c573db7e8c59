// Memory that runs out at any allocation of an update, in the trace or outside of it: vertices,
// stars and calls are as before, and the next update works.
#include <algorithm>
#include <catch2/catch.hpp>
#include <memory>
#include <vector>

#include "failing_new.hpp"
#include "mesher/extra/generate.hpp"
#include "traced_world.hpp"

namespace {

using mesher::Options;
using mesher::Point;
using mesher::PointId;
using mesher::SplitMix64;
using support::TracedWorld;

constexpr int kPoints = 24;
constexpr int kEdits = 6;

// The mesh as places: of each vertex, and around it its neighbours in the star.
using Stars = std::vector<std::vector<Point<2>>>;

Stars stars_of(TracedWorld& world) {
  Stars all;
  const auto& vertices = world.world().vertices;
  vertices.pool().for_each([&](const auto& v) {
    std::vector<Point<2>> star;
    vertices.for_each_simplex_at(v,
                                 [&](const auto& t) { star.push_back(vertices.pool()[t[1]].p); });
    std::rotate(star.begin(), std::min_element(star.begin(), star.end()), star.end());
    star.insert(star.begin(), v.p);
    all.push_back(std::move(star));
  });
  std::sort(all.begin(), all.end());
  return all;
}

sac::Engine& engine_of(TracedWorld& world) { return const_cast<sac::Engine&>(world.engine()); }

std::unique_ptr<TracedWorld> world_of_points() {
  auto world = std::make_unique<TracedWorld>(Options<2>{.domain = {{0, 0}, {1, 1}}});
  SplitMix64 random(5);
  for (int i = 0; i < kPoints; ++i) world->insert(PointId{i}, {random.unit(), random.unit()});
  world->update();
  return world;
}

// Some points go, as many come close together; with what takes that back.
void edit(TracedWorld& world) {
  SplitMix64 random(6);
  for (int i = 0; i < kEdits; ++i) {
    auto* gone = world.inputs().at(PointId{i});
    world.remove(PointId{i});
    engine_of(world).on_rollback([gone] { gone->input = true; });
    const PointId id{100 + i};
    world.insert(id, {random.unit() * 0.01 + 0.3, random.unit() * 0.01 + 0.4});
    engine_of(world).on_rollback([come = world.inputs().at(id)] { come->input = false; });
  }
}

// Updates with the k-th of some allocations failing, for every k until none fails.
template <class Arm, class Disarm>
std::uint64_t sweep(Arm&& arm, Disarm&& disarm) {
  for (std::uint64_t k = 1;; ++k) {
    INFO("allocation " << k);
    const auto world = world_of_points();
    const Stars before = stars_of(*world);
    const auto calls = world->engine().live_calls();
    edit(*world);
    arm(*world, k);
    bool failed = false;
    try {
      world->update();
    } catch (const std::bad_alloc&) {
      failed = true;
      world->world().vertices.commit();
    }
    disarm(*world);
    world->world().vertices.check_invariants();
    world->engine().check_invariants();
    if (!failed) return k;
    REQUIRE(world->engine().live_calls() == calls);
    REQUIRE(stars_of(*world) == before);
    world->insert(PointId{500}, {0.77, 0.11});
    world->update();
    world->world().vertices.check_invariants();
  }
}

}  // namespace

TEST_CASE("an update in which any one allocation fails leaves the mesh, and the next one works") {
  const auto arm = [](TracedWorld&, std::uint64_t k) { support::allocation_fuse.left = k; };
  const auto disarm = [](TracedWorld&) { support::allocation_fuse.left = 0; };
  CHECK(sweep(arm, disarm) > 5);
}

TEST_CASE("the same for any one allocation of calls, edges and rings") {
  const auto arm = [](TracedWorld& w, std::uint64_t k) { engine_of(w).arena().fail_after(k); };
  const auto disarm = [](TracedWorld& w) { engine_of(w).arena().fail_after(0); };
  CHECK(sweep(arm, disarm) > 300);
}

TEST_CASE("where memory is out when an update is taken back, the triangulation is made anew") {
  const auto world = world_of_points();
  auto& vertices = world->world().vertices;
  const auto before = world->mesh();
  edit(*world);
  struct Stop {};
  bool stopped = false;
  try {
    engine_of(*world).propagate([&] {
      vertices.follow();
      throw Stop();
    });
  } catch (const Stop&) {
    stopped = true;
    support::memory_is_out = true;
    vertices.commit();
  }
  support::memory_is_out = false;
  REQUIRE(stopped);
  CHECK(vertices.triangulation_bytes() == 0);
  CHECK(world->mesh() == before);
  vertices.check_invariants();
  world->insert(PointId{500}, {0.77, 0.11});
  world->update();
  vertices.check_invariants();
  CHECK(vertices.triangulation_bytes() > 0);
  const auto other = world_of_points();
  other->insert(PointId{500}, {0.77, 0.11});
  other->update();
  CHECK(world->mesh() == other->mesh());
}
