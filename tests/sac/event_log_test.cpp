// The event log: exactly what happens, in order, in small programs; and why.
#include "sac/event_log.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdint>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "random_program.hpp"
#include "sac/sac.hpp"

namespace {

using sac::Engine;
using sac::Event;
using sac::EventLog;
using sac::Mod;
using sac::Scope;
using Kind = sac::Event::Kind;
using Lines = std::vector<std::string>;

// An engine, its log, and what has happened since the last look.
struct Watched {
  Engine e;
  EventLog log{e};
  std::size_t seen = 0;

  // Modifiables are @1, @2, ... in the order of naming.
  template <class M>
  M named(M mod, const char* name) {
    e.name(mod, name);
    return mod;
  }
  Mod<int> input(int value, const char* name) { return named(e.input(value), name); }
  Mod<int> cell(const char* name) { return named(e.cell<int>(), name); }

  // The events since the last look. Handles are left out: `'a' (@7)` and `@7` become `'a'` and `@`.
  Lines news() {
    Lines lines;
    for (; seen < log.size(); ++seen) lines.push_back(without_handles(log.line(seen)));
    return lines;
  }
  [[nodiscard]] std::string why(const std::string& label) const {
    return without_handles(log.explain(label));
  }
  static std::string without_handles(const std::string& text) {
    std::string out;
    for (std::size_t i = 0; i < text.size();) {
      const bool bracket = text.compare(i, 3, " (@") == 0;
      if (!bracket && text[i] != '@') {
        out += text[i++];
        continue;
      }
      if (!bracket) out += '@';
      i += bracket ? 3 : 1;
      while (i < text.size() && text[i] >= '0' && text[i] <= '9') ++i;
      if (bracket) ++i;
    }
    return out;
  }
};

// `name` is only there to tell calls apart.
void copy(Scope& s, char, Mod<int> from, Mod<int> to) { s.write(to, s.read(from)); }
void add(Scope& s, Mod<int> a, Mod<int> b, Mod<int> out) { s.write(out, s.read(a) + s.read(b)); }

// --- Reads and writes ------------------------------------------------------------------------

TEST_CASE("a read sees the edit, a write reaches the reader behind it") {
  Watched w;
  const auto a = w.input(1, "a"), b = w.input(2, "b");
  const auto sum = w.cell("sum"), out = w.cell("out");
  w.e.run<add>(a, b, sum);
  CHECK(w.news() == Lines{"run_started", "created add(@, @, @)", "executed add(@, @, @)",
                          "changed modifiable 'sum' in add(@, @, @)", "finished"});
  w.e.run<copy>('x', sum, out);
  w.news();
  w.e.set(a, 5);
  CHECK(w.news() == Lines{"edited modifiable 'a'", "invalidated add(@, @, @) at modifiable 'a'"});
  w.e.propagate();
  CHECK(w.news() == Lines{"propagation_started", "executed add(@, @, @)",
                          "changed modifiable 'sum' in add(@, @, @)",
                          "invalidated copy(x, @, @) at modifiable 'sum' by add(@, @, @)",
                          "executed copy(x, @, @)", "changed modifiable 'out' in copy(x, @, @)",
                          "finished"});
  CHECK(
      w.why("copy(") ==
      "copy(x, @, @) ran again because modifiable 'sum' changed,\n"
      "  written by add(@, @, @), which ran again because modifiable 'a' was set from outside.\n");
}

TEST_CASE("an equal value set or written invalidates nobody") {
  Watched w;
  const auto a = w.input(1, "a"), b = w.input(2, "b");
  const auto sum = w.cell("sum"), out = w.cell("out");
  w.e.run<add>(a, b, sum);
  w.e.run<copy>('x', sum, out);
  w.news();
  w.e.set(a, 1);
  w.e.propagate();
  CHECK(w.news() == Lines{"propagation_started", "finished"});
  w.e.set(a, 2);
  w.e.set(b, 1);
  w.e.propagate();
  CHECK(w.news() == Lines{"edited modifiable 'a'", "invalidated add(@, @, @) at modifiable 'a'",
                          "edited modifiable 'b'", "invalidated add(@, @, @) at modifiable 'b'",
                          "propagation_started", "executed add(@, @, @)", "finished"});
  CHECK(w.why("add(") ==
        "add(@, @, @) ran again because modifiable 'a' was set from outside and "
        "modifiable 'b' was set from outside.\n");
  CHECK(w.why("copy(") == "copy(x, @, @) is new: run from outside.\n");
}

void copy_if(Scope& s, Mod<int> from, Mod<int> to) { s.write(to, s.read(from)); }

TEST_CASE("a function of exactly this name comes before others that contain it") {
  Watched w;
  const auto a = w.input(1, "a");
  const auto out = w.cell("out"), other = w.cell("other");
  w.e.run<copy>('x', a, out);
  w.e.run<copy_if>(a, other);
  CHECK(w.why("copy") == "copy(x, @, @) is new: run from outside.\n");
  CHECK(w.why("copy_i") == "copy_if(@, @) is new: run from outside.\n");
}

TEST_CASE("a call that would read what it has read does not run again") {
  Watched w;
  const auto a = w.input(1, "a");
  const auto out = w.cell("out");
  w.e.run<copy>('x', a, out);
  w.news();
  w.e.set(a, 2);
  w.e.set(a, 1);
  const sac::Counts counts = w.e.propagate();
  CHECK(counts.confirmed == 1);
  CHECK(counts.executed == 0);
  CHECK(w.news() == Lines{"edited modifiable 'a'", "invalidated copy(x, @, @) at modifiable 'a'",
                          "edited modifiable 'a'", "propagation_started", "confirmed copy(x, @, @)",
                          "finished"});
  CHECK(w.why("copy") == "copy(x, @, @) did not run again: it would have read the same values.\n");
  w.e.set(a, 3);
  w.e.propagate();
  CHECK(w.why("copy") == "copy(x, @, @) ran again because modifiable 'a' was set from outside.\n");
}

// Writes `value` to `out` unless it is negative.
void maybe(Scope& s, char, Mod<int> value, Mod<int> out) {
  if (const int v = s.read(value); v >= 0) s.write(out, v);
}

TEST_CASE("of a modifiable written more than once only the readers behind a write are told") {
  Watched w;
  const auto a = w.input(1, "a"), b = w.input(-1, "b");
  const auto m = w.cell("m"), first = w.cell("first"), second = w.cell("second");
  w.e.run<maybe>('a', a, m);
  w.e.run<copy>('1', m, first);
  w.e.run<maybe>('b', b, m);
  w.e.run<copy>('2', m, second);
  w.news();
  w.e.set(b, 7);  // a write appears
  w.e.propagate();
  CHECK(w.news() == Lines{"edited modifiable 'b'", "invalidated maybe(b, @, @) at modifiable 'b'",
                          "propagation_started", "executed maybe(b, @, @)",
                          "changed modifiable 'm' in maybe(b, @, @)",
                          "invalidated copy(2, @, @) at modifiable 'm' by maybe(b, @, @)",
                          "executed copy(2, @, @)", "changed modifiable 'second' in copy(2, @, @)",
                          "finished"});
  w.e.set(b, -1);  // and goes
  w.e.propagate();
  CHECK(w.news() == Lines{"edited modifiable 'b'", "invalidated maybe(b, @, @) at modifiable 'b'",
                          "propagation_started", "executed maybe(b, @, @)",
                          "reverted modifiable 'm' in maybe(b, @, @)",
                          "invalidated copy(2, @, @) at modifiable 'm' by maybe(b, @, @)",
                          "executed copy(2, @, @)", "changed modifiable 'second' in copy(2, @, @)",
                          "finished"});
  CHECK(w.why("copy(2") ==
        "copy(2, @, @) ran again because modifiable 'm' changed,\n"
        "  no longer written by maybe(b, @, @), which ran again because modifiable 'b' was set "
        "from outside.\n");
  w.e.set(b, 1);  // one of the same value disturbs nobody
  w.e.propagate();
  CHECK(w.news() == Lines{"edited modifiable 'b'", "invalidated maybe(b, @, @) at modifiable 'b'",
                          "propagation_started", "executed maybe(b, @, @)", "finished"});
}

// --- Calls and keyed objects -----------------------------------------------------------------

void leaf(Scope& s, int k, Mod<int> in, Mod<int> out) { s.write(out, s.read(in) + k); }
void grow(Scope& s, Mod<int> count, Mod<int> in) {
  for (int k = s.read(count); k > 0; --k) s.call<leaf>(k, in, s.cell<int>(k));
}

TEST_CASE("calls and keyed objects are created, kept and discarded with the call that asks") {
  Watched w;
  const auto count = w.input(1, "count"), in = w.input(5, "in");
  w.e.run<grow>(count, in);
  CHECK(w.news() == Lines{"run_started", "created grow(@, @)", "executed grow(@, @)",
                          "created make Cell(1) by grow(@, @)",
                          "created leaf(1, @, @) by grow(@, @)", "executed leaf(1, @, @)",
                          "changed modifiable @ in leaf(1, @, @)", "finished"});
  w.e.set(count, 2);
  w.e.propagate();
  CHECK(w.news() ==
        Lines{"edited modifiable 'count'", "invalidated grow(@, @) at modifiable 'count'",
              "propagation_started", "executed grow(@, @)", "created make Cell(2) by grow(@, @)",
              "created leaf(2, @, @) by grow(@, @)", "executed leaf(2, @, @)",
              "changed modifiable @ in leaf(2, @, @)", "reused make Cell(1) by grow(@, @)",
              "reused leaf(1, @, @) by grow(@, @)", "finished"});
  const std::string cause =
      "grow(@, @), which ran again because modifiable 'count' was set from "
      "outside.\n";
  CHECK(w.why("leaf(2") == "leaf(2, @, @) is new,\n  asked for by " + cause);
  CHECK(w.why("leaf(1") == "leaf(1, @, @) was kept,\n  asked for again by " + cause);
  CHECK(w.why("make Cell(2)") == "make Cell(2) is new,\n  asked for by " + cause);
  CHECK(w.why("make Cell") == "make Cell(1) was kept,\n  asked for again by " + cause +
                                  "(The last of 2 calls 'make Cell'.)\n");
  w.e.set(count, 0);
  w.e.propagate();
  CHECK(w.news() ==
        Lines{"edited modifiable 'count'", "invalidated grow(@, @) at modifiable 'count'",
              "propagation_started", "executed grow(@, @)", "discarded make Cell(2) by grow(@, @)",
              "discarded leaf(2, @, @) by grow(@, @)",
              "reverted modifiable @ in leaf(2, @, @) by grow(@, @)",
              "discarded make Cell(1) by grow(@, @)", "discarded leaf(1, @, @) by grow(@, @)",
              "reverted modifiable @ in leaf(1, @, @) by grow(@, @)", "finished"});
  CHECK(w.why("leaf(2") == "leaf(2, @, @) was discarded,\n  not asked for again by " + cause);
  CHECK(w.why("grow") == "grow(@, @) ran again because modifiable 'count' was set from outside.\n");
  CHECK(w.why("shrink") == "No call 'shrink' is in the log.\n");
}

void writer(Scope& s, int, Mod<int> out) { s.write(out, 1); }
void write_if(Scope& s, Mod<int> on, Mod<int> base, Mod<int> out) {
  s.call<copy>('b', base, out);
  if (s.read(on) == 1) s.call<writer>(7, out);
}

TEST_CASE("what a discarded call wrote is no longer seen") {
  Watched w;
  const auto on = w.input(1, "on"), base = w.input(9, "base");
  const auto m = w.cell("m"), out = w.cell("out");
  w.e.run<write_if>(on, base, m);
  w.e.run<copy>('x', m, out);
  w.e.set(on, 0);
  w.e.propagate();
  CHECK(w.why("copy(x") ==
        "copy(x, @, @) ran again because modifiable 'm' changed,\n"
        "  no longer written by writer(7, @), which was discarded,\n"
        "  not asked for again by write_if(@, @, @), which ran again because modifiable 'on' was "
        "set from outside.\n");
}

void count_down(Scope& s, Mod<int> in, int n) {
  s.read(in);
  if (n > 0) s.tail<count_down>(in, n - 1);
}
void start(Scope& s, Mod<int> n, Mod<int> in) { s.call<count_down>(in, s.read(n)); }

TEST_CASE("the middle of a long explanation is left out") {
  Watched w;
  const auto n = w.input(100, "n"), in = w.input(0, "in");
  w.e.run<start>(n, in);
  const std::string text = w.why(", 0)");
  CHECK(std::count(text.begin(), text.end(), '\n') == 13);
  CHECK_THAT(text, Catch::StartsWith("count_down(@, 0) is new,\n  asked for by count_down(@, 1)"));
  CHECK_THAT(text, Catch::Contains("  (90 more)\n"));
  CHECK_THAT(text, Catch::EndsWith("asked for by start(@, @), which is new: run from outside.\n"));
}

// --- Results -----------------------------------------------------------------------------------

TEST_CASE("an explanation through many calls reads the log a few times, not once for each call") {
  constexpr int kCalls = 100'000;
  Engine e;
  std::vector<Mod<int>> mods{e.input(0)};
  for (int i = 0; i < kCalls; ++i) {
    mods.push_back(e.cell<int>());
    e.run<copy>('a', mods[mods.size() - 2], mods.back());
  }
  EventLog log(e);
  e.set(mods.front(), 1);
  e.propagate();
  const std::string text = log.explain("copy");
  CHECK_THAT(text, Catch::Contains("  (" + std::to_string(kCalls - 12) + " more)\n") ||
                       Catch::Contains("  (" + std::to_string(kCalls - 11) + " more)\n"));
  CHECK_THAT(text, Catch::Contains(" was set from outside.\n"));
}

int half(Scope& s, Mod<int> in) { return s.read(in) / 2; }
void quarter(Scope& s, Mod<int> in, Mod<int> out) { s.write(out, s.call<half>(in) / 2); }

TEST_CASE("a result that changes runs its caller again, one that does not, does not") {
  Watched w;
  const auto in = w.input(8, "in");
  const auto out = w.cell("out");
  w.e.run<quarter>(in, out);
  CHECK(w.news() == Lines{"run_started", "created quarter(@, @)", "executed quarter(@, @)",
                          "created half(@) by quarter(@, @)", "executed half(@)",
                          "changed modifiable 'out' in quarter(@, @)", "finished"});
  w.e.set(in, 12);
  w.e.propagate();
  CHECK(w.news() == Lines{"edited modifiable 'in'", "invalidated half(@) at modifiable 'in'",
                          "propagation_started", "executed half(@)",
                          "returned quarter(@, @) by half(@)",
                          "invalidated quarter(@, @) by half(@)", "executed quarter(@, @)",
                          "reused half(@) by quarter(@, @)",
                          "changed modifiable 'out' in quarter(@, @)", "finished"});
  CHECK(w.why("quarter") ==
        "quarter(@, @) ran again because the result of half(@) changed,\n"
        "  half(@) ran again because modifiable 'in' was set from outside.\n");
  w.e.set(in, 13);
  w.e.propagate();
  CHECK(w.news() == Lines{"edited modifiable 'in'", "invalidated half(@) at modifiable 'in'",
                          "propagation_started", "executed half(@)", "finished"});
}

// --- Agendas -------------------------------------------------------------------------------------

struct World {
  sac::Agenda* agenda;
  Mod<int> wanted;
};
sac::Key key(int n) { return {.bucket = n}; }
void visit(Scope& s, int n) {
  if (n == 1 && s.read(s.environment<World>().wanted) == 3) {
    s.environment<World>().agenda->post<visit>(s, key(3), 3);
  }
}
// Reads `wanted` twice: two reads, two invalidations.
void post(Scope& s) {
  auto& world = s.environment<World>();
  for (const int n : {1, 2}) {
    if (s.read(world.wanted) >= n) world.agenda->post<visit>(s, key(n), n);
  }
  world.agenda->drain(s);
}

TEST_CASE("posts make calls, their end makes calls go") {
  Watched w;
  World world{&w.e.make_agenda("work"), w.input(1, "wanted")};
  w.e.set_environment(&world);
  w.e.run<post>();
  CHECK(w.news() == Lines{"run_started", "created post()", "executed post()",
                          "created visit(1) by post()", "posted visit(1) by post()",
                          "created drain(work) by post()", "executed drain(work)",
                          "executed visit(1)", "finished"});
  w.e.set(world.wanted, 3);
  w.e.propagate();
  const Lines news = w.news();
  CHECK(news == Lines{"edited modifiable 'wanted'", "invalidated visit(1) at modifiable 'wanted'",
                      "invalidated post() at modifiable 'wanted'",
                      "invalidated post() at modifiable 'wanted'", "propagation_started",
                      "executed post()", "created visit(2) by post()", "posted visit(2) by post()",
                      "reused drain(work) by post()", "executed visit(1)",
                      "created visit(3) by visit(1)", "posted visit(3) by visit(1)",
                      "executed visit(2)", "executed visit(3)", "finished"});
  CHECK(w.why("visit(3)") ==
        "visit(3) is new,\n  posted by visit(1), which ran again because modifiable 'wanted' was "
        "set from outside.\n");
  w.e.set(world.wanted, 1);
  w.e.propagate();
  CHECK(w.news() ==
        Lines{"edited modifiable 'wanted'", "invalidated visit(1) at modifiable 'wanted'",
              "invalidated post() at modifiable 'wanted'",
              "invalidated post() at modifiable 'wanted'", "propagation_started", "executed post()",
              "unposted visit(2) by post()", "reused drain(work) by post()", "executed visit(1)",
              "unposted visit(3) by visit(1)", "dying visit(2) by post()",
              "discarded visit(2) by post()", "dying visit(3) by post()",
              "discarded visit(3) by post()", "finished"});
  CHECK(w.why("visit(2)") ==
        "visit(2) was discarded: nobody posts it any more,\n"
        "  last posted by post(), which ran again because modifiable 'wanted' was set from "
        "outside.\n");
}

void visit_with_child(Scope& s, int n) { s.call<count_down>(s.environment<Mod<int>>(), n); }
void drain(Scope& s, sac::Agenda* agenda) { agenda->drain(s); }

TEST_CASE("posts from outside are edits; children go with the call that nobody posts") {
  Watched w;
  auto& agenda = w.e.make_agenda("work");
  auto in = w.input(0, "in");
  w.e.set_environment(&in);
  agenda.post_from_outside<visit_with_child>(key(4), 0);
  w.e.run<drain>(&agenda);
  w.news();
  CHECK(w.why("visit_with") == "visit_with_child(0) is new: posted from outside.\n");
  agenda.retract_from_outside<visit_with_child>(0);
  w.e.propagate();
  CHECK(w.news() == Lines{"unposted visit_with_child(0)", "propagation_started",
                          "dying visit_with_child(0)", "discarded count_down(@, 0)",
                          "discarded visit_with_child(0)", "finished"});
  CHECK(w.why("visit_with") == "visit_with_child(0) was discarded: nobody posts it any more.\n");
  CHECK(w.why("count_down") ==
        "count_down(@, 0) was discarded with visit_with_child(0), which nobody posts any "
        "more.\n");
}

// --- Failures ------------------------------------------------------------------------------------

void refuse(Scope& s, Mod<int> in, Mod<int> out) {
  const int v = s.read(in);
  if (v < 0) throw std::runtime_error("negative");
  s.write(out, v);
}

TEST_CASE("a propagation that fails says what is set back") {
  Watched w;
  const auto a = w.input(1, "a");
  const auto out = w.cell("out"), last = w.cell("last");
  w.e.run<copy>('x', a, out);
  w.e.run<refuse>(a, last);
  w.news();
  w.e.set(a, -1);
  CHECK_THROWS_AS(w.e.propagate(), std::runtime_error);
  CHECK(w.news() == Lines{"edited modifiable 'a'", "invalidated refuse(@, @) at modifiable 'a'",
                          "invalidated copy(x, @, @) at modifiable 'a'", "propagation_started",
                          "executed copy(x, @, @)", "changed modifiable 'out' in copy(x, @, @)",
                          "executed refuse(@, @)", "failed refuse(@, @): negative",
                          "reverted modifiable 'last' in refuse(@, @)", "invalidated refuse(@, @)",
                          "roll_back_started: negative", "edited modifiable 'a'",
                          "invalidated refuse(@, @) at modifiable 'a'",
                          "invalidated copy(x, @, @) at modifiable 'a'", "executed copy(x, @, @)",
                          "changed modifiable 'out' in copy(x, @, @)", "executed refuse(@, @)",
                          "changed modifiable 'last' in refuse(@, @)", "finished"});
  CHECK(w.why("copy(") ==
        "copy(x, @, @) ran again because modifiable 'a' was set back when refuse(@, @) failed "
        "(negative).\n");
}

void measure(Scope& s, sac::List<int> list, Mod<int> out) {
  s.write(out, static_cast<int>(sac::fetch(s, sac::size(s, list))));
}

TEST_CASE("a release that is refused says so") {
  Watched w;
  const auto a = w.input(1, "a");
  w.e.run<copy>('x', a, w.cell("out"));
  w.e.set(a, 2);
  w.e.release(a);
  CHECK_THROWS_AS(w.e.propagate(), sac::UsageError);
  CHECK(w.why("copy(") ==
        "copy(x, @, @) ran again because modifiable 'a' was set back when the propagation failed "
        "(release: copy(x, @, @) reads modifiable 'a', which has been released).\n");
}

TEST_CASE("a list is named by its handle") {
  Watched w;
  sac::Sequence<int> numbers(w.e, {1, 2});
  w.e.run<measure>(numbers.list(), w.cell("out"));
  CHECK(w.why("measure") == "measure(@, @) is new: run from outside.\n");
}

TEST_CASE("a run that fails is discarded") {
  Watched w;
  const auto a = w.input(-1, "a");
  CHECK_THROWS_AS(w.e.run<refuse>(a, w.cell("out")), std::runtime_error);
  CHECK(w.news() == Lines{"run_started", "created refuse(@, @)", "executed refuse(@, @)",
                          "failed refuse(@, @): negative", "invalidated refuse(@, @)",
                          "roll_back_started: negative", "discarded refuse(@, @)", "finished"});
  CHECK(w.why("refuse") == "refuse(@, @) was discarded because refuse(@, @) failed (negative).\n");
}

// --- A structure of the client's -----------------------------------------------------------------

// A number that calls look at.
class Dial : public sac::Structure {
 public:
  explicit Dial(Engine& engine) : engine_(engine), id_(engine.add_structure(*this)) {}
  int look(Scope& s) {
    reader_ = &s.self();
    const auto same = [](const sac::Edge&) { return true; };
    edge_ = s.recall<sac::Edge>(id_, 0, same);
    if (edge_ == nullptr) edge_ = &s.observe<sac::Edge>(id_, 0);
    return value_;
  }
  void turn(int value) {
    engine_.begin_edit();
    engine_.on_rollback([this, old = value_] { value_ = old; });
    engine_.invalidate(*reader_, edge_);
    value_ = value;
  }
  void retract(sac::Call&, sac::Edge&) noexcept override {}
  void print(const sac::Call&, const sac::Edge&, std::ostream& out) const override {
    out << "dial at " << value_;
  }

