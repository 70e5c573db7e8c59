#include "program_case.hpp"

#include <algorithm>
#include <array>
#include <sstream>
#include <string_view>

namespace support {

namespace {

constexpr std::array<std::string_view, Op::kKinds> kOpNames{
    "read input", "read cell", "read coarse", "read link", "read list", "write cell",
    "rewrite cell", "write coarse", "link", "ask", "call", "pass", "box", "post", "stripe",
    "relink", "tail", "tail box"};
constexpr std::array<std::string_view, Step::kKinds> kStepNames{
    "set", "post", "retract", "insert", "remove", "weigh", "propagate", "undo", "run", "shrink",
    "fuse", "client", "heap", "arena", "cancel", "starve"};

// Behind the kinds of ops: what ends a node, and what ends the program.
constexpr int kNextNode = Op::kKinds;
constexpr int kNoMoreNodes = Op::kKinds + 1;

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
    const int kind = bytes.next() % (kNoMoreNodes + 1);
    if (kind == kNoMoreNodes) break;
    if (kind == kNextNode) {
      if (nodes.size() == RandomProgram::kMostNodes) break;
      nodes.emplace_back();
      continue;
    }
    const int target = bytes.next();
    const int condition = bytes.next();
    nodes.back().push_back(
        {static_cast<Op::Kind>(kind), target, 2 + condition % 3, 1 + condition / 3 % 2});
  }
  return nodes;
}

// Targets that there are, phases in order, one op at most in the last phase.
void make_valid(RandomProgram& program) {
  for (int n = 0; n < static_cast<int>(program.nodes.size()); ++n) {
    auto& ops = program.nodes[static_cast<std::size_t>(n)];
    std::erase_if(ops, [&](const Op& op) { return program.targets(op.kind, n) <= 0; });
    for (Op& op : ops) op.target %= program.targets(op.kind, n);
    std::stable_sort(ops.begin(), ops.end(),
                     [](const Op& a, const Op& b) { return a.phase() < b.phase(); });
    while (ops.size() > 1 && ops[ops.size() - 2].phase() == 3) ops.pop_back();
  }
}

void add_random_failure(Random& random, std::vector<Step>& steps) {
  const auto add = [&](Step::Kind kind, int most) { steps.push_back({kind, random(most), 0}); };
  switch (random(6)) {
    case 0:
    case 1: return add(Step::fuse, 12);
    case 2: return add(Step::client, 200);
    case 3: return add(Step::heap, 60);
    case 4: return add(Step::arena, 40);
    default: return add(Step::cancel, 12);
  }
}

}  // namespace

Case random_case(std::uint64_t seed) {
  Random random(seed ^ 0xabcdef);
  const int nodes = RandomProgram::kLeastNodes + random(10);
  Case c;
  c.program = RandomProgram(seed, nodes);
  c.fragile = random(3) == 0;
  c.audit = random(4) == 0;
  c.observe = random(4) == 0;
  const auto add = [&](Step::Kind kind, int a, int b = 0) { c.steps.push_back({kind, a, b}); };
  for (int i = 0; i < 25; ++i) {
    if (random(6) == 0) add_random_failure(random, c.steps);
    for (int k = 1 + random(3); k > 0; --k) {
      const int values = random(4) == 0 ? 8 : 5;
      add(Step::set, random(4), random(values));
    }
    if (random(3) == 0) {
      for (int k = 1 + random(2); k > 0; --k) {
        add(random(2) == 0 ? Step::post : Step::retract, random(nodes));
      }
    }
    if (random(4) == 0) {
      constexpr Step::Kind kListEdits[] = {Step::insert, Step::remove, Step::weigh};
      for (int k = 1 + random(2); k > 0; --k) add(kListEdits[random(3)], random(6), random(5));
    }
    if (random(16) == 0) add(Step::undo, 0);
    if (random(24) == 0) add(Step::starve, 0);
    add(Step::propagate, 0);
    if (random(16) == 0) add(Step::shrink, 0);
    if (random(4) == 0) add_random_failure(random, c.steps);
    if (random(12) == 0) add(Step::run, random(16));
  }
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
  make_valid(c.program);
  while (!bytes.empty()) {
    const auto kind = static_cast<Step::Kind>(bytes.next() % Step::kKinds);
    const int a = bytes.next();
    c.steps.push_back({kind, a, bytes.next()});
  }
  return c;
}

std::vector<std::uint8_t> encode(const Case& c) {
  std::vector<std::uint8_t> bytes;
  const auto put = [&](int byte) { bytes.push_back(static_cast<std::uint8_t>(byte)); };
  put((c.fragile ? 1 : 0) + (c.audit ? 2 : 0) + (c.observe ? 4 : 0));
  for (std::size_t n = 0; n < c.program.nodes.size(); ++n) {
    if (n > 0) put(kNextNode);
    for (const Op& op : c.program.nodes[n]) {
      put(op.kind);
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

Case shrink(Case c, const std::function<bool(const Case&)>& fails) {
  bool smaller = true;
  const auto keep = [&](const Case& other) {
    if (!fails(other)) return;
    c = other;
    smaller = true;
  };
  const auto without = [](auto items, std::size_t i) {
    items.erase(items.begin() + static_cast<std::ptrdiff_t>(i));
    return items;
  };
  while (std::exchange(smaller, false)) {
    for (std::size_t i = c.steps.size(); i-- > 0;) {
      Case other = c;
      other.steps = without(c.steps, i);
      keep(other);
    }
    for (std::size_t n = c.program.nodes.size(); n-- > 0;) {
      for (std::size_t i = c.program.nodes[n].size(); i-- > 0;) {
        Case other = c;
        other.program.nodes[n] = without(c.program.nodes[n], i);
        keep(other);
      }
    }
    for (bool Case::*flag : {&Case::fragile, &Case::audit, &Case::observe}) {
      Case other = c;
      other.*flag = false;
      if (c.*flag) keep(other);
    }
  }
  return c;
}

}  // namespace support
