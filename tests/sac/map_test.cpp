// Maps: random programs under random edits against runs from scratch and plain runs; failures at
// every allocation and client call; what a change runs again; what is refused, and how.
#include <catch2/catch.hpp>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "failing_new.hpp"
#include "failure_source.hpp"
#include "fragile.hpp"
#include "random.hpp"
#include "sac/event_log.hpp"
#include "sac/sac.hpp"

namespace {

using support::ClientFailure;
using support::FailureSource;
using support::Fragile;
using support::kFailureSources;
using support::Random;

template <class S>
using HostOf = std::conditional_t<S::kTraced, sac::Engine, sac::PlainScope>;

// --- Random programs -----------------------------------------------------------------------------

// x -> a x + b, composed: associative and not commutative.
struct Affine {
  struct Value {
    std::uint64_t a = 1, b = 0;
    friend bool operator==(const Value&, const Value&) = default;
    friend std::uint64_t hash_value(const Value& v) { return sac::mix(v.a) + v.b; }
  };
  static Value none() { return {}; }
  template <class K, class V>
  static Value of(const K& key, const V& value) {
    return {static_cast<std::uint64_t>(2 * int(key) + 3), static_cast<std::uint64_t>(int(value))};
  }
  static Value join(const Value& x, const Value& y) { return {x.a * y.a, x.b * y.a + y.b}; }
};

constexpr int kKeys = 12;
constexpr int kInputs = 4;

struct Op {
  enum Kind { skip, put, add, query, call, each, merge, kinds };
  Kind kind;
  int a, b, c;
};
struct Text {
  std::vector<std::vector<Op>> nodes;  // node 0 is the root; calls go to later ones
};

// Early nodes rather fill, late ones rather ask: else most programs are refused.
Text random_text(Random& random) {
  Text text;
  const int n = 2 + random(6);
  for (int i = 0; i < n; ++i) {
    auto& ops = text.nodes.emplace_back();
    for (int k = 1 + random(4); k > 0; --k) {
      const bool fills = random(n) >= i;
      const Op::Kind kinds[] = {
          Op::skip,  Op::call, Op::call, fills ? Op::put : Op::query, fills ? Op::add : Op::query,
          Op::query, Op::each, Op::merge};
      const int which = random(20);
      const Op::Kind kind = which < 6    ? kinds[which]
                            : which < 18 ? kinds[3 + which % 2]
                                         : kinds[which - 12];
      ops.push_back({kind, random(60), random(60), random(60)});
    }
  }
  for (int i = 1; i < n; ++i) {
    if (random(3) != 0) text.nodes[0].push_back({Op::call, i - 1, 0, 0});
  }
  return text;
}

// What the outside has set.
struct Outside {
  std::vector<int> inputs = std::vector<int>(kInputs, 0);
  std::map<int, int> values, sums;
};

template <class Host>
struct World {
  using S = sac::ScopeOf<Host>;
  using Input = typename S::template ModType<int>;
  using Output = typename S::template ModType<std::uint64_t>;

  World(Host& h, const Text& t, const Outside& outside)
      : host(h), text(t), values(h, "values"), sums(h, "sums") {
    for (const int i : outside.inputs) inputs.push_back(h.input(int{i}));
    for (std::size_t i = 0; i < t.nodes.size(); ++i) {
      outputs.push_back(h.template cell<std::uint64_t>());
      h.set(outputs.back(), std::uint64_t{0});
      results.push_back(h.template cell<std::uint64_t>());
    }
    for (const auto& [k, v] : outside.values) values.set(Fragile(k), Fragile(v));
    for (const auto& [k, v] : outside.sums) sums.set(Fragile(k), v);
    h.set_environment(this);
  }

  std::string state() {
    std::ostringstream out;
    for (const Output& o : results) {
      try {
        out << host.get(o) << ' ';
      } catch (const sac::UsageError&) {
        out << "- ";
      }
    }
    for (const auto& [k, v] : values.entries()) out << k << ':' << v << ' ';
    for (const auto& [k, v] : sums.entries()) out << k << '=' << v << ' ';
    return out.str();
  }

