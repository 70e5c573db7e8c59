// Sequences: ids, what an edit costs, what is undone when something fails, what is freed.
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <deque>
#include <functional>
#include <new>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "failing_new.hpp"
#include "failure_source.hpp"
#include "random.hpp"
#include "sac/sac.hpp"

namespace {

using sac::ElementId;
using support::ClientFailure;
using support::FailureSource;
using support::kFailureSources;
using support::Random;

template <class Sequence>
std::string text_of(const Sequence& sequence) {
  std::ostringstream out;
  for (const auto& e : sequence) out << e.value() << e.id() << ' ';
  return out.str();
}
template <class Host, class List>
std::string text_of(Host& host, const List& list) {
  std::ostringstream out;
  for (const auto& e : list.view(host)) out << e.value() << e.id() << ' ';
  return out.str();
}

template <class Host>
void check_edits() {
  Host host;
  sac::Sequence<std::string, Host> s(host, {"b", "d"});
  CHECK(text_of(s) == "b#1 d#2 ");
  CHECK(s.push_back("e") == ElementId{3});
  CHECK(s.push_front("a") == ElementId{4});
  CHECK(s.insert_before(ElementId{2}, "c") == ElementId{5});
  CHECK(s.insert_after(ElementId{3}, "f") == ElementId{6});
  CHECK(text_of(s) == "a#4 b#1 c#5 d#2 e#3 f#6 ");
  s.set(ElementId{5}, "C");
  s.erase(ElementId{6});
  s.erase(ElementId{4});
  CHECK(text_of(s) == "b#1 C#5 d#2 e#3 ");
  CHECK(s.push_back("g") == ElementId{7});  // not 6 again
  CHECK(text_of(host, s.list()) == "b#1 C#5 d#2 e#3 g#7 ");
  CHECK(s.size() == 5);
  CHECK(s.at(ElementId{5}) == "C");
  CHECK(s.contains(ElementId{1}));
  CHECK_FALSE(s.contains(ElementId{4}));
  CHECK(s.first() == ElementId{1});
  CHECK(s.last() == ElementId{7});
  CHECK(s.before(ElementId{5}) == ElementId{1});
  CHECK(s.after(ElementId{7}) == ElementId{});
  CHECK(s.before(ElementId{1}) == ElementId{});
  CHECK(std::prev(s.end())->value() == "g");
  const std::string before = text_of(s);
  CHECK_THROWS_AS(s.erase(ElementId{6}), sac::UsageError);
  CHECK_THROWS_AS(s.set(ElementId{99}, "x"), sac::UsageError);
  CHECK_THROWS_AS(s.insert_after(ElementId{}, "x"), sac::UsageError);
  CHECK_THROWS_AS(static_cast<void>(s.at(ElementId{4})), sac::UsageError);
  CHECK(text_of(s) == before);
  s.check_invariants();
}

TEST_CASE("a sequence is edited anywhere, and ids are not given again") {
  check_edits<sac::Engine>();
  check_edits<sac::PlainScope>();
}

TEST_CASE("a saved sequence comes back with its ids, and goes on above them") {
  using Sequence = sac::Sequence<int>;
  sac::Engine e;
  Sequence s(e, std::vector<Sequence::Saved>{{{7}, 1}, {{3}, 2}});
  CHECK(text_of(s) == "1#7 2#3 ");
  CHECK(s.push_front(5) == ElementId{8});
  for (const ElementId id : {ElementId{7}, ElementId{0}}) {
    const auto twice = [&] { Sequence t(e, std::vector<Sequence::Saved>{{{7}, 1}, {id, 2}}); };
    CHECK_THROWS_AS(twice(), sac::UsageError);
  }
  e.propagate();  // nothing is left of those that failed
  CHECK_NOTHROW(e.check_invariants());
}

// --- Cost ----------------------------------------------------------------------------------------

int twice(int x) { return 2 * x; }
bool is_odd(int x) { return x % 2 != 0; }
struct Increment {
  template <class S>
  int operator()(S&, int x) const {
    return x + 1;
  }
};
struct Nothing {
  template <class S>
  void operator()(S&, int) const {}
};

using Operation = void (*)(sac::Scope&, sac::List<int>);
void for_each_of(sac::Scope& s, sac::List<int> in) { sac::for_each<Nothing{}>(s, in); }
void map_of(sac::Scope& s, sac::List<int> in) { static_cast<void>(sac::map<&twice>(s, in)); }
void scoped_map_of(sac::Scope& s, sac::List<int> in) {
  static_cast<void>(sac::map<Increment{}>(s, in));
}
void filter_of(sac::Scope& s, sac::List<int> in) { static_cast<void>(sac::filter<&is_odd>(s, in)); }
void reverse_of(sac::Scope& s, sac::List<int> in) { static_cast<void>(sac::reverse(s, in)); }
void sort_of(sac::Scope& s, sac::List<int> in) {
  static_cast<void>(sac::sort<std::less<>{}>(s, in));
}
void reduce_of(sac::Scope& s, sac::List<int> in) {
  static_cast<void>(sac::reduce<std::plus<>{}>(s, in, std::int64_t{0}));
}

struct Work {
  double executed = 0, created = 0, discarded = 0;
  void add(const sac::Counts& c) {
    executed += static_cast<double>(c.executed);
    created += static_cast<double>(c.created);
    discarded += static_cast<double>(c.discarded);
  }
};
struct Costs {
  Work insert, set, erase;  // in all, of kRounds
};
constexpr int kRounds = 200;

template <auto Program>
Costs costs_of(int n) {
  Random random(static_cast<std::uint64_t>(n));
  sac::Engine e;
  std::vector<int> values;
  while (static_cast<int>(values.size()) < n) values.push_back(random(1000000));
  sac::Sequence<int> s(e, values);
  e.run<Program>(s.list());
  Costs costs;
  for (int round = 0; round < kRounds; ++round) {
    const auto place = static_cast<std::uint64_t>(1 + random(n));
    const ElementId id = s.insert_after(ElementId{place}, 2 * random(500000));
    costs.insert.add(e.propagate());
    s.set(id, s.at(id) + 2);
    costs.set.add(e.propagate());
    s.erase(id);
    costs.erase.add(e.propagate());
  }
  return costs;
}

template <auto Program>
void check_constant(int calls) {
  for (const int n : {100, 10000}) {
    const Costs costs = costs_of<Program>(n);
    CHECK(costs.insert.executed == kRounds * (1 + calls));
    CHECK(costs.insert.created == kRounds * calls);
    CHECK(costs.insert.discarded == 0);
    CHECK(costs.set.executed == kRounds * (1 + calls));
    CHECK(costs.set.created == kRounds * calls);
    CHECK(costs.set.discarded == kRounds * calls);
    CHECK(costs.erase.executed == kRounds);
    CHECK(costs.erase.created == 0);
    CHECK(costs.erase.discarded == kRounds * calls);
  }
}

TEST_CASE("an edit is one call again and one new in for_each, map and reverse, two in scoped map") {
  check_constant<&for_each_of>(1);
  check_constant<&map_of>(1);
  check_constant<&scoped_map_of>(2);
  check_constant<&reverse_of>(1);
}

TEST_CASE("an even number among odd and even ones is one call of a filter for odd ones") {
  for (const int n : {100, 10000}) {
    const Costs costs = costs_of<&filter_of>(n);
    CHECK(costs.insert.executed == 2 * kRounds);
    CHECK(costs.insert.created == kRounds);
    CHECK(costs.erase.discarded == kRounds);
  }
}

TEST_CASE("an edit of a sorted or reduced sequence is O(log n) calls") {
  const Costs sort_small = costs_of<&sort_of>(1000), sort_large = costs_of<&sort_of>(64000);
  CHECK(sort_small.insert.executed < 25 * kRounds);
  CHECK(sort_large.insert.executed < 60 * kRounds);
  CHECK(sort_large.erase.executed < 60 * kRounds);
  CHECK(sort_large.set.executed < 120 * kRounds);
  CHECK(sort_large.insert.created < 10 * kRounds);
  const Costs small = costs_of<&reduce_of>(1000), large = costs_of<&reduce_of>(64000);
  CHECK(small.insert.executed < 6 * kRounds);
  CHECK(large.insert.executed < 9 * kRounds);
  CHECK(large.erase.executed < 9 * kRounds);
}

// --- Failures ------------------------------------------------------------------------------------

// A number whose copies are counted, and may fail.
class Fragile {
 public:
  static inline support::Fuse fuse;
  static inline int living = 0;

