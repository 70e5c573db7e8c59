// A call means what its text says: what it reads, writes and posts behind a child happens behind
// it.
#include <catch2/catch.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "counter.hpp"
#include "sac/sac.hpp"

namespace {

using Catch::Contains;
using sac::Engine;
using sac::Mod;
using sac::Scope;

std::vector<std::string> calls_of(const Engine& e) {
  std::vector<std::string> calls;
  e.walk([&](const sac::Call& c, std::size_t depth) {
    calls.push_back(std::string(depth, ' ') + Engine::describe(c));
  });
  return calls;
}

// --- Reads and writes between children ---------------------------------------------------------

// `steps` of 0: writes a; 1: a child writes b = a; 2: writes a = b + 1; read of a is the result.
struct Between {
  struct Copy {
    template <class S, class M>
    void operator()(S& s, M from, M to) const {
      s.write(to, s.read(from));
    }
  };
  static constexpr Copy copy{};
  template <class S, class M>
  void operator()(S& s, M in, M a, M b, M out) const {
    s.write(a, s.read(in));
    s.template call<copy>(a, b);
    s.write(a, s.read(b) + 1);
    s.template call<copy>(a, b);
    s.write(a, s.read(b) + s.read(a));
    s.template call<copy>(a, out);
  }
};
constexpr Between between{};

TEST_CASE("a modifiable written between children has a value for each of them") {
  Engine e;
  sac::PlainScope plain;
  const auto in = e.input(3), a = e.cell<int>(), b = e.cell<int>(), out = e.cell<int>();
  const auto p_in = plain.input(3), p_a = plain.cell<int>(), p_b = plain.cell<int>(),
             p_out = plain.cell<int>();
  e.run<between>(in, a, b, out);
  plain.run<between>(p_in, p_a, p_b, p_out);
  CHECK(e.get(out) == 8);
  CHECK(plain.get(p_out) == 8);
  for (const int value : {4, 4, -1, 10}) {
    e.set(in, value);
    e.propagate();
    e.check_invariants();
    CHECK(e.get(out) == 2 * (value + 1));
    CHECK(e.get(b) == value + 1);
  }
}

// D10: traced, the child's write used to stay.
struct WritesOne {
  template <class S, class M>
  void operator()(S& s, M x) const {
    s.write(x, 1);
  }
};
constexpr WritesOne writes_one{};
struct WritesTwoBehind {
  template <class S, class M>
  void operator()(S& s, M x) const {
    s.template call<writes_one>(x);
    s.write(x, 2);
  }
};
constexpr WritesTwoBehind writes_two_behind{};

TEST_CASE("a caller's write behind a child's is the last one") {
  Engine e;
  sac::PlainScope plain;
  const auto x = e.cell<int>();
  const auto y = plain.cell<int>();
  e.run<writes_two_behind>(x);
  plain.run<writes_two_behind>(y);
  CHECK(e.get(x) == 2);
  CHECK(plain.get(y) == 2);
}

// D2: a child used to be shown, for a while, what its caller had written behind it.
struct Shown {
  Mod<int> flag;
  std::vector<Mod<int>> x;
  int executed_with_1 = 0;
};
int fails_at_1(Scope& s, int i) {
  auto& env = s.environment<Shown>();
  if (s.read(env.flag) == 0) return 0;
  if (s.read(env.x[static_cast<std::size_t>(i)]) == 1) ++env.executed_with_1;
  return 5;
}
void writes_behind(Scope& s, int i) {
  if (s.call<fails_at_1>(i) == 0) {
    s.write(s.environment<Shown>().x[static_cast<std::size_t>(i)], 1);
  }
}
void many_write_behind(Scope& s, int n) {
  auto& env = s.environment<Shown>();
  for (int i = 0; i < n; ++i) s.write(env.x[static_cast<std::size_t>(i)], 0);
  for (int i = 0; i < n; ++i) s.call<writes_behind>(i);
}

TEST_CASE("a child never sees what its caller writes behind it") {
  constexpr int kCalls = 40;
  Engine e;
  Shown env{e.input(0), {}};
  for (int i = 0; i < kCalls; ++i) env.x.push_back(e.cell<int>());
  e.set_environment(&env);
  e.run<many_write_behind>(kCalls);
  for (const int flag : {1, 0, 1}) {
    e.set(env.flag, flag);
    e.propagate();
    e.check_invariants();
    for (const Mod<int> x : env.x) CHECK(e.get(x) == 1 - flag);
  }
  CHECK(env.executed_with_1 == 0);
}

// D1: the caller used to run again before the tail of what it had called.
struct Tailed {
  Mod<int> x;
  int inconsistent = 0;
};
int value_of_x(Scope& s) { return s.read(s.environment<Tailed>().x); }
void compare_with_x(Scope& s, int v) {
  if (s.call<value_of_x>() != v) ++s.environment<Tailed>().inconsistent;
}
int get_and_compare(Scope& s) {
  const int v = s.read(s.environment<Tailed>().x);
  s.tail<compare_with_x>(v);
  return v;
}
void call_get(Scope& s, Mod<int> out) { s.write(out, s.call<get_and_compare>()); }

TEST_CASE("who depends on a result runs behind the tail of the call that returned it") {
  Engine e;
  Tailed env{e.input(0)};
  e.set_environment(&env);
  const auto out = e.cell<int>();
  e.run<call_get>(out);
  for (const int x : {1, 2, 2, 0}) {
    e.set(env.x, x);
    e.propagate();
    e.check_invariants();
    CHECK(e.get(out) == x);
  }
  CHECK(env.inconsistent == 0);
}

// --- What an update costs ----------------------------------------------------------------------

void square(Scope& s, Mod<int> in, Mod<int> out) { s.write(out, s.read(in) * s.read(in)); }
// Uses what each child has written; the sum goes to `sum`.
void sum_of_squares(Scope& s, const std::vector<Mod<int>>* ins, const std::vector<Mod<int>>* outs,
                    Mod<int> sum) {
  int total = 0;
  for (std::size_t i = 0; i < ins->size(); ++i) {
    s.call<square>((*ins)[i], (*outs)[i]);
    total += s.read((*outs)[i]);
  }
  s.write(sum, total);
}

TEST_CASE("of a call that reads behind its children, an update runs it and the child once") {
  Engine e;
  std::vector<Mod<int>> ins, outs;
  for (int i = 0; i < 20; ++i) {
    ins.push_back(e.input(i));
    outs.push_back(e.cell<int>());
  }
  const auto sum = e.cell<int>();
  e.run<sum_of_squares>(&ins, &outs, sum);
  CHECK(e.get(sum) == 2470);
  e.set(ins[3], 5);
  e.set(ins[17], 1);
  const sac::Counts work = e.propagate();
  CHECK(e.get(sum) == 2470 - 9 + 25 - 289 + 1);
  CHECK(work.executed == 3 + 0);
  CHECK(work.edges_made <= 2);
  e.set(ins[4], -4);
  CHECK(e.propagate().executed == 1);  // the square is the same: its reader is not asked
  e.check_invariants();
}

// In doubt in its second segment only, and what lies between is in doubt as well.
void sign(Scope& s, Mod<int> in, Mod<int> out) { s.write(out, s.read(in) < 0 ? -1 : 1); }
void doubled(Scope& s, Mod<int> in, Mod<int> out) { s.write(out, 2 * s.read(in)); }
void sign_behind(Scope& s, Mod<int> in, Mod<int> sign_of, Mod<int> twice, Mod<int> out) {
  s.call<sign>(in, sign_of);
  const int first = s.read(sign_of);
  s.call<doubled>(sign_of, twice);
  s.write(out, first + s.read(twice));
}

TEST_CASE("a call in doubt is asked segment by segment, each when its turn comes") {
  Engine e;
  const auto in = e.input(1), sign_of = e.cell<int>(), twice = e.cell<int>(), out = e.cell<int>();
  e.run<sign_behind>(in, sign_of, twice, out);
  CHECK(e.get(out) == 3);
  e.set(in, 2);
  CHECK(e.propagate().executed == 1);
  e.set(in, -2);
  CHECK(e.propagate().executed == 3);  // each once
  CHECK(e.get(out) == -3);
  e.check_invariants();
}

// --- Children that come and go between what a call does ----------------------------------------

struct Coming {
  std::vector<Mod<int>> here;  // whether child i is called
  std::vector<Mod<int>> x;
  Mod<int> log;
};
void appends(Scope& s, int i) {
  auto& env = s.environment<Coming>();
  s.write(env.x[static_cast<std::size_t>(i)], i + s.read(env.log));
}
void comes_and_goes(Scope& s) {
  auto& env = s.environment<Coming>();
  s.write(env.log, 0);
  for (int i = 0; i < static_cast<int>(env.here.size()); ++i) {
    const bool here = s.read(env.here[static_cast<std::size_t>(i)]) != 0;
    if (here) s.call<appends>(i);
    if (here) s.write(env.log, s.read(env.log) + s.read(env.x[static_cast<std::size_t>(i)]));
  }
}

TEST_CASE("children that come and go between reads and writes leave the trace of a first run") {
  constexpr int kChildren = 6;
  Engine e;
  Coming env{{}, {}, e.cell<int>()};
  for (int i = 0; i < kChildren; ++i) {
    env.here.push_back(e.input(1));
    env.x.push_back(e.cell<int>());
  }
  e.set_environment(&env);
  e.run<comes_and_goes>();
  for (int step = 0; step < 1 << kChildren; ++step) {
    const int mask = (step * 37) % (1 << kChildren);
    Engine fresh;
    Coming other{{}, {}, fresh.cell<int>()};
    for (int i = 0; i < kChildren; ++i) {
      e.set(env.here[static_cast<std::size_t>(i)], mask >> i & 1);
      other.here.push_back(fresh.input(mask >> i & 1));
      other.x.push_back(fresh.cell<int>());
    }
    e.propagate();
    e.check_invariants();
    fresh.set_environment(&other);
    fresh.run<comes_and_goes>();
    CHECK(calls_of(e) == calls_of(fresh));
    CHECK(e.get(env.log) == fresh.get(other.log));
    CHECK(e.live_edges() == fresh.live_edges());
  }
  const auto all_states = [&] {  // their bytes
    std::vector<std::size_t> bytes;
    for (int mask = 0; mask < 1 << kChildren; ++mask) {
      for (int i = 0; i < kChildren; ++i) {
        e.set(env.here[static_cast<std::size_t>(i)], mask >> i & 1);
      }
      e.propagate();
      bytes.push_back(e.memory().calls_and_edges_live);
    }
    return bytes;
  };
  all_states();
  const auto bytes = all_states();
  CHECK(all_states() == bytes);
}

// --- Structures and agendas --------------------------------------------------------------------

struct Adding {
  support::Counter<>& counter;
  Mod<int> key;  // what the parent adds to behind its child
  Mod<int> child, parent;
};
void ask_for_1(Scope& s) {
  auto& a = s.environment<Adding>();
  s.write(a.child, a.counter.total(s, 1));
}
void add_behind_child(Scope& s) {
  auto& a = s.environment<Adding>();
  const int key = s.read(a.key);
  s.call<ask_for_1>();
  a.counter.add(s, key, 7);
  s.write(a.parent, a.counter.total(s, 1));
}

TEST_CASE("a user's structure keeps places: what is added behind a child is not there for it") {
  Engine e;
  support::Counter<> counter(e);
  Adding a{counter, e.input(1), e.cell<int>(), e.cell<int>()};
  e.set_environment(&a);
  e.run<add_behind_child>();
  for (const int key : {1, 2, 1}) {
    e.set(a.key, key);
    e.propagate();
    e.check_invariants();
    CHECK(e.get(a.child) == 0);
    CHECK(e.get(a.parent) == (key == 1 ? 7 : 0));
  }
}

struct Posting {
  Mod<int> on, out;
  sac::Agenda& agenda;
};
void posted(Scope& s, int v) { s.write(s.environment<Posting>().out, v); }
void nothing(Scope&) {}
void drains(Scope& s) { s.environment<Posting>().agenda.drain(s); }
void posts_behind_a_child(Scope& s) {
  auto& p = s.environment<Posting>();
  s.write(p.out, 0);
  s.call<nothing>();
  if (s.read(p.on) != 0) p.agenda.post<posted>(s, {}, s.read(p.on));
  s.call<drains>();
}
void posts_behind_its_drain(Scope& s) {
  auto& p = s.environment<Posting>();
  s.write(p.out, 0);
  s.call<drains>();
  if (s.read(p.on) != 0) p.agenda.post<posted>(s, {}, 7);
}

TEST_CASE("what is posted between children counts for a drain behind it") {
  Engine e;
  Posting p{e.input(0), e.cell<int>(), e.make_agenda("a")};
  e.set_environment(&p);
  e.run<posts_behind_a_child>();
  for (const int on : {3, 4, 0, 5}) {
    e.set(p.on, on);
    e.propagate();
    e.check_invariants();
    CHECK(e.get(p.out) == on);
  }
}

TEST_CASE("what is posted behind its drain is refused, in a first run and in an update") {
  Engine e;
  Posting p{e.input(1), e.cell<int>(), e.make_agenda("a")};
  e.set_environment(&p);
  CHECK_THROWS_WITH(e.run<posts_behind_its_drain>(), Contains("posting into the past"));
  e.set(p.on, 0);
  e.run<posts_behind_its_drain>();
  e.set(p.on, 1);
  CHECK_THROWS_WITH(e.propagate(), Contains("posting into the past"));
  CHECK(e.get(p.on) == 0);
  e.check_invariants();
}

}  // namespace