  Host& host;
  const Text& text;
  sac::Map<Fragile, Fragile, Affine, Host> values;
  sac::Map<Fragile, int, sac::Sum, Host, Affine> sums;
  std::vector<Input> inputs;
  std::vector<Output> outputs, results;
};

template <class T>
std::uint64_t number_of(const T& x) {
  if constexpr (std::is_convertible_v<T, std::uint64_t>) {
    return static_cast<std::uint64_t>(x);
  } else {
    return static_cast<std::uint64_t>(int(x));
  }
}
template <class A, class B>
std::uint64_t number_of(const std::pair<A, B>& x) {
  return 31 * number_of(x.first) + number_of(x.second);
}
template <class T>
std::uint64_t number_of(const std::optional<T>& x) {
  return x ? 1 + number_of(*x) : 0;
}
template <class T>
std::uint64_t number_of(const std::vector<T>& list) {
  std::uint64_t h = list.size();
  for (const T& x : list) h = 37 * h + number_of(x);
  return h;
}
std::uint64_t number_of(const Affine::Value& x) { return hash_value(x); }

sac::Interval<Fragile> interval_of(int b, int c) {
  sac::Interval<Fragile> i;
  const Fragile low(b % kKeys);
  const Fragile high(b % kKeys + c % 4);
  if (c % 7 != 0) (b % 3 == 0 ? i.above : i.from) = low;
  if (c % 5 != 0) (c % 3 == 0 ? i.below : i.to) = high;
  return i;
}

template <class S, class M>
std::uint64_t answer(S& s, M& map, const Op& op) {
  const Fragile key(op.b % kKeys);
  const auto keys = interval_of(op.b, op.c);
  const auto n = static_cast<std::size_t>(op.c % 4);
  switch (op.a / 2 % 12) {
    case 0:
      return number_of(map.find(s, key));
    case 1:
      return map.contains(s, key) ? 1 : 2;
    case 2:
      return map.count(s, keys);
    case 3:
      return number_of(map.first(s, keys));
    case 4:
      return number_of(map.last(s, keys));
    case 5:
      return number_of(map.nth(s, n));
    case 6:
      return number_of(map.top(s, 1 + n));
    case 7:
      return number_of(map.bottom(s, 1 + n));
    case 8:
      return number_of(map.range(s, keys));
    case 9:
      return number_of(map.template fold<Affine>(s, keys));
    case 10:
      return op.c % 6 == 0 ? number_of(map.get(s, key)) : number_of(map.next(s, key));
    default:
      return number_of(map.next_key(s, keys)) + map.rank(s, key);
  }
}

struct AddEach {
  template <class S>
  void operator()(S& s, const Fragile& key, const Fragile& value) const {
    auto& w = s.template environment<World<HostOf<S>>>();
    w.sums.add(s, Fragile(int(key) / 2), int(value));
  }
};
struct WriteEach {
  template <class S>
  void operator()(S& s, const Fragile& key) const {
    auto& w = s.template environment<World<HostOf<S>>>();
    const auto to = static_cast<std::size_t>(int(key)) % w.outputs.size();
    const auto value = number_of(w.sums.find(s, key)) + number_of(w.values.find(s, key));
    s.write(w.results[to], value);
  }
};

struct Node {
  static constexpr std::string_view kName = "node";
  template <class S>
  void operator()(S& s, int i) const {
    auto& w = s.template environment<World<HostOf<S>>>();
    const auto& ops = w.text.nodes[static_cast<std::size_t>(i)];
    const auto input = [&](int a) {
      return s.read(w.inputs[static_cast<std::size_t>(a % kInputs)]);
    };
    std::uint64_t seen = 0;
    for (std::size_t k = 0; k < ops.size(); ++k) {
      const Op& op = ops[k];
      const int key = op.a % 3 == 0   ? op.b + input(op.c)
                      : op.a % 7 == 1 ? op.b + int(seen % 5)
                                      : op.b;
      const int later = i + 1 + op.a % static_cast<int>(w.text.nodes.size());
      switch (op.kind) {
        case Op::skip:
          if (input(op.a) % 2 == 0) ++k;
          break;
        case Op::put:
          w.values.put(s, Fragile(key % kKeys), Fragile(op.c % 8 == 0 ? input(op.c) : key % 5));
          break;
        case Op::add:
          w.sums.add(s, Fragile(key % kKeys), op.c % 2 == 0 ? input(op.a) : op.c);
          break;
        case Op::query:
          seen = 31 * seen + (op.a % 2 == 0 ? answer(s, w.values, op) : answer(s, w.sums, op));
          break;
        case Op::call:
          if (later < static_cast<int>(w.text.nodes.size())) s.template call<Node{}>(later);
          break;
        case Op::each:
          w.values.template for_each<AddEach{}>(s);
          break;
        default:
          sac::merge<WriteEach{}>(s, w.values, w.sums);
      }
    }
    s.write(w.results[static_cast<std::size_t>(i)], seen);
  }
};
struct Start {
  template <class S>
  void operator()(S& s) const {
    s.template call<Node{}>(0);
  }
};
inline constexpr Start start{};

struct Edit {
  enum Kind { input, value, sum } kind;
  int place, to;  // of values and sums: to < 0 erases
};
std::vector<Edit> random_edits(Random& random) {
  std::vector<Edit> edits;
  for (int k = 1 + random(3); k > 0; --k) {
    const auto kind = static_cast<Edit::Kind>(random(3));
    edits.push_back({kind, random(kind == Edit::input ? kInputs : kKeys),
                     kind == Edit::input ? random(6) : random(5) - 2});
  }
  return edits;
}

struct Traced {
  sac::Engine engine;
  World<sac::Engine> world;
  Traced(const Text& text, const Outside& outside) : world(engine, text, outside) {}