  Fragile(int value) : value_(value) {
    burn();
    ++living;
  }
  Fragile(const Fragile& other) : value_(other.value_) {
    burn();
    ++living;
  }
  Fragile(Fragile&& other) noexcept : value_(other.value_) { ++living; }
  Fragile& operator=(Fragile&&) noexcept = default;
  ~Fragile() { --living; }
  static void burn() {
    if (fuse.burns()) throw ClientFailure();
  }
  [[nodiscard]] int value() const noexcept { return value_; }
  friend bool operator==(const Fragile& a, const Fragile& b) {
    burn();
    return a.value_ == b.value_;
  }
  friend std::uint64_t hash_value(const Fragile& f) {
    burn();
    return static_cast<std::uint64_t>(f.value_);
  }
  friend std::ostream& operator<<(std::ostream& out, const Fragile& f) { return out << f.value_; }

 private:
  int value_;
};

Fragile doubled(const Fragile& x) { return {2 * x.value()}; }
struct Successor {
  template <class S>
  Fragile operator()(S&, const Fragile& x) const {
    return {x.value() + 1};
  }
};
bool is_small(const Fragile& x) {
  Fragile::burn();
  return x.value() % 5 < 3;
}
bool by_value(const Fragile& a, const Fragile& b) {
  Fragile::burn();
  return a.value() / 4 < b.value() / 4;
}
int add(int a, int b) {
  Fragile::burn();
  return a + b;
}
int number(const Fragile& x) { return x.value(); }

void all_operations(sac::Scope& s, sac::List<Fragile> in, sac::Mod<sac::List<Fragile>> out,
                    sac::Mod<int> sum) {
  const auto list =
      sac::sort<&by_value>(s, sac::filter<&is_small>(s, sac::map<Successor{}>(s, in)));
  s.write(out, sac::map<&doubled>(s, sac::reverse(s, list)));
  s.write(sum, sac::fetch(s, sac::map_reduce<&number, &add>(s, list, 0)));
}

struct Failing {
  sac::Engine engine;
  sac::Sequence<Fragile> sequence;
  sac::Mod<sac::List<Fragile>> out = engine.cell<sac::List<Fragile>>();
  sac::Mod<int> sum = engine.cell<int>();

