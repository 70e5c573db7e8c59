// Agendas: order, merging, life of posted calls, placing, posting into the past, roll-back.
#include <catch2/catch.hpp>
#include <map>
#include <memory>
#include <new>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "random.hpp"
#include "sac/sac.hpp"

namespace {

using Catch::Contains;
using sac::Agenda;
using sac::Engine;
using sac::Key;
using sac::Mod;
using sac::Scope;

// What ran, in the order of the trace.
std::vector<std::string> trace(const Engine& e) {
  std::vector<std::string> out;
  e.walk([&](const sac::Call& c, std::size_t) { out.push_back(Engine::describe(c)); });
  return out;
}
std::vector<int> visited(const Engine& e) {
  std::vector<int> out;
  e.walk([&](const sac::Call& c, std::size_t) {
    if (!c.function().posted) return;
    const std::string text = Engine::describe(c);
    out.push_back(std::stoi(text.substr(text.find('(') + 1)));
  });
  return out;
}

struct Program {
  Agenda* agenda = nullptr;
  Agenda* other = nullptr;
  Mod<int> input;
  std::vector<Mod<int>> inputs;
  std::map<int, std::vector<int>> children;  // what visit(n) posts
};

Key key_of(int n) { return {.bucket = n / 100, .order = static_cast<std::uint64_t>(n % 100 / 10)}; }

void visit(Scope& s, int n) {
  auto& p = s.environment<Program>();
  for (const int c : p.children[n]) p.agenda->post<visit>(s, key_of(c), c);
}
void root(Scope& s, Mod<std::vector<int>> posts) {
  auto& p = s.environment<Program>();
  for (const int n : s.read(posts)) p.agenda->post<visit>(s, key_of(n), n);
}
void drain_all(Scope& s) { s.environment<Program>().agenda->drain(s); }

struct Fixture {
  Engine e;
  Program p;
  Mod<std::vector<int>> posts;
  explicit Fixture(std::vector<int> first) : posts(e.input(first)) {
    p.agenda = &e.make_agenda("main");
    e.set_environment(&p);
  }
  void run() {
    e.run<root>(posts);
    e.run<drain_all>();
  }
  sac::Counts post(std::vector<int> now) {
    e.set(posts, now);
    const auto counts = e.propagate();
    e.check_invariants();
    return counts;
  }
};

TEST_CASE("posted calls run by bucket, then order, then arguments, whatever the order of posts") {
  Fixture f({512, 3, 311, 12, 11, 319, -200, 5});
  f.run();
  CHECK(visited(f.e) == std::vector<int>{-200, 3, 5, 11, 12, 311, 319, 512});
  f.e.check_invariants();
}

TEST_CASE("equal posts merge into one call, which lives while one of them does") {
  Fixture f({1, 2, 1, 3, 2});
  f.p.children = {{1, {7}}, {2, {7}}};
  f.run();
  CHECK(visited(f.e) == std::vector<int>{1, 2, 3, 7});
  CHECK(f.post({1, 3}).discarded == 1);
  CHECK(visited(f.e) == std::vector<int>{1, 3, 7});
  CHECK(f.post({3}).discarded == 2);
  CHECK(visited(f.e) == std::vector<int>{3});
}

TEST_CASE("a call posted late into the class that runs takes its turn there") {
  Fixture f({10, 12, 18});
  f.p.children = {{10, {11, 15}}, {11, {13}}, {15, {19}}};
  f.run();
  CHECK(visited(f.e) == std::vector<int>{10, 11, 12, 13, 15, 18, 19});
}

TEST_CASE("a call posted in a propagation is placed between its neighbours") {
  Fixture f({100, 500});
  f.p.children = {{300, {301, 410, 501}}, {410, {411}}};
  f.run();
  for (const auto& posts : {std::vector<int>{100, 300, 500}, {500}, {300}, {700, 1, 300}, {}}) {
    f.post(posts);
    Fixture fresh(posts);
    fresh.p.children = f.p.children;
    fresh.run();
    CHECK(visited(f.e) == visited(fresh.e));
    CHECK(f.e.live_calls() == fresh.e.live_calls());
  }
}

TEST_CASE("a dying call that an earlier call posts again costs nothing") {
  Fixture f({1, 2});
  f.p.children = {{1, {50}}, {2, {}}, {50, {60}}};
  f.run();
  // 1 goes, and with it the post of 50; 0 comes, earlier than 50, and posts it.
  f.p.children[0] = {50};
  const auto counts = f.post({0, 2});
  CHECK(visited(f.e) == std::vector<int>{0, 2, 50, 60});
  CHECK(counts.executed == 2);
  CHECK(counts.created == 1);
  CHECK(counts.discarded == 1);
}

// --- The past ----------------------------------------------------------------------------------

TEST_CASE("posting into the past is an error that names both calls") {
  Fixture f({300});
  f.p.children = {{300, {200}}};
  f.e.run<root>(f.posts);
  CHECK_THROWS_WITH(f.e.run<drain_all>(), Contains("visit(300)") && Contains("visit(200)"));
}

TEST_CASE("a call that posts itself posts into the past") {
  Fixture f({300});
  f.p.children = {{300, {300}}};
  f.e.run<root>(f.posts);
  CHECK_THROWS_WITH(f.e.run<drain_all>(), Contains("past"));
}

TEST_CASE("posting into the past in a propagation is undone with its edit") {
  Fixture f({100});
  f.p.children = {{300, {200}}};
  f.run();
  f.e.set(f.posts, {100, 300});
  CHECK_THROWS_WITH(f.e.propagate(), Contains("past"));
  f.e.check_invariants();
  CHECK(visited(f.e) == std::vector<int>{100});
  f.post({100, 500});
  CHECK(visited(f.e) == std::vector<int>{100, 500});
}

TEST_CASE("a post after the drain is a post into the past") {
  Fixture f({100});
  f.run();
  CHECK_THROWS_WITH(f.e.run<root>(f.e.input(std::vector<int>{900})), Contains("past"));
  f.e.check_invariants();
  CHECK(visited(f.e) == std::vector<int>{100});
}

// --- Children of posted calls --------------------------------------------------------------------

void helper(Scope& s, int n) {
  auto& p = s.environment<Program>();
  const int extra = s.read(p.input);
  if (extra > 0) p.agenda->post<visit>(s, key_of(n + extra), n + extra);
}
void worker(Scope& s, int n) {
  auto& p = s.environment<Program>();
  s.cell<int>(n);
  p.agenda->post<visit>(s, key_of(n + 10), n + 10);
  s.call<helper>(n);
  s.cell<int>(n, 1);
  p.agenda->post<visit>(s, key_of(n + 20), n + 20);
  s.tail<helper>(n + 1);
}
void root_of_workers(Scope& s, Mod<std::vector<int>> posts) {
  auto& p = s.environment<Program>();
  for (const int n : s.read(posts)) p.agenda->post<worker>(s, key_of(n), n);
}

TEST_CASE(
    "a posted call may have children before and after it posts, and they may post as it does") {
  const auto make = [](Engine& e, Program& p, int extra) {
    p.agenda = &e.make_agenda("main");
    p.input = e.input(extra);
    e.set_environment(&p);
  };
  Engine e;
  Program p;
  make(e, p, 0);
  auto posts = e.input(std::vector<int>{100});
  e.run<root_of_workers>(posts);
  e.run<drain_all>();
  int extra = 0;
  for (const int step : {0, 1, 2, 3, 4, 5, 6, 7}) {
    const std::vector<int> now =
        step % 2 == 0 ? std::vector<int>{100, 300} : std::vector<int>{300, 500, 700};
    extra = step % 3 == 0 ? 0 : 50;
    e.set(posts, now);
    e.set(p.input, extra);
    e.propagate();
    e.check_invariants();
    Engine fresh;
    Program q;
    make(fresh, q, extra);
    fresh.run<root_of_workers>(fresh.input(now));
    fresh.run<drain_all>();
    CHECK(visited(e) == visited(fresh));
    CHECK(e.live_calls() == fresh.live_calls());
    CHECK(trace(e).size() == trace(fresh).size());
  }
}

TEST_CASE("a child of a posted call that posts into the past is told so") {
  for (const bool in_first_run : {true, false}) {
    Engine e;
    Program p;
    p.agenda = &e.make_agenda("main");
    p.input = e.input(in_first_run ? -90 : 0);
    e.set_environment(&p);
    struct Back {
      void operator()(Scope& s, int n) const {
        auto& q = s.environment<Program>();
        if (s.read(q.input) < 0) q.agenda->post<visit>(s, key_of(n - 90), n - 90);
      }
    };
    struct Front {
      void operator()(Scope& s, int n) const { s.call<Back{}>(n); }
    };
    p.agenda->post_from_outside<Front{}>(key_of(300), 300);
    if (in_first_run) {
      CHECK_THROWS_WITH(e.run<drain_all>(), Contains("past"));
    } else {
      e.run<drain_all>();
      e.set(p.input, -90);
      CHECK_THROWS_WITH(e.propagate(), Contains("past"));
    }
    e.check_invariants();
  }
}

// --- Outside -------------------------------------------------------------------------------------

TEST_CASE("posts from outside run, merge with others, and are taken back") {
  Fixture f({2});
  f.p.agenda->post_from_outside<visit>(key_of(1), 1);
  f.p.agenda->post_from_outside<visit>(key_of(2), 2);
  f.run();
  CHECK(visited(f.e) == std::vector<int>{1, 2});
  f.p.agenda->post_from_outside<visit>(key_of(0), 0);
  f.p.agenda->retract_from_outside<visit>(1);
  f.p.agenda->retract_from_outside<visit>(2);
  f.e.check_invariants();
  f.e.propagate();
  f.e.check_invariants();
  CHECK(visited(f.e) == std::vector<int>{0, 2});
  CHECK_THROWS_AS(f.p.agenda->retract_from_outside<visit>(1), sac::UsageError);
}

TEST_CASE("edits are undone beyond the memory limit") {
  Fixture f({2});
  f.p.agenda->post_from_outside<visit>(key_of(1), 1);
  f.run();
  f.p.agenda->retract_from_outside<visit>(1);
  f.e.set_memory_limit(0);
  CHECK_THROWS_AS(f.p.agenda->post_from_outside<visit>(key_of(3), 3), std::bad_alloc);
  f.e.undo_edits();
  CHECK(f.e.propagate().discarded == 0);
  CHECK(visited(f.e) == std::vector<int>{1, 2});
  f.e.check_invariants();
}

TEST_CASE("a call posted from outside and taken back before the run does not run") {
  Fixture f({});
  f.p.agenda->post_from_outside<visit>(key_of(1), 1);
  f.p.agenda->retract_from_outside<visit>(1);
  f.run();
  CHECK(visited(f.e).empty());
  f.e.check_invariants();
  CHECK(f.e.live_calls() == 3);
}

void fail_on(Scope& s, int n) {
  auto& p = s.environment<Program>();
  const int bad = s.read(p.input);
  for (const int c : p.children[n]) p.agenda->post<fail_on>(s, key_of(c), c);
  if (bad == n) throw std::runtime_error("bad " + std::to_string(n));
}

TEST_CASE("a failing propagation brings back what was taken back from outside, and discarded") {
  Engine e;
  Program p;
  p.agenda = &e.make_agenda("main");
  p.input = e.input(0);
  p.children = {{100, {200}}};
  e.set_environment(&p);
  for (const int n : {100, 300, 500}) p.agenda->post_from_outside<fail_on>(key_of(n), n);
  e.run<drain_all>();
  const auto calls = e.live_calls();
  const auto edges = e.live_edges();
  for (int round = 0; round < 3; ++round) {
    p.agenda->retract_from_outside<fail_on>(100);
    p.agenda->post_from_outside<fail_on>(key_of(150), 150);
    p.agenda->retract_from_outside<fail_on>(150);
    p.agenda->post_from_outside<fail_on>(key_of(160), 160);
    e.set(p.input, 500);
    CHECK_THROWS_WITH(e.propagate(), "bad 500");
    e.check_invariants();
    CHECK(visited(e) == std::vector<int>{100, 200, 300, 500});
    CHECK(e.live_calls() == calls);
    CHECK(e.live_edges() == edges);
  }
  p.agenda->retract_from_outside<fail_on>(100);
  e.propagate();
  CHECK(visited(e) == std::vector<int>{300, 500});
}

TEST_CASE("a first run that throws in a drain keeps the posts from outside for the next run") {
  Engine e;
  Program p;
  p.agenda = &e.make_agenda("main");
  p.input = e.input(300);
  p.children = {{100, {200, 400}}, {300, {600}}};
  e.set_environment(&p);
  for (const int n : {100, 300, 500}) p.agenda->post_from_outside<fail_on>(key_of(n), n);
  CHECK_THROWS_WITH(e.run<drain_all>(), "bad 300");
  e.check_invariants();
  CHECK(e.live_calls() == 3);
  CHECK(e.live_edges() == 0);
  CHECK(p.agenda->waiting_calls() == 3);
  e.set(p.input, 0);
  e.propagate();
  e.run<drain_all>();
  CHECK(visited(e) == std::vector<int>{100, 200, 300, 400, 500, 600});
  e.check_invariants();
}

TEST_CASE("an agenda is drained once") {
  Fixture f({1});
  f.run();
  CHECK_THROWS_WITH(f.e.run<drain_all>(), Contains("twice"));
  f.e.check_invariants();
}

// --- A drain in a call that runs again
// -------------------------------------------------------------

void post_and_drain(Scope& s, Mod<std::vector<int>> posts, Mod<int> how) {
  auto& p = s.environment<Program>();
  const int mode = s.read(how);
  for (const int n : s.read(posts)) p.agenda->post<fail_on>(s, key_of(n), n);
  if (mode == 1) return;
  if (mode == 2) return s.call<drain_all>();
  p.agenda->drain(s);
}

TEST_CASE("a drain is reused, discarded and made again as any call") {
  const auto make = [](Engine& e, Program& p) {
    p.agenda = &e.make_agenda("main");
    p.input = e.input(0);
    p.children = {{100, {200, 400}}, {300, {600}}, {700, {710}}};
    e.set_environment(&p);
  };
  Engine e;
  Program p;
  make(e, p);
  auto posts = e.input(std::vector<int>{100, 300});
  auto how = e.input(0);
  e.run<post_and_drain>(posts, how);
  int step = 0;
  for (const int mode : {0, 1, 0, 2, 0, 0, 1, 2, 2, 1, 1, 0}) {
    ++step;
    std::vector<int> now{500};
    if (step % 2 == 0) now.push_back(100);
    if (step % 3 == 0) now.push_back(700);
    if (step % 4 == 0) {  // first an edit that fails
      e.set(how, (mode + 1) % 3);
      e.set(p.input, step % 8 == 0 ? 500 : 710);
      e.set(posts, {700, 500, 100});
      if (mode != 0) CHECK_THROWS_AS(e.propagate(), std::runtime_error);
      e.undo_edits();
      e.propagate();
      e.check_invariants();
    }
    e.set(posts, now);
    e.set(how, mode);
    e.propagate();
    e.check_invariants();
    Engine fresh;
    Program q;
    make(fresh, q);
    fresh.run<post_and_drain>(fresh.input(now), fresh.input(mode));
    CHECK(visited(e) == visited(fresh));
    CHECK(e.live_calls() == fresh.live_calls());
    CHECK(e.live_edges() == fresh.live_edges());
  }
}

void post_some(Scope& s, Mod<std::vector<int>> posts, Agenda* agenda) {
  for (const int n : s.read(posts)) agenda->post<visit>(s, key_of(n), n);
}

TEST_CASE("a post that fails leaves no call behind, even where nothing is drained") {
  Engine e;
  auto& agenda = e.make_agenda("undrained");
  const auto posts = e.input(std::vector<int>{});
  e.run<post_some>(posts, &agenda);
  for (std::uint64_t count = 1;; ++count) {
    e.set(posts, {1, 2});
    e.arena().fail_after(count);
    try {
      e.propagate();
      CHECK(count == 5);  // two calls and two posts
      break;
    } catch (const std::bad_alloc&) {
      CHECK(agenda.waiting_calls() == 0);
      CHECK(e.live_calls() == 1);
      e.check_invariants();
    }
  }
  e.arena().fail_after(0);
  CHECK(agenda.waiting_calls() == 2);
}

// --- Random
// ---------------------------------------------------------------------------------------

TEST_CASE("random posts from a call and from outside leave the trace of a fresh run") {
  std::uint64_t state = 2024;
  const auto random = [&](int n) {
    state = sac::mix(state + 0x9e3779b97f4a7c15u);
    return static_cast<int>(state % static_cast<std::uint64_t>(n));
  };
  std::map<int, std::vector<int>> children;
  for (int n = 0; n < 400; ++n) {
    for (int i = random(3); i > 0; --i) children[n].push_back(n + 10 + random(120));
  }
  Fixture f({5, 20});
  f.p.children = children;
  f.run();
  std::multiset<int> outside;
  for (int step = 0; step < 300; ++step) {
    std::vector<int> posts;
    for (int i = random(4); i > 0; --i) posts.push_back(random(300));
    f.e.set(f.posts, posts);
    for (int i = random(3); i > 0; --i) {
      if (!outside.empty() && random(2) == 0) {
        const int n = *outside.begin();
        outside.erase(outside.begin());
        f.p.agenda->retract_from_outside<visit>(n);
      } else {
        const int n = random(300);
        outside.insert(n);
        f.p.agenda->post_from_outside<visit>(key_of(n), n);
      }
    }
    f.e.propagate();
    f.e.check_invariants();
    Fixture fresh(posts);
    fresh.p.children = children;
    for (const int n : outside) fresh.p.agenda->post_from_outside<visit>(key_of(n), n);
    fresh.run();
    INFO("step " << step);
    REQUIRE(visited(f.e) == visited(fresh.e));
    REQUIRE(f.e.live_calls() == fresh.e.live_calls());
    REQUIRE(f.e.live_edges() == fresh.e.live_edges());
  }
}

// --- Posts that are not repeated before a drain ------------------------------------------------

struct Marked {
  Mod<int> in, mark, out;
  Agenda& agenda;
};

void set_mark(Scope& s, int) { s.write(s.environment<Marked>().mark, 1); }
void require_mark(Scope& s) {
  auto& m = s.environment<Marked>();
  const int in = s.read(m.in), mark = s.read(m.mark);
  if (in != mark) throw std::logic_error("the mark is wrong");
  s.write(m.out, mark);
}
void maybe_mark(Scope& s) {
  auto& m = s.environment<Marked>();
  s.write(m.mark, 0);
  if (s.read(m.in) != 0) m.agenda.post<set_mark>(s, {}, 0);
  m.agenda.drain(s);
  s.call<require_mark>();
}

TEST_CASE("a drain that is reused does not hand on what is not posted again") {
  Engine e;
  Marked m{e.input(1), e.cell<int>(), e.cell<int>(), e.make_agenda("marks")};
  e.set_environment(&m);
  e.run<maybe_mark>();
  for (const int in : {0, 1, 0, 0, 1}) {
    e.set(m.in, in);
    e.propagate();
    CHECK(e.get(m.out) == in);
    e.check_invariants();
  }
}

// --- Functions of one name ---------------------------------------------------------------------

struct Claims {
  std::vector<Mod<int>> in, even, odd;
  Agenda& agenda;
};

namespace even {
void claim(Scope& s, int i) {
  s.write(s.environment<Claims>().even[static_cast<std::size_t>(i)], 1);
}
}  // namespace even
namespace odd {
void claim(Scope& s, int i) {
  s.write(s.environment<Claims>().odd[static_cast<std::size_t>(i)], 1);
}
}  // namespace odd

void post_claims(Scope& s, int i) {
  auto& c = s.environment<Claims>();
  const int v = s.read(c.in[static_cast<std::size_t>(i)]);
  if (v % 2 == 1) c.agenda.post<even::claim>(s, {}, i);
  if (v / 2 == 1) c.agenda.post<odd::claim>(s, {}, i);
}
void all_claims(Scope& s) {
  auto& c = s.environment<Claims>();
  for (std::size_t i = 0; i < c.in.size(); ++i) {
    s.write(c.even[i], 0);
    s.write(c.odd[i], 0);
    s.call<post_claims>(static_cast<int>(i));
  }
  c.agenda.drain(s);
}

struct Spell {
  static constexpr std::string_view kName = "spell";
  template <class S, class T>
  void operator()(S& s, T) const;
};
inline constexpr Spell spell{};
template <class S>
struct Spelling {
  typename S::template ModType<int> in, out;
  typename S::AgendaType& agenda;
};
template <class S, class T>
void Spell::operator()(S& s, T) const {
  const auto out = s.template environment<Spelling<S>>().out;
  s.write(out, 10 * s.read(out) + static_cast<int>(sizeof(T)));
}
struct PostSpells {
  static constexpr std::string_view kName = "post_spells";
  template <class S>
  void operator()(S& s) const {
    auto& spelling = s.template environment<Spelling<S>>();
    s.write(spelling.out, 0);
    const bool long_first = s.read(spelling.in) == 1;
    if (long_first) spelling.agenda.template post<spell>(s, {}, 1L);
    spelling.agenda.template post<spell>(s, {}, 1);
    if (!long_first) spelling.agenda.template post<spell>(s, {}, 2L);
    spelling.agenda.drain(s);
  }
};
inline constexpr PostSpells post_spells{};
template <class S>
int spelled(auto& host, int first, int then) {
  Spelling<S> spelling{host.input(first), host.template cell<int>(), host.make_agenda("spells")};
  host.set_environment(&spelling);
  host.template run<post_spells>();
  if constexpr (S::kTraced) {
    host.set(spelling.in, then);
    host.propagate();
    host.check_invariants();
  }
  return host.get(spelling.out);
}

// Which was posted first in the life of the engine must not matter.
TEST_CASE("one function with arguments of two types has one order on an agenda") {
  Engine changed, fresh;
  sac::PlainScope plain;
  const int expected = spelled<sac::PlainScope>(plain, 1, 1);
  CHECK(spelled<Scope>(fresh, 1, 1) == expected);
  CHECK(spelled<Scope>(changed, 0, 1) == expected);
}

TEST_CASE("functions of one name are apart in the order of an agenda") {
  Engine e;
  Claims c{{}, {}, {}, e.make_agenda("claims")};
  support::Random random(1);
  std::vector<int> values;
  for (int i = 0; i < 10; ++i) {
    values.push_back(random(4));
    c.in.push_back(e.input(values.back()));
    c.even.push_back(e.cell<int>());
    c.odd.push_back(e.cell<int>());
  }
  e.set_environment(&c);
  e.run<all_claims>();
  for (int round = 0; round < 200; ++round) {
    const auto i = static_cast<std::size_t>(random(10));
    values[i] = random(4);
    e.set(c.in[i], values[i]);
    e.propagate();
    e.check_invariants();
    for (std::size_t k = 0; k < 10; ++k) {
      REQUIRE(e.get(c.even[k]) == values[k] % 2);
      REQUIRE(e.get(c.odd[k]) == values[k] / 2);
    }
  }
}

TEST_CASE("a call whose post from outside is undone leaves with the next propagation") {
  for (const bool drained : {false, true}) {
    Engine e;
    Program p;
    p.agenda = &e.make_agenda("main");
    e.set_environment(&p);
    if (drained) e.run<drain_all>();
    const auto calls = e.live_calls();
    p.agenda->post_from_outside<visit>(key_of(5), 5);
    p.agenda->post_from_outside<visit>(key_of(7), 7);
    e.undo_edits();
    CHECK(p.agenda->waiting_calls() == (drained ? 0 : 2));
    CHECK_THROWS_WITH(e.release(*p.agenda), Contains("is in use"));
    CHECK(e.propagate().executed == 0);
    CHECK(p.agenda->waiting_calls() == 0);
    CHECK(e.live_calls() == calls);
    e.check_invariants();
    if (!drained) e.release(*p.agenda);
  }
}

// --- Arguments of any type on a plain agenda ----------------------------------------------------

struct Saying {
  static constexpr std::string_view kName = "saying";
  template <class S>
  void operator()(S& s, const std::string& word, const std::shared_ptr<int>& end) const {
    auto& out = *s.template environment<std::pair<std::string*, sac::PlainAgenda*>>().first;
    auto& agenda = *s.template environment<std::pair<std::string*, sac::PlainAgenda*>>().second;
    if (word == "throw") throw std::runtime_error("thrown");
    out += word + ' ';
    if (word.size() < 3) agenda.template post<Saying{}>(s, {}, word + word, end);
  }
};

TEST_CASE("a plain agenda takes arguments of any type, merges equal ones, and destroys them") {
  const auto end = std::make_shared<int>(0);
  const std::string long_word = "a word that is too long to be kept in place";
  std::string said;
  for (const bool fails : {false, true}) {
    said.clear();
    sac::PlainScope s;
    auto& agenda = s.make_agenda("sayings");
    auto environment = std::make_pair(&said, &agenda);
    s.set_environment(&environment);
    for (const char* word : {"b", "aa", "b", "c"}) {
      agenda.post_from_outside<Saying{}>({}, word, end);
    }
    agenda.post_from_outside<Saying{}>({.bucket = 1}, long_word, end);
    agenda.post_from_outside<Saying{}>({}, "aa", end);
    if (fails) agenda.post_from_outside<Saying{}>({}, "throw", end);
    CHECK(end.use_count() == (fails ? 8 : 7));
    if (fails) {
      CHECK_THROWS_AS(agenda.drain(s), std::runtime_error);
    } else {
      agenda.drain(s);
    }
    CHECK(said == "aa aaaa b bb bbbb c cc cccc " + (fails ? "" : long_word + ' '));
  }
  CHECK(end.use_count() == 1);
}

}  // namespace
