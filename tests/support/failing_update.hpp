// Updates of a mesh with any one allocation failing.
#pragma once

#include <catch2/catch.hpp>
#include <cstdint>

#include "failing_new.hpp"
#include "mesher/mesher.hpp"

namespace support {

/// Checks that an update in which an allocation fails leaves the mesh, and that it works when it is
/// asked for again. World{}: a mesher `m`, and what is seen of it, `before`; announce() asks for
/// edits. Returns how many allocations there were, and one.
template <class World, class See>
std::uint64_t check_failing_updates(See see) {
  World whole;
  whole.announce();
  whole.m.update();
  const auto expected = see(whole.m);
  REQUIRE_FALSE(expected == whole.before);
  bool burnt = true;
  std::uint64_t count = 1;
  for (; burnt; ++count) {
    CAPTURE(count);
    World world;
    world.announce();
    const bool failed = fails(count, burnt, [&] { world.m.update(); });
    world.m.check_invariants();
    if (failed) {
      REQUIRE(see(world.m) == world.before);
      world.announce();
      world.m.update();
      world.m.check_invariants();
    }
    REQUIRE(see(world.m) == expected);
  }
  CHECK(count > 100);
  return count;
}
/// The same, where the mesh is what is seen, all of it.
template <class World>
void check_failing_updates() {
  check_failing_updates<World>([](const auto& m) {
    if constexpr (requires { m.box_mesh(); }) {
      return m.box_mesh();
    } else {
      return m.mesh();
    }
  });
}

}  // namespace support
