// Modifiables: single and many writes, what reads see, errors that name calls.
#include <catch2/catch.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "random.hpp"
#include "sac/sac.hpp"

namespace {

using Catch::Contains;
using sac::Engine;
using sac::Mod;
using sac::Scope;

// Writes `value` to `out` unless it is negative.
void maybe_write(Scope& s, Mod<int> value, Mod<int> out, int) {
  if (const int v = s.read(value); v >= 0) s.write(out, v);
}
void copy(Scope& s, Mod<int> from, Mod<int> to, int) { s.write(to, s.read(from)); }
void forward(Scope& s, Mod<int> from, Mod<int> to) { s.write(to, s.read(from)); }

TEST_CASE("reads between two writes move when a write appears, changes or goes") {
  Engine e;
  auto a = e.input(1), b = e.input(-1), c = e.input(3);
  auto m = e.cell<int>();
  std::vector<Mod<int>> seen;
  for (int i = 0; i < 3; ++i) seen.push_back(e.cell<int>());
  e.run<maybe_write>(a, m, 0);
  e.run<copy>(m, seen[0], 0);
  e.run<maybe_write>(b, m, 1);
  e.run<copy>(m, seen[1], 1);
  e.run<maybe_write>(c, m, 2);
  e.run<copy>(m, seen[2], 2);
  const auto values = [&] {
    return std::vector<int>{e.get(seen[0]), e.get(seen[1]), e.get(seen[2])};
  };
  CHECK(values() == std::vector<int>{1, 1, 3});
  e.set(b, 2);  // appears
  CHECK(e.propagate().executed == 2);
  CHECK(values() == std::vector<int>{1, 2, 3});
  e.check_invariants();
  e.set(a, 7);  // changes: the read behind b does not run again
  CHECK(e.propagate().executed == 2);
  CHECK(values() == std::vector<int>{7, 2, 3});
  e.set(b, -1);  // goes
  CHECK(e.propagate().executed == 2);
  CHECK(values() == std::vector<int>{7, 7, 3});
  e.set(c, -1);
  e.propagate();
  CHECK(values() == std::vector<int>{7, 7, 7});
  CHECK(e.get(m) == 7);
  e.check_invariants();
}

TEST_CASE("a write of the value that precedes it, appearing or going, disturbs no reader") {
  Engine e;
  auto a = e.input(1), b = e.input(-1);
  auto m = e.cell<int>(), seen = e.cell<int>();
  e.run<maybe_write>(a, m, 0);
  e.run<maybe_write>(b, m, 1);
  e.run<copy>(m, seen, 0);
  e.set(b, 1);
  CHECK(e.propagate().executed == 1);
  e.set(b, -1);
  CHECK(e.propagate().executed == 1);
  e.check_invariants();
  e.set(a, 4);
  e.propagate();
  CHECK(e.get(seen) == 4);
}

// Writes what it is told, if anything, and passes on what it then sees.
void step(Scope& s, Mod<int> value, Mod<int> among, Mod<int> seen) {
  if (const int v = s.read(value); v >= 0) s.write(among, v);
  s.write(seen, s.read(among));
}

TEST_CASE("writes come and go among many readers") {
  constexpr std::size_t kSteps = 600;
  support::Random random(7);
  Engine e;
  const auto among = e.cell<int>();
  std::vector<Mod<int>> values, seen;
  std::vector<int> value(kSteps, -1);
  value[0] = 0;
  for (std::size_t i = 0; i < kSteps; ++i) {
    values.push_back(e.input(value[i]));
    seen.push_back(e.cell<int>());
    e.run<step>(values[i], among, seen[i]);
  }
  const std::size_t least = e.memory().versions;
  for (int edit = 0; edit < 300; ++edit) {
    const bool late = edit % 10 < 7;  // with few readers behind
    const auto i = static_cast<std::size_t>(late ? 599 - random(20) : 1 + random(599));
    value[i] = value[i] >= 0 && random(2) == 0 ? -1 : random(3);
    e.set(values[i], value[i]);
    if (edit % 50 == 49) e.set(values[0], value[0] = random(3));
    e.propagate();
    e.check_invariants();
    int expected = 0;
    for (std::size_t k = 0; k < kSteps; ++k) {
      if (value[k] >= 0) expected = value[k];
      REQUIRE(e.get(seen[k]) == expected);
    }
    if (edit == 0) CHECK(e.memory().versions > least + kSteps * 4);  // the readers, in order
  }
}

void writer_of(Scope& s, Mod<int> in, Mod<int> out, int) { s.write(out, s.read(in) / 10); }
void through(Scope& s, Mod<int> in, Mod<int> out, Mod<int> last) {
  s.call<writer_of>(in, out, s.read(in));
  s.call<forward>(out, last);
}

TEST_CASE("another call that writes the same value in place of the first disturbs no reader") {
  Engine e;
  auto in = e.input(50);
  auto out = e.cell<int>(), last = e.cell<int>();
  e.run<through>(in, out, last);
  e.set(in, 51);
  const auto counts = e.propagate();
  CHECK(counts.executed == 2);
  CHECK(counts.reused == 1);
  CHECK(e.get(last) == 5);
  e.check_invariants();
}

TEST_CASE(
    "a write that appears before the first write of a modifiable is not seen behind that one") {
  Engine e;
  auto early = e.input(-1), late = e.input(5);
  auto m = e.cell<int>(), seen = e.cell<int>();
  e.run<maybe_write>(early, m, 0);
  e.run<maybe_write>(late, m, 1);
  e.run<copy>(m, seen, 0);
  e.set(early, 3);
  CHECK(e.propagate().executed == 1);
  CHECK(e.get(seen) == 5);
  e.check_invariants();
  e.set(late, -1);
  CHECK(e.propagate().executed == 2);
  CHECK(e.get(seen) == 3);
  e.check_invariants();
  e.set(late, 6);
  e.set(early, -1);
  e.propagate();
  CHECK(e.get(seen) == 6);
  e.check_invariants();
}

// --- A call and its own writes -----------------------------------------------------------------

void twice(Scope& s, Mod<int> in, Mod<int> m, Mod<int> out) {
  const int v = s.read(in);
  s.write(m, v);
  const int first = s.read(m);
  s.write(m, v + 1);
  s.write(out, 100 * first + s.read(m));
}

TEST_CASE("a call sees its own writes of this execution, the last one goes on") {
  Engine e;
  auto in = e.input(1);
  auto m = e.cell<int>(), out = e.cell<int>(), seen = e.cell<int>();
  e.run<twice>(in, m, out);
  e.run<copy>(m, seen, 0);
  CHECK(e.get(out) == 102);
  for (const int v : {2, 1, 5}) {
    e.set(in, v);
    CHECK(e.propagate().executed == 2);
    CHECK(e.get(out) == 100 * v + v + 1);
    CHECK(e.get(seen) == v + 1);
    e.check_invariants();
  }
}

void read_then_write(Scope& s, Mod<int> in, Mod<int> m, Mod<int> out) {
  s.write(out, s.read(m));
  if (const int v = s.read(in); v >= 0) s.write(m, v);
}

TEST_CASE("while a call runs again it does not see what it wrote last time") {
  Engine e;
  auto base = e.input(10), in = e.input(1);
  auto m = e.cell<int>(), out = e.cell<int>(), seen = e.cell<int>();
  e.run<copy>(base, m, 0);
  e.run<read_then_write>(in, m, out);
  e.run<copy>(m, seen, 1);
  for (const int v : {2, -1, 3, -1, -1, 4}) {
    e.set(in, v);
    const auto counts = e.propagate();
    CHECK(e.get(out) == 10);
    CHECK(e.get(seen) == (v >= 0 ? v : 10));
    CHECK(counts.executed <= 2);
    e.check_invariants();
  }
}

void write_then_maybe_read_first(Scope& s, Mod<int> in, Mod<int> m, Mod<int> out) {
  if (s.read(in) == 0) {
    s.write(m, 5);
    s.write(out, s.read(m));
  } else {
    s.write(out, s.read(m));
  }
}

TEST_CASE("a call that takes its own write back is not run again because of that") {
  Engine e;
  auto base = e.input(10), in = e.input(0);
  auto m = e.cell<int>(), out = e.cell<int>();
  e.run<copy>(base, m, 0);
  e.run<write_then_maybe_read_first>(in, m, out);
  e.set(in, 1);
  CHECK(e.propagate().executed == 1);
  CHECK(e.get(out) == 10);
  e.check_invariants();
}

void repeat(Scope& s, Mod<int> in, Mod<int> m) {
  s.read(in);
  s.write(m, 1);
}

TEST_CASE("repeating an effect confirms it: readers later in the trace do not run") {
  Engine e;
  auto in = e.input(0);
  auto m = e.cell<int>(), seen = e.cell<int>();
  e.run<repeat>(in, m);
  e.run<copy>(m, seen, 0);
  e.set(in, 1);
  const auto counts = e.propagate();
  CHECK(counts.executed == 1);
  CHECK(counts.edges_made == 0);
  CHECK(counts.edges_removed == 0);
}

TEST_CASE("a write invalidates later reads only") {
  Engine e;
  auto a = e.input(1), b = e.input(2);
  auto m = e.cell<int>(), before = e.cell<int>(), after = e.cell<int>();
  e.run<maybe_write>(a, m, 0);
  e.run<copy>(m, before, 0);
  e.run<maybe_write>(b, m, 1);
  e.run<copy>(m, after, 1);
  e.set(b, 9);
  CHECK(e.propagate().executed == 2);
  CHECK(e.get(before) == 1);
  CHECK(e.get(after) == 9);
}

// --- Errors --------------------------------------------------------------------------------------

TEST_CASE("reading a modifiable that nobody has written is an error that names the call") {
  Engine e;
  auto m = e.cell<int>(), out = e.cell<int>();
  CHECK_THROWS_WITH(e.run<copy>(m, out, 0), Contains("copy(") && Contains("nobody"));
  CHECK_THROWS_AS(e.get(m), sac::UsageError);
}

TEST_CASE("reading what only a later call writes is an error that names both") {
  Engine e;
  auto late = e.input(1);
  auto m = e.cell<int>(), out = e.cell<int>();
  auto early = e.input(1);
  e.run<maybe_write>(early, m, 0);
  e.run<copy>(m, out, 1);
  e.run<maybe_write>(late, m, 2);
  e.set(early, -1);
  CHECK_THROWS_WITH(e.propagate(), Contains("copy(") && Contains("maybe_write("));
  e.check_invariants();
  CHECK(e.get(out) == 1);
}

void read_after_child(Scope& s, Mod<int> in, Mod<int> m, Mod<int> out) {
  s.write(m, 0);
  s.call<copy>(in, m, 0);
  s.write(out, s.read(m));
}

TEST_CASE("a call reads what its own child has written") {
  Engine e;
  auto in = e.input(1);
  auto m = e.cell<int>(), out = e.cell<int>();
  e.run<read_after_child>(in, m, out);
  CHECK(e.get(out) == 1);
  e.set(in, 2);
  CHECK(e.propagate().executed == 2);
  CHECK(e.get(out) == 2);
  e.check_invariants();
}

void write_after_child(Scope& s, Mod<int> in, Mod<int> m, Mod<int> out) {
  s.write(m, s.read(in));
  s.call<copy>(m, out, 0);
  s.write(m, s.read(in) + 1);
}

TEST_CASE("a call changes what its own child has read, behind it") {
  Engine e;
  auto in = e.input(1);
  auto m = e.cell<int>(), out = e.cell<int>();
  e.run<write_after_child>(in, m, out);
  for (const int value : {5, 4}) {
    e.set(in, value);
    e.propagate();
    CHECK(e.get(out) == value);
    CHECK(e.get(m) == value + 1);
    e.check_invariants();
  }
}

TEST_CASE("the program cannot write an input, the outside cannot set what the program writes") {
  Engine e;
  auto in = e.input(1), other = e.input(2);
  CHECK_THROWS_WITH(e.run<copy>(in, other, 0), Contains("input"));
  auto m = e.cell<int>();
  e.run<copy>(in, m, 0);
  CHECK_THROWS_AS(e.set(m, 3), sac::UsageError);
}

TEST_CASE("values with memory of their own are moved, replaced and freed with their versions") {
  struct Put {
    void operator()(Scope& s, Mod<int> in, Mod<std::string> m, int) const {
      const int v = s.read(in);
      if (v >= 0) s.write(m, std::string(static_cast<std::size_t>(50 + v), 'x'));
    }
  };
  struct Measure {
    void operator()(Scope& s, Mod<std::string> m, Mod<int> out) const {
      s.write(out, static_cast<int>(s.read(m).size()));
    }
  };
  Engine e;
  auto a = e.input(-1), b = e.input(1), c = e.input(2);
  auto m = e.cell<std::string>();
  auto out = e.cell<int>();
  e.run<Put{}>(a, m, 0);
  e.run<Put{}>(b, m, 1);
  e.run<Measure{}>(m, out);
  e.run<Put{}>(c, m, 2);
  int expected = 51;
  CHECK(e.get(out) == expected);
  for (int step = 0; step < 30; ++step) {
    e.set(a, step % 3 == 0 ? step : -1);
    e.set(b, step % 3 == 0 && step % 2 == 0 ? -1 : step);
    e.set(c, step % 4 - 1);
    e.propagate();
    e.check_invariants();
    CHECK(e.get(out) == 50 + step);
  }
}

// --- Pointers to what is made and unmade -------------------------------------------------------

struct Box {
  sac::Cell<int> content;
};
using BoxMod = Mod<const Box*>;

void fill(Scope& s, Box& self, int value) { s.write(self.content, value); }
void point(Scope& s, BoxMod from, BoxMod to) { s.write(to, s.read(from)); }
void show(Scope& s, BoxMod box, Mod<int> out, int) {
  const Box* b = s.read(box);
  s.write(out, b != nullptr ? s.read(b->content) : -1);
}
void point_and_show(Scope& s, BoxMod from, BoxMod to, Mod<int> out, int kind) {
  s.call<point>(from, to);
  s.call<show>(to, out, kind);
}
void maybe_box(Scope& s, Mod<int> in, BoxMod a, BoxMod b, Mod<int> out) {
  const int v = s.read(in);
  if (v > 0) s.write(a, &s.make<Box, fill>(v));
  s.call<point_and_show>(a, b, out, v);
}
void no_box(Scope& s, Mod<int> in, BoxMod a, BoxMod b, Mod<int> out) {
  s.write(a, nullptr);
  s.call<maybe_box>(in, a, b, out);
}

TEST_CASE("a reused child of a child does not hand on what their caller does not write again") {
  Engine e;
  auto in = e.input(7);
  auto a = e.cell<const Box*>(), b = e.cell<const Box*>();
  auto out = e.cell<int>();
  e.run<no_box>(in, a, b, out);
  CHECK(e.get(out) == 7);
  for (const int v : {0, 5, 6, 0, 0, 7}) {
    e.set(in, v);
    e.propagate();
    CHECK(e.get(out) == (v > 0 ? v : -1));
    e.check_invariants();
  }
}

// --- What a running call has not repeated ------------------------------------------------------

struct Shared {
  Mod<int> in, x, y, z, out;
  std::vector<Mod<int>> outs;
  explicit Shared(Engine& e, int readers = 0)
      : in(e.input(1)), x(e.cell<int>()), y(e.cell<int>()), z(e.cell<int>()), out(e.cell<int>()) {
    for (int i = 0; i < readers; ++i) outs.push_back(e.cell<int>());
    e.set_environment(this);
  }
};

void y_to_z(Scope& s) {
  auto& shared = s.environment<Shared>();
  s.write(shared.z, s.read(shared.y));
}
void by_tail(Scope& s, int) { s.tail<y_to_z>(); }
void require_equal(Scope& s) {
  auto& shared = s.environment<Shared>();
  const int y = s.read(shared.y), z = s.read(shared.z);
  if (y != z) throw std::logic_error("y and z differ");
  s.write(shared.out, z);
}
void maybe_y(Scope& s) {
  auto& shared = s.environment<Shared>();
  const int v = s.read(shared.in);
  if (v != 0) s.write(shared.y, v);
  s.call<by_tail>(v);
  s.call<require_equal>();
}
void zero_y_first(Scope& s) {
  s.write(s.environment<Shared>().y, 0);
  s.call<maybe_y>();
}

TEST_CASE("a tail call that a new child reuses does not hand on what is not written again") {
  Engine e;
  Shared shared(e);
  e.run<zero_y_first>();
  for (const int v : {0, 1, 2, 0}) {
    e.set(shared.in, v);
    e.propagate();
    CHECK(e.get(shared.out) == v);
    e.check_invariants();
  }
}

void x_to_out(Scope& s) {
  auto& shared = s.environment<Shared>();
  s.write(shared.out, s.read(shared.x));
}
void if_y(Scope& s) {
  if (s.read(s.environment<Shared>().y) == 1) s.call<x_to_out>();
}
void y_to(Scope& s, int i) {
  auto& shared = s.environment<Shared>();
  s.write(shared.outs[static_cast<std::size_t>(i)], s.read(shared.y));
}
void maybe_x_and_y(Scope& s) {
  auto& shared = s.environment<Shared>();
  if (const int v = s.read(shared.in); v != 0) {
    s.write(shared.y, 1);
    s.write(shared.x, v);
  }
  s.call<if_y>();
  for (std::size_t i = 0; i < shared.outs.size(); ++i) s.call<y_to>(static_cast<int>(i));
}
void zero_y_before(Scope& s) {
  s.write(s.environment<Shared>().y, 0);
  s.call<maybe_x_and_y>();
}

TEST_CASE("what is not written again is hidden however many have read it") {
  for (const int readers : {0, 15, 16, 200}) {
    Engine e;
    Shared shared(e, readers);
    e.run<zero_y_before>();
    e.set(shared.in, 0);
    e.propagate();
    e.check_invariants();
    e.set(shared.in, 5);
    e.propagate();
    e.check_invariants();
    CHECK(e.get(shared.out) == 5);
  }
}

// While in is 1, y is 1, and a child says so once more.
void y_again(Scope& s) {
  auto& shared = s.environment<Shared>();
  s.write(shared.y, s.read(shared.in));
}
void maybe_y_twice(Scope& s) {
  auto& shared = s.environment<Shared>();
  const int v = s.read(shared.in);
  if (v == 1) {
    s.write(shared.y, 1);
    s.call<y_again>();
  }
  s.call<y_to_z>();
  if (v == 0) s.call<require_equal>();  // new, where y_to_z is not
}
void zero_y_before_twice(Scope& s) {
  s.write(s.environment<Shared>().y, 0);
  s.call<maybe_y_twice>();
}

TEST_CASE("what a child wrote again goes, and with it what its caller has not written again") {
  Engine e;
  Shared shared(e);
  e.run<zero_y_before_twice>();
  for (const int v : {0, 1, 0}) {
    e.set(shared.in, v);
    e.propagate();
    CHECK(e.get(shared.z) == v);
    e.check_invariants();
  }
}

}  // namespace
