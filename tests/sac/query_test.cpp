// Queries: one call for a label, on demand, where it is first asked for.
#include "sac/query.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "failing_new.hpp"
#include "sac/sac.hpp"

namespace {

// Targets that are built of others; a program asks for some of them.
template <class S>
struct Project {
  std::vector<typename S::template ModType<std::vector<int>>> needs;
  std::vector<typename S::template ModType<int>> source;
  typename S::template ModType<std::vector<int>> wanted;
  typename S::template ModType<std::int64_t> built;
};

struct Build {
  template <class S>
  std::int64_t operator()(S& s, int target) const {
    auto& p = s.template environment<Project<S>>();
    const auto index = static_cast<std::size_t>(target);
    std::int64_t made = s.read(p.source[index]) % 1000;
    for (const int n : s.read(p.needs[index])) made = 31 * made + s.template query<Build{}>(n);
    return made;
  }
};
inline constexpr Build build{};

struct BuildAll {
  template <class S>
  void operator()(S& s) const {
    auto& p = s.template environment<Project<S>>();
    std::int64_t all = 0;
    for (const int t : s.read(p.wanted)) all = 7 * all + s.template query<build>(t);
    s.write(p.built, all);
  }
};
inline constexpr BuildAll build_all{};

template <class Host, class S>
struct Built {
  Host host;
  Project<S> project;