  explicit Failing(const std::vector<sac::Sequence<Fragile>::Saved>& elements)
      : sequence(engine, elements) {
    engine.run<all_operations>(sequence.list(), out, sum);
  }
  [[nodiscard]] std::vector<sac::Sequence<Fragile>::Saved> saved() const {
    std::vector<sac::Sequence<Fragile>::Saved> elements;
    for (const auto& e : sequence) elements.push_back({e.id(), e.value()});
    return elements;
  }
  // What can be seen: the sequence, results, calls in order, number of edges.
  [[nodiscard]] std::string state() const {
    std::ostringstream text;
    text << text_of(sequence) << "; " << text_of(engine, engine.get(out)) << "; " << engine.get(sum)
         << "; ";
    engine.walk(
        [&](const sac::Call& c, std::size_t depth) { text << depth << c.function().name << ' '; });
    text << engine.live_calls() << ' ' << engine.live_edges();
    return text.str();
  }
  void check() const {
    sequence.check_invariants();
    engine.check_invariants();
  }
};

using FragileEdit = std::function<void(sac::Sequence<Fragile>&)>;

FragileEdit random_edit(Random& random, const sac::Sequence<Fragile>& sequence) {
  const int value = random(30);
  if (sequence.empty()) return [=](auto& s) { s.push_front(value); };
  auto at = sequence.begin();
  std::advance(at, random(static_cast<int>(sequence.size())));
  const ElementId id = at->id();
  switch (random(5)) {
    case 0:
      return [=](auto& s) { s.push_back(value); };
    case 1:
      return [=](auto& s) { s.insert_before(id, value); };
    case 2:
      return [=](auto& s) { s.insert_after(id, value); };
    case 3:
      return [=](auto& s) { s.set(id, value); };
    default:
      return [=](auto& s) { s.erase(id); };
  }
}

TEST_CASE("an edit of a sequence that fails anywhere changes nothing") {
  std::uint64_t failures = 0;
  for (const FailureSource& source : kFailureSources<Fragile>) {
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
      CAPTURE(source.name, seed);
      Random random(seed);
      Failing f({{{1}, 4}, {{2}, 11}, {{3}, 2}});
      for (int i = 0; i < 40; ++i) {
        const FragileEdit edit = random_edit(random, f.sequence);
        const std::string before = text_of(f.sequence);
        for (std::uint64_t count = 1;; ++count) {
          CAPTURE(i, count);
          if (!fails(f.engine, source, count, [&] { edit(f.sequence); })) break;
          ++failures;
          REQUIRE(text_of(f.sequence) == before);
          f.sequence.check_invariants();
        }
        if (random(4) != 0) continue;
        f.engine.propagate();
        f.check();
        REQUIRE(f.state() == Failing(f.saved()).state());
      }
    }
  }
  CHECK(failures > 500);
}

