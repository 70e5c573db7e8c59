// The text of a random program: a table of nodes, each a list of ops. What ops do is said in
// random_program.hpp.
//
// Ops belong to features, so that a program can be asked for that is dense in one of them, and one
// that has none of those that an engine cannot do yet: kFeatures.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "random.hpp"

namespace support {

/// What a program may have besides reads, writes, calls, posts and tail calls: a set of these.
struct Feature {
  enum : unsigned {
    drains = 1,      // nodes post on side agendas and drain them, directly and through wrappers
    failures = 2,    // exceptions and what is misused, caught or not: most runs refuse
    structures = 4,  // structures of the user
    keys = 8,        // keys that are no function of the label
    unequal = 16,    // posted arguments that do not equal themselves
    outside = 32,    // the client's side of the engine in a traced function
    behind = 64,     // ops in any order: reads, writes, claims and posts behind calls as well
    queries = 128    // nodes that are asked for, in any order; some need their own results
  };
  static constexpr unsigned kAll = 255;
};

/// What programs from seeds and from bytes have.
inline constexpr unsigned kFeatures = Feature::kAll;

struct Op {
  enum Kind : std::uint8_t {
    // reads and writes,
    read_input,
    read_cell,
    read_coarse,
    read_link,
    read_list,
    write_cell,
    rewrite_cell,
    write_coarse,
    // allocates and writes,
    link,
    // calls,
    ask,
    call,
    pass,
    box,
    post,
    stripe,
    relink,
    // tail calls,
    tail,
    tail_box,
    // reads and writes cells that nobody may have written, or inputs,
    read_maybe,
    catch_maybe,
    write_maybe,
    write_input,
    catch_write,
    // asks and tells structures,
    claim,
    count,
    total,
    // posts on side agendas and drains them,
    mark,
    post_side,
    drain,
    drain_call,
    tail_drain,
    post_early,
    // posts badly,
    keyed,
    real,
    catch_real,
    // fails,
    fail,
    catch_own,
    catch_call,
    misuse,
    catch_misuse,
    // calls what returns a value and goes on by a tail call,
    answer,
    // writes what an earlier op of the node has read
    late_write,
    // asks for a node behind this one, or for any
    query,
    query_any
  };
  static constexpr int kKinds = query_any + 1;

  Kind kind;
  int target;   // input, cell, node ..., below targets()
  int modulus;  // happens if (what was read) % modulus < threshold
  int threshold;

  /// Ops of a node come in the order of their phases: reads and writes, allocation, calls, a tail
  /// call. There is one of the last phase at most. In a program with ops of Feature::behind the
  /// first three are one.
  [[nodiscard]] int phase() const {
    switch (kind) {
      case link:
        return 1;
      case tail:
      case tail_box:
      case tail_drain:
        return 3;
      default:
        return kind < link || (kind >= read_maybe && kind <= total) ? 0 : 2;
    }
  }
  /// The feature that it belongs to; 0: none.
  [[nodiscard]] static unsigned feature(Kind kind) {
    if (kind < read_maybe) return 0;
    if (kind == write_maybe) return 0;
    if (kind <= catch_write) return Feature::failures;
    if (kind <= total) return Feature::structures;
    if (kind <= post_early) return Feature::drains;
    if (kind == keyed) return Feature::keys;
    if (kind <= catch_real) return Feature::unequal;
    if (kind <= catch_call) return Feature::failures;
    if (kind <= catch_misuse) return Feature::outside;
    return kind <= late_write ? Feature::behind : Feature::queries;
  }
};

struct RandomProgram {
  static constexpr int kInputs = 4;
  static constexpr int kCells = 5;
  static constexpr int kCoarse = 2;  // cells that tell halves only
  static constexpr int kLinks = 2;   // cells that hold pointers to boxes
  static constexpr int kMaybes = 3;  // cells that only some nodes write
  static constexpr int kKeys = 3;    // of a structure
  static constexpr int kCounters = 2;
  static constexpr int kSides = 2;  // agendas that nodes drain
  static constexpr int kWraps = 4;  // ways to drain in a call
  static constexpr int kMisuses = 6;
  static constexpr int kLeastNodes = 4;
  static constexpr int kMostNodes = 14;

  std::vector<std::vector<Op>> nodes;

  [[nodiscard]] int size() const { return static_cast<int>(nodes.size()); }
  [[nodiscard]] std::vector<Op>& node(int n) { return nodes[static_cast<std::size_t>(n)]; }