  void edit(const Edit& e, Outside& o) {
    if (e.kind == Edit::input) {
      engine.set(world.inputs[static_cast<std::size_t>(e.place)], e.to);
      o.inputs[static_cast<std::size_t>(e.place)] = e.to;
    } else if (e.kind == Edit::value) {
      edit_map(world.values, o.values, e, [](int x) { return Fragile(x); });
    } else {
      edit_map(world.sums, o.sums, e, [](int x) { return x; });
    }
  }
  void edit_map(auto& map, std::map<int, int>& model, const Edit& e, auto value) {
    const Fragile key(e.place);
    if (e.to >= 0) {
      map.set(key, value(e.to));
      model[e.place] = e.to;
    } else if (model.contains(e.place)) {
      map.erase(key);
      model.erase(e.place);
    }
  }
  std::string state() {
    return world.state() + std::to_string(engine.live_calls()) + " calls, " +
           std::to_string(engine.live_edges()) + " edges";
  }
};

// What a run refuses, if it does.
std::optional<std::string> refusal_of(const std::function<void()>& act) {
  try {
    act();
  } catch (const sac::UsageError& error) {
    return error.what();
  }
  return std::nullopt;
}

void require_plain_equals(const Text& text, const Outside& outside, Traced& fresh, bool refused) {
  sac::PlainScope scope;
  World<sac::PlainScope> plain(scope, text, outside);
  const auto refusal = refusal_of([&] { scope.run<start>(); });
  INFO("plain: " << refusal.value_or("runs"));
  REQUIRE(refusal.has_value() == refused);
  if (!refused) REQUIRE(plain.state() == fresh.world.state());
}

// Returns how many batches were accepted, and how many refused.
std::pair<int, int> check_program(std::uint64_t seed, int batches) {
  CAPTURE(seed);
  Random random(seed);
  const Text text = random_text(random);
  Outside outside;
  for (int& i : outside.inputs) i = random(6);
  for (int k = random(5); k > 0; --k) outside.values[random(kKeys)] = random(4);
  for (int k = random(3); k > 0; --k) outside.sums[random(kKeys)] = random(4);
  Traced p(text, outside);
  const bool refused = refusal_of([&] { p.engine.run<start>(); }).has_value();
  require_plain_equals(text, outside, p, refused);
  if (refused) return {0, 1};
  std::pair<int, int> done{0, 0};
  for (int i = 0; i < batches; ++i) {
    CAPTURE(i);
    const std::string before = p.state();
    Outside wanted = outside;
    for (const Edit& e : random_edits(random)) p.edit(e, wanted);
    if (random(8) == 0) {
      p.engine.undo_edits();
      p.engine.propagate();
      p.engine.check_invariants();
      REQUIRE(p.state() == before);
      continue;
    }
    const auto refusal = refusal_of([&] { p.engine.propagate(); });
    p.engine.check_invariants();
    Traced fresh(text, wanted);
    const auto from_scratch = refusal_of([&] { fresh.engine.run<start>(); });
    INFO("propagated: " << refusal.value_or("accepted")
                        << "\nfrom scratch: " << from_scratch.value_or("accepted"));
    REQUIRE(refusal.has_value() == from_scratch.has_value());
    require_plain_equals(text, wanted, fresh, refusal.has_value());
    if (refusal) {
      ++done.second;
      REQUIRE(p.state() == before);
    } else {
      ++done.first;
      outside = wanted;
      REQUIRE(p.state() == fresh.state());
    }
  }
  return done;
}

TEST_CASE(
    "random programs on maps equal runs from scratch and plain runs, or are refused as they") {
  int accepted = 0, refused = 0;
  for (std::uint64_t seed = 0; seed < 1500; ++seed) {
    const auto [yes, no] = check_program(seed, 12);
    accepted += yes;
    refused += no;
  }
  CAPTURE(accepted, refused);
  CHECK((accepted > 3000 && refused > 1000));
}

TEST_CASE("many random programs on maps", "[.soak]") {
  for (std::uint64_t seed = 10000; seed < 200000; ++seed) check_program(seed, 20);
}

// --- Failures ------------------------------------------------------------------------------------

// Edits and propagates; each time with every failure of the source in turn. Returns their number.
std::uint64_t check_failures(std::uint64_t seed, const FailureSource& source, int batches) {
  CAPTURE(seed, source.name);
  Random random(seed);
  const Text text = random_text(random);
  Outside outside;
  for (int k = random(5); k > 0; --k) outside.values[random(kKeys)] = random(4);
  Traced p(text, outside);
  if (refusal_of([&] { p.engine.run<start>(); })) return 0;
  std::uint64_t failures = 0;
  for (int i = 0; i < batches; ++i) {
    CAPTURE(i);
    const std::vector<Edit> edits = random_edits(random);
    const std::string before = p.state();
    Outside after = outside;
    const auto act = [&] {
      after = outside;
      for (const Edit& e : edits) p.edit(e, after);
      p.engine.propagate();
    };
    const auto require_undone = [&] {
      p.engine.undo_edits();
      p.engine.propagate();
      p.engine.check_invariants();
      REQUIRE(p.state() == before);
    };
    if (refusal_of(act)) {
      require_undone();
      continue;
    }
    const std::string expected = p.state();
    for (const Edit& e : edits) {  // and back
      if (e.kind == Edit::input)
        p.edit({e.kind, e.place, outside.inputs[std::size_t(e.place)]}, after);
      const auto& model = e.kind == Edit::value ? outside.values : outside.sums;
      const auto old = model.find(e.place);
      if (e.kind != Edit::input)
        p.edit({e.kind, e.place, old == model.end() ? -1 : old->second}, after);
    }
    p.engine.propagate();
    REQUIRE(p.state() == before);
    for (std::uint64_t count = 1; fails(p.engine, source, count, act); ++count) {
      CAPTURE(count);
      ++failures;
      require_undone();
    }
    p.engine.check_invariants();
    outside = after;
    REQUIRE(p.state() == expected);
  }
  return failures;
}

TEST_CASE("a propagation that fails anywhere leaves the maps as before the edits") {
  std::uint64_t failures = 0;
  for (const FailureSource& source : kFailureSources<Fragile>) {
    for (std::uint64_t seed = 0; seed < 200; ++seed) failures += check_failures(seed, source, 3);
  }
  CAPTURE(failures);
  CHECK(failures > 10000);
}

TEST_CASE("many propagations on maps fail anywhere", "[.soak]") {
  for (const FailureSource& source : kFailureSources<Fragile>) {
    for (std::uint64_t seed = 10000; seed < 20000; ++seed) check_failures(seed, source, 6);
  }
}

TEST_CASE("a first run that fails anywhere leaves maps with what the outside has set") {
  std::uint64_t failures = 0;
  for (const FailureSource& source : kFailureSources<Fragile>) {
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
      CAPTURE(seed, source.name);
      Random random(seed);
      const Text text = random_text(random);
      Outside outside;
      outside.values = {{1, 2}, {5, 0}};
      Traced p(text, outside), good(text, outside);
      if (refusal_of([&] { good.engine.run<start>(); })) continue;
      const auto run = [&] { p.engine.run<start>(); };
      for (std::uint64_t count = 1; fails(p.engine, source, count, run); ++count) {
        ++failures;
        REQUIRE(p.engine.live_edges() == 0);
        p.engine.check_invariants();
        REQUIRE(p.world.values.size() == 2);
        REQUIRE(p.world.sums.size() == 0);
      }
      REQUIRE(p.state() == good.state());
    }
  }
  CHECK(failures > 500);
}

