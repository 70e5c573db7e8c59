// Objects with a body, cells as members, objects of the outside, and results of calls.
#include <catch2/catch.hpp>
#include <ostream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "sac/sac.hpp"

namespace {

using sac::Cell;
using sac::Engine;
using sac::Mod;
using sac::Scope;

// --- A list whose nodes are calls ------------------------------------------------------------

struct Node {
  int value = 0;
  Cell<const Node*> next;
};

void twice(Scope& s, Node& self, const Node* in) {
  self.value = 2 * in->value;
  const Node* next = s.read(in->next);
  s.write(self.next, next == nullptr ? nullptr : &s.tail_make<Node, twice>(next));
}

void twice_list(Scope& s, Mod<const Node*> in, Mod<const Node*> out) {
  const Node* first = s.read(in);
  s.write(out, first == nullptr ? nullptr : &s.tail_make<Node, twice>(first));
}

struct ListMap {
  Engine e;
  std::vector<Node*> nodes;
  Mod<const Node*> head = e.input<const Node*>(nullptr);
  Mod<const Node*> out = e.cell<const Node*>();

  explicit ListMap(int n) {
    for (int i = 0; i < n; ++i) {
      Node& node = e.make<Node>();
      node.value = i;
      e.set(node.next, nullptr);
      nodes.empty() ? e.set(head, &node) : e.set(nodes.back()->next, &node);
      nodes.push_back(&node);
    }
    e.run<twice_list>(head, out);
  }
  [[nodiscard]] std::vector<int> values() const {
    std::vector<int> all;
    for (const Node* n = e.get(out); n != nullptr; n = e.get(n->next)) all.push_back(n->value);
    return all;
  }
};

TEST_CASE("an object with a body is one call; an insertion makes one and runs one again") {
  ListMap list(50);
  CHECK(list.e.live_calls() == 51);
  const Node* first = list.e.get(list.out);
  Node& extra = list.e.make<Node>();
  extra.value = 100;
  list.e.set(extra.next, list.nodes[21]);
  list.e.set(list.nodes[20]->next, &extra);
  const auto counts = list.e.propagate();
  CHECK(counts.created == 1);
  CHECK(counts.executed == 2);
  CHECK(counts.discarded == 0);
  CHECK(list.e.get(list.out) == first);
  CHECK(list.values()[21] == 200);
  CHECK(list.values()[22] == 42);
  list.e.check_invariants();

  list.e.set(list.nodes[20]->next, list.nodes[21]);
  list.e.release(extra);
  CHECK(list.e.propagate().discarded == 1);
  CHECK(list.e.live_calls() == 51);
  list.e.check_invariants();
}

TEST_CASE("an object that tail_make gave may be filled in a run of a million links") {
  ListMap list(1'000'000);
  CHECK(list.e.live_calls() == 1'000'001);
  CHECK(list.values().back() == 2 * 999'999);
}

// --- Objects of the outside ------------------------------------------------------------------

struct Counted {
  static inline int alive = 0;
  Cell<std::string> text;
  Counted() { ++alive; }
  ~Counted() { --alive; }
};

void length(Scope& s, Counted* object, Mod<std::size_t> out) {
  s.write(out, object == nullptr ? 0 : s.read(object->text).size());
}
void length_of(Scope& s, Mod<Counted*> which, Mod<std::size_t> out) {
  s.call<length>(s.read(which), out);
}

TEST_CASE("an object of the outside lives until the propagation after its release has succeeded") {
  Counted::alive = 0;
  {
    Engine e;
    auto& a = e.make<Counted>();
    auto& b = e.make<Counted>();
    e.set(a.text, "four");
    e.set(b.text, "seventy");
    const auto which = e.input(&a);
    const auto out = e.cell<std::size_t>();
    e.run<length_of>(which, out);
    CHECK(e.get(out) == 4);
    e.set(which, &b);
    e.release(a);
    CHECK_THROWS_AS(e.release(a), sac::UsageError);
    CHECK(Counted::alive == 2);
    e.undo_edits();
    e.propagate();
    CHECK(Counted::alive == 2);
    CHECK(e.get(out) == 4);
    e.set(which, &b);
    e.release(a);
    e.propagate();
    CHECK(Counted::alive == 1);
    CHECK(e.get(out) == 7);
    e.check_invariants();
    Counted outside;
    CHECK_THROWS_AS(e.release(outside), sac::UsageError);
    CHECK_THROWS_AS(e.set(outside.text, "x"), sac::UsageError);
  }
  CHECK(Counted::alive == 0);
}

TEST_CASE("a cell that the program writes is no input, one that nobody writes becomes one") {
  Engine e;
  const auto which = e.input<Counted*>(nullptr);
  const auto out = e.cell<std::size_t>();
  e.name(out, "length");
  e.run<length_of>(which, out);
  CHECK_THROWS_WITH(e.set(out, 3u),
                    Catch::Contains("'length'") && Catch::Contains("length(null, @"));
  const auto fresh = e.cell<int>();
  CHECK_THROWS_AS(e.get(fresh), sac::UsageError);
  e.set(fresh, 4);
  CHECK(e.get(fresh) == 4);
  e.undo_edits();
  CHECK_THROWS_AS(e.get(fresh), sac::UsageError);
}

// --- Results ---------------------------------------------------------------------------------

using Row = std::vector<Mod<int>>;

int runs_of_sum = 0;

int sum(Scope& s, const Row* row, int from, int to) {
  ++runs_of_sum;
  if (to - from == 1) return s.read((*row)[static_cast<std::size_t>(from)]);
  const int middle = (from + to) / 2;
  return s.call<sum>(row, from, middle) + s.call<sum>(row, middle, to);
}

void store_sum(Scope& s, const Row* row, Mod<int> out) {
  s.write(out, s.call<sum>(row, 0, static_cast<int>(row->size())));
}

TEST_CASE("a caller runs again when a result changes, and only then") {
  Engine e;
  Row row;
  for (int i = 0; i < 64; ++i) row.push_back(e.input(i));
  const auto out = e.cell<int>();
  const Row* all = &row;
  e.run<store_sum>(all, out);
  CHECK(e.get(out) == 63 * 64 / 2);
  runs_of_sum = 0;
  e.set(row[10], 11);
  e.set(row[11], 10);
  e.propagate();
  CHECK(runs_of_sum == 3);  // two leaves and the call above them, whose sum is what it was
  e.set(row[10], 1011);
  CHECK(e.propagate().executed == 8);  // the path to the root, and the writer
  CHECK(e.get(out) == 63 * 64 / 2 + 1000);
  e.check_invariants();
}

struct Rounded {
  struct Same {
    bool operator()(int a, int b) const { return a / 10 == b / 10; }
  };
  int operator()(Scope& s, Mod<int> in) const { return s.read(in); }
};
inline constexpr Rounded rounded{};

void store_rounded(Scope& s, Mod<int> in, Mod<int> out) { s.write(out, s.call<rounded>(in)); }

TEST_CASE("the client chooses when results and values are the same") {
  Engine e;
  const auto in = e.input(12);
  const auto out = e.cell<int>();
  e.run<store_rounded>(in, out);
  e.set(in, 17);
  CHECK(e.propagate().executed == 1);
  CHECK(e.get(out) == 12);
  e.set(in, 21);
  CHECK(e.propagate().executed == 2);
  CHECK(e.get(out) == 21);

  struct Never {
    bool operator()(int, int) const { return false; }
  };
  const auto pulse = e.input<int, Never>(1);
  e.set(pulse, 1);
  CHECK(e.get(pulse) == 1);
  const auto coarse = e.input<int, Rounded::Same>(11);
  e.set(coarse, 19);
  CHECK(e.get(coarse) == 11);
}

// A result moves to a new caller with the call that it belongs to.
int value_of(Scope& s, Mod<int> in) { return s.read(in); }
void one_way(Scope& s, Mod<int> in, Mod<int> out) { s.write(out, s.call<value_of>(in)); }
void other_way(Scope& s, Mod<int> in, Mod<int> out) { s.write(out, -s.call<value_of>(in)); }
void choose(Scope& s, Mod<bool> which, Mod<int> in, Mod<int> out) {
  s.read(which) ? s.call<one_way>(in, out) : s.call<other_way>(in, out);
}

TEST_CASE("a result is a dependence of the call that asked last") {
  Engine e;
  const auto which = e.input(true);
  const auto in = e.input(5);
  const auto out = e.cell<int>();
  e.run<choose>(which, in, out);
  e.set(which, false);
  e.propagate();
  CHECK(e.get(out) == -5);
  e.set(in, 6);
  e.propagate();
  CHECK(e.get(out) == -6);
  e.set(which, true);
  e.set(in, 7);
  e.propagate();
  CHECK(e.get(out) == 7);
  e.check_invariants();
}

// --- What is told ----------------------------------------------------------------------------

TEST_CASE("memory is reported in all and by function") {
  ListMap list(1000);
  const auto profile = list.e.profile();
  REQUIRE(profile.size() == 2);
  CHECK(profile[0].name == "twice");
  CHECK(profile[0].calls == 1000);
  CHECK(profile[0].edges == 2000);
  CHECK(profile[0].edge_bytes == 1000 * (24 + 16));
  if (!sac::kChecked) CHECK(profile[0].bytes == 1000 * (32 + 8 + 8 + 24));
  const auto m = list.e.memory();
  CHECK(m.live() <= m.held());
  CHECK(m.live() == list.e.bytes());
}

TEST_CASE("shrink gives memory back and leaves the trace as it is") {
  ListMap list(100'000);
  list.e.set(list.nodes[9]->next, nullptr);
  list.e.propagate();
  const auto before = list.e.memory();
  list.e.shrink();
  CHECK(list.e.memory().held() < before.held() / 2);
  CHECK(list.e.memory().calls_and_edges_live == before.calls_and_edges_live);
  list.e.check_invariants();
  CHECK(list.values().size() == 10);
  list.e.set(list.nodes[9]->next, list.nodes[10]);
  list.e.propagate();
  CHECK(list.values().size() == 100'000);
  list.e.check_invariants();
}

TEST_CASE("progress is told, and may cancel a run or a propagation, which takes all back") {
  ListMap list(10'000);
  std::uint64_t told = 0;
  bool go_on = true;
  list.e.set_progress(
      [&](const sac::Progress& p) {
        CHECK(p.executed == told * 100);
        ++told;
        return go_on || told < 50;
      },
      100);
  list.e.set(list.nodes[0]->next, nullptr);
  list.e.propagate();
  CHECK(told == 1);
  told = 0;
  go_on = false;
  list.e.set(list.nodes[0]->next, list.nodes[1]);
  CHECK_THROWS_AS(list.e.propagate(), sac::Cancelled);
  CHECK(told == 50);
  CHECK(list.values().size() == 1);
  list.e.check_invariants();
  told = 0;
  const auto out = list.e.cell<const Node*>();
  list.e.set(list.nodes[0]->next, list.nodes[1]);
  go_on = true;
  list.e.propagate();
  told = 0;
  go_on = false;
  CHECK_THROWS_AS((list.e.run<twice_list>(list.head, out)), sac::Cancelled);
  list.e.check_invariants();
  CHECK(list.values().size() == 10'000);
  list.e.set_progress(nullptr);
  list.e.run<twice_list>(list.head, out);
  list.e.check_invariants();
}

TEST_CASE("a scope that is used when nothing runs says so") {
  Engine e;
  const auto in = e.input(1);
  const auto out = e.cell<int>();
  Scope late(e.core());
  CHECK_THROWS_AS(late.read(in), sac::UsageError);
  CHECK_THROWS_AS(late.write(out, 1), sac::UsageError);
  CHECK_THROWS_AS((late.call<value_of>(in)), sac::UsageError);
  CHECK_THROWS_AS((late.tail<one_way>(in, out)), sac::UsageError);
  e.check_invariants();
}

// --- Arguments are kept as what the function takes ---------------------------------------------

void keep_text(Scope& s, const std::string& text, Mod<std::size_t> out) {
  s.write(out, text.size());
}
struct KeepLong {
  void operator()(Scope& s, long x, Mod<long> out) const { s.write(out, x); }
};
inline constexpr KeepLong keep_long{};
void write_out_in_two_ways(Scope& s, Mod<int> in, Mod<std::size_t> size, Mod<long> number) {
  const std::string name = "temporary" + std::to_string(s.read(in));
  s.call<keep_text>(name.c_str(), size);  // a copy
  s.call<keep_long>(s.read(in) % 2, number);
}

TEST_CASE("an argument is converted to what the function takes, and copied") {
  Engine e;
  const auto in = e.input(7);
  const auto size = e.cell<std::size_t>();
  const auto number = e.cell<long>();
  e.run<write_out_in_two_ways>(in, size, number);
  CHECK(e.get(size) == 10);
  e.set(in, 15);
  e.propagate();
  CHECK(e.get(size) == 11);
  e.set(in, 17);
  e.propagate();
  CHECK(e.get(size) == 11);
  CHECK(e.get(number) == 1);
  std::set<std::string> labels;
  e.walk([&](const sac::Call& c, std::size_t) { labels.insert(Engine::describe(c)); });
  CHECK(labels.count("keep_text(temporary17, @" + std::to_string(size.head().handle()) + ")") == 1);
  CHECK((sac::detail::Called<keep_long, long, Mod<long>>::function.frame_bytes) > 0);
}

struct Printed {
  int number;
  friend std::ostream& operator<<(std::ostream& out, const Printed* p) {
    return out << 'P' << p->number;
  }
};

TEST_CASE("pointers print as handles in the engine's memory, unless they print themselves") {
  Engine e;
  const int& inside = e.make<int>();
  const int outside = 3;
  const Printed printed{4};
  const unsigned char text[] = "abc";
  const auto print = [&](const auto& value) {
    std::ostringstream out;
    sac::print_argument(out, value, &inside);
    return out.str();
  };
  CHECK(print(&inside) == "@" + std::to_string(e.arena().handle_of(&inside)));
  CHECK_THAT(print(&outside), Catch::StartsWith("0x"));
  CHECK(print(static_cast<const int*>(nullptr)) == "null");
  CHECK(print(&printed) == "P4");
  CHECK(print(static_cast<const unsigned char*>(text)) == "abc");
}

}  // namespace
