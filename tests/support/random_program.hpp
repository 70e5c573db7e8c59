// Random programs for the engine, from a seed; the same text runs on sac::Scope and
// sac::PlainScope.
//
// A program is a table of nodes. A node, called with its number and a small argument, reads inputs
// and cells, writes cells (several nodes and calls write one cell: imperative), asks for results,
// allocates, calls and posts nodes of higher number, and goes on with a tail call. What it does
// depends on what it read. Reads and writes come before calls: a call's effects are at the place of
// the call. (A result that was asked for changes what the call does next, not what it wrote.)
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "random.hpp"
#include "sac/sac.hpp"

namespace support {

/// Thrown by a program whose fuse has burnt down.
struct Failure : std::runtime_error {
  Failure() : std::runtime_error("the fuse of a random program") {}
};

struct Op {
  enum Kind {
    read_input, read_cell, write_cell, rewrite_cell, ask, call, pass, box, post, tail, tail_box
  } kind;
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
      some(1, Op::ask, cells);
      later(2, Op::call);
      some(1, Op::pass, cells);
      some(1, Op::box, cells);
      later(2, Op::post);
      later(1, Op::call);
      if (random(2) == 0) {
        later(1, Op::tail);
      } else {
        some(1, Op::tail_box, cells);
      }
    }
  }
};

/// V: the type of values and arguments, made from an int and converted to one.
template <class S, class V = int>
struct RandomWorld {
  using Mod = typename S::template ModType<V>;

  const RandomProgram* program = nullptr;
  std::vector<Mod> inputs;
  std::vector<Mod> cells;
  typename S::AgendaType* agenda = nullptr;
  int fuse = -1;  // calls left until one throws; -1: none does

  void burn() {
    if (fuse >= 0 && fuse-- == 0) throw Failure();
  }
  void start(auto& engine, const std::vector<int>& values) {
    for (const int v : values) inputs.push_back(engine.template input<V>(V(v)));
    for (int i = 0; i < program->cells; ++i) cells.push_back(engine.template cell<V>());
    agenda = &engine.make_agenda("nodes");
    engine.set_environment(this);
  }
};

// Adds what `from` holds to a cell.
template <class V>
struct Pass {
  static constexpr std::string_view kName = "pass";
  template <class S>
  void operator()(S& s, typename S::template ModType<V> from, int cell) const {
    auto& w = s.template environment<RandomWorld<S, V>>();
    w.burn();
    const auto to = w.cells[static_cast<std::size_t>(cell)];
    s.write(to, V((int(s.read(to)) + int(s.read(from))) % 7));
  }
};
template <class V>
inline constexpr Pass<V> pass{};

// What a cell holds, as a result; the caller depends on it.
template <class V>
struct Ask {
  static constexpr std::string_view kName = "ask";
  template <class S>
  V operator()(S& s, V argument, int cell) const {
    auto& w = s.template environment<RandomWorld<S, V>>();
    w.burn();
    return V((int(s.read(w.cells[static_cast<std::size_t>(cell)])) + int(argument)) % 2);
  }
};
template <class V>
inline constexpr Ask<V> ask{};

// An object that holds something of a cell, behind a modifiable of its own.
template <class S, class V>
struct Box {
  typename S::template CellType<V> content;
};
template <class V>
struct Fill {
  static constexpr std::string_view kName = "fill";
  template <class S>
  void operator()(S& s, Box<S, V>& self, int id, V argument, int cell) const {
    auto& w = s.template environment<RandomWorld<S, V>>();
    w.burn();
    const int read = int(s.read(w.cells[static_cast<std::size_t>(cell)]));
    s.write(self.content, V((read + id + int(argument)) % 3));
  }
};
template <class V>
inline constexpr Fill<V> fill{};

template <class V>
struct Node {
  static constexpr std::string_view kName = "node";
  template <class S>
  void operator()(S& s, int id, V argument) const;
};
template <class V>
inline constexpr Node<V> node{};

inline sac::Key node_key(int id, int argument) {
  return {.bucket = id / 2,
          .colour = static_cast<unsigned>(id % 2),
          .order = static_cast<std::uint64_t>(argument / 2)};
}

template <class V>
template <class S>
void Node<V>::operator()(S& s, int id, V argument) const {
  auto& w = s.template environment<RandomWorld<S, V>>();
  const auto cell = [&](int i) { return w.cells[static_cast<std::size_t>(i)]; };
  w.burn();
  int sum = int(argument);
  int passed = 0;
  for (const Op& op : w.program->nodes[static_cast<std::size_t>(id)]) {
    if (sum % op.modulus >= op.threshold) continue;
    switch (op.kind) {
      case Op::read_input:
        sum += int(s.read(w.inputs[static_cast<std::size_t>(op.target)]));
        break;
      case Op::read_cell:
        sum += int(s.read(cell(op.target)));
        break;
      case Op::rewrite_cell:
        s.write(cell(op.target), V(sum % 3));
        [[fallthrough]];
      case Op::write_cell:
        s.write(cell(op.target), V((sum + id) % 5));
        break;
      case Op::ask:
        sum += int(s.template call<ask<V>>(argument, op.target));
        break;
      case Op::call:
        s.template call<node<V>>(op.target, V(sum % 3));
        break;
      case Op::pass: {
        auto own = s.template cell<V>(id, argument, passed++);
        s.write(own, V(sum % 4));
        s.template call<pass<V>>(own, op.target);
        break;
      }
      case Op::box: {
        auto& box = s.template make<Box<S, V>, fill<V>>(id, argument, op.target);
        s.template call<pass<V>>(typename S::template ModType<V>(box.content), op.target);
        break;
      }
      case Op::post:
        w.agenda->template post<node<V>>(s, node_key(op.target, sum % 3), op.target, V(sum % 3));
        break;
      case Op::tail:
        s.template tail<node<V>>(op.target, V(sum % 3));
        break;
      case Op::tail_box:
        s.template tail_make<Box<S, V>, fill<V>>(id, argument, op.target);
        break;
    }
  }
  w.burn();
}

// The program: all cells are written, three nodes are called, what they posted is run, a cell is
// passed on.
template <class V>
struct Root {
  static constexpr std::string_view kName = "root";
  template <class S>
  void operator()(S& s) const {
    auto& w = s.template environment<RandomWorld<S, V>>();
    const int v = int(s.read(w.inputs[0]));
    for (const auto& c : w.cells) s.write(c, V(0));
    for (int n = 0; n < 3; ++n) s.template call<node<V>>(n, V((v + n) % 2));
    if (v % 4 == 1) s.template call<node<V>>(3, V(7));
    w.agenda->drain(s);
    s.template call<pass<V>>(w.cells[0], 1 + v % 2);
  }
};
template <class V>
inline constexpr Root<V> random_root{};

}  // namespace support