// --- What a change runs again --------------------------------------------------------------------

constexpr int kMany = 1000;
struct Ranges {
  sac::Map<int, int> points;
  sac::Map<int, int> kept;
  sac::Map<int, std::int64_t, sac::Sum> sums;
  std::vector<sac::Mod<std::uint64_t>> results;
  explicit Ranges(sac::Engine& e) : points(e, "points"), kept(e, "kept"), sums(e, "sums") {}
};
void count_between(sac::Scope& s, int i) {
  auto& w = s.environment<Ranges>();
  const int from = 10 * i;
  s.write(w.results[std::size_t(i)], w.points.count(s, {.from = from, .below = from + 20}));
}
void count_all(sac::Scope& s) {
  for (int i = 0; i < kMany; ++i) s.call<count_between>(i);
}

TEST_CASE("a change outside of a query's span runs nothing again; inside, those that see it") {
  sac::Engine e;
  Ranges w(e);
  e.set_environment(&w);
  for (int i = 0; i < 10 * kMany; i += 3) w.points.set(i, i);
  for (int i = 0; i < kMany; ++i) w.results.push_back(e.cell<std::uint64_t>());
  e.run<count_all>();
  for (int i = 0; i < 200; ++i) {
    const int key = 12000 + i;
    w.points.set(key, 1);
    CHECK(e.propagate().executed == 0);  // behind all spans
  }
  Random random(1);
  for (int i = 0; i < 200; ++i) {
    const int key = 3 * (7 + random(3 * kMany)) + 1;  // a new one
    w.points.set(key, 1);
    const sac::Counts there = e.propagate();
    CHECK((there.executed == 2 && there.confirmed == 0 && there.created == 0));
    w.points.set(key, 2);
    const sac::Counts same = e.propagate();  // as many as before
    CHECK((same.executed == 0 && same.confirmed == 2));
    w.points.erase(key);
    CHECK(e.propagate().executed == 2);
  }
  e.check_invariants();
}

