// Errors name the calls and the modifiables that they are about. Each test asserts the whole text.
#include <catch2/catch.hpp>
#include <cstddef>
#include <cstdint>
#include <sstream>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

#include "random.hpp"
#include "sac/event_log.hpp"
#include "sac/sac.hpp"

namespace {

using sac::Engine;
using sac::Mod;
using sac::Scope;

// What act() says when it fails; empty if it does not.
template <class Act>
std::string error_of(Act&& act) {
  try {
    act();
  } catch (const sac::UsageError& error) {
    return error.what();
  }
  return "";
}

std::string at(sac::Handle handle) { return "@" + std::to_string(handle); }
std::string at(sac::ModRef mod) { return at(mod.handle()); }

Mod<int> named(Engine& e, Mod<int> mod, const char* name) {
  e.name(mod, name);
  return mod;
}
std::string text(const char* name, Mod<int> mod) {
  return "modifiable '" + std::string(name) + "' (" + at(mod.head()) + ")";
}
template <class... Args>
std::string call(const char* name, const Args&... args) {
  std::ostringstream out;
  sac::print_arguments(out, std::make_tuple(args...));
  return std::string(name) + '(' + out.str() + ')';
}

void copy(Scope& s, Mod<int> from, Mod<int> to) { s.write(to, s.read(from)); }
// Writes `value` to `out` unless it is negative.
void maybe(Scope& s, Mod<int> value, Mod<int> out) {
  if (const int v = s.read(value); v >= 0) s.write(out, v);
}

// --- Entering ------------------------------------------------------------------------------------

void reenter(Scope& s, Mod<int> how) {
  Engine& e = s.engine();
  switch (s.read(how)) {
    case 0:
      return;
    case 1:
      return static_cast<void>(e.propagate());
    case 2:
      return static_cast<void>(e.run<reenter>(how));
    case 3:
      return e.set(how, 9);
    case 4:
      return e.shrink();
    case 5:
      return e.undo_edits();
    case 6:
      return e.release(how);
    case 7:
      return e.begin_edit();
    default:
      return e.set_progress([](const sac::Progress&) { return true; });
  }
}

TEST_CASE("entering a running engine: the operation and the running call are named") {
  const std::vector<std::string> operations{"propagate",  "run",     "set",  "shrink",
                                            "undo_edits", "release", "edit", "set_progress"};
  Engine e;
  const auto how = e.input(0);
  e.run<reenter>(how);
  for (std::size_t i = 0; i < operations.size(); ++i) {
    const std::string text = operations[i] + ": the engine is running " + call("reenter", how);
    e.set(how, static_cast<int>(i) + 1);
    CHECK(error_of([&] { e.propagate(); }) == text);
    CHECK(e.get(how) == 0);
    Engine first;
    const auto same_how = first.input(static_cast<int>(i) + 1);
    REQUIRE(same_how == how);
    CHECK(error_of([&] { first.run<reenter>(same_how); }) == text);
  }
}

TEST_CASE("running with edits that have not been propagated") {
  Engine e;
  const auto a = e.input(1), b = e.cell<int>();
  e.run<copy>(a, b);
  e.set(a, 2);
  CHECK(error_of([&] { e.run<copy>(b, e.cell<int>()); }) == "run: propagate the edits first");
}

// --- Reading -------------------------------------------------------------------------------------

TEST_CASE("reading what nobody has written") {
  Engine e;
  const auto m = named(e, e.cell<int>(), "price"), out = e.cell<int>();
  CHECK(error_of([&] { e.run<copy>(m, out); }) ==
        call("copy", m, out) + " reads " + text("price", m) + ", which nobody has written");
  CHECK(error_of([&] { static_cast<void>(e.get(m)); }) ==
        text("price", m) + " has no value: nobody has written it");
  CHECK(error_of([&] { static_cast<void>(e.get(out)); }) ==
        "modifiable " + at(out.head()) + " has no value: nobody has written it");
}

TEST_CASE("reading what only a later call writes, because an earlier one does so no longer") {
  for (const bool several : {false, true}) {
    Engine e;
    const auto early = e.input(1), late = e.input(several ? 1 : -1), out = e.cell<int>();
    const auto m = named(e, e.cell<int>(), "m");
    e.run<maybe>(early, m);
    e.run<copy>(m, out);
    e.run<maybe>(late, m);
    e.set(early, -1);
    CHECK(error_of([&] { e.propagate(); }) ==
          call("copy", m, out) + " reads " + text("m", m) +
              (several ? ", which is written only by the later call " + call("maybe", late, m)
                       : std::string(", which nobody has written")));
    CHECK(e.get(out) == 1);
  }
}

void write_behind(Scope& s, Mod<int> order, Mod<int> in, Mod<int> m, Mod<int> out) {
  if (s.read(order) == 0) s.call<copy>(in, m);
  s.call<copy>(m, out);
  if (s.read(order) == 1) s.call<copy>(in, m);
}

TEST_CASE("a call that comes to read what a later call writes") {
  Engine e;
  const auto order = e.input(0), in = e.input(3), out = e.cell<int>();
  const auto m = named(e, e.cell<int>(), "m");
  e.run<write_behind>(order, in, m, out);
  e.set(order, 1);
  // The writer is not there when the reader runs.
  CHECK(error_of([&] { e.propagate(); }) ==
        call("copy", m, out) + " reads " + text("m", m) + ", which nobody has written");
  CHECK(e.get(out) == 3);
  e.check_invariants();
}

// --- Writing -------------------------------------------------------------------------------------

TEST_CASE("writing an input, and setting what the program writes") {
  Engine e;
  const auto in = named(e, e.input(1), "in"), out = named(e, e.cell<int>(), "out");
  CHECK(error_of([&] { e.run<copy>(in, in); }) ==
        call("copy", in, in) + " writes " + text("in", in) + ", which is an input");
  e.run<copy>(in, out);
  CHECK(error_of([&] { e.set(out, 3); }) ==
        "set: " + text("out", out) + " is written by the program, in " + call("copy", in, out));
  CHECK(e.get(out) == 1);
}

void use_stray(Scope& s, int write) {
  const sac::Cell<int> cell{};
  write == 1 ? s.write(cell, 1) : static_cast<void>(s.read(cell));
}

TEST_CASE("modifiables that are null or in no memory of the engine") {
  Engine e;
  const Mod<int> null, out = e.cell<int>(), in = e.input(1);
  CHECK(error_of([&] { e.run<copy>(null, out); }) ==
        "copy(@0, " + at(out.head()) + ") reads a modifiable that is null");
  CHECK(error_of([&] { e.run<copy>(in, null); }) ==
        "copy(" + at(in.head()) + ", @0) writes a modifiable that is null");
  CHECK(error_of([&] { e.set(null, 1); }) == "set: the modifiable is null");
  CHECK(error_of([&] { static_cast<void>(e.get(null)); }) == "get: the modifiable is null");
  const sac::Cell<int> stray{};
  CHECK(error_of([&] { e.set(stray, 1); }) == "set: the cell is not in memory of this engine");
  CHECK(error_of([&] { static_cast<void>(e.get(stray)); }) ==
        "get: the cell is not in memory of this engine");
  CHECK(error_of([&] { e.run<use_stray>(0); }) ==
        "use_stray(0): read: the cell is not in memory of this engine");
  CHECK(error_of([&] { e.run<use_stray>(1); }) ==
        "use_stray(1): write: the cell is not in memory of this engine");
  e.check_invariants();
}

struct Kept {
  Scope* scope = nullptr;
  sac::Agenda* agenda = nullptr;
};
void posted_late(Scope&, int) {}
void keep(Scope& s) { s.environment<Kept>().scope = new Scope(s); }

TEST_CASE("a scope that was kept for too long") {
  Engine e;
  const auto in = e.input(1), out = e.cell<int>();
  Kept kept{.agenda = &e.make_agenda("work")};
  e.set_environment(&kept);
  e.run<keep>();
  Scope& s = *kept.scope;
  const std::string text =
      "a scope is used while no traced function runs: it was kept for too long";
  CHECK(error_of([&] { s.write(out, 1); }) == text);
  CHECK(error_of([&] { s.read(in); }) == text);
  CHECK(error_of([&] { s.call<copy>(in, out); }) == text);
  CHECK(error_of([&] { s.tail<copy>(in, out); }) == text);
  CHECK(error_of([&] { s.make<int>(1); }) == text);
  CHECK(error_of([&] { kept.agenda->post<posted_late>(s, {}, 1); }) == text);
  CHECK(error_of([&] { kept.agenda->drain(s); }) == text);
  CHECK(error_of([&] { s.observe<sac::Edge>(0, 0); }) == text);
  CHECK(error_of([&] { s.recall<sac::Edge>(0, 0, [](const auto&) { return true; }); }) == text);
  delete kept.scope;
  CHECK(e.live_calls() == 1);
  e.check_invariants();
}

// --- Calls ---------------------------------------------------------------------------------------

void call_behind_tail(Scope& s, Mod<int> in, Mod<int> out, bool tail) {
  s.tail<copy>(in, out);
  tail ? s.tail<maybe>(in, out) : s.call<maybe>(in, out);
}

TEST_CASE("a call behind a tail call") {
  Engine e;
  const auto in = e.input(1), out = e.cell<int>();
  for (const bool tail : {false, true}) {
    CHECK(error_of([&] { e.run<call_behind_tail>(in, out, tail); }) ==
          call("call_behind_tail", in, out, tail) + " calls maybe behind its tail call " +
              call("copy", in, out) + ", which must be the last");
  }
  CHECK(e.live_calls() == 0);
}

void dig(Scope& s, Mod<int> depth, int level) {
  if (level < s.read(depth)) s.call<dig>(depth, level + 1);
}

TEST_CASE("calls inside of calls that would overflow the native stack") {
  Engine e;
  const auto depth = e.input(100'000);
  const std::string text = error_of([&] { e.run<dig>(depth, 0); });
  CHECK_THAT(text, Catch::StartsWith("dig(" + at(depth.head()) + ", "));
  CHECK_THAT(text, Catch::Contains(") calls dig too deep: calls inside of calls have taken "));
  CHECK_THAT(text, Catch::EndsWith(" bytes of the native stack; use tail calls, or divide"));
  CHECK(e.live_calls() == 0);
  e.check_invariants();
  e.set(depth, 20);
  e.propagate();
  e.run<dig>(depth, 0);
  e.set(depth, 100'000);
  CHECK(error_of([&] { e.propagate(); }).substr(0, 4) == "dig(");
  CHECK(e.get(depth) == 20);
  CHECK(e.live_calls() == 21);
  e.check_invariants();
  e.set(depth, 1000);
  e.propagate();
  CHECK(e.live_calls() == 1001);
}

struct Shaft {
  Engine e;
  std::vector<Mod<bool>> goes_on;
  Mod<int> light = e.input(0);
};
void dig_on(Scope& s, int level) {
  auto& shaft = s.environment<Shaft>();
  static_cast<void>(s.read(shaft.light));
  if (s.read(shaft.goes_on[static_cast<std::size_t>(level)])) s.call<dig_on>(level + 1);
}

TEST_CASE("calls that updates have nested deeper than one run could are left by a roll-back") {
  Shaft shaft;
  Engine& e = shaft.e;
  e.set_environment(&shaft);
  e.set_stack_limit(std::size_t{1} << 18);
  for (int i = 0; i < 5000; ++i) shaft.goes_on.push_back(e.input(false));
  e.run<dig_on>(0);
  for (std::size_t i = 0; i + 1 < shaft.goes_on.size(); ++i) {
    e.set(shaft.goes_on[i], true);
    if (i % 100 == 99) e.propagate();
  }
  e.propagate();
  CHECK(e.live_calls() == shaft.goes_on.size());
  for (int light = 1; light < 4; ++light) {
    e.set(shaft.light, light);  // all run again, each inside of the one before
    CHECK_THAT(error_of([&] { e.propagate(); }), Catch::Contains(" calls dig_on too deep"));
    CHECK(e.get(shaft.light) == 0);
    CHECK(e.live_calls() == shaft.goes_on.size());
    e.check_invariants();
  }
  e.set(shaft.goes_on[10], false);
  e.propagate();
  CHECK(e.live_calls() == 11);
}

// How deep calls go in a stack of so many bytes.
std::uint64_t depth_in(std::size_t bytes) {
  Engine e;
  std::uint64_t deepest = 0;
  e.set_stack_limit(bytes);
  e.set_progress(
      [&](const sac::Progress& p) {
        deepest = p.executed + 1;
        return true;
      },
      1);
  const std::string end = "have taken " + std::to_string(bytes) +
                          " bytes of the native stack; use tail calls, or divide";
  CHECK_THAT(error_of([&] { e.run<dig>(e.input(100'000), 0); }), Catch::EndsWith(end));
  return deepest;
}

TEST_CASE("the limit of the native stack can be set") {
  const auto small = depth_in(std::size_t{1} << 16);
  const auto large = depth_in(std::size_t{1} << 20);
  CHECK(small > 4);
  CHECK(large > 14 * small);
  CHECK(large < 18 * small);
}

// --- Agendas -------------------------------------------------------------------------------------

struct World {
  sac::Agenda* agenda = nullptr;
  Mod<int> back;
};
void visit(Scope& s, int n) {
  auto& world = s.environment<World>();
  if (const int to = s.read(world.back); n == 5 && to != 0) {
    world.agenda->post<visit>(s, {.bucket = to}, to);
  }
}
void drain(Scope& s) { s.environment<World>().agenda->drain(s); }
void outsider(Scope& s) { s.environment<World>().agenda->post_from_outside<visit>({}, 1); }
void drain_inside(Scope& s, int) { s.environment<World>().agenda->drain(s); }

TEST_CASE("posting into the past, in a first run and in a propagation") {
  const std::string text = "posting into the past: visit(5) posts visit(3) on agenda 'work'";
  for (const bool first : {true, false}) {
    Engine e;
    World world{&e.make_agenda("work"), e.input(first ? 3 : 0)};
    e.set_environment(&world);
    world.agenda->post_from_outside<visit>({.bucket = 5}, 5);
    if (first) {
      CHECK(error_of([&] { e.run<drain>(); }) == text);
    } else {
      e.run<drain>();
      e.set(world.back, 3);
      CHECK(error_of([&] { e.propagate(); }) == text);
    }
    e.check_invariants();
  }
}

TEST_CASE("draining an agenda twice") {
  Engine e;
  World world{&e.make_agenda("work"), e.input(0)};
  e.set_environment(&world);
  e.run<drain>();
  CHECK(error_of([&] { e.run<drain>(); }) == "drain(): agenda 'work' is drained twice");
  Engine inside;
  World other{&inside.make_agenda("work"), inside.input(0)};
  inside.set_environment(&other);
  other.agenda->post_from_outside<drain_inside>({}, 1);
  CHECK(error_of([&] { inside.run<drain>(); }) ==
        "drain_inside(1): agenda 'work' is drained twice; of the first drain drain_inside(1) is "
        "running");
}

TEST_CASE("taking back a post that is not there, and posting while the engine runs") {
  Engine e;
  World world{&e.make_agenda("work"), e.input(0)};
  e.set_environment(&world);
  CHECK(error_of([&] { world.agenda->retract_from_outside<visit>(4); }) ==
        "retract_from_outside: no call visit with these arguments is posted on agenda 'work'");
  CHECK(error_of([&] { e.run<outsider>(); }) ==
        "post_from_outside: the engine is running outsider()");
}

// --- Exceptions that are caught ------------------------------------------------------------------

void refuse(Scope& s, Mod<int> in) {
  if (s.read(in) < 0) throw std::runtime_error("negative");
}
void lenient(Scope& s, Mod<int> in, Mod<int> out) {
  try {
    s.call<refuse>(in);
    s.write(out, 1);
  } catch (const std::runtime_error&) {
    s.write(out, 0);
  }
}
void above(Scope& s, Mod<int> on, Mod<int> in, Mod<int> out) {
  if (s.read(on) != 0) s.call<lenient>(in, out);
}

TEST_CASE("a call that catches what its child throws is told that this does not do") {
  Engine e;
  const auto on = e.input(1), in = e.input(-1), out = e.cell<int>();
  const std::string message = call("lenient", in, out) + " has caught what " + call("refuse", in) +
                              " threw: exceptions of calls must pass";
  CHECK(error_of([&] { e.run<above>(on, in, out); }) == message);
  CHECK(e.live_calls() == 0);

  e.set(in, 1);
  e.propagate();
  e.run<above>(on, in, out);
  sac::EventLog log(e);
  e.set(in, -2);
  // In a propagation the child runs by itself: there is nobody to catch what it throws.
  CHECK_THROWS_AS(e.propagate(), std::runtime_error);
  CHECK(e.get(out) == 1);
  CHECK(log.explain("refuse").find("was set back when " + call("refuse", in) +
                                   " failed (negative)") != std::string::npos);

  e.set(on, 0);
  e.propagate();
  e.set(in, -2);
  e.propagate();
  e.set(on, 1);
  log.clear();
  CHECK(error_of([&] { e.propagate(); }) == message);
  CHECK(log.explain("above").find("was set back when " + call("lenient", in, out) + " failed (" +
                                  message + ")") != std::string::npos);
  CHECK(e.live_calls() == 1);
  e.check_invariants();
}

// --- Objects of the outside ----------------------------------------------------------------------

TEST_CASE("releasing twice, and what the outside has not made") {
  Engine e;
  const auto a = named(e, e.input(1), "a"), b = e.input(2);
  int& object = e.make<int>();
  e.release(a);
  e.release(b);
  e.release(object);
  CHECK(error_of([&] { e.release(a); }) ==
        "release: " + text("a", a) + " has been released already");
  CHECK(error_of([&] { e.release(b); }) ==
        "release: modifiable " + at(b.head()) + " has been released already");
  CHECK(error_of([&] { e.release(object); }) ==
        "release: object " + at(e.arena().handle_of(&object)) + " has been released already");
  int stray = 0;
  CHECK(error_of([&] { e.release(stray); }) == "release: the outside has not made this object");
  e.propagate();
  e.check_invariants();
}

struct Box {
  int number = 7;
  const Box* self = this;  // looks like no modifiable
  sac::Cell<int> first, second;
  std::string text = "box";
};
// Reads what a box holds, if there is one.
void look_into(Scope& s, Mod<Box*> which, Mod<int> out) {
  Box* const box = s.read(which);
  s.write(out, box != nullptr ? s.read(box->second) : 0);
}
void fill(Scope& s, Mod<Box*> which, Mod<int> from) {
  if (Box* const box = s.read(which)) s.write(box->first, s.read(from));
}
void look_at(Scope& s, Mod<int> number, Mod<int> out) { s.write(out, s.read(number)); }

TEST_CASE("what has been released is read still, or written: the release is taken back") {
  Engine e;
  auto& box = e.make<Box>();
  e.set(box.second, 5);
  const auto which = e.input(&box);
  const auto out = e.cell<int>(), number = e.input(1);
  const auto reader = [&] { return "look_into(" + at(which.head()) + ", " + at(out.head()) + ")"; };
  const auto second = at(Mod<int>(box.second).head());
  e.run<look_into>(which, out);

  e.release(box);
  CHECK(error_of([&] { e.run<look_at>(number, e.cell<int>()); }) ==
        "release: " + reader() + " reads modifiable " + second + ", which has been released");
  CHECK(error_of([&] { e.propagate(); }) ==
        "release: " + reader() + " reads modifiable " + second + ", which has been released");
  e.check_invariants();
  e.set(box.second, 6);
  e.propagate();
  CHECK(e.get(out) == 6);

  e.run<fill>(which, number);
  e.release(number);
  CHECK(error_of([&] { e.propagate(); }) == "release: fill(" + at(which.head()) + ", " +
                                                at(number.head()) + ") reads modifiable " +
                                                at(number.head()) + ", which has been released");

  // Nobody reads `first`, but it is written.
  e.run<look_at>(number, out);  // out gets a second version
  e.release(out);
  CHECK(error_of([&] { e.propagate(); }) == "release: " + reader() + " writes modifiable " +
                                                at(out.head()) + ", which has been released");
  auto& other = e.make<Box>();
  e.set(other.second, 9);
  const auto third = e.input(&other);
  e.run<fill>(third, number);
  e.release(other);
  CHECK(error_of([&] { e.propagate(); }) ==
        "release: fill(" + at(third.head()) + ", " + at(number.head()) + ") writes modifiable " +
            at(Mod<int>(other.first).head()) + ", which has been released");

  e.set(which, nullptr);
  e.set(third, nullptr);
  e.release(box);
  e.release(other);
  e.propagate();
  CHECK(e.get(out) == 1);
  e.check_invariants();
}

void only_read(Scope& s, Mod<int> in) { static_cast<void>(s.read(in)); }
void only_write(Scope& s, Mod<int> out) { s.write(out, 1); }
void leaf(Scope&, int) {}
void grow(Scope& s, Mod<int> count) {
  for (int i = s.read(count); i > 0; --i) s.call<leaf>(i);
}

// What says that a modifiable is in use may be the last block in memory.
TEST_CASE("a use that was recorded last keeps a release from being done") {
  Engine e;
  const auto a = e.input(1);
  e.run<only_read>(a);
  e.release(a);
  CHECK_THROWS_AS(e.propagate(), sac::UsageError);
  e.release(a);
  CHECK_THROWS_AS(e.run<only_read>(e.input(1)), sac::UsageError);
  e.undo_edits();

  const auto first = e.input(0), second = e.input(0), out = e.cell<int>();
  e.run<grow>(first);
  e.run<grow>(second);
  e.run<only_write>(out);
  e.set(first, 1);
  e.propagate();
  e.set(second, 1);
  e.propagate();
  e.release(out);
  CHECK_THROWS_AS(e.propagate(), sac::UsageError);
  e.check_invariants();
}

struct Numbers {
  Numbers() {}  // what was there before stays
  std::uint32_t numbers[240];
};
struct Cells {
  sac::Cell<int> cells[40];
};
static_assert(sizeof(Numbers) == sizeof(Cells));
void look_at_all(Scope& s, Mod<Cells*> which) {
  if (Cells* const cells = s.read(which)) {
    for (const auto& cell : cells->cells) static_cast<void>(s.read(cell));
  }
}

TEST_CASE("an object of numbers that look like handles is released like any other") {
  support::Random random(7);
  Engine e;
  const auto which = e.input<Cells*>(nullptr);
  const auto count = e.input(0);
  e.run<look_at_all>(which);
  e.run<grow>(count);
  for (int step = 0; step < 2000; ++step) {
    auto& cells = e.make<Cells>();
    for (auto& cell : cells.cells) e.set(cell, 1);
    e.set(which, &cells);
    e.set(count, random(60));
    e.propagate();
    e.set(which, nullptr);
    e.set(count, 0);
    e.release(cells);
    e.propagate();
    if (step % 3 == 0) e.shrink();
    auto& numbers = e.make<Numbers>();
    for (auto& number : numbers.numbers) {
      if (random(4) == 0) number = static_cast<std::uint32_t>(random(400));
    }
    e.release(numbers);
    e.propagate();
  }
  e.check_invariants();
}

TEST_CASE("a run that reads what has been released is taken back") {
  Engine e;
  auto& box = e.make<Box>();
  e.set(box.second, 5);
  const auto which = e.input(&box);
  const auto out = e.cell<int>();
  e.release(box);
  CHECK(error_of([&] { e.run<look_into>(which, out); }) ==
        "release: look_into(" + at(which.head()) + ", " + at(out.head()) + ") reads modifiable " +
            at(Mod<int>(box.second).head()) + ", which has been released");
  CHECK(e.live_calls() == 0);
  e.propagate();  // now it is free
  e.check_invariants();
}

// --- The environment -----------------------------------------------------------------------------

void use_environment(Scope& s, int) { static_cast<void>(s.environment<World>()); }

TEST_CASE("an environment that nobody gave") {
  Engine e;
  CHECK(error_of([&] { e.run<use_environment>(3); }) ==
        "use_environment(3): there is no environment: Engine::set_environment gives one");
}

}  // namespace
