// Calls that do what they did last time in another order: what has moved far is made anew.
#include <catch2/catch.hpp>
#include <new>
#include <vector>

#include "failing_new.hpp"
#include "random.hpp"
#include "sac/sac.hpp"

namespace {

using sac::Engine;
using sac::Mod;
using sac::Scope;

// A call writes `n` places in an order, and with values, that `turn` says; a call before it has
// written some of them, and one behind it copies each.
struct World {
  explicit World(int n, int first_turn) : turn(e.input(first_turn)) {
    e.set_environment(this);
    for (int i = 0; i < n; ++i) {
      places.push_back(e.cell<int>());
      copies.push_back(e.cell<int>());
    }
  }
  [[nodiscard]] int size() const { return static_cast<int>(places.size()); }
  [[nodiscard]] std::vector<int> values() const {
    std::vector<int> all;
    for (const auto copy : copies) all.push_back(e.get(copy));
    return all;
  }
  Engine e;
  Mod<int> turn;
  std::vector<Mod<int>> places;
  std::vector<Mod<int>> copies;
};

void copy(Scope& s, int i) {
  auto& w = s.environment<World>();
  s.write(w.copies[static_cast<std::size_t>(i)], s.read(w.places[static_cast<std::size_t>(i)]));
}
void write_half(Scope& s) {
  auto& w = s.environment<World>();
  for (std::size_t i = 0; i < w.places.size(); i += 2) s.write(w.places[i], -1);
}
// Backwards if `turn` is negative, else from the place `turn` on.
void write_all(Scope& s) {
  auto& w = s.environment<World>();
  const int turn = s.read(w.turn);
  for (int i = 0; i < w.size(); ++i) {
    const int k = turn < 0 ? w.size() - 1 - i : (i + turn) % w.size();
    if (k % 14 == 0 && turn % 2 != 0) continue;  // -1, then
    s.write(w.places[static_cast<std::size_t>(k)], k % 3 == 0 ? turn : k);
  }
}
void write_and_copy(Scope& s) {
  auto& w = s.environment<World>();
  s.call<write_half>();
  s.call<write_all>();
  for (int i = 0; i < w.size(); ++i) s.call<copy>(i);
}

void require_as_from_scratch(World& w) {
  World fresh(w.size(), w.e.get(w.turn));
  fresh.e.run<write_and_copy>();
  REQUIRE(w.values() == fresh.values());
  REQUIRE(w.e.live_edges() == fresh.e.live_edges());
  w.e.check_invariants();
}

TEST_CASE("writes in another order leave what a run from scratch leaves, and no edge behind") {
  support::Random random(Catch::rngSeed());
  World w(400, 0);
  w.e.run<write_and_copy>();
  for (int i = 0; i < 60; ++i) {
    w.e.set(w.turn, random(400) - 100);
    w.e.propagate();
    require_as_from_scratch(w);
  }
}

TEST_CASE("a write that has moved far is made anew, not looked for among all") {
  constexpr int kPlaces = 200'000;
  World w(kPlaces, 0);
  w.e.run<write_and_copy>();
  w.e.set(w.turn, -2);
  const sac::Counts work = w.e.propagate();
  CHECK(work.edges_made > kPlaces - 200);
  CHECK(work.edges_made < kPlaces);
  CHECK(work.edges_made == work.edges_removed);
  require_as_from_scratch(w);
}

TEST_CASE("memory that runs out among writes in another order leaves all as before") {
  World w(200, 0);
  w.e.run<write_and_copy>();
  const auto before = w.values();
  int failures = 0;
  for (std::uint64_t count = 1; count < 500; count += 1 + count / 16) {
    w.e.set(w.turn, -3);
    w.e.arena().fail_after(count);
    try {
      w.e.propagate();
    } catch (const std::bad_alloc&) {
      ++failures;
      REQUIRE(w.values() == before);
    }
    w.e.arena().fail_after(0);
    require_as_from_scratch(w);
    w.e.set(w.turn, 0);
    w.e.propagate();
    REQUIRE(w.values() == before);
  }
  CHECK(failures > 20);
}

}  // namespace