void keep(sac::Scope& s, int key, int value) {
  if (value % 2 == 0) s.environment<Ranges>().kept.put(s, key, value);
}
void sum_up(sac::Scope& s, int key, int value) {
  s.environment<Ranges>().sums.add(s, key / 100, value);
}
void chains(sac::Scope& s) {
  auto& w = s.environment<Ranges>();
  w.points.for_each<keep>(s);
  w.kept.for_each<sum_up>(s);
  std::uint64_t best = 0;
  for (const auto& [key, sum] : w.sums.top(s, 3)) best += static_cast<std::uint64_t>(sum);
  s.write(w.results[0], best);
}

TEST_CASE("an entry that comes or goes makes O(1) calls of for_each run again") {
  sac::Engine e;
  Ranges w(e);
  e.set_environment(&w);
  e.set_audit(true);
  for (int i = 0; i < 10 * kMany; i += 3) w.points.set(i, 2 * i);
  w.results.push_back(e.cell<std::uint64_t>());
  e.run<chains>();
  Random random(1);
  for (int i = 0; i < 300; ++i) {
    const int key = 3 * random(3 * kMany) + 1;
    w.points.set(key, 8);
    const sac::Counts there = e.propagate();
    // Before it, it; before it and it among those kept; the sums, if of the greatest keys.
    CHECK((there.executed <= 5 && there.created == 2 && there.discarded == 0));
    w.points.erase(key);
    const sac::Counts back = e.propagate();
    CHECK((back.executed <= 3 && back.created == 0 && back.discarded == 2));
  }
  CHECK((e.audit().duplicates == 0 && e.audit().reordered == 0));
  e.check_invariants();
}

