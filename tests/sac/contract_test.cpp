// What a first run refuses a propagation refuses, what it accepts a propagation accepts, and both
// leave the same: programs that are at odds with their own order.
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <limits>
#include <ostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "claims.hpp"
#include "sac/sac.hpp"

namespace {

using sac::Agenda;
using sac::Engine;
using sac::Mod;
using sac::Scope;

// An engine with the things that the programs below use.
struct World {
  explicit World(int in_value) : in(e.input(in_value)) {
    e.set_environment(this);
    e.set_audit(true);
  }
  Engine e;
  examples::Claims<int> claims{e};
  Mod<int> in;
  Mod<int> m = e.cell<int>();
  Mod<int> out = e.cell<int>();
  Agenda& agenda = e.make_agenda("work");
  Agenda& other = e.make_agenda("other");
};
World& world(Scope& s) { return s.environment<World>(); }

// What the program leaves in `out`, or the refusal.
std::string outcome(World& w, const std::function<void()>& action) {
  try {
    action();
  } catch (const std::exception& error) {
    const std::string text = error.what();
    return "refused: " + text.substr(0, text.find(" (@"));
  }
  w.e.check_invariants();
  return "out " + std::to_string(w.e.get(w.out));
}

// Runs with `from`, changes the input to `to`, and compares with a run from scratch; then back.
template <auto Program>
std::string change(int from, int to) {
  World w(from);
  const std::string before = outcome(w, [&] { w.e.run<Program>(); });
  w.e.set(w.in, to);
  const std::string updated = outcome(w, [&] { w.e.propagate(); });
  World fresh(to);
  const std::string scratch = outcome(fresh, [&] { fresh.e.run<Program>(); });
  CHECK(updated == scratch);
  w.e.check_invariants();
  if (updated.starts_with("refused")) {
    CHECK(w.e.get(w.in) == from);
    CHECK(w.e.get(w.out) == std::stoi(before.substr(4)));
  } else {
    w.e.set(w.in, from);
    CHECK(outcome(w, [&] { w.e.propagate(); }) == before);
  }
  return updated;
}

void set_m(Scope& s, int value) { s.write(world(s).m, value); }
void copy_m(Scope& s) { s.write(world(s).out, s.read(world(s).m)); }
void drain(Scope& s) { world(s).agenda.drain(s); }

// --- Posts and drains --------------------------------------------------------------------------

template <bool kWrapped>
void post_behind_drain(Scope& s) {
  s.call<set_m>(0);
  kWrapped ? s.call<drain>() : world(s).agenda.drain(s);
  world(s).agenda.post<set_m>(s, {}, 7);
}

TEST_CASE("a post behind one's own drain is refused, direct or through a wrapper") {
  World w(0);
  CHECK_THROWS_WITH((w.e.run<post_behind_drain<false>>()),
                    Catch::StartsWith("posting into the past"));
  CHECK_THROWS_WITH((w.e.run<post_behind_drain<true>>()),
                    Catch::StartsWith("posting into the past"));
  w.e.check_invariants();
}

void post_moves_behind_drain(Scope& s) {
  auto& w = world(s);
  const int in = s.read(w.in);
  s.write(w.out, in);
  if (in == 0) w.agenda.post<set_m>(s, {}, 7);
  s.call<drain>();
  if (in != 0) w.agenda.post<set_m>(s, {}, 7);
}

TEST_CASE("a post that moves behind the drain is refused when it is repeated") {
  CHECK(change<post_moves_behind_drain>(0, 1).starts_with("refused: posting into the past"));
}

void post_unless(Scope& s) {
  auto& w = world(s);
  s.write(w.m, 0);
  if (s.read(w.in) != 0) w.agenda.post<set_m>(s, {}, 1);
  s.call<drain>();
  s.call<copy_m>();
}

TEST_CASE("a post that is not repeated is not there for a wrapper that drains and is reused") {
  CHECK(change<post_unless>(1, 0) == "out 0");
  CHECK(change<post_unless>(0, 1) == "out 1");
}

void post_in_child(Scope& s, int in) {
  if (in != 0) world(s).agenda.post<set_m>(s, {}, 1);
}
void drain_instead(Scope& s) {
  auto& w = world(s);
  const int in = s.read(w.in);
  s.call<set_m>(0);
  if (in != 0) s.call<post_in_child>(in);
  if (in == 0) w.agenda.drain(s);
  s.call<copy_m>();
}

TEST_CASE("a drain runs what was posted before it, not what a later call of last time posts") {
  CHECK(change<drain_instead>(1, 0) == "out 0");
}

void drain_if(Scope& s, int which) {
  auto& w = world(s);
  if ((s.read(w.in) != 0) == (which == 0)) w.agenda.drain(s);
}
void drain_moves(Scope& s) {
  auto& w = world(s);
  s.write(w.m, 0);
  w.agenda.post<set_m>(s, {}, 7);
  s.call<drain_if>(0);
  s.call<drain_if>(1);
  s.call<copy_m>();
}
void drain_unless(Scope& s) {
  if (s.read(world(s).in) == 0) s.call<drain>();
}
void drain_comes_before(Scope& s) {
  auto& w = world(s);
  s.write(w.out, 0);
  if (s.read(w.in) != 0) w.agenda.drain(s);
  s.call<drain_unless>();
}
void drain_twice_if(Scope& s) {
  auto& w = world(s);
  s.write(w.out, 0);
  if (s.read(w.in) != 0) s.call<drain_if>(0);
  s.call<drain>();
}

TEST_CASE("a drain moves to an earlier call and to a later one; a second one is refused") {
  CHECK(change<drain_moves>(0, 1) == "out 7");
  CHECK(change<drain_moves>(1, 0) == "out 7");
  CHECK(change<drain_comes_before>(0, 1) == "out 0");
  CHECK(
      change<drain_twice_if>(0, 1).starts_with("refused: drain(): agenda 'work' is drained twice"));
}

int read_m(Scope& s) { return s.read(world(s).m); }
int drain_and_read(Scope& s) {
  s.call<set_m>(0);
  s.call<drain>();
  return s.call<read_m>();
}
void leaf(Scope&, int) {}
void inner(Scope& s) { s.call<leaf>(0); }
void tail_leaf(Scope&) {}
void post_behind_and_go_on(Scope& s) {
  const int read = s.call<drain_and_read>();
  world(s).agenda.post<set_m>(s, {}, 1);
  if (read != 0) s.call<inner>();
  s.tail<tail_leaf>();
}
void new_call_if(Scope& s) {
  s.write(world(s).out, 0);
  if (s.read(world(s).in) == 0) {
    s.call<leaf>(0);
  } else {
    s.call<post_behind_and_go_on>();
  }
}
void late(Scope&) {}

TEST_CASE("a post behind a drain in a call that is new in a propagation is refused") {
  World w(0);
  w.e.run<new_call_if>();
  w.e.run<late>();
  w.e.set(w.in, 1);
  CHECK_THROWS_WITH(w.e.propagate(), Catch::StartsWith("posting into the past"));
  w.e.check_invariants();
}

// --- Keys and arguments ------------------------------------------------------------------------

void post_by_priority(Scope& s) {
  auto& w = world(s);
  w.agenda.post<set_m>(s, {.bucket = s.read(w.in)}, 1);
  w.agenda.drain(s);
}

TEST_CASE("a key that changes under one label is refused, and nothing is lost") {
  World w(0);
  w.e.run<post_by_priority>();
  w.e.set(w.in, 1);
  CHECK_THROWS_WITH(w.e.propagate(), Catch::Contains("set_m(1) is posted at two keys"));
  CHECK(w.e.get(w.in) == 0);
  CHECK(w.e.get(w.m) == 1);
  w.e.check_invariants();
}

void take(Scope&, double) {}
void post_number(Scope& s, double x) {
  world(s).agenda.post<take>(s, {}, x);
  world(s).agenda.drain(s);
}

TEST_CASE("a posted argument that does not equal itself is refused") {
  World w(0);
  CHECK_THROWS_WITH(w.e.run<post_number>(std::nan("")), Catch::Contains("does not equal itself"));
  CHECK_THROWS_WITH(w.agenda.post_from_outside<take>({}, std::nan("")),
                    Catch::Contains("does not equal itself"));
  w.e.run<post_number>(1.0);
  w.e.check_invariants();
}

// Told apart by both numbers, ordered by one.
struct Half {
  int ordered = 0;
  int other = 0;
  friend bool operator==(const Half&, const Half&) = default;
  friend auto operator<=>(const Half& a, const Half& b) { return a.ordered <=> b.ordered; }
  friend std::uint64_t hash_value(const Half& h) { return static_cast<std::uint64_t>(h.ordered); }
  friend std::ostream& operator<<(std::ostream& out, const Half& h) { return out << h.other; }
};
void take_half(Scope& s, Half) { s.read(world(s).in); }
constexpr auto take_half_plainly = [](sac::PlainScope&, Half) {};
void post_halves(Scope& s) {
  auto& w = world(s);
  for (int i = 0; i <= s.read(w.in); ++i) w.agenda.post<take_half>(s, {}, Half{1, i});
  w.agenda.drain(s);
}

TEST_CASE("posted arguments that are neither equal nor ordered are refused, as in an update") {
  World two(1);
  CHECK_THROWS_WITH(two.e.run<post_halves>(), Catch::Contains("neither equal nor ordered"));
  two.e.check_invariants();
  World one(0);
  one.e.run<post_halves>();
  one.e.set(one.in, 1);
  CHECK_THROWS_WITH(one.e.propagate(), Catch::Contains("neither equal nor ordered"));
  one.e.check_invariants();
  CHECK(one.e.get(one.in) == 0);
  sac::PlainScope plain;
  sac::PlainAgenda& agenda = plain.make_agenda("halves");
  for (int i = 0; i < 2; ++i) agenda.post<take_half_plainly>(plain, {}, Half{1, i});
  CHECK_THROWS_WITH(agenda.drain(plain), Catch::Contains("neither equal nor ordered"));
}

void inverse(Scope& s, Mod<double> x, Mod<double> out) { s.write(out, 1 / s.read(x)); }
void inverse_of(Scope& s, double x, Mod<double> out) { s.write(out, 1 / x); }
void by_argument(Scope& s, Mod<double> x, Mod<double> out) { s.call<inverse_of>(s.read(x), out); }

TEST_CASE("-0.0 is another value and another argument than 0.0") {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Engine e;
  const auto x = e.input(0.0);
  const auto out = e.cell<double>();
  const auto out2 = e.cell<double>();
  e.run<inverse>(x, out);
  e.run<by_argument>(x, out2);
  e.set(x, -0.0);
  e.propagate();
  CHECK(e.get(out) == -kInfinity);
  CHECK(e.get(out2) == -kInfinity);
}

// --- What is not repeated, and what comes behind children ----------------------------------------

void write_unless(Scope& s) {
  auto& w = world(s);
  s.write(w.out, 5);
  if (s.read(w.in) != 0) s.write(w.m, 1);
  s.call<copy_m>();
}

TEST_CASE("what a call wrote last time is not there for its child, nor for itself") {
  CHECK(change<write_unless>(1, 0).starts_with("refused: copy_m() reads"));
}

void claim_in_child(Scope& s) { s.write(world(s).out, world(s).claims.claim(s, 1)); }
void claim_unless(Scope& s) {
  if (s.read(world(s).in) != 0) world(s).claims.claim(s, 1);
  s.call<claim_in_child>();
}

TEST_CASE("what is not repeated is not there for children in a structure of the user's") {
  CHECK(change<claim_unless>(1, 0) == "out 1");
  CHECK(change<claim_unless>(0, 1) == "out 0");
}

template <int kChildDoes, int kParentDoes>
struct Behind {
  static constexpr std::string_view kName = "behind";
  static void act(Scope& s, int what) {
    auto& w = world(s);
    if (what == 0) static_cast<void>(s.read(w.m));
    if (what == 1) s.write(w.m, 9);
    if (what == 2) w.claims.claim(s, 1);
    if (what == 3) w.agenda.post<set_m>(s, {}, 1);
    if (what == 4) w.agenda.drain(s);
  }
  struct Child {
    static constexpr std::string_view kName = "child";
    void operator()(Scope& s) const {
      if (s.read(world(s).in) != 0) act(s, kChildDoes);
    }
  };
  void operator()(Scope& s) const {
    s.write(world(s).out, 3);
    s.call<Child{}>();
    act(s, kParentDoes);
  }
};
template <int kChildDoes, int kParentDoes>
struct WithM {
  void operator()(Scope& s) const {
    s.call<set_m>(1);
    s.call<Behind<kChildDoes, kParentDoes>{}>();
  }
};

TEST_CASE("what a child newly does comes before what its parent does behind it") {
  CHECK(change<WithM<0, 1>{}>(0, 1).starts_with("out"));
  CHECK(change<WithM<1, 0>{}>(0, 1).starts_with("out"));
  CHECK(change<WithM<2, 2>{}>(0, 1).starts_with("out"));
  CHECK(change<WithM<4, 3>{}>(0, 1).starts_with("refused: posting into the past: behind() posts"));
}

void copy_if(Scope& s) {
  auto& w = world(s);
  s.write(w.out, s.read(w.in) != 0 ? s.read(w.m) : 0);
}
void write_between(Scope& s) {
  s.call<leaf>(0);
  s.write(world(s).m, 4);
  s.call<copy_if>();
}

TEST_CASE("what a parent does between two children is there for the second") {
  CHECK(change<write_between>(0, 1) == "out 4");
  World w(0);
  w.e.run<write_between>();
  w.e.set(w.in, 1);
  CHECK(w.e.propagate().executed <= 2);  // copy_if, and the parent says that all is well
}

// --- Exceptions --------------------------------------------------------------------------------

void maybe_write(Scope& s) {
  if (s.read(world(s).in) != 0) s.write(world(s).m, 5);
}
void try_to_read(Scope& s) {
  int value = -1;
  try {
    value = s.read(world(s).m);
  } catch (const sac::UsageError&) {
  }
  s.write(world(s).out, value);
}
void read_with_care(Scope& s) {
  s.call<maybe_write>();
  s.call<try_to_read>();
}

TEST_CASE("a call that catches what its own read threw is refused, in runs and propagations") {
  CHECK(change<read_with_care>(1, 0).starts_with("refused: try_to_read() has caught"));
  World w(0);
  CHECK_THROWS_WITH(w.e.run<read_with_care>(), Catch::StartsWith("try_to_read() has caught"));
}

void fail_if(Scope& s) {
  if (s.read(world(s).in) != 0) throw std::runtime_error("no");
}
void go_on_after_failure(Scope& s) {
  try {
    s.call<fail_if>();
  } catch (const std::runtime_error&) {
    s.call<leaf>(1);
  }
  s.write(world(s).out, 1);
}

TEST_CASE("a call that catches what its child threw may not make another") {
  World w(1);
  CHECK_THROWS_WITH(w.e.run<go_on_after_failure>(),
                    Catch::StartsWith("go_on_after_failure() has caught"));
  World x(0);
  x.e.run<go_on_after_failure>();
  x.e.set(x.in, 1);
  CHECK_THROWS(x.e.propagate());
  x.e.check_invariants();
}

// --- The outside's operations -------------------------------------------------------------------

template <int kWhich>
void use_outside(Scope& s) {
  Engine& e = s.engine();
  World& w = world(s);
  if (kWhich == 0) static_cast<void>(e.input(1));
  if (kWhich == 1) static_cast<void>(e.cell<int>());
  if (kWhich == 2) static_cast<void>(e.make<int>());
  if (kWhich == 3) e.set(w.in, 1);
  if (kWhich == 4) static_cast<void>(e.get(w.in));
  if (kWhich == 5) e.release(w.in);
  if (kWhich == 6) static_cast<void>(e.make_agenda("new"));
}

TEST_CASE("the outside's operations are refused inside of a traced function, and leave nothing") {
  World w(0);
  const std::size_t live = w.e.memory().calls_and_edges_live;
  const auto refused = [&]<int... which>(std::integer_sequence<int, which...>) {
    const auto check = [&](const auto& run) {
      CHECK_THROWS_WITH(run(), Catch::Contains("the engine is running"));
    };
    (check([&] { w.e.run<use_outside<which>>(); }), ...);
  };
  refused(std::make_integer_sequence<int, 7>());
  CHECK(w.e.memory().calls_and_edges_live == live);
}

TEST_CASE("a handle of another engine, or of what is gone, is an error in checked builds") {
  Engine a;
  Engine b;
  const auto of_a = a.input(1);
  static_cast<void>(b.input(42));
  const auto gone = a.input(10);
  a.release(gone);
  a.propagate();
  const auto in_its_place = a.input(20);
  CHECK(in_its_place.head() == gone.head());
  if (!sac::kChecked) return;
  CHECK_THROWS_WITH(b.get(of_a), "get: the modifiable is one of another engine");
  CHECK_THROWS_WITH(b.set(of_a, 2), "set: the modifiable is one of another engine");
  CHECK_THROWS_WITH(b.release(of_a), "release: the modifiable is one of another engine");
  CHECK_THROWS_WITH(a.get(gone), Catch::Contains("is gone"));
  CHECK_THROWS_WITH(a.set(gone, 2), Catch::Contains("is gone"));
  CHECK_THROWS_WITH(a.release(gone), Catch::Contains("is gone"));
  CHECK(a.get(in_its_place) == 20);
  World w(0);
  CHECK_THROWS_WITH(w.e.run<inverse>(a.input(1.0), a.cell<double>()),
                    Catch::Contains("read: the modifiable is one of another engine"));
}

// --- Rolling back -------------------------------------------------------------------------------

struct Near {
  bool operator()(double a, double b) const { return std::abs(a - b) < 1; }
};
using Rough = Mod<double, Near>;
struct Rounded {
  using Same = Near;
  double operator()(Scope& s, Mod<double> a) const { return s.read(a); }
};
void to_rough(Scope& s, Mod<double> a, Rough b) { s.write(b, s.read(a)); }
void from_rough(Scope& s, Rough b, Mod<double> c) { s.write(c, s.read(b)); }
void through_rough(Scope& s, Mod<double> a, Rough b, Mod<double> c, Mod<double> d) {
  s.call<to_rough>(a, b);
  s.call<from_rough>(b, c);
  s.write(d, s.call<Rounded{}>(a));
}

TEST_CASE("a roll-back restores the very values, whatever a Same takes for the same") {
  Engine e;
  const auto a = e.input(0.0);
  const Rough b = e.cell<double, Near>();
  const auto c = e.cell<double>();
  const auto d = e.cell<double>();
  e.run<through_rough>(a, b, c, d);
  e.set(a, 0.9);
  e.propagate();
  const auto values = [&] { return std::vector{e.get(a), e.get(b), e.get(c), e.get(d)}; };
  CHECK(values() == std::vector{0.9, 0.0, 0.0, 0.0});
  bool went_through = false;
  for (int calls = 0; !went_through; ++calls) {
    int left = calls;
    e.set_progress([&](const sac::Progress&) { return left-- > 0; }, 1);
    e.set(a, 1.5);
    try {
      e.propagate();
      went_through = true;
    } catch (const sac::Cancelled&) {
      CAPTURE(calls);
      CHECK(values() == std::vector{0.9, 0.0, 0.0, 0.0});
    }
  }
  CHECK(values() == std::vector{1.5, 1.5, 1.5, 1.5});
}

struct Rooms {
  Engine e;
  Mod<double> first = e.input(0.9);
  Mod<double> second = e.input(1.5);
  Mod<bool> fails = e.input(false);
  Mod<double> now = e.cell<double>();
  Rough rough = e.cell<double, Near>();
  Mod<double> seen_first = e.cell<double>();
  Mod<double> seen_second = e.cell<double>();
};
void enter(Scope& s, Mod<double> from) { s.write(s.environment<Rooms>().now, s.read(from)); }
void roughen(Scope& s) {
  auto& rooms = s.environment<Rooms>();
  s.write(rooms.rough, s.read(rooms.now));
}
void see(Scope& s, Mod<double> out) { s.write(out, s.read(s.environment<Rooms>().rough)); }
void fail_when(Scope& s, Mod<bool> fails) {
  if (s.read(fails)) throw std::runtime_error("as it is told");
}
// Makes two calls `roughen` of one label, which write one modifiable.
template <bool kMadeAnew>
void roughen_twice(Scope& s) {
  auto& rooms = s.environment<Rooms>();
  const bool roughens = !kMadeAnew || !s.read(rooms.fails);
  s.call<enter>(rooms.first);
  if (roughens) s.call<roughen>();
  if (roughens) s.call<see>(rooms.seen_first);
  s.call<enter>(rooms.second);
  if (roughens) s.call<roughen>();
  if (roughens) s.call<see>(rooms.seen_second);
  s.call<fail_when>(rooms.fails);
}

template <bool kMadeAnew>
void check_each_gets_its_own() {
  Rooms rooms;
  rooms.e.set_environment(&rooms);
  rooms.e.run<roughen_twice<kMadeAnew>>();
  rooms.e.set(rooms.first, 5.9);
  rooms.e.set(rooms.second, 7.5);
  rooms.e.set(rooms.fails, true);
  CHECK_THROWS_WITH(rooms.e.propagate(), "as it is told");
  CHECK(rooms.e.get(rooms.seen_first) == 0.9);
  CHECK(rooms.e.get(rooms.seen_second) == 1.5);
  CHECK(rooms.e.get(rooms.rough) == 1.5);
  rooms.e.check_invariants();
}

TEST_CASE("a roll-back gives each of two calls of one label its own value") {
  check_each_gets_its_own<false>();
  check_each_gets_its_own<true>();
}

// --- Agendas come and go -------------------------------------------------------------------------

TEST_CASE("agendas are released, and as many as are alive have room") {
  World w(0);
  for (int i = 0; i < 1000; ++i) w.e.release(w.e.make_agenda("passing"));
  w.agenda.post_from_outside<set_m>({}, 1);
  CHECK_THROWS_WITH(w.e.release(w.agenda), Catch::Contains("agenda 'work' is in use"));
  w.e.run<drain>();
  CHECK_THROWS_WITH(w.e.release(w.agenda), Catch::Contains("agenda 'work' is in use"));
  const auto make_all = [&] {
    while (true) static_cast<void>(w.e.make_agenda("more"));
  };
  CHECK_THROWS_WITH(make_all(), Catch::Contains("255 structures"));
  w.e.check_invariants();
}

// --- Costs -----------------------------------------------------------------------------------

int fibonacci(Scope& s, int n) {
  return n < 2 ? n : (s.call<fibonacci>(n - 1) + s.call<fibonacci>(n - 2)) % 1000;
}
void fibonacci_of(Scope& s, Mod<int> n, Mod<int> out) {
  s.write(out, s.call<fibonacci>(s.read(n)));
}

TEST_CASE("calls with equal labels are found by their place") {
  Engine e;
  const auto n = e.input(15);
  const auto out = e.cell<int>();
  e.run<fibonacci_of>(n, out);
  e.check_invariants();
  for (const int next : {17, 16, 14, 18, 15}) {
    e.set(n, next);
    e.propagate();
    e.check_invariants();
    Engine f;
    const auto m = f.input(next);
    const auto result = f.cell<int>();
    f.run<fibonacci_of>(m, result);
    CHECK(e.get(out) == f.get(result));
    CHECK(e.live_calls() == f.live_calls());
  }
}

// Calls inside of calls: each writes one modifiable or, if told so, reads it.
struct Nested {
  explicit Nested(int calls) : depth(calls), seen(static_cast<std::size_t>(calls), -1) {
    e.set_environment(this);
  }
  Engine e;
  int depth;
  Mod<int> reads = e.input(0);  // 0: all write; 1: only the first; 2: and every third
  Mod<int> m = e.cell<int>();
  std::vector<int> seen;
};
void write_or_read(Scope& s, int level) {
  auto& n = s.environment<Nested>();
  const int reads = s.read(n.reads);
  if (reads == 0 || level == 0 || (reads == 2 && level % 3 == 0)) {
    s.write(n.m, level);
  } else {
    n.seen[static_cast<std::size_t>(level)] = s.read(n.m);
  }
  if (level + 1 < n.depth) s.call<write_or_read>(level + 1);
}

// With the address sanitizer, unoptimized, a call takes more of the stack: 2.8 KB, not 0.5.
#if defined(__SANITIZE_ADDRESS__)
constexpr int kDeep = 2000;
#else
constexpr int kDeep = 6000;
#endif

TEST_CASE("a read passes what calls around it wrote last time, however many these are") {
  for (const int depth : {2, 3, 50, kDeep}) {  // of kDeep each would pass half of the others
    Nested n(depth);
    n.e.run<write_or_read>(0);
    for (const int reads : {1, 2, 0, 2, 1, 0, 1, 2}) {
      n.e.set(n.reads, reads);
      n.e.propagate();
      n.e.check_invariants();
      Nested fresh(depth);
      fresh.e.set(fresh.reads, reads);
      fresh.e.run<write_or_read>(0);
      CHECK(n.e.get(n.m) == fresh.e.get(fresh.m));
      if (reads != 0) CHECK(n.seen.back() == fresh.seen.back());
      CHECK(n.e.live_edges() == fresh.e.live_edges());
    }
  }
}

}  // namespace
