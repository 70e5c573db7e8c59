// Updates of a mesh with any one allocation failing.
#pragma once

#include <catch2/catch.hpp>
#include <cstdint>

#include "failing_new.hpp"
#include "mesher/mesher.hpp"

namespace support {

/// Checks that an update in which an allocation fails leaves the mesh, and that it works when it is
/// asked for again. World{}: a mesher `m` and its mesh `before`; announce() asks for edits.
template <class World>
void check_failing_updates() {
  World whole;
  whole.announce();
  whole.m.update();
  const mesher::Mesh<2> expected = whole.m.mesh();
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
      REQUIRE(world.m.mesh() == world.before);
      world.announce();
      world.m.update();
      world.m.check_invariants();
    }
    REQUIRE(world.m.mesh() == expected);
  }
  CHECK(count > 100);
}

}  // namespace support
