// What the client is told of: watched modifiables, outputs as differences; names, environments.
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <memory>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "failing_new.hpp"
#include "random.hpp"
#include "sac/sac.hpp"

namespace {

void divide(sac::Scope& s, sac::Mod<int> a, sac::Mod<int> b, sac::Mod<int> out) {
  const int by = s.read(b);
  if (by < 0) throw std::runtime_error("by a negative number");
  if (by > 0) s.write(out, s.read(a) / by);
}

struct Division {
  sac::Engine e;
  sac::Mod<int> a = e.input(7), b = e.input(2), out = e.cell<int>();
  Division() { e.run<divide>(a, b, out); }
  void set(int x, int y) {
    e.set(a, x);
    e.set(b, y);
    e.propagate();
  }
};

TEST_CASE("the client is told which watched modifiables have another value") {
  Division d;
  d.e.watch(d.out);
  d.e.watch(d.b);
  CHECK_FALSE(d.e.changed(d.out));
  d.set(6, 2);
  CHECK_FALSE(d.e.changed(d.out));
  CHECK_FALSE(d.e.changed(d.b));
  d.set(9, 3);  // 3 again
  CHECK_FALSE(d.e.changed(d.out));
  CHECK(d.e.changed(d.b));
  d.set(9, 1);
  CHECK(d.e.changed(d.out));
  d.e.propagate();
  CHECK_FALSE(d.e.changed(d.out));
  d.set(9, 0);
  CHECK(d.e.changed(d.out));
  CHECK_FALSE(d.e.has_value(d.out));
  d.set(9, 9);
  CHECK(d.e.changed(d.out));
  CHECK(d.e.has_value(d.out));
  d.e.unwatch(d.out);
  d.set(9, 1);
  CHECK_FALSE(d.e.changed(d.out));
}

TEST_CASE("functions are called when a change has been made, not for one that fails") {
  Division d;
  std::vector<int> seen;
  d.e.on_change(d.out, [&](int x) { seen.push_back(x); });
  d.e.on_change(d.out, [&](int x) { seen.push_back(-x); });
  d.set(8, 2);
  CHECK(seen == std::vector{4, -4});
  d.e.set(d.b, -1);
  CHECK_THROWS(d.e.propagate());
  CHECK_FALSE(d.e.changed(d.out));
  d.set(9, 2);
  CHECK(seen == std::vector{4, -4});
  d.e.set(d.a, 2);
  d.e.undo_edits();
  d.e.propagate();
  CHECK(seen.size() == 2);
  d.set(9, 0);  // no value: nothing to call for
  CHECK(seen.size() == 2);
}

TEST_CASE("a function that is called may edit, propagate, and throw") {
  Division d;
  d.e.on_change(d.out, [&](int x) {
    if (x > 100) throw std::runtime_error("too much");
    if (x == 7) d.set(12, 2);
  });
  d.set(7, 1);
  CHECK(d.e.get(d.out) == 6);
  CHECK_THROWS_WITH(d.set(1000, 1), "too much");
  CHECK(d.e.get(d.out) == 1000);
  d.set(1, 1);
  CHECK(d.e.get(d.out) == 1);
}

TEST_CASE("functions may watch and unwatch while they are called") {
  Division d;
  std::string log;
  d.e.on_change(d.out, [&](int x) {
    log += "a" + std::to_string(x);
    for (int i = 0; i < 9; ++i) d.e.on_change(d.out, [&log](int y) { log += char('0' + y % 10); });
  });
  d.set(8, 2);
  CHECK(log == "a4");
  d.e.unwatch(d.out);
  d.e.unwatch(d.out);
  d.e.unwatch(sac::Mod<int>());
  d.e.on_change(d.out, [&](int) { d.e.unwatch(d.out); });
  d.e.on_change(d.out, [&](int) { log += '!'; });
  d.set(9, 1);
  CHECK(log == "a4");
  CHECK_FALSE(d.e.changed(d.out));
}

TEST_CASE(
    "a function that propagates keeps what it was given, and the others are told the newest") {
  Division d;
  std::vector<int> seen;
  d.e.on_change(d.out, [&](const int& x) {
    if (x == 1) d.set(2, 1);
    if (x == 4) d.set(2, 0);
    seen.push_back(x);
  });
  d.e.on_change(d.out, [&](int x) { seen.push_back(10 * x); });
  d.set(1, 1);
  CHECK(seen == std::vector{2, 20, 1});
  seen.clear();
  d.set(4, 1);
  CHECK(seen == std::vector{4});
  CHECK_FALSE(d.e.has_value(d.out));
}

TEST_CASE("whatever fails in finding out what has changed takes the change back") {
  std::uint64_t failures = 0;
  for (std::uint64_t count = 1;; ++count) {
    Division d;
    int told = 0;
    d.e.on_change(d.out, [&](int) { ++told; });
    d.e.watch(d.a);
    d.e.set(d.a, 100);
    bool burnt = false;
    const bool failed = support::fails(count, burnt, [&] { d.e.propagate(); });
    if (!failed && !burnt) break;
    ++failures;
    CHECK(d.e.get(d.out) == (failed ? 3 : 50));
    CHECK(d.e.changed(d.out) != failed);
    CHECK(d.e.changed(d.a) != failed);
    CHECK(told == (failed ? 0 : 1));
    d.e.check_invariants();
  }
  CHECK(failures > 2);
}

TEST_CASE("a modifiable is not watched while edits wait") {
  Division d;
  d.e.set(d.a, 4);
  CHECK_THROWS_WITH(d.e.watch(d.out), Catch::Contains("propagate the edits first"));
}

struct Held {
  sac::Cell<int> value;
};
void hold(sac::Scope& s, sac::Mod<bool> on, sac::Mod<const Held*> out) {
  if (!s.read(on)) return s.write(out, nullptr);
  Held& held = s.make<Held>();
  s.write(held.value, 3);
  s.write(out, &held);
}

TEST_CASE("a watched modifiable may go") {
  sac::Engine e;
  const auto on = e.input(true);
  const auto out = e.cell<const Held*>();
  e.run<hold>(on, out);
  int calls = 0;
  e.on_change(sac::Mod<int>(e.get(out)->value), [&](int) { ++calls; });
  const auto input = e.input(1);
  e.on_change(input, [&](int) { ++calls; });
  e.release(input);
  e.set(on, false);
  e.propagate();
  e.set(on, true);
  e.propagate();
  e.check_invariants();
  CHECK(calls <= 1);  // that its value was taken away, if at all
  CHECK(e.get(e.get(out)->value) == 3);
}

TEST_CASE("modifiables of an array have names with their indices") {
  sac::Engine e;
  std::vector<sac::Mod<int>> hops{e.cell<int>(), e.cell<int>()};
  e.name(hops, "hops");
  CHECK_THROWS_WITH(e.get(hops[1]), Catch::Contains("'hops[1]'"));
}

struct World {
  int x = 3;
};
void ask_world(sac::Scope& s, sac::Mod<int> out) { s.write(out, s.environment<const World>().x); }
void ask_int(sac::Scope& s, sac::Mod<int> out) { s.write(out, s.environment<int>()); }

TEST_CASE("an environment is asked for by its type") {
  sac::Engine e;
  World world;
  const auto out = e.cell<int>(), out2 = e.cell<int>();
  CHECK_THROWS_WITH(e.run<ask_world>(out), Catch::Contains("there is no environment"));
  e.set_environment(&world);
  e.run<ask_world>(out);
  CHECK(e.get(out) == 3);
  CHECK_THROWS_WITH(e.run<ask_int>(out),
                    Catch::Contains("the environment is of type") && Catch::Contains("not int"));
  sac::PlainScope plain;
  plain.set_environment(&world);
  CHECK_THROWS_AS(plain.environment<int>(), sac::UsageError);
  CHECK(plain.environment<World>().x == 3);
  const World fixed;
  e.set_environment(&fixed);
  e.run<ask_world>(out2);
  CHECK(e.get(out2) == 3);
  World* none = nullptr;
  e.set_environment(none);
  plain.set_environment(none);
  CHECK_THROWS_WITH(e.run<ask_world>(e.cell<int>()), Catch::Contains("there is no environment"));
  CHECK_THROWS_AS(plain.environment<World>(), sac::UsageError);
}

// --- Outputs -----------------------------------------------------------------------------------

using Out = sac::Output<sac::Placed<int>>;

bool is_below(int x, int limit) { return x < limit; }
int scaled(sac::Scope&, int x, int by, int plus) { return x * by + plus; }

void show(sac::Scope& s, sac::List<int> in, sac::Mod<int> limit) {
  const auto below = sac::filter<is_below>(s, in, s.read(limit));
  sac::emit(s, sac::map<scaled>(s, below, 2, 1), s.environment<Out>());
}

// The values of the output in order, by their places.
std::vector<int> in_order(const std::vector<sac::Placed<int>>& placed) {
  std::vector<int> values;
  sac::ElementId last;
  for (std::size_t n = 0; n < placed.size(); ++n) {
    for (const auto& p : placed) {
      if (p.before != last) continue;
      values.push_back(p.value);
      last = p.id;
      break;
    }
  }
  return values;
}

TEST_CASE("a list is put out as differences") {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    CAPTURE(seed);
    support::Random random(seed);
    sac::Engine e;
    Out out(e);
    e.set_environment(&out);
    sac::Sequence<int> numbers(e, {5, 1, 8, 3});
    const auto limit = e.input(6);
    e.run<show>(numbers.list(), limit);
    CHECK(in_order(out.values()) == std::vector{11, 3, 7});
    std::multiset<sac::Placed<int>> mirror;
    for (const auto& p : out.added()) mirror.insert(p);
    for (int round = 0; round < 30; ++round) {
      for (int k = random(4); k > 0; --k) {
        switch (random(4)) {
          case 0:
            if (numbers.size() > 0) numbers.erase(numbers.first());
            break;
          case 1:
            e.set(limit, random(10));
            break;
          default:
            numbers.push_back(random(10));
        }
      }
      const bool undone = random(5) == 0;
      if (undone) {
        e.undo_edits();
      }
      e.propagate();
      for (const auto& p : out.removed()) {
        REQUIRE(mirror.contains(p));
        mirror.erase(mirror.find(p));
      }
      for (const auto& p : out.added()) mirror.insert(p);
      CHECK(std::vector(mirror.begin(), mirror.end()) == out.values());
      std::vector<int> expected;
      for (const auto& element : numbers.list().view(e)) {
        if (element.value() < e.get(limit)) expected.push_back(2 * element.value() + 1);
      }
      CHECK(in_order(out.values()) == expected);
      if (undone) CHECK(out.added().size() + out.removed().size() == 0);
      e.check_invariants();
    }
  }
}

