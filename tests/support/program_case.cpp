#include "program_case.hpp"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <iterator>
#include <sstream>
#include <string_view>
#include <utility>

namespace support {

namespace {

constexpr std::array<std::string_view, Op::kKinds> kOpNames{
    "read input",   "read cell",    "read coarse", "read link",    "read list",   "write cell",
    "rewrite cell", "write coarse", "link",        "ask",          "call",        "pass",
    "box",          "post",         "stripe",      "relink",       "tail",        "tail box",
    "read maybe",   "catch maybe",  "write maybe", "write input",  "catch write", "claim",
    "count",        "total",        "mark",        "post side",    "drain",       "drain call",
    "tail drain",   "post early",   "keyed",       "real",         "catch real",  "fail",
    "catch own",    "catch call",   "misuse",      "catch misuse", "answer",      "late write",
    "query",        "query any"};
constexpr std::array<std::string_view, Step::kKinds> kStepNames{
    "set", "post",   "retract", "insert", "remove", "weigh", "propagate", "undo",
    "run", "shrink", "fuse",    "client", "heap",   "arena", "cancel",    "starve"};

// Among the kinds of ops, as bytes: what ends a node, and what ends the program.
constexpr int kNextNode = Op::read_maybe;
constexpr int kNoMoreNodes = kNextNode + 1;
constexpr int kBytes = Op::kKinds + 2;

int byte_of(Op::Kind kind) { return kind < kNextNode ? kind : kind + 2; }
Op::Kind kind_of(int byte) { return static_cast<Op::Kind>(byte < kNextNode ? byte : byte - 2); }

// Takes bytes from the front; zeros behind the end.
class Bytes {
 public:
  explicit Bytes(std::span<const std::uint8_t> bytes) : left_(bytes) {}
  [[nodiscard]] bool empty() const { return left_.empty(); }
  int next() {
    if (left_.empty()) return 0;
    const int byte = left_.front();
    left_ = left_.subspan(1);
    return byte;
  }

