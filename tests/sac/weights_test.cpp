// Weights: what calls say that they do inside (Scope::weigh).
#include <catch2/catch.hpp>
#include <cstdint>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "sac/sac.hpp"

namespace {

// Weighs its input twice over, in two parts; below 0 it throws.
void work(sac::Scope& s, sac::Mod<int> in, sac::Mod<int> out) {
  const int n = s.read(in);
  s.weigh(static_cast<std::uint64_t>(n));
  if (n < 0) throw std::runtime_error("below 0");
  s.write(out, n % 10);
  s.weigh(static_cast<std::uint64_t>(n));
}
void copy(sac::Scope& s, sac::Mod<int> from, sac::Mod<int> to) {
  s.weigh(1);
  s.write(to, s.read(from));
}
void both(sac::Scope& s, sac::Mod<int> in, sac::Mod<int> middle, sac::Mod<int> out) {
  s.call<work>(in, middle);
  s.call<copy>(middle, out);
}

struct World {
  sac::Engine engine;
  sac::Mod<int> in = engine.input(7), middle = engine.cell<int>(), out = engine.cell<int>();

  sac::Counts run() { return engine.run<both>(in, middle, out); }
  sac::Counts set(int value) {
    engine.set(in, int{value});
    return engine.propagate();
  }
  // Of both, work and copy.
  std::vector<std::uint64_t> weights() const {
    std::vector<std::uint64_t> all;
    engine.walk([&](const sac::Call& call, std::size_t) { all.push_back(engine.weight_of(call)); });
    return all;
  }
};

using Weights = std::vector<std::uint64_t>;

}  // namespace

TEST_CASE("Calls weigh what they said in their last execution, whether it was more or less") {
  World w;
  w.engine.record_weights();
  CHECK(w.engine.records_weights());
  CHECK(w.run().weight == 15);
  CHECK(w.weights() == Weights{0, 14, 1});
  CHECK(w.set(25).weight == 51);
  CHECK(w.weights() == Weights{0, 50, 1});
  CHECK(w.set(5).weight == 10);  // the copy does not run: 5 both times
  CHECK(w.weights() == Weights{0, 10, 1});
  w.engine.check_invariants();
}

TEST_CASE("Weights take nothing unless they are recorded") {
  World with, without;
  with.engine.record_weights();
  with.run();
  CHECK(without.run().weight == 0);
  CHECK(without.weights() == Weights{0, 0, 0});
  CHECK(with.engine.live_edges() == without.engine.live_edges() + 3);
  CHECK(with.engine.bytes() == without.engine.bytes() + 3 * 16);
  CHECK(with.set(8).executed == without.set(8).executed);
}

TEST_CASE("Weights that are asked for late are those of calls that have run since") {
  World w;
  w.run();
  w.engine.record_weights();
  w.engine.record_weights();
  CHECK(w.weights() == Weights{0, 0, 0});
  CHECK(w.set(17).weight == 34);
  CHECK(w.weights() == Weights{0, 34, 0});
}

TEST_CASE("After a failed propagation calls weigh what they did before") {
  World w;
  w.engine.record_weights();
  w.run();
  CHECK_THROWS_AS(w.set(-1), std::runtime_error);
  CHECK(w.weights() == Weights{0, 14, 1});
  CHECK(w.set(9).weight == 19);
  w.engine.check_invariants();
}

TEST_CASE("Printed edges say what a call weighs") {
  World w;
  w.engine.record_weights();
  w.run();
  std::ostringstream text;
  w.engine.walk([&](const sac::Call& call, std::size_t) {
    w.engine.for_each_edge(call, [&](const sac::Edge& edge) {
      w.engine.structure_of(edge).print(call, edge, text);
      text << "; ";
    });
  });
  CHECK(text.str().find("weighs 7; ") != std::string::npos);
  CHECK(text.str().find("weighs 1; ") != std::string::npos);
}

// Weighs before it reads if `first`, else behind.
struct Inputs {
  sac::Engine engine;
  sac::Mod<bool> first = engine.input(false);
  std::vector<sac::Mod<int>> all;
};
void weigh_first_or_last(sac::Scope& s) {
  auto& inputs = s.environment<Inputs>();
  const bool first = s.read(inputs.first);
  if (first) s.weigh(3);
  for (const auto input : inputs.all) static_cast<void>(s.read(input));
  if (!first) s.weigh(3);
}

TEST_CASE("A weight of last time is not looked for behind all that the call has done") {
  Inputs inputs;
  inputs.engine.set_environment(&inputs);
  inputs.engine.record_weights();
  for (int i = 0; i < 100; ++i) inputs.all.push_back(inputs.engine.input(i));
  inputs.engine.run<weigh_first_or_last>();
  inputs.engine.set(inputs.first, true);
  const sac::Counts work = inputs.engine.propagate();
  CHECK(work.weight == 3);
  CHECK(work.edges_made == 1);
  CHECK(work.edges_removed == 1);
  inputs.engine.check_invariants();
}