void emit_double(sac::Scope& s, sac::Mod<double> in) {
  s.environment<sac::Output<double>>().emit(s, s.read(in));
}
void read_output(sac::Scope& s, sac::Mod<std::size_t> out) {
  s.write(out, s.environment<sac::Output<double>>().values().size());
}

TEST_CASE("an output tells 0.0 from -0.0, is not read by calls, and may end before the engine") {
  sac::Engine e;
  const auto in = e.input(0.0);
  { sac::Output<double> unused(e); }
  sac::Output<double> out(e);
  e.set_environment(&out);
  e.run<emit_double>(in);
  e.set(in, -0.0);
  e.propagate();
  REQUIRE(out.values().size() == 1);
  CHECK(std::signbit(out.values()[0]));
  CHECK((out.added().size() == 1 && out.removed().size() == 1));
  CHECK_THROWS_AS(e.run<read_output>(e.cell<std::size_t>()), sac::UsageError);
}

void emit_or_fail(sac::Scope& s, sac::Mod<int> in) {
  const int x = s.read(in);
  s.environment<sac::Output<int>>().emit(s, x);
  s.environment<sac::Output<int>>().emit(s, 1);
  s.environment<sac::Output<int>>().emit(s, 1);
  if (x == 0) throw std::runtime_error("zero");
}

TEST_CASE("an output is a multiset, and a change that fails changes nothing") {
  sac::Engine e;
  sac::Output<int> out(e);
  e.set_environment(&out);
  const auto in = e.input(1);
  e.run<emit_or_fail>(in);
  CHECK(out.values() == std::vector{1, 1, 1});
  e.set(in, 0);
  CHECK_THROWS(e.propagate());
  CHECK(out.values() == std::vector{1, 1, 1});
  CHECK(out.added().empty());
  CHECK(out.removed().empty());
  e.set(in, 2);
  e.propagate();
  CHECK(out.values() == std::vector{1, 1, 2});
  CHECK(out.added() == std::vector{2});
  CHECK(out.removed() == std::vector{1});
  e.propagate();
  CHECK(out.added().empty());
  CHECK(out.removed().empty());
  e.check_invariants();
}

}  // namespace