TEST_CASE("a map takes memory for its entries and queries alone, and gives it back") {
  sac::Engine e;
  Ranges w(e);
  e.set_environment(&w);
  for (int i = 0; i < 10 * kMany; i += 3) w.points.set(i, 2 * i);
  w.results.push_back(e.cell<std::uint64_t>());
  e.run<chains>();
  Random random(1);
  std::size_t most = 0;
  for (int i = 0; i < 2000; ++i) {
    const int key = 3 * random(3 * kMany) + 1;
    w.points.set(key, 8);
    e.propagate();
    w.points.erase(key);
    e.propagate();
    if (i == 200) most = e.memory().live();
    if (i > 200) REQUIRE(e.memory().live() <= most);
  }
}

// --- Folds, exactly ------------------------------------------------------------------------------

struct Total {
  using Value = double;
  static double none() { return 0; }
  static double of(int, double x) { return x; }
  static double join(double a, double b) { return a + b; }
};
template <class Host>
struct Numbers {
  sac::Map<int, double, Total, Host> map;
  typename sac::ScopeOf<Host>::template ModType<double> total;
  Numbers(Host& h, const std::map<int, double>& numbers)
      : map(h, "numbers"), total(h.template cell<double>()) {
    for (const auto& [k, v] : numbers) map.set(k, v);
    h.set_environment(this);
  }
};
struct Totals {
  template <class S>
  void operator()(S& s) const {
    auto& w = s.template environment<Numbers<HostOf<S>>>();
    s.write(w.total, w.map.template fold<Total>(s, {.from = 20, .below = 180}));
  }
};
inline constexpr Totals totals{};