  explicit Built(const std::vector<std::vector<int>>& needs, const std::vector<int>& wanted) {
    int n = 0;
    for (const auto& ids : needs) {
      project.needs.push_back(host.template input<std::vector<int>>(ids));
      project.source.push_back(host.template input<int>(++n));
    }
    project.wanted = host.template input<std::vector<int>>(wanted);
    project.built = host.template cell<std::int64_t>();
    host.set_environment(&project);
    host.template run<build_all>();
  }
};
using Traced = Built<sac::Engine, sac::Scope>;
using Plain = Built<sac::PlainScope, sac::PlainScope>;

std::string shape(const sac::Engine& e) {
  std::string text;
  e.walk([&](const sac::Call& c, std::size_t depth) {
    text += std::to_string(depth) + sac::Engine::describe(c) + ' ';
  });
  return text;
}

const std::vector<std::vector<int>> kNeeds{{2, 3}, {3, 4}, {}, {5}, {}, {}};

TEST_CASE("a query runs once, however often it is asked for") {
  Traced t(kNeeds, {0, 1});
  CHECK(shape(t.host) ==
        "0BuildAll() 1Build(0) 2Build(2) 2Build(3) 3Build(5) 1Build(1) 2Build(4) ");
  Plain plain(kNeeds, {0, 1});
  CHECK(t.host.get(t.project.built) == plain.host.get(plain.project.built));
  CHECK(t.host.queries().size() == 6);
}

TEST_CASE("who has asked runs again only if the value is another one") {
  Traced t(kNeeds, {0, 1});
  t.host.set(t.project.source[5], 1006);  // the same modulo 1000
  CHECK(t.host.propagate().executed == 1);
  t.host.set(t.project.source[5], 7);
  const auto work = t.host.propagate();
  CHECK(work.executed == 5);  // 5, 3, 0, 1 and all
  CHECK(work.created + work.discarded == 0);
}

TEST_CASE("a query moves to who asks first now, and nobody else runs") {
  Traced t(kNeeds, {0, 1});
  t.host.set(t.project.needs[0], {2});
  auto work = t.host.propagate();
  CHECK(shape(t.host) ==
        "0BuildAll() 1Build(0) 2Build(2) 1Build(1) 2Build(3) 3Build(5) 2Build(4) ");
  CHECK(work.discarded == 2);  // 3 and 5
  CHECK(work.created == 2);
  CHECK(work.executed == 5);  // 0, 1, 3, 5 and all, since the value of 0 is another one
  t.host.set(t.project.needs[2], {3});
  work = t.host.propagate();
  CHECK(shape(t.host) ==
        "0BuildAll() 1Build(0) 2Build(2) 3Build(3) 4Build(5) 1Build(1) 2Build(4) ");
  t.host.check_invariants();
}

TEST_CASE("what nobody asks for is neither computed nor kept") {
  Traced t(kNeeds, {1});
  CHECK(t.host.queries().size() == 4);
  const std::size_t before = t.host.bytes();
  t.host.set(t.project.wanted, {1, 0});
  t.host.propagate();
  CHECK(t.host.queries().size() == 6);
  t.host.set(t.project.wanted, {1});
  t.host.propagate();
  CHECK(t.host.queries().size() == 4);
  t.host.set(t.project.wanted, {});
  t.host.propagate();
  CHECK(t.host.queries().size() == 0);
  CHECK(t.host.live_calls() == 1);
  t.host.set(t.project.wanted, {1});
  t.host.propagate();
  CHECK(t.host.bytes() <= before + 256);
}

TEST_CASE("a query that needs its own result is refused with the cycle, and nothing is lost") {
  const std::string cycle =
      "a query needs its own result: Build(0) asks for Build(3) asks for Build(5) asks for "
      "Build(0)";
  Traced t(kNeeds, {1, 0});
  const std::string before = shape(t.host);
  const std::int64_t built = t.host.get(t.project.built);
  t.host.set(t.project.needs[5], {0});
  CHECK_THROWS_WITH(t.host.propagate(), cycle);
  CHECK(shape(t.host) == before);
  CHECK(t.host.get(t.project.built) == built);
  t.host.check_invariants();
  auto needs = kNeeds;
  needs[5] = {0};
  CHECK_THROWS_WITH(Traced(needs, {1, 0}), cycle);
  CHECK_THROWS_WITH(Plain(needs, {1, 0}), cycle);
  needs[0] = {0};
  CHECK_THROWS_WITH(Traced(needs, {0}), "a query needs its own result: Build(0) asks for Build(0)");
}

// --- Arguments and results ---------------------------------------------------------------------

struct Once {
  template <class S>
  void operator()(S& s, const std::string& word, typename S::template ModType<int> count) const {
    s.write(count, s.read(count) + static_cast<int>(word.size()));
  }
};
inline constexpr Once once{};
struct Root {
  template <class S>
  void operator()(S& s, typename S::template ModType<int> count) const {
    s.write(count, 0);
    s.template query<once>("four", count);
    s.template query<once>(std::string("four"), count);
    s.template query<once>(std::string_view("three"), count);
  }
};
inline constexpr Root root{};

template <class Host>
int counted() {
  Host host;
  const auto count = host.template cell<int>();
  host.template run<root>(count);
  return host.get(count);
}

TEST_CASE("a query without a result is done once") {
  CHECK(counted<sac::Engine>() == 9);
  CHECK(counted<sac::PlainScope>() == 9);
}

double half(sac::Scope&, double x) { return x / 2; }
std::vector<int> upto(sac::Scope& s, unsigned n) {
  if (n == 0) return {};
  std::vector<int> all = s.query<upto>(n - 1);
  all.push_back(static_cast<int>(n));
  return all;
}
void ask_both(sac::Scope& s, sac::Mod<double> in, sac::Mod<double> out, sac::Mod<int> size) {
  s.write(out, s.query<half>(s.read(in)));
  const std::vector<int>& all = s.query<upto>(3);
  s.write(size, static_cast<int>(all.size()));
}

TEST_CASE("arguments and results are compared by value, numbers by their bits") {
  sac::Engine e;
  const auto in = e.input(0.0);
  const auto out = e.cell<double>();
  const auto size = e.cell<int>();
  e.run<ask_both>(in, out, size);
  CHECK(e.get(size) == 3);
  e.set(in, -0.0);
  e.propagate();
  CHECK(std::signbit(e.get(out)));
}

// An object that a query makes is there for all that ask.
struct Box {
  sac::Cell<int> value;
};
const Box* boxed(sac::Scope& s, sac::Mod<int> in) {
  Box& box = s.make<Box>(1);
  s.write(box.value, 10 * s.read(in));
  return &box;
}
void open_boxes(sac::Scope& s, sac::Mod<int> in, sac::Mod<int> a, sac::Mod<int> b) {
  s.write(a, s.read(s.query<boxed>(in)->value));
  s.write(b, s.read(s.query<boxed>(in)->value) + 1);
}

TEST_CASE("a query returns what it makes, and changes come through its cells") {
  sac::Engine e;
  const auto in = e.input(1);
  const auto a = e.cell<int>(), b = e.cell<int>();
  e.run<open_boxes>(in, a, b);
  CHECK(e.get(b) == 11);
  e.set(in, 2);
  e.propagate();
  CHECK((e.get(a) == 20 && e.get(b) == 21));
  e.check_invariants();
}

TEST_CASE("a query is printed and recorded as what it is") {
  Traced t(kNeeds, {0});
  std::string text;
  t.host.walk([&](const sac::Call& c, std::size_t) {
    t.host.for_each_edge(c, [&](const sac::Edge& edge) {
      std::ostringstream out;
      t.host.structure_of(edge).print(c, edge, out);
      text += out.str() + '\n';
    });
  });
  CHECK(text.find("is the first to ask for Build(3)") != text.npos);
}

TEST_CASE("a first run and an update survive every failing allocation") {
  std::uint64_t failures = 0;
  for (std::uint64_t count = 1;; ++count) {
    Traced t(kNeeds, {0});
    const std::string before = shape(t.host);
    bool burnt = false;
    const bool failed = support::fails(count, burnt, [&] {
      t.host.set(t.project.wanted, {1, 4, 0});
      t.host.propagate();
    });
    if (!failed && !burnt) break;
    ++failures;
    if (failed) {
      t.host.undo_edits();
      t.host.propagate();
      CHECK(shape(t.host) == before);
    }
    t.host.check_invariants();
    CHECK(t.host.queries().size() == (failed ? 4u : 6u));
  }
  CHECK(failures > 3);
}

struct Turn {
  int x;
  friend bool operator==(const Turn&, const Turn&) = default;
};
int turn(sac::Scope& s, Turn t) { return s.query<turn>(Turn{(t.x + 1) % 3}); }
void start_turn(sac::Scope& s) { s.query<turn>(Turn{0}); }

TEST_CASE("a cycle is told by the queries, not by their names") {
  sac::Engine e;
  try {
    e.run<start_turn>();
    FAIL("a cycle");
  } catch (const sac::UsageError& error) {
    const std::string text = error.what();
    std::size_t asks = 0;
    for (auto at = text.find("asks for"); at != text.npos; at = text.find("asks for", at + 1)) {
      ++asks;
    }
    CHECK(asks == 3);
  }
}

struct SumOf {
  template <class S>
  double operator()(S&, const std::vector<double>& all) const {
    return all.empty() ? 0 : all[0];
  }
};
struct AskSum {
  template <class S>
  void operator()(S& s, double x) const {
    s.template query<SumOf{}>(std::vector{x});
  }
};
inline constexpr AskSum ask_sum{};

TEST_CASE("an argument of a query equals itself") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  sac::Engine e;
  e.run<ask_sum>(1.0);
  CHECK_THROWS_WITH(e.run<ask_sum>(nan), Catch::Contains("does not equal itself"));
  sac::PlainScope plain;
  CHECK_THROWS_WITH(plain.run<ask_sum>(nan), Catch::Contains("does not equal itself"));
  e.check_invariants();
}

std::optional<sac::Scope> kept_scope;
void keep_scope(sac::Scope& s) { kept_scope.emplace(s); }

TEST_CASE("a query through a scope that was kept leaves nothing") {
  sac::Engine e;
  e.run<keep_scope>();
  CHECK_THROWS_AS(kept_scope->query<upto>(2u), sac::UsageError);
  kept_scope.reset();
  e.check_invariants();
}

}  // namespace
