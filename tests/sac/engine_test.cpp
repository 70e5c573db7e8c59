// Calls: direct style, reuse, discarding, tail calls, keyed allocation, roll-back, re-entry.
#include <catch2/catch.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "sac/sac.hpp"

namespace {

using Catch::Contains;
using sac::Engine;
using sac::Mod;
using sac::Scope;

void add(Scope& s, Mod<int> a, Mod<int> b, Mod<int> out) { s.write(out, s.read(a) + s.read(b)); }

TEST_CASE("the example of the design: an edit re-executes exactly one call") {
  Engine e;
  auto a = e.input(3), b = e.input(4);
  auto sum = e.cell<int>();
  e.run<add>(a, b, sum);
  CHECK(e.get(sum) == 7);
  e.set(a, 10);
  const auto counts = e.propagate();
  CHECK(e.get(sum) == 14);
  CHECK(counts.executed == 1);
  CHECK(counts.created == 0);
  CHECK(counts.discarded == 0);
  CHECK(counts.edges_made == 0);
  e.check_invariants();
}

TEST_CASE("setting an input to its value re-executes nothing") {
  Engine e;
  auto a = e.input(3), b = e.input(4);
  auto sum = e.cell<int>();
  e.run<add>(a, b, sum);
  e.set(a, 3);
  CHECK(e.propagate().executed == 0);
}

TEST_CASE("a write of an equal value stops the propagation") {
  Engine e;
  auto a = e.input(3), b = e.input(4);
  auto sum = e.cell<int>(), twice = e.cell<int>();
  e.run<add>(a, b, sum);
  e.run<add>(sum, sum, twice);
  e.set(a, 4);
  e.set(b, 3);
  CHECK(e.propagate().executed == 1);
  CHECK(e.get(twice) == 14);
}

// --- Reuse -----------------------------------------------------------------------------------

void leaf(Scope& s, Mod<int> in, Mod<int> out, int k) { s.write(out, s.read(in) + k); }
void inner(Scope& s, Mod<int> in, Mod<int> out, int k) {
  auto mid = s.cell<int>(std::string("mid"), k);
  s.call<leaf>(in, mid, k);
  s.call<leaf>(mid, out, k);
}
void choose(Scope& s, Mod<int> which, Mod<int> in, Mod<int> out) {
  const int w = s.read(which);
  auto a = s.cell<int>(std::string("a"));
  auto b = s.cell<int>(std::string("b"));
  if (w != 1) s.call<inner>(in, a, 1);
  s.call<inner>(in, b, 2);
  s.write(out, w);
}

TEST_CASE("a call with an equal label is reused with its whole subtree, what is passed over goes") {
  Engine e;
  auto which = e.input(0), in = e.input(5);
  auto out = e.cell<int>();
  e.run<choose>(which, in, out);
  const auto calls = e.live_calls();
  CHECK(calls == 1 + 2 + 2 * 4);
  e.set(which, 1);
  auto counts = e.propagate();
  CHECK(counts.executed == 1);
  CHECK(counts.reused == 3);
  CHECK(counts.discarded == 4);
  CHECK(e.live_calls() == calls - 4);
  e.check_invariants();
  e.set(which, 2);
  counts = e.propagate();
  CHECK(counts.created == 4);
  CHECK(counts.executed == 4);  // and a cell, which has no body
  CHECK(e.live_calls() == calls);
  e.check_invariants();
}

struct Wrap {
  template <class S>
  void operator()(S& s, Mod<int> in, Mod<int> out) const {
    s.template call<leaf>(in, out, 7);
  }
};
inline constexpr Wrap wrap{};

void wrap_sometimes(Scope& s, Mod<int> how, Mod<int> in, Mod<int> out) {
  if (s.read(how) == 0) {
    s.call<leaf>(in, out, 7);
  } else {
    s.call<wrap>(in, out);
  }
}

TEST_CASE("a call is reused inside a fresh call, and out of a discarded one") {
  Engine e;
  auto how = e.input(0), in = e.input(1);
  auto out = e.cell<int>();
  e.run<wrap_sometimes>(how, in, out);
  e.set(how, 1);
  auto counts = e.propagate();
  CHECK(counts.created == 1);
  CHECK(counts.reused == 1);
  CHECK(counts.executed == 2);
  e.check_invariants();
  e.set(how, 0);
  counts = e.propagate();
  CHECK(counts.discarded == 1);
  CHECK(counts.reused == 1);
  e.set(in, 2);
  CHECK(e.propagate().executed == 1);
  CHECK(e.get(out) == 9);
  e.check_invariants();
}

void grow(Scope& s, Mod<int> n, Mod<int> in, Mod<int> sum) {
  const int count = s.read(n);
  for (int i = 0; i < count; ++i) s.call<leaf>(in, s.cell<int>(i), i);
  s.write(sum, count);
}

TEST_CASE("a leaf that gains children on re-execution keeps its place, as does its sibling") {
  Engine e;
  auto n = e.input(0), in = e.input(1);
  auto first = e.cell<int>(), second = e.cell<int>();
  e.run<grow>(n, in, first);
  e.run<add>(first, in, second);
  for (const int count : {3, 0, 5, 1, 0, 2}) {
    e.set(n, count);
    e.propagate();
    CHECK(e.live_calls() == static_cast<std::uint64_t>(2 + 2 * count));
    CHECK(e.get(second) == count + 1);
    e.check_invariants();
  }
}

// A reused call that is itself out of date runs before what follows it.
void copy(Scope& s, Mod<int> in, Mod<int> out) { s.write(out, s.read(in)); }
void expect_equal(Scope& s, Mod<int> a, Mod<int> b, int version) {
  if (s.read(a) != s.read(b)) throw std::runtime_error("stale " + std::to_string(version));
}
void copy_then_check(Scope& s, Mod<int> in) {
  auto out = s.cell<int>(std::string("copy"));
  s.call<copy>(in, out);
  s.call<expect_equal>(in, out, s.read(in));
}

TEST_CASE("what precedes a running call is settled, also in a subtree reused just before") {
  Engine e;
  auto in = e.input(1);
  e.run<copy_then_check>(in);
  e.set(in, 2);
  CHECK(e.propagate().executed == 3);
  e.check_invariants();
}

// --- Tail calls ------------------------------------------------------------------------------

void count_down(Scope& s, Mod<int> in, int n) {
  if (n == 0) return;
  s.tail<count_down>(in, n - 1);
}
void start(Scope& s, Mod<int> n) { s.call<count_down>(n, s.read(n)); }

TEST_CASE("a million tail calls do not recurse on the native stack") {
  Engine e;
  auto n = e.input(1'000'000);
  e.run<start>(n);
  CHECK(e.live_calls() == 1'000'002);
  e.set(n, 1'000'010);
  auto counts = e.propagate();
  CHECK(counts.created == 10);
  CHECK(counts.discarded == 0);
  e.set(n, 3);
  counts = e.propagate();
  CHECK(counts.created == 0);
  CHECK(counts.reused == 1);
  CHECK(e.live_calls() == 5);
  e.check_invariants();
}

void link(Scope& s, Mod<int> how, Mod<int> total, int n) {
  if (n == 0) return;
  s.call<leaf>(how, s.cell<int>(n), n);
  s.tail<link>(how, total, n - 1);
}
void tail_or_call(Scope& s, Mod<int> how, Mod<int> total) {
  switch (s.read(how)) {
    case 0:
      return s.tail<link>(how, total, 3);
    case 1:
      s.call<link>(how, total, 3);
      return s.call<leaf>(how, total, 100);
    case 2:
      s.call<leaf>(how, total, 100);
      return s.tail<link>(how, total, 2);
    case 3:
      return s.call<link>(how, total, 1);
    default:
      return;
  }
}
void after(Scope& s, Mod<int> how, Mod<int> seen) { s.write(seen, s.read(how)); }

TEST_CASE("a tail call that becomes an ordinary call leaves room for its siblings") {
  for (int from = 0; from < 5; ++from) {
    for (int to = 0; to < 5; ++to) {
      Engine e;
      auto how = e.input(from);
      auto total = e.cell<int>(), seen = e.cell<int>();
      e.run<tail_or_call>(how, total);
      e.run<after>(how, seen);
      for (const int next : {to, from, to}) {
        e.set(how, next);
        e.propagate();
        e.check_invariants();
        CHECK(e.get(seen) == next);
        Engine fresh;
        auto how2 = fresh.input(next);
        auto total2 = fresh.cell<int>(), seen2 = fresh.cell<int>();
        fresh.run<tail_or_call>(how2, total2);
        fresh.run<after>(how2, seen2);
        CHECK(e.live_calls() == fresh.live_calls());
        std::vector<std::size_t> depths, fresh_depths;
        e.walk([&](const sac::Call&, std::size_t d) { depths.push_back(d); });
        fresh.walk([&](const sac::Call&, std::size_t d) { fresh_depths.push_back(d); });
        CHECK(depths.size() == fresh_depths.size());
        if (next == 1 || next == 2) CHECK(e.get(total) == fresh.get(total2));
      }
    }
  }
}

void call_after_tail(Scope& s, Mod<int> in) {
  s.tail<count_down>(in, 1);
  s.call<count_down>(in, 1);
}

TEST_CASE("nothing can be called after a tail call") {
  Engine e;
  CHECK_THROWS_AS(e.run<call_after_tail>(e.input(1)), sac::UsageError);
  CHECK(e.live_calls() == 0);
  e.check_invariants();
}

// --- Keyed allocation and lists ----------------------------------------------------------------

struct List;
using Link = Mod<const List*>;
struct List {
  int value;
  Link next;
};

struct MapCell {
  int value = 0;
  int unused = 0;
};

void map(Scope& s, Link in, Mod<MapCell*> out) {
  const List* cell = s.read(in);
  if (cell == nullptr) return s.write<MapCell*>(out, nullptr);
  auto& mine = s.make<MapCell>(cell);
  mine.value = cell->value * 10;
  s.write(out, &mine);
  s.tail<map>(cell->next, s.cell<MapCell*>(cell));
}

TEST_CASE(
    "an insertion into a mapped list costs one call re-executed, one new, and what it makes") {
  Engine e;
  std::vector<std::unique_ptr<List>> cells;
  Link head = e.input<const List*>(nullptr);
  Link end = head;
  for (int i = 0; i < 50; ++i) {
    cells.push_back(std::make_unique<List>(List{i, e.input<const List*>(nullptr)}));
    e.set<const List*>(end, cells.back().get());
    end = cells.back()->next;
  }
  e.propagate();
  auto out = e.cell<MapCell*>();
  e.run<map>(head, out);
  const auto calls = e.live_calls();
  MapCell* first = e.get(out);
  const Link place = cells[20]->next;
  cells.push_back(std::make_unique<List>(List{77, e.input<const List*>(e.get(place))}));
  e.set<const List*>(place, cells.back().get());
  auto counts = e.propagate();
  CHECK(counts.created == 1 + 2);  // a map, with the object and the cell that it makes
  CHECK(counts.executed == 2);
  CHECK(e.live_calls() == calls + 3);
  CHECK(e.get(out) == first);
  e.check_invariants();
  e.set<const List*>(place, cells[21].get());
  counts = e.propagate();
  CHECK(e.live_calls() == calls);
  e.check_invariants();
}

void make_numbers(Scope& s, Mod<int> order, Mod<std::vector<int*>> out) {
  std::vector<int*> all;
  const int skip = s.read(order);
  for (int i = 0; i < 5; ++i) {
    if (i != skip) all.push_back(&s.make<int>(i));
  }
  s.write(out, all);
}

TEST_CASE("make gives back the same object under reuse, at the same address") {
  Engine e;
  auto order = e.input(-1);
  auto out = e.cell<std::vector<int*>>();
  e.run<make_numbers>(order, out);
  const auto before = e.get(out);
  for (int i = 0; i < 5; ++i) *before[i] = i;
  e.set(order, 2);
  e.propagate();
  const auto now = e.get(out);
  CHECK(now == std::vector<int*>{before[0], before[1], before[3], before[4]});
  CHECK(*now[2] == 3);
}

void fill(Scope& s, Mod<std::string> cell, Mod<int> in) {
  s.write(cell, std::string(40, static_cast<char>('a' + s.read(in))));
}
void make_and_fill(Scope& s, Mod<int> in) { s.call<fill>(s.cell<std::string>(1), in); }

TEST_CASE(
    "a value in a cell that another call wrote is destroyed once, with the engine or before") {
  Engine e;
  auto in = e.input(0);
  e.run<make_and_fill>(in);
  e.set(in, 1);
  e.propagate();
}

void takes_text(Scope&, std::string) {}
void posts_text(Scope& s, sac::Agenda* agenda, Mod<int> in) {
  agenda->post<takes_text>(s, {}, std::string(static_cast<std::size_t>(40 + s.read(in)), 'x'));
}

TEST_CASE("arguments of calls that are never drained are destroyed with the engine") {
  Engine e;
  auto& agenda = e.make_agenda("never");
  e.run<posts_text>(&agenda, e.input(1));
  CHECK(e.live_calls() == 2);
}

// --- Failures ----------------------------------------------------------------------------------

void fail_if(Scope& s, Mod<int> in, Mod<int> out) {
  const int v = s.read(in);
  s.write(out, v);
  if (v < 0) throw std::runtime_error("negative");
}
void sum_checked(Scope& s, Mod<int> a, Mod<int> b, Mod<int> out) {
  auto x = s.cell<int>(std::string("x"));
  auto y = s.cell<int>(std::string("y"));
  s.call<fail_if>(a, x);
  s.call<fail_if>(b, y);
  s.call<add>(x, y, out);
}

TEST_CASE("if client code throws in propagate, values, trace and edits are as before") {
  Engine e;
  auto a = e.input(1), b = e.input(2);
  auto out = e.cell<int>();
  e.run<sum_checked>(a, b, out);
  const auto calls = e.live_calls();
  const auto edges = e.live_edges();
  e.set(a, 5);
  e.set(b, -1);
  CHECK_THROWS_WITH(e.propagate(), "negative");
  e.check_invariants();
  CHECK(e.get(out) == 3);
  CHECK(e.get(a) == 1);
  CHECK(e.get(b) == 2);
  CHECK(e.live_calls() == calls);
  CHECK(e.live_edges() == edges);
  CHECK(e.propagate().executed == 0);
  e.set(a, 6);
  CHECK(e.propagate().executed == 2);
  CHECK(e.get(out) == 8);
}

TEST_CASE("a first run that throws leaves nothing, and the engine can be used") {
  Engine e;
  auto a = e.input(1), b = e.input(-2);
  auto out = e.cell<int>();
  CHECK_THROWS_WITH(e.run<sum_checked>(a, b, out), "negative");
  CHECK(e.live_calls() == 0);
  CHECK(e.live_edges() == 0);
  CHECK_THROWS_AS(e.get(out), sac::UsageError);
  e.check_invariants();
  e.set(b, 2);
  e.propagate();
  e.run<sum_checked>(a, b, out);
  CHECK(e.get(out) == 3);
}

void always_fails(Scope& s, Mod<int> in) {
  static int runs = 0;
  s.read(in);
  if (++runs > 1) throw std::runtime_error("always");
}

TEST_CASE("a broken engine refuses to run, to propagate and to be edited") {
  Engine e;
  auto in = e.input(1);
  e.run<always_fails>(in);
  e.set(in, 2);
  CHECK_THROWS_WITH(e.propagate(), "always");
  CHECK_THROWS_WITH(e.propagate(), Contains("broken"));
  CHECK_THROWS_WITH(e.set(in, 3), Contains("broken"));
  CHECK_THROWS_WITH(e.run<always_fails>(in), Contains("broken"));
}

void reenter(Scope& s, Mod<int> in) {
  const int how = s.read(in);
  if (how == 1) s.engine().propagate();
  if (how == 2) s.engine().run<reenter>(in);
  if (how == 3) s.engine().set(in, 9);
  if (how == 4) s.engine().undo_edits();
}

TEST_CASE("a running engine refuses to be entered again") {
  for (const int how : {1, 2, 3, 4}) {
    Engine e;
    auto in = e.input(how);
    CHECK_THROWS_WITH(e.run<reenter>(in), Contains("running"));
    auto later = e.input(0);
    e.run<reenter>(later);
    e.set(later, how);
    CHECK_THROWS_WITH(e.propagate(), Contains("running"));
    CHECK(e.get(later) == 0);
    e.check_invariants();
  }
}

TEST_CASE("undo_edits takes the edits back, newest first") {
  Engine e;
  auto a = e.input(1), b = e.input(2);
  auto out = e.cell<int>();
  e.run<add>(a, b, out);
  e.set(a, 5);
  e.set(a, 6);
  e.undo_edits();
  CHECK(e.get(a) == 1);
  e.propagate();
  CHECK(e.get(out) == 3);
}

TEST_CASE("edits made together are made all or none, and earlier ones stay") {
  sac::Engine e;
  const auto a = e.input(1), b = e.input(2);
  e.set(a, 10);
  const auto fail = [&] {
    e.edit_together([&] {
      e.set(a, 11);
      e.edit_together([&] { e.set(b, 20); });
      e.release(b);
      throw std::runtime_error("no");
    });
  };
  CHECK_THROWS_AS(fail(), std::runtime_error);
  CHECK(e.get(a) == 10);
  CHECK(e.get(b) == 2);
  e.edit_together([&] { e.set(b, 21); });
  CHECK(e.get(b) == 21);
  e.undo_edits();
  CHECK(e.get(a) == 1);
  CHECK(e.get(b) == 2);
}

struct Throwing {
  int id = 0;
  inline static int copies_left = -1;
  Throwing(int i) : id(i) {}
  Throwing(const Throwing& o) : id(o.id) {
    if (copies_left >= 0 && copies_left-- == 0) throw std::bad_alloc();
  }
  friend bool operator==(const Throwing& a, const Throwing& b) { return a.id == b.id; }
  friend std::uint64_t hash_value(const Throwing& t) { return static_cast<std::uint64_t>(t.id); }
};
void take_it(Scope& s, Throwing t, Mod<int> out) { s.write(out, t.id); }
void take_them(Scope& s, Mod<int> in, Mod<int> out) {
  const int v = s.read(in);
  s.call<take_it>(Throwing(v), s.cell<int>(v));
  s.tail<take_it>(Throwing(v + 1), out);
}

TEST_CASE("arguments that throw when copied leave the engine as it was") {
  Engine e;
  auto in = e.input(1);
  auto out = e.cell<int>();
  e.run<take_them>(in, out);
  const auto calls = e.live_calls();
  for (int copies = 0; copies < 12; ++copies) {
    e.set(in, 10);
    Throwing::copies_left = copies;
    bool thrown = false;
    try {
      e.propagate();
    } catch (const std::bad_alloc&) {
      thrown = true;
    }
    Throwing::copies_left = -1;
    e.check_invariants();
    CHECK(e.live_calls() == calls);
    CHECK(e.get(out) == (thrown ? 2 : 11));
    if (!thrown) {
      e.set(in, 1);
      e.propagate();
    }
  }
}

int runs_until_failure = 0;

void sees(Scope& s, Mod<int> m, Mod<int> out) {
  if (runs_until_failure > 0 && --runs_until_failure == 0) throw std::runtime_error("enough");
  s.write(out, s.read(m));
}
void pass_on(Scope& s, Mod<int> in, Mod<int> out) { s.write(out, s.read(in) + 1); }
// For 0 it writes m and calls nobody; else its calls see m as it was, and it goes on with a tail.
void write_or_call(Scope& s, Mod<int> in, Mod<int> m, Mod<int> first, Mod<int> second) {
  if (s.read(in) == 0) return s.write(m, 5);
  s.call<sees>(m, first);
  s.call<pass_on>(first, second);
  s.tail<pass_on>(second, s.cell<int>(0));
}
void write_and_go_on(Scope& s, Mod<int> in, Mod<int> m, Mod<int> first, Mod<int> second) {
  s.write(m, 1);
  s.call<write_or_call>(in, m, first, second);
}

TEST_CASE("calls behind one that fails between the links of a tail chain leave with the chain") {
  for (int runs = 1; runs < 4; ++runs) {
    Engine e;
    auto in = e.input(0);
    auto m = e.cell<int>(), first = e.cell<int>(), second = e.cell<int>();
    e.run<write_and_go_on>(in, m, first, second);
    e.set(in, 1);
    runs_until_failure = runs;
    try {
      e.propagate();
      CHECK(e.get(second) == 2);
    } catch (const std::runtime_error&) {
      CHECK(e.live_calls() == 2);
      CHECK(e.get(m) == 5);
    }
    runs_until_failure = 0;
    e.check_invariants();
  }
}

// --- Detectors -----------------------------------------------------------------------------------

void duplicate(Scope& s, Mod<int> in) {
  s.call<count_down>(in, 0);
  s.call<count_down>(in, 0);
}

TEST_CASE("the detector speaks of a program that is not concise") {
  Engine e;
  e.set_audit(true);
  e.run<duplicate>(e.input(1));
  CHECK(e.audit().duplicates == 1);
  CHECK_THAT(e.audit().first_duplicate, Contains("count_down"));
}

void swap_leaves(Scope& s, Mod<int> in, Mod<int> x, Mod<int> y) {
  const bool first = s.read(in) == 0;
  s.call<count_down>(first ? x : y, 0);
  s.call<count_down>(first ? y : x, 0);
}

TEST_CASE("the detector speaks of a program that is not monotone") {
  Engine e;
  e.set_audit(true);
  auto in = e.input(0);
  e.run<swap_leaves>(in, e.input(1), e.input(2));
  CHECK(e.audit().reordered == 0);
  e.set(in, 1);
  e.propagate();
  CHECK(e.audit().reordered == 1);
  CHECK(e.audit().duplicates == 0);
  CHECK_THAT(e.audit().first_reordered, Contains("count_down"));
  e.check_invariants();
}

TEST_CASE("walk visits calls in pre-order with their depths") {
  Engine e;
  auto in = e.input(1);
  e.run<copy_then_check>(in);
  std::string text;
  e.walk([&](const sac::Call& c, std::size_t depth) {
    text += std::to_string(depth) + std::string(c.function().name) + ' ';
  });
  CHECK(text == "0copy_then_check 1make Cell 1copy 1expect_equal ");
}

}  // namespace