 private:
  Engine& engine_;
  std::uint8_t id_;
  int value_ = 1;
  sac::Call* reader_ = nullptr;
  sac::Edge* edge_ = nullptr;
};
void watch(Scope& s, Mod<int> out) { s.write(out, s.environment<Dial>().look(s)); }

TEST_CASE("a structure of the client says what was seen of it") {
  Watched w;
  Dial dial(w.e);
  w.e.set_environment(&dial);
  w.e.run<watch>(w.cell("out"));
  w.news();
  dial.turn(3);
  w.e.propagate();
  CHECK(w.news() == Lines{"invalidated watch(@) at what it saw (dial at 1)", "propagation_started",
                          "executed watch(@)", "changed modifiable 'out' in watch(@)", "finished"});
  CHECK(w.why("watch") == "watch(@) ran again because what it saw (dial at 1) changed.\n");
}

// --- Counting
// --------------------------------------------------------------------------------------

TEST_CASE("events are counted by kind and by function") {
  Watched w;
  const auto count = w.input(3, "count"), in = w.input(5, "in");
  w.e.run<grow>(count, in);
  w.e.set(in, 6);
  w.e.propagate();
  CHECK(w.log.count(Kind::executed) == 1 + 3 + 3);
  CHECK(w.log.count(Kind::executed, "leaf") == 6);
  CHECK(w.log.count(Kind::created, "make Cell") == 3);
  CHECK(w.log.count(Kind::discarded, "leaf") == 0);
  CHECK(w.log.count(Kind::executed, "nobody") == 0);
  std::ostringstream table;
  w.log.print_counts(table);
  CHECK(table.str() ==
        "outside: run_started 1, propagation_started 1, finished 2, edited 1\n"
        "grow: executed 1, created 1\n"
        "leaf: changed 6, invalidated 3, executed 6, created 3\n"
        "make Cell: created 3\n");
  std::ostringstream all;
  w.log.print(all);
  const std::string text = all.str();
  CHECK(static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')) == w.log.size());
  w.log.clear();
  CHECK(w.log.size() == 0);
  CHECK(w.log.count(Kind::executed) == 0);
}

TEST_CASE("the engine forgets a log that is gone, and the names of what is freed") {
  Engine e;
  const auto a = e.input(1);
  {
    EventLog log(e);
    CHECK(e.observer() == &log);
  }
  CHECK(e.observer() == nullptr);
  e.name(a, "old");
  e.release(a);
  e.propagate();
  const auto b = e.input(2);
  REQUIRE(b == a);
  CHECK(e.describe_mod(b.head()) == "modifiable @" + std::to_string(b.head().handle()));
}

// Prints badly.
struct Sullen {
  friend bool operator==(const Sullen&, const Sullen&) = default;
  friend std::uint64_t hash_value(const Sullen&) { return 1; }
  friend std::ostream& operator<<(std::ostream&, const Sullen&) { throw std::runtime_error("no"); }
};
void sulk(Scope&, Sullen) {}

TEST_CASE("an event that cannot be written down is counted as lost, and the engine goes on") {
  Watched w;
  w.e.run<sulk>(Sullen{});
  CHECK(w.news() == Lines{"run_started", "finished"});
  CHECK(w.log.lost() == 2);
}

// The counts of a propagation are the events told in it, and a log changes nothing.
TEST_CASE("in random programs the log tells what the engine counts, failures included") {
  using namespace support;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const RandomProgram text(seed, 4 + random(10));
    RandomWorld<Scope> world, silent_world;
    Engine e, silent;
    EventLog log(e);
    world.start(e, text, {});
    silent_world.start(silent, text, {});
    world.run(e, {});
    silent_world.run(silent, {});
    for (int step = 0; step < 20; ++step) {
      const auto i = static_cast<std::size_t>(random(4));
      const int value = random(5);
      log.clear();
      e.set(world.inputs[i], value);
      silent.set(silent_world.inputs[i], value);
      world.fuse = silent_world.fuse = random(3) == 0 ? random(10) : -1;
      bool failed = false;
      sac::Counts counts, expected;
      try {
        counts = e.propagate();
      } catch (const Failure&) {
        failed = true;
      }
      try {
        expected = silent.propagate();
      } catch (const Failure&) {
        REQUIRE(failed);
      }
      CHECK(log.lost() == 0);
      CHECK(log.count(Kind::finished) == 1);
      CHECK((log.count(Kind::failed) > 0) == failed);
      CHECK((log.count(Kind::roll_back_started) > 0) == failed);
      if (failed) continue;
      CHECK(counts.executed == expected.executed);
      CHECK(log.count(Kind::executed) == counts.executed);
      CHECK(log.count(Kind::reused) == counts.reused);
      CHECK(log.count(Kind::created) == counts.created);
      REQUIRE(e.live_calls() == silent.live_calls());
      for (std::size_t k = 0; k < log.size(); ++k) CHECK_FALSE(log.line(k).empty());
      e.walk([&](const sac::Call& c, std::size_t) { CHECK_FALSE(log.explain(c).empty()); });
    }
  }
}

}  // namespace
