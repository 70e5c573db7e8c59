// Updates of a mesh with any one allocation failing.
#pragma once

#include <catch2/catch.hpp>
#include <cstdint>

#include "failing_new.hpp"
#include "mesher/mesher.hpp"

namespace support {

/// Checks that an update in which an allocation fails leaves the mesh, and that it works when it is
/// asked for again. World{}: a mesher `m`, and what is seen of it, `before`; announce() asks for
/// edits; `stride`: every so many allocations. Returns how many there were, and some.
template <class World, class See>
std::uint64_t check_failing_updates(See see, std::uint64_t stride = 1) {
  World whole;
  whole.announce();
  whole.m.update();
  const auto expected = see(whole.m);
  REQUIRE_FALSE(expected == whole.before);
  bool burnt = true;
  std::uint64_t count = 1;
  for (; burnt; count += stride) {
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
/// What is seen of a mesher by default: the mesh, all of it.
struct SeeMesh {
  template <class Mesher>
  auto operator()(const Mesher& m) const {
    if constexpr (requires { m.box_mesh(); }) {
      return m.box_mesh();
    } else {
      return m.mesh();
    }
  }
};
template <class World>
void check_failing_updates() {
  check_failing_updates<World>(SeeMesh{});
}

/// Whether an update is stopped, which leaves the mesh.
template <class Mesher, class Mesh>
bool is_stopped(Mesher& m, const mesher::RunControl& control, const Mesh& before) {
  try {
    m.update(control);
  } catch (const mesher::Error& e) {
    REQUIRE(e.code() == mesher::ErrorCode::cancelled);
    m.discard_edits();
    REQUIRE(m.mesh() == before);
    m.check_invariants();
    return true;
  }
  return false;
}

}  // namespace support