TEST_CASE("a propagation that fails anywhere takes the edits of the sequence back") {
  std::uint64_t failures = 0;
  for (const FailureSource& source : kFailureSources<Fragile>) {
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
      CAPTURE(source.name, seed);
      Random random(seed);
      std::vector<sac::Sequence<Fragile>::Saved> elements;
      for (std::uint64_t id = 1; id < 30; ++id) elements.push_back({{id}, random(30)});
      Failing f(elements);
      for (int i = 0; i < 6; ++i) {
        const std::string before = f.state();
        const std::uint64_t batch = seed * 100 + static_cast<std::uint64_t>(i);
        for (std::uint64_t count = 1;; ++count) {
          CAPTURE(i, count);
          Random edits(batch);
          for (int k = 1 + edits(3); k > 0; --k) random_edit(edits, f.sequence)(f.sequence);
          if (!fails(f.engine, source, count, [&] { f.engine.propagate(); })) break;
          ++failures;
          f.check();
          REQUIRE(f.state() == before);
        }
        f.check();
        REQUIRE(f.state() == Failing(f.saved()).state());
      }
    }
  }
  CHECK(failures > 500);
  CHECK(Fragile::living == 0);
}

TEST_CASE("edits of a sequence are undone with the others") {
  sac::Engine e;
  sac::Sequence<int> s(e, {1, 2, 3});
  const auto out = e.cell<int>();
  e.run<[](sac::Scope& scope, sac::List<int> in, sac::Mod<int> to) {
    scope.write(to, sac::fetch(scope, sac::reduce<std::plus<>{}>(scope, in, 0)));
  }>(s.list(), out);
  const std::string before = text_of(s);
  const ElementId four = s.push_back(4);
  s.erase(ElementId{1});
  s.set(ElementId{2}, 20);
  s.set(ElementId{2}, 21);
  s.erase(four);
  s.insert_after(ElementId{2}, 5);
  s.erase(ElementId{2});
  e.undo_edits();
  CHECK(text_of(s) == before);
  s.check_invariants();
  CHECK(e.propagate().created == 0);
  CHECK(e.get(out) == 6);
  CHECK(s.push_back(7) > four);
}

TEST_CASE("an engine that runs refuses edits of its sequences") {
  struct World {
    sac::Sequence<int>* sequence;
  };
  sac::Engine e;
  sac::Sequence<int> s(e, {1});
  World world{&s};
  e.set_environment(&world);
  const auto edit = [&] {
    e.run<[](sac::Scope& scope) { scope.environment<World>().sequence->push_back(2); }>();
  };
  CHECK_THROWS_AS(edit(), sac::UsageError);
  CHECK(text_of(s) == "1#1 ");
}

// --- Memory --------------------------------------------------------------------------------------

TEST_CASE("what a sequence erased is destroyed when that is final, and memory stays flat") {
  sac::Engine e;
  {
    sac::Sequence<Fragile> s(e);
    std::deque<ElementId> ids;
    for (int i = 0; i < 100; ++i) ids.push_back(s.push_back(i));
    e.propagate();
    CHECK(Fragile::living == 100);
    s.erase(ids.front());
    CHECK(Fragile::living == 100);
    e.propagate();
    CHECK(Fragile::living == 99);
    ids.pop_front();
    std::size_t held = 0;
    for (int i = 0; i < 20000; ++i) {
      ids.push_back(s.push_back(i));
      s.erase(ids.front());
      ids.pop_front();
      e.propagate();
      if (i == 1000) held = e.memory().held();
    }
    CHECK(e.memory().held() == held);
    for (int i = 0; i < 1000; ++i) {
      s.push_back(i);
      e.undo_edits();
    }
    CHECK(e.memory().held() == held);
    CHECK(Fragile::living <= 100);
  }
}

void add_up(sac::Scope& s, sac::List<double> list, sac::Mod<double> out) {
  s.write(out, sac::fetch(s, sac::reduce<std::plus<>{}>(s, list, -0.0)));
}

TEST_CASE("an element that differs in the sign of zero is another one") {
  sac::Engine e;
  sac::Sequence<double> numbers(e, {0.0});
  const auto sum = e.cell<double>();
  e.run<add_up>(numbers.list(), sum);
  CHECK_FALSE(std::signbit(e.get(sum)));
  numbers.erase(numbers.first());
  numbers.push_back(-0.0);
  e.propagate();
  CHECK(std::signbit(e.get(sum)));
  numbers.set(numbers.first(), 0.0);
  CHECK_FALSE(std::signbit(numbers.at(numbers.first())));
  e.propagate();
  CHECK_FALSE(std::signbit(e.get(sum)));
  numbers.set(numbers.first(), -0.0);
  e.propagate();
  CHECK(std::signbit(e.get(sum)));
}

}  // namespace