 private:
  std::span<const std::uint8_t> left_;
};

std::vector<std::vector<Op>> decode_nodes(Bytes& bytes) {
  std::vector<std::vector<Op>> nodes(1);
  while (!bytes.empty()) {
    const int kind = bytes.next() % kBytes;
    if (kind == kNoMoreNodes) break;
    if (kind == kNextNode) {
      if (nodes.size() == RandomProgram::kMostNodes) break;
      nodes.emplace_back();
      continue;
    }
    const int target = bytes.next();
    const int condition = bytes.next();
    nodes.back().push_back({kind_of(kind), target, 2 + condition % 3, 1 + condition / 3 % 2});
  }
  return nodes;
}

void add_random_failure(Random& random, std::vector<Step>& steps) {
  const auto add = [&](Step::Kind kind, int most) { steps.push_back({kind, random(most), 0}); };
  switch (random(6)) {
    case 0:
    case 1:
      return add(Step::fuse, 12);
    case 2:
      return add(Step::client, 200);
    case 3:
      return add(Step::heap, 60);
    case 4:
      return add(Step::arena, 40);
    default:
      return add(Step::cancel, 12);
  }
}

}  // namespace

namespace {

// Leaves out what belongs to other features, and makes the rest valid. Side agendas are not without
// drains.
void make_valid(Case& c, unsigned features) {
  c.program.keep_features(features);
  c.program.make_valid();
  if ((features & Feature::drains) != 0) return;
  for (Step& step : c.steps) {
    if (step.kind == Step::run) step.a %= 16;
    if (step.kind == Step::post || step.kind == Step::retract) step.b = 0;
  }
}

// A few ops of the features, so that most runs accept: what makes a run refuse is rare.
void sprinkle_features(Random& random, RandomProgram& program, unsigned features) {
  const auto put = [&](int most, std::initializer_list<Op::Kind> kinds) {
    for (int i = random(most + 1); i > 0; --i) {
      const auto kind = kinds.begin()[random(static_cast<int>(kinds.size()))];
      program.sprinkle(random, random(program.size()), kind);
    }
  };
  if (features & Feature::drains) {
    put(5, {Op::mark, Op::post_side});
    put(2, {Op::drain, Op::drain_call, Op::drain_call, Op::tail_drain});
    put(1, {Op::post_early});
  }
  if (features & Feature::structures) put(8, {Op::claim, Op::count, Op::total});
  if (features & Feature::failures) {
    put(3, {Op::write_maybe});
    put(2, {Op::read_maybe, Op::catch_maybe, Op::fail, Op::catch_own, Op::catch_call,
            Op::write_input, Op::catch_write});
  }
  if (features & Feature::keys) put(2, {Op::keyed});
  if (features & Feature::unequal) put(2, {Op::real, Op::catch_real});
  if (features & Feature::outside) put(1, {Op::misuse, Op::catch_misuse});
  if (features & Feature::behind) put(3, {Op::answer, Op::late_write, Op::late_write});
  if (features & Feature::queries) put(6, {Op::query, Op::query, Op::query, Op::query_any});
}

// Propagations with edits before them, and failures if they shall be; as many as `batches`.
void add_steps(Random& random, Case& c, int batches, bool failures) {
  const auto add = [&](Step::Kind kind, int a, int b = 0) { c.steps.push_back({kind, a, b}); };
  for (int i = 0; i < batches; ++i) {
    if (failures && random(6) == 0) add_random_failure(random, c.steps);
    for (int k = 1 + random(3); k > 0; --k) {
      const int values = random(4) == 0 ? 8 : 5;
      add(Step::set, random(4), random(values));
    }
    if (random(3) == 0) {
      for (int k = 1 + random(2); k > 0; --k) {
        const auto kind = random(2) == 0 ? Step::post : Step::retract;
        const int where = random(3) == 0 ? random(3) : 0;
        add(kind, random(c.program.size()), where);
      }
    }
    if (random(4) == 0) {
      constexpr Step::Kind kListEdits[] = {Step::insert, Step::remove, Step::weigh};
      for (int k = 1 + random(2); k > 0; --k) add(kListEdits[random(3)], random(6), random(5));
    }
    if (random(16) == 0) add(Step::undo, 0);
    if (failures && random(24) == 0) add(Step::starve, 0);
    add(Step::propagate, 0);
    if (random(16) == 0) add(Step::shrink, 0);
    if (random(8) == 0) add(Step::propagate, 0);
    if (failures && random(4) == 0) add_random_failure(random, c.steps);
    if (random(12) == 0) add(Step::run, random(32));
  }
}

}  // namespace

Case random_case(std::uint64_t seed, unsigned features) {
  Random random(seed ^ 0xabcdef);
  Case c;
  c.program = RandomProgram(seed, RandomProgram::kLeastNodes + random(10));
  unsigned some = 0;  // most programs have few features: each makes runs refuse
  for (int k = random(4); k > 0; --k) some |= 1u << random(7);
  sprinkle_features(random, c.program, features & some);
  c.fragile = random(3) == 0;
  c.audit = random(4) == 0;
  c.observe = random(4) == 0;
  add_steps(random, c, 25, true);
  make_valid(c, features);
  return c;
}

namespace {

// All is about few inputs, cells and keys, and inputs come first, so that ops meet.
void make_narrow(Random& random, Case& c) {
  for (auto& ops : c.program.nodes) {
    for (Op& op : ops) {
      const bool of_nodes = op.kind == Op::call || op.kind == Op::post || op.kind == Op::tail ||
                            op.kind == Op::post_side || op.kind == Op::post_early ||
                            op.kind == Op::catch_call || op.kind == Op::drain_call;
      if (!of_nodes) op.target %= 2;
    }
    std::stable_partition(ops.begin(), ops.end(),
                          [](const Op& op) { return op.kind == Op::read_input; });
  }
  for (Step& step : c.steps) {
    if (step.kind == Step::set) step.a = random(4) == 0 ? step.a : step.a % 2;
  }
}

}  // namespace

Case focused_case(std::uint64_t seed, unsigned features) {
  Random random(seed ^ 0xf0c05);
  Case c;
  c.program = RandomProgram(RandomProgram::kLeastNodes + random(3));
  std::vector<Op::Kind> kinds;
  for (int k = Op::read_maybe; k < Op::kKinds; ++k) {
    const auto kind = static_cast<Op::Kind>(k);
    if ((Op::feature(kind) & features) != 0) kinds.push_back(kind);
  }
  constexpr Op::Kind kPlain[] = {Op::read_input, Op::read_input, Op::read_cell, Op::write_cell,
                                 Op::ask,        Op::call,       Op::call,      Op::tail,
                                 Op::post,       Op::write_maybe};
  for (int n = 0; n < c.program.size(); ++n) {
    if (n < 3) c.program.sprinkle(random, n, Op::read_input);
    if (n < 3) c.program.sprinkle(random, n, random(4) == 0 ? Op::tail : Op::call);
    for (int i = 1 + random(3); i > 0; --i) {
      c.program.sprinkle(random, n, kPlain[random(static_cast<int>(std::size(kPlain)))]);
    }
    for (int i = kinds.empty() ? 0 : random(n < 3 ? 4 : 3); i > 0; --i) {
      c.program.sprinkle(random, n,
                         kinds[static_cast<std::size_t>(random(static_cast<int>(kinds.size())))]);
    }
  }
  c.fragile = random(8) == 0;
  c.audit = random(8) == 0;
  add_steps(random, c, 10, random(4) == 0);
  if (random(2) == 0) make_narrow(random, c);
  make_valid(c, features);
  return c;
}

Case decode(std::span<const std::uint8_t> all) {
  Bytes bytes(all);
  Case c;
  const int flags = bytes.next();
  c.fragile = flags & 1;
  c.audit = flags & 2;
  c.observe = flags & 4;
  c.program.nodes = decode_nodes(bytes);
  if (c.program.nodes.size() < RandomProgram::kLeastNodes) {
    c.program.nodes.resize(RandomProgram::kLeastNodes);
  }
  while (!bytes.empty()) {
    const auto kind = static_cast<Step::Kind>(bytes.next() % Step::kKinds);
    const int a = bytes.next();
    c.steps.push_back({kind, a, bytes.next()});
  }
  make_valid(c, kFeatures);
  return c;
}

std::vector<std::uint8_t> encode(const Case& c) {
  std::vector<std::uint8_t> bytes;
  const auto put = [&](int byte) { bytes.push_back(static_cast<std::uint8_t>(byte)); };
  put((c.fragile ? 1 : 0) + (c.audit ? 2 : 0) + (c.observe ? 4 : 0));
  for (std::size_t n = 0; n < c.program.nodes.size(); ++n) {
    if (n > 0) put(kNextNode);
    for (const Op& op : c.program.nodes[n]) {
      put(byte_of(op.kind));
      put(op.target);
      put(op.modulus - 2 + 3 * (op.threshold - 1));
    }
  }
  put(kNoMoreNodes);
  for (const Step& step : c.steps) {
    put(step.kind);
    put(step.a);
    put(step.b);
  }
  return bytes;
}

std::string describe(const Case& c) {
  std::ostringstream out;
  out << (c.fragile ? "fragile values" : "ints") << (c.audit ? ", audit" : "")
      << (c.observe ? ", observed" : "") << '\n';
  for (std::size_t n = 0; n < c.program.nodes.size(); ++n) {
    out << "node " << n << ':';
    for (const Op& op : c.program.nodes[n]) {
      out << "  " << kOpNames[op.kind] << ' ' << op.target << " if %" << op.modulus << '<'
          << op.threshold;
    }
    out << '\n';
  }
  for (const Step& step : c.steps) {
    out << kStepNames[step.kind] << ' ' << step.a << ' ' << step.b
        << (step.kind == Step::propagate ? '\n' : ';') << ' ';
  }
  out << "\nbytes";
  for (const std::uint8_t byte : encode(c)) out << ' ' << int(byte);
  out << '\n';
  return out.str();
}

namespace {

// Calls visit(smaller) for cases with one thing less than `c`, or one that is simpler.
void for_each_smaller(const Case& c, const std::function<void(const Case&)>& visit) {
  const auto without = [](auto items, std::size_t i) {
    items.erase(items.begin() + static_cast<std::ptrdiff_t>(i));
    return items;
  };
  for (std::size_t i = c.steps.size(); i-- > 0;) {
    Case other = c;
    other.steps = without(c.steps, i);
    visit(other);
  }
  for (std::size_t n = c.program.nodes.size(); n-- > 0;) {
    for (std::size_t i = c.program.nodes[n].size(); i-- > 0;) {
      Case other = c;
      other.program.nodes[n] = without(c.program.nodes[n], i);
      visit(other);
    }
  }
  if (c.program.size() > RandomProgram::kLeastNodes) {
    Case other = c;
    other.program.nodes.pop_back();
    other.program.make_valid();
    visit(other);
  }
  for (std::size_t n = 0; n < c.program.nodes.size(); ++n) {
    for (std::size_t i = 0; i < c.program.nodes[n].size(); ++i) {
      if (const Op& op = c.program.nodes[n][i]; op.modulus == 2 && op.threshold == 2) continue;
      Case other = c;  // with an op that always happens
      other.program.nodes[n][i].modulus = other.program.nodes[n][i].threshold = 2;
      visit(other);
    }
  }
  for (bool Case::*flag : {&Case::fragile, &Case::audit, &Case::observe}) {
    if (!(c.*flag)) continue;
    Case other = c;
    other.*flag = false;
    visit(other);
  }
}

}  // namespace

Case shrink(Case c, const std::function<bool(const Case&)>& fails) {
  for (bool smaller = true; std::exchange(smaller, false);) {
    const Case all = c;

    for_each_smaller(all, [&](const Case& other) {
      if (smaller || !fails(other)) return;
      c = other;
      smaller = true;
    });
  }
  return c;
}

}  // namespace support
