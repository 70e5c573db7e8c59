// Random programs for the engine, from a seed; the same text runs on sac::Scope and
// sac::PlainScope.
//
// A program is a table of nodes. A node, called with its number and a small argument, reads inputs
// and cells, writes cells (several nodes and calls write one cell: imperative), allocates, calls
// and posts nodes of higher number, and goes on with a tail call. What it does depends on what it
// read. Reads and writes come before calls: a call's effects are at the place of the call.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <vector>

#include "random.hpp"
#include "sac/sac.hpp"

namespace support {

/// Thrown by a program whose fuse has burnt down.
struct Failure : std::runtime_error {
  Failure() : std::runtime_error("the fuse of a random program") {}
};

struct Op {
  enum Kind { read_input, read_cell, write_cell, rewrite_cell, call, pass, post, tail } kind;
  int target;   // input, cell or node
  int modulus;  // happens if (what was read) % modulus < threshold
  int threshold;
};

struct RandomProgram {
  int inputs = 4;
  int cells = 5;
  std::vector<std::vector<Op>> nodes;

  RandomProgram(std::uint64_t seed, int node_count) : nodes(static_cast<std::size_t>(node_count)) {
    for (int n = 0; n < node_count; ++n) {
      Random random(seed * 1000 + static_cast<std::uint64_t>(n));
      auto& ops = nodes[static_cast<std::size_t>(n)];
      const auto some = [&](int most, Op::Kind kind, int targets) {
        for (int i = random(most + 1); i > 0; --i) {
          ops.push_back({kind, random(targets), 2 + random(3), 1 + random(2)});
        }
      };
      const auto later = [&](int most, Op::Kind kind) {
        if (n + 1 >= node_count) return;
        for (int i = random(most + 1); i > 0; --i) {
          const int to = n + 1 + random(node_count - n - 1);
          ops.push_back({kind, to, 2 + random(3), 1 + random(2)});
        }
      };
      some(2, Op::read_input, inputs);
      some(2, Op::read_cell, cells);
      some(2, Op::write_cell, cells);
      some(1, Op::rewrite_cell, cells);
      later(2, Op::call);
      some(1, Op::pass, cells);
      later(2, Op::post);
      later(1, Op::call);
      later(1, Op::tail);
    }
  }
};

template <class S>
struct RandomWorld {
  template <class T>
  using Mod = typename S::template ModType<T>;

  const RandomProgram* program = nullptr;
  std::vector<Mod<int>> inputs;
  std::vector<Mod<int>> cells;
  typename S::AgendaType* agenda = nullptr;
  int fuse = -1;  // calls left until one throws; -1: none does

  void burn() {
    if (fuse >= 0 && fuse-- == 0) throw Failure();
  }
  void start(auto& engine, const std::vector<int>& values) {
    for (const int v : values) inputs.push_back(engine.template input<int>(v));
    for (int i = 0; i < program->cells; ++i) cells.push_back(engine.template cell<int>());
    agenda = &engine.make_agenda("nodes");
    engine.set_environment(this);
  }
};

// Adds what `from` holds to a cell.
struct Pass {
  template <class S>
  void operator()(S& s, typename S::template ModType<int> from, int cell) const {
    auto& w = s.template environment<RandomWorld<S>>();
    w.burn();
    const auto to = w.cells[static_cast<std::size_t>(cell)];
    s.write(to, (s.read(to) + s.read(from)) % 7);
  }
};
inline constexpr Pass pass{};

struct Node {
  template <class S>
  void operator()(S& s, int id, int argument) const;
};
inline constexpr Node node{};

inline sac::Key node_key(int id, int argument) {
  return {.bucket = id / 2,
          .colour = static_cast<unsigned>(id % 2),
          .order = static_cast<std::uint64_t>(argument / 2)};
}

template <class S>
void Node::operator()(S& s, int id, int argument) const {
  auto& w = s.template environment<RandomWorld<S>>();
  const auto cell = [&](int i) { return w.cells[static_cast<std::size_t>(i)]; };
  w.burn();
  int sum = argument;
  int passed = 0;
  for (const Op& op : w.program->nodes[static_cast<std::size_t>(id)]) {
    if (sum % op.modulus >= op.threshold) continue;
    switch (op.kind) {
      case Op::read_input:
        sum += s.read(w.inputs[static_cast<std::size_t>(op.target)]);
        break;
      case Op::read_cell:
        sum += s.read(cell(op.target));
        break;
      case Op::rewrite_cell:
        s.write(cell(op.target), sum % 3);
        [[fallthrough]];
      case Op::write_cell:
        s.write(cell(op.target), (sum + id) % 5);
        break;
      case Op::call:
        s.template call<node>(op.target, sum % 3);
        break;
      case Op::pass: {
        auto own = s.template cell<int>(id, argument, passed++);
        s.write(own, sum % 4);
        s.template call<pass>(own, op.target);
        break;
      }
      case Op::post:
        w.agenda->template post<node>(s, node_key(op.target, sum % 3), op.target, sum % 3);
        break;
      case Op::tail:
        s.template tail<node>(op.target, sum % 3);
        break;
    }
  }
  w.burn();
}

// The program: all cells are written, three nodes are called, what they posted is run, a cell is
// passed on.
struct Root {
  template <class S>
  void operator()(S& s) const {
    auto& w = s.template environment<RandomWorld<S>>();
    const int v = s.read(w.inputs[0]);
    for (const auto& c : w.cells) s.write(c, 0);
    for (int n = 0; n < 3; ++n) s.template call<node>(n, (v + n) % 2);
    if (v % 4 == 1) s.template call<node>(3, 7);
    w.agenda->drain(s);
    s.template call<pass>(w.cells[0], 1 + v % 2);
  }
};
inline constexpr Root random_root{};

}  // namespace support
