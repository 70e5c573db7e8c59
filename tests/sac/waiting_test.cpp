// Calls that wait on an agenda which nobody drains, or not yet: they come and go with their posts.
#include <catch2/catch.hpp>
#include <cstdint>
#include <new>
#include <vector>

#include "failing_new.hpp"
#include "random.hpp"
#include "sac/sac.hpp"

namespace {

using sac::Agenda;
using sac::Engine;
using sac::Mod;
using sac::Scope;

// Every input that is not 0 posts a call of its own, or shares one; if `drains` is not 0, a last
// call drains.
struct World {
  explicit World(int n) {
    e.set_environment(this);
    for (int i = 0; i < n; ++i) {
      inputs.push_back(e.input(1));
      marks.push_back(e.cell<int>());
    }
  }
  [[nodiscard]] int size() const { return static_cast<int>(inputs.size()); }
  [[nodiscard]] Mod<int> input(int i) const { return inputs[static_cast<std::size_t>(i)]; }
  Engine e;
  Agenda& agenda = e.make_agenda("waiting");
  Mod<int> drains = e.input(0);
  std::vector<Mod<int>> inputs;
  std::vector<Mod<int>> marks;
};

void mark(Scope& s, int i) {
  s.write(s.environment<World>().marks[static_cast<std::size_t>(i)], 1);
}
void post_if(Scope& s, int i) {
  auto& w = s.environment<World>();
  const int what = s.read(w.input(i));
  const int target = what == 2 ? i / 2 : i;
  if (what != 0) w.agenda.post<mark>(s, {.bucket = target % 3}, target);
}
void clear(Scope& s, int i) {
  s.write(s.environment<World>().marks[static_cast<std::size_t>(i)], 0);
}
void drain_if(Scope& s) {
  auto& w = s.environment<World>();
  if (s.read(w.drains) != 0) w.agenda.drain(s);
}
void post_all(Scope& s) {
  auto& w = s.environment<World>();
  for (int i = 0; i < w.size(); ++i) s.call<clear>(i);
  for (int i = 0; i < w.size(); ++i) s.call<post_if>(i);
  s.call<drain_if>();
}

void require_as_from_scratch(World& w) {
  World fresh(w.size());
  for (int i = 0; i < w.size(); ++i) fresh.e.set(fresh.input(i), w.e.get(w.input(i)));
  fresh.e.set(fresh.drains, w.e.get(w.drains));
  fresh.e.run<post_all>();
  for (std::size_t i = 0; i < w.marks.size(); ++i) {
    REQUIRE(w.e.get(w.marks[i]) == fresh.e.get(fresh.marks[i]));
  }
  REQUIRE(w.agenda.waiting_calls() == fresh.agenda.waiting_calls());
  REQUIRE(w.e.live_calls() == fresh.e.live_calls());
  w.e.check_invariants();
}

void edit(World& w, support::Random& random) {
  for (int k = 1 + random(6); k > 0; --k) w.e.set(w.input(random(w.size())), random(3));
  if (random(8) == 0) w.e.set(w.drains, 1 - w.e.get(w.drains));
}

TEST_CASE("calls that wait leave with their last post, drained before, later, or never") {
  support::Random random(Catch::rngSeed());
  World w(30);
  w.e.run<post_all>();
  for (int i = 0; i < 400; ++i) {
    edit(w, random);
    if (random(5) == 0) w.e.undo_edits();
    w.e.propagate();
    require_as_from_scratch(w);
  }
}

TEST_CASE("calls that wait are as before when memory runs out while posts go") {
  support::Random random(Catch::rngSeed());
  World w(30);
  w.e.run<post_all>();
  for (int i = 0; i < 20; ++i) {
    for (std::uint64_t count = 1;; ++count) {
      support::Random same = random;
      edit(w, same);
      support::allocation_fuse.left = count;
      try {
        w.e.propagate();
      } catch (const std::bad_alloc&) {
      }
      const bool went_through = support::allocation_fuse.left != 0;
      support::allocation_fuse.left = 0;
      require_as_from_scratch(w);
      if (went_through) break;
    }
    edit(w, random);
    w.e.propagate();
  }
}

TEST_CASE("a post from outside that fails, or is taken back, leaves what waits as it was") {
  for (std::uint64_t count = 1;; ++count) {
    World w(9);
    w.e.run<post_all>();
    bool burnt = false;
    const bool failed =
        support::fails(count, burnt, [&] { w.agenda.post_from_outside<mark>({.bucket = 7}, 100); });
    REQUIRE(failed == burnt);
    w.e.check_invariants();
    if (!failed) {
      CHECK(w.agenda.waiting_calls() == 10);
      w.agenda.retract_from_outside<mark>(100);
      w.e.check_invariants();
      CHECK(w.agenda.waiting_calls() == 10);  // until the next propagation
    }
    if (count % 2 == 0) {
      w.e.propagate();
      require_as_from_scratch(w);
    }
    w.e.set(w.drains, 1);
    w.e.propagate();
    require_as_from_scratch(w);
    if (!failed) break;
  }
}

// Calls of one class that a drain has left are merged with others that are posted afterwards.
TEST_CASE("what a drain has left and what comes afterwards run in one order") {
  World w(30);
  w.e.run<post_all>();
  for (int round = 0; round < 6; ++round) {
    for (int i = 0; i < 30; ++i) w.e.set(w.input(i), (i + round) % 4 == 0 ? 0 : 1);
    w.e.set(w.drains, 1);
    w.e.propagate();
    require_as_from_scratch(w);
    for (int i = 0; i < 30; ++i) w.e.set(w.input(i), i % (round + 2) == 0 ? 0 : 1);
    w.e.set(w.drains, 0);
    w.e.propagate();
    require_as_from_scratch(w);
  }
}

TEST_CASE("an update does not look at all calls that wait") {
  World w(200'000);
  w.e.run<post_all>();
  for (int i = 0; i < 2000; ++i) {
    w.e.set(w.input(i % 2 == 0 ? i : w.size() - i), 0);
    w.e.propagate();
  }
  CHECK(w.agenda.waiting_calls() == 198'000);
  require_as_from_scratch(w);
}

}  // namespace
