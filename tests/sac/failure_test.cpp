// Failures injected at every allocation and every client call: the engine is as before the edits,
// and goes on working.
#include <catch2/catch.hpp>
#include <cstdint>
#include <functional>
#include <new>
#include <optional>
#include <string>
#include <vector>

#include "failing_new.hpp"
#include "failure_source.hpp"
#include "fragile.hpp"
#include "program_oracle.hpp"

namespace {

using namespace support;

using Program = Traced<Fragile>;

// Sets, and a post from outside, the retraction of one, or an edit of the list.
std::vector<Step> random_edits(Random& random, int nodes, const Outside& outside) {
  std::vector<Step> edits;
  for (int k = 1 + random(3); k > 0; --k) edits.push_back({Step::set, random(4), random(5)});
  if (!outside.posts.empty() && random(3) == 0) {
    edits.push_back({Step::retract, *outside.posts.rbegin() - 3, 0});
  } else if (random(2) == 0) {
    edits.push_back({Step::post, random(nodes - 3), 0});
  }
  if (random(3) == 0) {
    edits.push_back({random(2) == 0 ? Step::insert : Step::remove, random(8), random(5)});
  }
  return edits;
}

// With which words the program itself refuses to do `act`; null: it does it.
std::optional<std::string> refusal_of(const std::function<void()>& act) {
  try {
    act();
  } catch (const sac::UsageError& error) {
    return error.what();
  } catch (const Refusal& error) {
    return error.what();
  }
  return std::nullopt;
}
bool refuses(const std::function<void()>& act) { return refusal_of(act).has_value(); }

bool refused_from_scratch(const RandomProgram& text, Outside outside,
                          const std::vector<Step>& edits) {
  Program edited(text, Outside(outside));
  for (const Step& edit : edits) edited.edit(edit, outside);
  Program fresh(text, outside);
  return refuses([&] { fresh.run(outside); });
}

// The engine is as it was before the edits.
void require_undone(Program& p, const std::string& before) {
  p.engine.undo_edits();
  p.engine.propagate();
  p.check_invariants();
  REQUIRE(p.state() == before);
}

// Whether the program refuses the edits where nothing fails, from scratch or for a changed key.
// `scout` is as before the edits; it has done them if they are not refused.
bool is_refused(Program& scout, const RandomProgram& text, const Outside& outside,
                const std::vector<Step>& edits) {
  const std::string before = scout.state();
  const auto items = scout.world.items;
  Outside wanted = outside;
  const auto refusal = refusal_of([&] {
    for (const Step& edit : edits) scout.edit(edit, wanted);
    scout.engine.propagate();
  });
  const bool from_scratch = refused_from_scratch(text, outside, edits);
  if (!refusal) {
    REQUIRE(!from_scratch);
    return false;
  }
  INFO(*refusal);
  REQUIRE((from_scratch || is_changed_key(*refusal, text)));
  require_undone(scout, before);
  scout.world.items = items;
  return true;
}

// Programs of calls alone, and small ones with all features.
RandomProgram random_text(std::uint64_t seed, int nodes) {
  return seed % 2 == 0 ? RandomProgram(seed, nodes) : focused_case(seed, kFeatures).program;
}

// Edits and propagates; each time with every failure of the source in turn. Returns their number.
// Edits that the program refuses are undone.
std::uint64_t check_failures(std::uint64_t seed, const FailureSource& source, int batches) {
  CAPTURE(seed, source.name);
  Random random(seed ^ 0x5eed);
  const int nodes = 5 + random(6);
  const RandomProgram text = random_text(seed, nodes);
  Outside outside;
  Program p(text, outside), scout(text, outside);
  if (refuses([&] { p.run(outside); })) return 0;
  scout.run(outside);
  std::uint64_t failures = 0;
  for (int i = 0; i < batches; ++i) {
    CAPTURE(i);
    const std::vector<Step> edits = random_edits(random, text.size(), outside);
    const std::string before = p.state();
    const auto items = p.world.items;
    const auto act = [&](Outside& wanted) {
      for (const Step& edit : edits) p.edit(edit, wanted);
      p.engine.propagate();
    };
    if (is_refused(scout, text, outside, edits)) {
      Outside wanted = outside;
      REQUIRE(refuses([&] { act(wanted); }));
      require_undone(p, before);
      p.world.items = items;
      continue;
    }
    for (std::uint64_t count = 1;; ++count) {
      CAPTURE(count);
      Outside wanted = outside;
      const bool failed = fails(p.engine, source, count, [&] { act(wanted); });
      if (!failed) {
        outside = wanted;
        break;
      }
      ++failures;
      require_undone(p, before);
      p.world.items = items;
    }
    p.check_invariants();
    Program fresh(text, outside);
    fresh.run(outside);
    REQUIRE(p.state() == fresh.state());
  }
  return failures;
}

TEST_CASE("a propagation that fails anywhere leaves the engine as before the edits") {
  std::uint64_t failures = 0;
  for (const FailureSource& source : kFailureSources<Fragile>) {
    for (std::uint64_t seed = 0; seed < 150; ++seed) failures += check_failures(seed, source, 4);
  }
  CHECK(failures > 20000);
}

TEST_CASE("many propagations fail anywhere", "[.soak]") {
  for (const FailureSource& source : kFailureSources<Fragile>) {
    for (std::uint64_t seed = 1000; seed < 2000; ++seed) check_failures(seed, source, 12);
  }
}

TEST_CASE("a run that fails anywhere leaves nothing, and may be tried again") {
  Outside outside;
  outside.inputs = {2, 1, 3, 0};
  outside.posts = {4, 4, 6};
  std::uint64_t failures = 0;
  for (const FailureSource& source : kFailureSources<Fragile>) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      CAPTURE(seed, source.name);
      const RandomProgram text(seed, 8);
      Program p(text, outside);
      Program good(text, outside);
      good.run(outside);
      p.engine.run<list_root<Fragile>>();
      const std::uint64_t edges = p.engine.live_edges();
      const auto run = [&] { p.engine.run<random_root<Fragile>>(); };
      for (std::uint64_t count = 1; fails(p.engine, source, count, run); ++count) {
        ++failures;
        REQUIRE(p.engine.live_edges() == edges);
        p.engine.check_invariants();
      }
      REQUIRE(p.state() == good.state());
      p.engine.check_invariants();
    }
  }
  CHECK(failures > 1000);
}

