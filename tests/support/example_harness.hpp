// Checks an example program (sac/examples) under random edits.
//
// An App (sac/examples/apps/app.hpp) is a program with random inputs and edits.
//
// After every propagation: (1) the engine's invariants hold; (2) the result is that of the oracle
// and of a plain run; (3) result, calls and edges are as many as in a fresh engine; (4) no two
// calls have equal labels and none is discarded and made anew; and (5) an edit followed by its
// inverse leaves as many calls and edges as there were.
#pragma once

#include <catch2/catch.hpp>
#include <cstdint>
#include <exception>
#include <string>
#include <type_traits>
#include <utility>

#include "random.hpp"
#include "sac/sac.hpp"

namespace support {

using apps::name_all;
using apps::ScopeOf;

/// A random run is named by these; an equal plan does the same again.
struct Plan {
  std::uint64_t seed;
  int size;   // of the first input
  int steps;  // propagations, about
};

namespace example {

inline std::string sizes(const sac::Engine& engine) {
  return std::to_string(engine.live_calls()) + " calls, " + std::to_string(engine.live_edges()) +
         " edges";
}

template <class App>
std::string plain_fault(const typename App::Input& input) {
  sac::PlainScope scope;
  typename App::template World<sac::PlainScope> world(scope, input);
  if (world.result() != App::oracle(input)) return "a plain run differs from the oracle";
  return "";
}

/// What is wrong with `world` for `input`; empty if nothing.
template <class App, class World>
std::string traced_fault(sac::Engine& engine, World& world, const typename App::Input& input) {
  engine.check_invariants();
  if (world.result() != App::oracle(input)) return "the result differs from the oracle";
  if (const std::string fault = plain_fault<App>(input); !fault.empty()) return fault;
  sac::Engine fresh;
  World other(fresh, input);
  if (world.result() != other.result()) return "the result differs from a run from scratch";
  if (sizes(engine) != sizes(fresh)) {
    return sizes(engine) + "; from scratch " + sizes(fresh);
  }
  const sac::AuditReport& audit = engine.audit();
  if (audit.duplicates != 0) return "two calls are " + audit.first_duplicate;
  if (audit.reordered != 0 && !apps::kMovesCalls<App>)
    return "discarded and made anew: " + audit.first_reordered;
  return "";
}

template <class App>
class Session {
 public:
  explicit Session(const Plan& plan)
      : random_(plan.seed),
        input_(App::random_input(random_, plan.size)),
        world_((engine_.set_audit(true), engine_), input_) {}

  [[nodiscard]] std::string fault() { return traced_fault<App>(engine_, world_, input_); }

  /// One to three edits, then a propagation.
  std::string several_edits() {
    for (int k = 1 + random_(3); k > 0; --k) edit(App::random_edit(random_, input_));
    engine_.propagate();
    return fault();
  }

  std::string there_and_back() {
    const std::string before = sizes(engine_);
    const auto there = App::random_edit(random_, input_);
    const auto back = App::inverse(input_, there);
    edit(there);
    engine_.propagate();
    if (std::string wrong = fault(); !wrong.empty()) return wrong;
    edit(back);
    engine_.propagate();
    if (std::string wrong = fault(); !wrong.empty()) return "taken back: " + wrong;
    if (sizes(engine_) != before) return "taken back: " + sizes(engine_) + "; were " + before;
    return "";
  }

 private:
  void edit(const typename App::Edit& e) {
    App::apply(input_, e);
    world_.edit(e);
  }

  Random random_;
  typename App::Input input_;
  sac::Engine engine_;
  typename App::template World<sac::Engine> world_;
};

/// What goes wrong in a traced run of `plan`; empty if nothing.
template <class App>
std::string fault_of(const Plan& plan) {
  std::string where = "first run: ";
  try {
    Session<App> session(plan);
    std::string wrong = session.fault();
    for (int step = 0; step < plan.steps && wrong.empty(); ++step) {
      where = "step " + std::to_string(step) + ": ";
      wrong = step % 3 == 2 ? session.there_and_back() : session.several_edits();
    }
    return wrong.empty() ? "" : where + wrong;
  } catch (const std::exception& error) {
    return where + error.what();
  }
}

/// The first smaller plan of the same seed that fails too: fewer elements, then fewer steps.
template <class App>
Plan shrink(Plan plan) {
  const auto fails = [](const Plan& p) { return !fault_of<App>(p).empty(); };
  for (int size = 0; size < plan.size; ++size) {
    if (fails({plan.seed, size, plan.steps})) plan.size = size;
  }
  while (plan.steps > 0 && fails({plan.seed, plan.size, plan.steps - 1})) --plan.steps;
  return plan;
}

}  // namespace example

/// Random edit sequences on an engine, for seeds 0 .. seeds - 1; inputs of 0 .. size elements.
template <class App>
void check_example(int seeds, int size, int steps) {
  for (int seed = 0; seed < seeds; ++seed) {
    const Plan plan{static_cast<std::uint64_t>(seed), (size * seed + seeds / 2) / seeds, steps};
    if (example::fault_of<App>(plan).empty()) {
      SUCCEED();
      continue;
    }
    const Plan small = example::shrink<App>(plan);
    FAIL(App::kName << ": seed " << small.seed << ", size " << small.size << ", steps "
                    << small.steps << ": " << example::fault_of<App>(small));
  }
}

/// Plain runs against the oracle, for seeds 0 .. seeds - 1; inputs of 0 .. size elements.
template <class App>
void check_example_plain(int seeds, int size) {
  for (int seed = 0; seed < seeds; ++seed) {
    Random random(static_cast<std::uint64_t>(seed));
    const int elements = random(size + 1);
    INFO(App::kName << ": seed " << seed);
    REQUIRE(example::plain_fault<App>(App::random_input(random, elements)).empty());
  }
}

}  // namespace support
