// Memory that runs out at any allocation of an edit, an update or a mesh: all is as before.
#include <catch2/catch.hpp>

#include "failing_new.hpp"
#include "mesher/generate.hpp"
#include "mesher/mesher.hpp"
#include "sac/sac.hpp"
#include "traced_world.hpp"

namespace {

using mesher::FeatureId;
using mesher::Mesher;
using mesher::Options;
using mesher::Point;
using mesher::SplitMix64;

const Options<2> kOptions{.domain = {{0, 0}, {1, 1}}};

// Runs body() with the k-th allocation failing. Returns whether it came to that.
template <class Body>
bool runs_out(std::uint64_t k, Body&& body) {
  support::allocation_fuse.left = k;
  bool failed = false;
  try {
    body();
  } catch (const std::bad_alloc&) {
    failed = true;
  }
  const bool burnt = support::allocation_fuse.left == 0;
  support::allocation_fuse.left = 0;
  CHECK(burnt == failed);  // nobody swallows it
  return failed;
}

Mesher<2> sixty_points() {
  Mesher<2> m(kOptions);
  SplitMix64 random(5);
  for (int i = 0; i < 60; ++i) m.insert(FeatureId{i}, {random.unit(), random.unit()});
  m.update();
  return m;
}

// Twenty points go, twenty come close together.
void edit(Mesher<2>& m) {
  SplitMix64 random(6);
  for (int i = 0; i < 20; ++i) m.remove(FeatureId{i});
  for (int i = 100; i < 120; ++i) {
    m.insert(FeatureId{i}, {random.unit() * 0.01 + 0.3, random.unit() * 0.01 + 0.4});
  }
}

}  // namespace

TEST_CASE("an update in which any one allocation fails leaves the mesh, and the next one works") {
  std::uint64_t k = 1;
  for (;; ++k) {
    INFO("allocation " << k);
    Mesher<2> m = sixty_points();
    const auto before = m.mesh();
    edit(m);
    if (!runs_out(k, [&] { m.update(); })) break;
    m.check_invariants();
    REQUIRE(m.mesh() == before);
    m.insert(FeatureId{500}, {0.77, 0.11});
    m.update();
    m.check_invariants();
  }
  CHECK(k > 20);
}

TEST_CASE("memory that runs out in the trace leaves the vertices as they were") {
  std::uint64_t limit = 0;
  bool done = false;
  for (; !done; limit += 2048) {
    INFO("bytes " << limit);
    support::TracedWorld world(kOptions);
    SplitMix64 random(7);
    std::int64_t id = 0;
    for (; id < 20; ++id) world.insert(FeatureId{id}, {random.unit(), random.unit()});
    world.update();
    const auto calls = world.engine().live_calls();
    for (; id < 30; ++id) world.insert(FeatureId{id}, {random.unit() / 8, random.unit() / 8});
    auto& engine = const_cast<sac::Engine&>(world.engine());
    engine.set_memory_limit(engine.memory().calls_and_edges_held + limit);
    try {
      world.update();
      done = true;
    } catch (const std::bad_alloc&) {
      world.world().vertices.commit();
      engine.set_memory_limit(sac::Arena::kReserve);
      world.world().vertices.check_invariants();
      CHECK(world.engine().live_calls() == calls);
    }
  }
  CHECK(limit > 2048);
}
