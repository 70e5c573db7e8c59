// Optimality of propagation [Theorem 1.4.4]: on random programs that are concise and monotone, the
// work of a propagation is at most twice the distance of the traces of runs from scratch before and
// after the edit. Two is the least there can be: a call that is new is made and run.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdint>
#include <memory>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "random_program.hpp"
#include "sac/sac.hpp"
#include "traces/audit.hpp"
#include "traces/distance.hpp"
#include "traces/recorder.hpp"

namespace {

using support::node_key;
using support::Op;
using support::Random;
using support::RandomProgram;

// The nodes of a random program, made concise: every call has the path on which it was reached as
// its argument. Calls come in the order of the text and posts in that of their labels, so it is
// monotone.
struct World {
  const RandomProgram* program = nullptr;
  std::vector<sac::Mod<int>> inputs;
  std::vector<sac::Mod<int>> cells;
  sac::Agenda* agenda = nullptr;
};

std::uint64_t step(std::uint64_t path, std::size_t op) {
  return sac::mix(path * 64 + op + 1) >> 20;
}

int ask(sac::Scope& s, std::uint64_t path, int cell) {
  const auto& w = s.environment<World>();
  return (s.read(w.cells[static_cast<std::size_t>(cell)]) + static_cast<int>(path % 2)) % 2;
}
void pass(sac::Scope& s, sac::Mod<int> from, int cell, std::uint64_t) {
  const auto to = s.environment<World>().cells[static_cast<std::size_t>(cell)];
  s.write(to, (s.read(to) + s.read(from)) % 7);
}
struct Box {
  sac::Cell<int> content;
};
void fill(sac::Scope& s, Box& self, std::uint64_t path, int cell) {
  const int read = s.read(s.environment<World>().cells[static_cast<std::size_t>(cell)]);
  s.write(self.content, (read + static_cast<int>(path % 5)) % 3);
}

void node(sac::Scope& s, int id, std::uint64_t path) {
  auto& w = s.environment<World>();
  const auto cell = [&](int i) { return w.cells[static_cast<std::size_t>(i)]; };
  const auto& ops = w.program->nodes[static_cast<std::size_t>(id)];
  int sum = static_cast<int>(path % 3);
  for (std::size_t i = 0; i < ops.size(); ++i) {
    const Op& op = ops[i];
    if (sum % op.modulus >= op.threshold) continue;
    const int other = id + 1 + op.target;  // a node behind this one
    switch (op.kind) {
      case Op::read_input:
        sum += s.read(w.inputs[static_cast<std::size_t>(op.target)]);
        break;
      case Op::read_cell:
        sum += s.read(cell(op.target));
        break;
      case Op::rewrite_cell:
      case Op::write_cell:
        s.write(cell(op.target), (sum + id) % 5);
        break;
      case Op::ask:
        sum += s.call<ask>(step(path, i), op.target);
        break;
      case Op::call:
        s.call<node>(other, step(path, i));
        break;
      case Op::pass:
      case Op::box: {
        Box& box = s.make<Box, fill>(step(path, i), op.target);
        s.call<pass>(sac::Mod<int>(box.content), op.target, step(path, i));
        break;
      }
      case Op::post:
        w.agenda->post<node>(s, node_key(other, 0), other, step(path, i));
        break;
      case Op::tail:
        s.tail<node>(other, step(path, i));
        break;
      case Op::tail_box:
        s.tail_make<Box, fill>(step(path, i), op.target);
        break;
      default:
        break;
    }
  }
}

void root(sac::Scope& s) {
  auto& w = s.environment<World>();
  for (const auto& c : w.cells) s.write(c, 0);
  for (int n = 0; n < 3; ++n) s.call<node>(n, static_cast<std::uint64_t>(n));
  w.agenda->drain(s);
  s.call<ask>(1, 0);
}

struct Run {
  World world;
  sac::Engine engine;
  traces::Recorder recorder{engine};

  Run(const RandomProgram& program, const std::vector<int>& values) {
    world.program = &program;
    for (std::size_t i = 0; i < values.size(); ++i) {
      world.inputs.push_back(engine.input(values[i]));
      recorder.name(world.inputs.back(), "input", i);
    }
    for (int i = 0; i < program.kCells; ++i) {
      world.cells.push_back(engine.cell<int>());
      recorder.name(world.cells.back(), "cell", i);
    }
    world.agenda = &engine.make_agenda("nodes");
    engine.set_environment(&world);
    engine.run<root>();
  }
};

// Edits until a propagation costs more than `limit` times its distance; what it then cost.
// `widest`: the largest ratio seen. Throws what the engine throws.
bool within(std::uint64_t seed, int nodes, int edits, double limit, double& widest,
            std::uint64_t& measured) {
  const RandomProgram program(seed, nodes);
  Random random(seed + 77);
  std::vector<int> values(std::size_t{RandomProgram::kInputs}, 1);
  auto run = std::make_unique<Run>(program, values);
  traces::Trace before = run->recorder.trace();
  for (int i = 0; i < edits; ++i) {
    const auto first = static_cast<std::size_t>(random(program.kInputs));
    for (std::size_t k = 0; k < 1 + static_cast<std::size_t>(random(2)); ++k) {
      const std::size_t input = (first + k) % values.size();  // each once: no edit undoes another
      values[input] = random(5);
      run->engine.set(run->world.inputs[input], values[input]);
    }
    const sac::Counts counts = run->engine.propagate();
    const traces::Trace after = Run(program, values).recorder.trace();
    REQUIRE(after.unnamed == 0);
    REQUIRE(traces::check_concise(after).surplus == 0);
    REQUIRE(traces::check_monotone(before, after).moved == 0);
    REQUIRE(traces::distance(run->recorder.trace(), after).all.distance() == 0);
    const std::uint64_t distance = traces::distance(before, after).all.distance();
    const std::uint64_t work = counts.created + counts.discarded + counts.executed;
    before = after;
    ++measured;
    const double ratio =
        static_cast<double>(work) / static_cast<double>(std::max<std::uint64_t>(distance, 1));
    widest = std::max(widest, ratio);
    if (ratio > limit) {
      UNSCOPED_INFO("edit " << i << ": work " << work << " (created " << counts.created
                            << ", discarded " << counts.discarded << ", executed "
                            << counts.executed << "), distance " << distance);
      return false;
    }
  }
  return true;
}

// Of the programs that fail, the one with the fewest nodes, then the fewest edits.
void check_seeds(std::uint64_t from, std::uint64_t to, double limit) {
  double widest = 0;
  std::uint64_t measured = 0;
  for (std::uint64_t seed = from; seed < to; ++seed) {
    const int nodes = 4 + static_cast<int>(seed % 5);
    if (within(seed, nodes, 15, limit, widest, measured)) continue;
    for (int n = 4; n <= nodes; ++n) {
      for (int edits = 1; edits <= 15; ++edits) {
        if (within(seed, n, edits, limit, widest, measured)) continue;
        FAIL("seed " << seed << ", " << n << " nodes, " << edits << " edits");
      }
    }
  }
  WARN("work / distance: at most " << widest << " over " << measured << " propagations");
}

TEST_CASE("work is within a constant factor of the distance, on random programs") {
  check_seeds(0, 300, 2);
}

TEST_CASE("work is within a constant factor of the distance, on many random programs", "[.soak]") {
  check_seeds(1000, 20000, 2);
}

}  // namespace