TEST_CASE("if the undoing of edits fails, the engine is broken and says so") {
  const RandomProgram text(1, 8);
  Outside outside;
  outside.posts = {4};
  std::uint64_t count = 1;
  for (bool failed = true; failed; ++count) {
    Program p(text, outside);
    p.run(outside);
    Outside wanted = outside;
    p.edit({Step::retract, 1, 0}, wanted);
    p.edit({Step::remove, 0, 0}, wanted);
    p.edit({Step::set, 2, 5}, wanted);
    failed = fails(p.engine, kFailureSources<Fragile>[0], count, [&] { p.engine.undo_edits(); });
    if (failed) CHECK_THROWS_WITH(p.engine.propagate(), Catch::Contains("broken"));
  }
  CHECK(count > 2);
}

void copy(sac::Scope& s, sac::Mod<int> from, sac::Mod<int> to) { s.write(to, s.read(from)); }

TEST_CASE("a propagation that finds no memory to begin with undoes the edits") {
  sac::Engine e;
  const auto in = e.input(1), out = e.cell<int>();
  e.run<copy>(in, out);
  for (int i = 0; i < 3; ++i) {
    e.shrink();
    e.set(in, 2);
    allocation_fuse.left = 1;
    bool failed = false;
    try {
      e.propagate();
    } catch (const std::bad_alloc&) {
      failed = true;
    }
    allocation_fuse.left = 0;
    CHECK(failed);
    CHECK(e.get(in) == 1);
    e.propagate();
    CHECK(e.get(out) == 1);
  }
}

}  // namespace