  /// Number of targets of an op of node `node`.
  [[nodiscard]] int targets(Op::Kind kind, int node) const {
    const int behind = size() - 1 - node;
    switch (kind) {
      case Op::read_input:
        return kInputs;
      case Op::read_coarse:
      case Op::write_coarse:
        return kCoarse;
      case Op::read_link:
      case Op::link:
      case Op::relink:
        return kLinks;
      case Op::read_list:
        return 4;  // so many elements
      case Op::stripe:
        return 12 * kCells;  // length and cell
      case Op::call:
      case Op::post:
      case Op::tail:
      case Op::post_early:
      case Op::catch_call:
      case Op::query:
        return behind;
      case Op::query_any:
        return size();
      case Op::post_side:
        return kSides * behind;
      case Op::read_maybe:
      case Op::catch_maybe:
      case Op::write_maybe:
        return kMaybes;
      case Op::write_input:
      case Op::catch_write:
        return kInputs;
      case Op::claim:
        return kKeys;
      case Op::count:
      case Op::total:
        return kCounters * kKeys;
      case Op::mark:
      case Op::keyed:
        return kSides * kCells;
      case Op::real:
      case Op::catch_real:
        return kSides * kCells;
      case Op::drain:
        return kSides;
      case Op::drain_call:
        return kSides * kWraps;
      case Op::tail_drain:
        return kSides;
      case Op::fail:
      case Op::catch_own:
        return 1;
      case Op::misuse:
      case Op::catch_misuse:
        return kMisuses;
      default:
        return kCells;
    }
  }

  explicit RandomProgram(int node_count) : nodes(static_cast<std::size_t>(node_count)) {}

  /// A program of calls, posts, reads and writes.
  RandomProgram(std::uint64_t seed, int node_count) : RandomProgram(node_count) {
    for (int n = 0; n < node_count; ++n) {
      Random random(seed * 1000 + static_cast<std::uint64_t>(n));
      const auto some = [&](int most, Op::Kind kind) {
        const int to = targets(kind, n);
        for (int i = to > 0 ? random(most + 1) : 0; i > 0; --i) {
          node(n).push_back({kind, random(to), 2 + random(3), 1 + random(2)});
        }
      };
      some(2, Op::read_input);
      some(2, Op::read_cell);
      some(2, Op::write_cell);
      some(1, Op::rewrite_cell);
      if (random(2) == 0) {
        for (const auto kind : {Op::read_coarse, Op::read_link, Op::read_list, Op::write_coarse}) {
          some(1, kind);
        }
      }
      if (random(3) == 0) some(2, Op::link);
      some(1, Op::ask);
      some(2, Op::call);
      some(1, Op::pass);
      some(1, Op::box);
      some(2, Op::post);
      some(1, Op::call);
      if (random(4) == 0) some(1, Op::stripe);
      if (random(4) == 0) some(1, Op::relink);
      some(1, random(2) == 0 ? Op::tail : Op::tail_box);
    }
  }

  /// Puts an op at a random place of a node, if it has a target there.
  void sprinkle(Random& random, int n, Op::Kind kind) {
    const int to = targets(kind, n);
    if (to <= 0) return;
    auto& ops = node(n);
    const Op op{kind, random(to), 2 + random(3), 1 + random(2)};
    ops.insert(ops.begin() + random(static_cast<int>(ops.size()) + 1), op);
  }

  /// Targets that there are, phases in order, one op at most in the last phase.
  void make_valid() {
    const bool in_any_order = has(Op::answer) || has(Op::late_write);
    for (int n = 0; n < size(); ++n) {
      auto& ops = node(n);
      std::erase_if(ops, [&](const Op& op) { return targets(op.kind, n) <= 0; });
      for (Op& op : ops) op.target %= targets(op.kind, n);
      std::stable_sort(ops.begin(), ops.end(), [&](const Op& a, const Op& b) {
        return in_any_order ? a.phase() < 3 && b.phase() == 3 : a.phase() < b.phase();
      });
      while (ops.size() > 1 && ops[ops.size() - 2].phase() == 3) ops.pop_back();
    }
  }

  [[nodiscard]] bool has(Op::Kind kind) const {
    return std::any_of(nodes.begin(), nodes.end(), [&](const auto& ops) {
      return std::any_of(ops.begin(), ops.end(), [&](const Op& op) { return op.kind == kind; });
    });
  }

  /// Leaves out what belongs to other features.
  void keep_features(unsigned features) {
    for (auto& ops : nodes) {
      std::erase_if(ops, [&](const Op& op) { return (Op::feature(op.kind) & ~features) != 0; });
    }
  }
};

}  // namespace support