TEST_CASE("a fold of floating-point numbers has the bits of a run from scratch and a plain run") {
  Random random(5);
  std::map<int, double> numbers;
  for (int i = 0; i < 100; ++i) numbers[random(200)] = 1.0 / (1 + random(1000000));
  sac::Engine e;
  Numbers<sac::Engine> w(e, numbers);
  e.run<totals>();
  int differs_from_left_to_right = 0;
  for (int i = 0; i < 500; ++i) {
    const int key = random(200);
    const auto old = numbers.find(key);
    if (old != numbers.end() && random(2) == 0) {
      w.map.erase(key);
      numbers.erase(old);
    } else {
      w.map.set(key, numbers[key] = 1.0 / (1 + random(1000000)));
    }
    e.propagate();
    sac::Engine other;
    Numbers<sac::Engine> fresh(other, numbers);
    other.run<totals>();
    sac::PlainScope scope;
    Numbers<sac::PlainScope> plain(scope, numbers);
    scope.run<totals>();
    REQUIRE(sac::detail::identical(e.get(w.total), other.get(fresh.total)));
    REQUIRE(sac::detail::identical(e.get(w.total), scope.get(plain.total)));
    double sum = 0;
    for (const auto& [k, v] : numbers) sum += k >= 20 && k < 180 ? v : 0;
    differs_from_left_to_right += sum != e.get(w.total);
  }
  CHECK(differs_from_left_to_right > 50);
}

// --- Lists ---------------------------------------------------------------------------------------

struct Listed {
  sac::Map<std::string, int> words;
  sac::Map<int, std::string> lengths;
  sac::Mod<std::string> out;
  sac::Mod<std::uint64_t> size;
  explicit Listed(sac::Engine& e)
      : words(e, "words"),
        lengths(e, "lengths"),
        out(e.cell<std::string>()),
        size(e.cell<std::uint64_t>()) {}
};
using Word = std::pair<std::string, int>;
bool is_many(const Word& w) { return w.second > 1; }
struct Join {
  std::string operator()(const std::string& a, const std::string& b) const { return a + b; }
};
std::string text_of(const Word& w) { return w.first + std::to_string(w.second) + ' '; }
void list_words(sac::Scope& s) {
  auto& w = s.environment<Listed>();
  const auto many = sac::filter<is_many>(s, w.words.list(s));
  s.write(w.out, sac::fetch(s, sac::reduce<Join{}>(s, sac::map<text_of>(s, many), std::string())));
}

TEST_CASE("a map as a list goes through filter, map and reduce") {
  sac::Engine e;
  Listed w(e);
  e.set_environment(&w);
  e.set_audit(true);
  std::map<std::string, int> model;
  Random random(3);
  const auto edit = [&] {
    const std::string word(static_cast<std::size_t>(1 + random(30)),
                           static_cast<char>('a' + random(4)));
    if (model.contains(word) && random(2) == 0) {
      w.words.erase(word);
      model.erase(word);
    } else {
      w.words.set(word, model[word] = random(5));
    }
  };
  for (int i = 0; i < 30; ++i) edit();
  e.run<list_words>();
  for (int i = 0; i < 300; ++i) {
    std::string expected;
    for (const Word word : model) expected += is_many(word) ? text_of(word) : "";
    REQUIRE(e.get(w.out) == expected);
    edit();
    CHECK(e.propagate().executed < 40);
    e.check_invariants();
    edit();
    e.undo_edits();
    model.clear();
    for (const auto& [k, v] : w.words.entries()) model[k] = v;
  }
  CHECK((e.audit().duplicates == 0 && e.audit().reordered == 0));
}

// --- What is refused -----------------------------------------------------------------------------

struct Small {
  sac::Map<int, int> map;
  sac::Map<int, int, sac::Sum> sums;
  sac::Mod<int> in;
  sac::Mod<std::uint64_t> out;
  explicit Small(sac::Engine& e)
      : map(e, "prices"), sums(e, "sums"), in(e.input(0)), out(e.cell<std::uint64_t>()) {
    e.set_environment(this);
  }
};
void look(sac::Scope& s, int from) {
  auto& w = s.environment<Small>();
  s.write(w.out, w.map.count(s, {.from = from, .to = from + 2}));
}
void put(sac::Scope& s, int key, int value) { s.environment<Small>().map.put(s, key, value); }
void put_where_told(sac::Scope& s) {
  auto& w = s.environment<Small>();
  s.call<put>(1, 10);
  s.call<look>(3);
  if (const int key = s.read(w.in)) s.call<put>(key, 20);
}

TEST_CASE("a put behind a query that depends on it, or of a second value, names both calls") {
  sac::Engine e;
  Small w(e);
  e.run<put_where_told>();
  for (const int key : {2, 6, 7}) {
    e.set(w.in, key);
    e.propagate();
    CHECK(w.map.size() == 2);
  }
  e.set(w.in, 4);
  CHECK_THROWS_WITH(e.propagate(),
                    "map 'prices': put(4, 20) puts key 4 behind a query of look(3) "
                    "that depends on it: what is put comes before who looks");
  CHECK((e.get(w.in) == 7 && w.map.size() == 2 && *w.map.find(7) == 20));
  e.set(w.in, 1);
  CHECK_THROWS_WITH(e.propagate(),
                    "map 'prices': put(1, 20) puts another value for key 1 than put(1, 10)");
  w.map.set(1, 11);
  CHECK_THROWS_WITH(e.propagate(),
                    "map 'prices': put(1, 10) puts another value for key 1 than the outside");
  w.map.set(1, 10);  // the same
  e.propagate();
  w.map.erase(1);
  e.propagate();
  CHECK(*w.map.find(1) == 10);
  CHECK_THROWS_WITH(w.map.erase(1), "map 'prices': erase: the outside has not set key 1");
  e.check_invariants();
}

void get_missing(sac::Scope& s) {
  try {
    static_cast<void>(s.environment<Small>().map.get(s, 5));
  } catch (const sac::UsageError&) {
  }
}
TEST_CASE("a key that is not there is an error, which fails the call even if it is caught") {
  sac::Engine e;
  Small w(e);
  CHECK_THROWS_AS(e.run<get_missing>(), sac::UsageError);
  w.map.set(5, 1);
  CHECK_NOTHROW(e.run<get_missing>());
  w.map.erase(5);
  CHECK_THROWS_WITH(e.propagate(), Catch::Contains("caught"));
  CHECK(w.map.size() == 1);
}

TEST_CASE("the log and prints name maps, keys and answers") {
  sac::Engine e;
  Small w(e);
  e.run<put_where_told>();
  std::ostringstream out;
  e.walk([&](const sac::Call& c, std::size_t) {
    e.for_each_edge(c, [&](const sac::Edge& edge) {
      e.structure_of(edge).print(c, edge, out);
      out << "; ";
    });
  });
  CHECK_THAT(out.str(), Catch::Contains("'prices', puts 1: 10; 'prices', count: 0; "));
}

TEST_CASE("outside edits are refused while the engine runs") {
  sac::Engine e;
  Small w(e);
  static Small* world = nullptr;
  world = &w;
  constexpr auto kEdits = [](sac::Scope&) { world->map.set(1, 2); };
  CHECK_THROWS_AS(e.run<kEdits>(), sac::UsageError);
  CHECK(w.map.size() == 0);
}

void put_one(sac::Scope& s, sac::Mod<int> in) {
  s.environment<sac::Map<int, int>>().put(s, 1, s.read(in));
}
void look_at_one(sac::Scope& s, sac::Mod<int> out) {
  s.write(out, s.environment<sac::Map<int, int>>().find(s, 1).value_or(-1));
}

TEST_CASE("between an edit and its propagation a map is not looked at; a run sees it as it is") {
  sac::Engine e;
  sac::Map<int, int> map(e, "map");
  e.set_environment(&map);
  const auto in = e.input(10);
  const auto out = e.cell<int>();
  e.run<put_one>(in);
  map.set(1, 20);
  CHECK_THROWS_WITH(map.find(1), Catch::Contains("between an edit and its propagation"));
  e.undo_edits();
  CHECK_THROWS_AS(map.size(), sac::UsageError);
  e.run<look_at_one>(out);
  CHECK(e.get(out) == 10);
  CHECK(map.size() == 1);
}

}  // namespace
