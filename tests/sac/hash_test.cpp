// Hashes of arguments that nobody has written hash_value for.
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <list>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <unordered_set>
#include <utility>
#include <variant>
#include <vector>

#include "sac/sac.hpp"

namespace {

using sac::Engine;
using sac::hash_argument;
using sac::Mod;
using sac::Scope;

// --- Types -----------------------------------------------------------------------------------

struct Empty {
  bool operator==(const Empty&) const = default;
};
struct Padded {  // bytes between that nobody sets
  char c;
  double d;
  bool operator==(const Padded&) const = default;
};
struct Nested {
  std::string name;
  std::vector<Padded> all;
  std::optional<std::pair<int, std::string>> maybe;
  std::variant<int, double, std::string> either;
  int grid[2][3];
  bool operator==(const Nested&) const = default;
};
struct Twelve {
  int a, b, c, d, e, f, g, h, i, j, k;
  std::string l;
  bool operator==(const Twelve&) const = default;
};
struct NoDefault {
  explicit NoDefault(int v) : value(v) {}
  int value;
  bool operator==(const NoDefault&) const = default;
};
struct HasNoDefault {
  NoDefault first;
  std::string second;
  bool operator==(const HasNoDefault&) const = default;
};
struct Fields {
  unsigned narrow : 3;
  unsigned wide : 17;
  bool operator==(const Fields&) const = default;
};
struct Coarse {  // its == looks at one member only
  int seen;
  std::string unseen;
  bool operator==(const Coarse& other) const { return seen == other.seen; }
  friend std::uint64_t hash_value(const Coarse& c) { return static_cast<std::uint64_t>(c.seen); }
};
struct WithMod {
  Mod<int> mod;
  const int* pointer;
  bool operator==(const WithMod&) const = default;
};

Nested nested(int n) {
  return {std::to_string(n),
          {{'a', n + 0.5}, {'b', 1}},
          {{n, "pair"}},
          n + 0.25,
          {{1, 2, 3}, {4, 5, n}}};
}

// --- Equal values have equal hashes ----------------------------------------------------------

TEST_CASE("values that are equal have one hash, whatever lies between their members") {
  alignas(Padded) std::array<unsigned char, sizeof(Padded)> memory[2];
  memory[0].fill(0x00);
  memory[1].fill(0xff);
  auto* const a = new (memory[0].data()) Padded;
  auto* const b = new (memory[1].data()) Padded;
  a->c = b->c = 'x';
  a->d = b->d = 1.5;
  CHECK(hash_argument(*a) == hash_argument(*b));
  a->d = 2.5;
  CHECK(hash_argument(*a) != hash_argument(*b));
  CHECK(hash_argument(nested(3)) == hash_argument(nested(3)));
  CHECK(hash_argument(Coarse{1, "a"}) == hash_argument(Coarse{1, "b"}));
  CHECK(hash_argument(std::vector<Coarse>{{1, "a"}}) ==
        hash_argument(std::vector<Coarse>{{1, "b"}}));
}

TEST_CASE("zeros that are equal in a container have one hash") {
  const double zero = 0.0, minus = -0.0;
  CHECK(hash_argument(std::vector{zero}) == hash_argument(std::vector{minus}));
  CHECK(hash_argument(std::pair(1, zero)) == hash_argument(std::pair(1, minus)));
  CHECK(hash_argument(std::array{zero}) == hash_argument(std::array{minus}));
  CHECK(hash_argument(std::optional(zero)) == hash_argument(std::optional(minus)));
  CHECK(hash_argument(std::variant<int, double>(zero)) ==
        hash_argument(std::variant<int, double>(minus)));
  CHECK(hash_argument(Padded{'x', zero}) == hash_argument(Padded{'x', minus}));
  CHECK(hash_argument(std::vector{0.0f}) == hash_argument(std::vector{-0.0f}));
}

TEST_CASE("a set without an order has one hash, in whatever order its elements lie") {
  std::unordered_set<int> up, down(1000);
  for (int i = 0; i < 100; ++i) up.insert(i), down.insert(99 - i);
  REQUIRE(up == down);
  CHECK(hash_argument(up) == hash_argument(down));
  down.erase(5);
  CHECK(hash_argument(up) != hash_argument(down));
}

TEST_CASE("values that differ in any part have different hashes") {
  std::set<std::uint64_t> hashes;
  std::size_t n = 0;
  const auto add = [&](const auto& value) { hashes.insert(hash_argument(value)), ++n; };
  for (int i = 0; i < 4; ++i) {
    add(nested(i));
    Nested other = nested(9);
    other.grid[i / 2][i % 2] = 77;
    add(other);
  }
  Nested other = nested(9);
  other.either = "text";
  add(other);
  other.maybe.reset();
  add(other);
  other.all.pop_back();
  add(other);
  Twelve twelve{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, "12"};
  add(twelve);
  for (int* member : {&twelve.a, &twelve.b, &twelve.f, &twelve.j, &twelve.k})
    ++*member, add(twelve);
  twelve.l = "13";
  add(twelve);
  add(std::vector<int>{});
  add(std::vector<int>{0});
  add(std::vector<int>{0, 0});
  add(std::vector<std::vector<int>>{{1}, {2, 3}});
  add(std::vector<std::vector<int>>{{1, 2}, {3}});
  add(std::list<int>{1, 2, 4});
  add(std::map<int, std::string>{{1, "a"}});
  add(std::map<int, std::string>{{1, "b"}});
  add(std::tuple(1, std::string("a"), 2.5));
  add(std::tuple(1, std::string("a"), 3.5));
  add(std::variant<int, int>(std::in_place_index<0>, 1));
  add(std::variant<int, int>(std::in_place_index<1>, 1));
  add(HasNoDefault{NoDefault(1), "a"});
  add(HasNoDefault{NoDefault(2), "a"});
  add(HasNoDefault{NoDefault(1), "b"});
  add(Fields{1, 2});
  add(Fields{2, 1});
  CHECK(hashes.size() == n);
}

// --- As arguments ----------------------------------------------------------------------------

struct Count {
  static constexpr std::string_view kName = "count";
  template <class T>
  void operator()(Scope& s, const T&, Mod<int> in, Mod<int> out) const {
    s.write(out, s.read(out) + s.read(in));
  }
};
inline constexpr Count count{};

template <class T>
struct Values {
  std::vector<T> all;
  Mod<int> which, in, out;
};
template <class T>
void count_all(Scope& s, Values<T>* values) {
  s.write(values->out, 0);
  const int skipped = s.read(values->which);
  for (int i = 0; i < static_cast<int>(values->all.size()); ++i) {
    if (i != skipped)
      s.call<count>(values->all[static_cast<std::size_t>(i)], values->in, values->out);
  }
}

// Calls are found again by equal arguments, and no others are.
template <class T>
void require_found(std::vector<T> all) {
  Engine e;
  const int n = static_cast<int>(all.size());
  Values<T> values{std::move(all), e.input(-1), e.input(1), e.cell<int>()};
  e.run<count_all<T>>(&values);
  REQUIRE(e.get(values.out) == n);
  for (int skipped = 0; skipped < n; ++skipped) {
    e.set(values.which, skipped);
    const sac::Counts work = e.propagate();
    REQUIRE(e.get(values.out) == n - 1);
    REQUIRE(work.discarded == 1);
    REQUIRE(work.created == (skipped > 0 ? 1 : 0));
    e.check_invariants();
  }
}

TEST_CASE("calls with arguments of any hashable type are found again") {
  require_found<Nested>({nested(1), nested(2), nested(3)});
  require_found<Padded>({{'a', 1}, {'a', 2}, {'b', 1}});
  require_found<HasNoDefault>({{NoDefault(1), "a"}, {NoDefault(1), "b"}});
  require_found<Fields>({{1, 2}, {2, 1}});
  require_found<std::pair<int, std::string>>({{1, "a"}, {2, "a"}, {1, "b"}});
  require_found<std::vector<std::array<int, 2>>>({{}, {{1, 2}}, {{2, 1}}, {{1, 2}, {2, 1}}});
  require_found<std::optional<std::tuple<int, double>>>({{}, {{1, 0.5}}, {{1, 1.5}}});
  require_found<std::variant<std::monostate, int, std::string>>({{}, 1, "1"});
  require_found<std::set<std::string>>({{}, {"a"}, {"a", "b"}});
}

TEST_CASE("hashes are the same in every engine, and those of modifiables are by handle") {
  const auto hash = [] {
    Engine e;
    const auto first = e.input(1);
    const auto second = e.input(2);
    return std::pair(hash_argument(WithMod{first, nullptr}),
                     hash_argument(WithMod{second, nullptr}));
  };
  const auto once = hash();
  CHECK(once == hash());
  CHECK(once.first != once.second);
}

// --- Posted ----------------------------------------------------------------------------------

template <class T>
struct Log {
  sac::Agenda& agenda;
  std::vector<T> posts;
  std::vector<T> ran;
};
template <class T>
void note(Scope& s, const T& value) {
  s.environment<Log<T>>().ran.push_back(value);
}
template <class T>
void post_all(Scope& s) {
  auto& log = s.environment<Log<T>>();
  for (const T& value : log.posts) log.agenda.template post<note<T>>(s, {}, value);
  log.agenda.drain(s);
}
template <class T>
void require_order(const std::vector<T>& sorted) {
  Engine e;
  Log<T> log{e.make_agenda("a"), {sorted.rbegin(), sorted.rend()}, {}};
  log.posts.push_back(sorted[0]);
  e.set_environment(&log);
  e.run<post_all<T>>();
  CHECK(log.ran == sorted);
  e.check_invariants();
}

struct Version {
  int major_number;
  std::vector<std::string> rest;
  auto operator<=>(const Version&) const = default;
};

TEST_CASE("posted calls run in the order that the standard gives their arguments") {
  require_order<std::pair<int, std::string>>({{1, "a"}, {1, "b"}, {2, ""}});
  require_order<std::tuple<double, int>>({{-1.5, 9}, {0.5, 1}, {0.5, 2}});
  require_order<std::vector<int>>({{}, {1}, {1, 0}, {2}});
  require_order<std::array<int, 2>>({{1, 5}, {2, 0}});
  require_order<std::optional<int>>({{}, -7, 3});
  require_order<std::variant<std::string, int>>({"a", "b", -1, 1});
  require_order<Version>({{1, {}}, {1, {"a"}}, {2, {}}});
}

TEST_CASE("a NaN in a part of a posted argument is refused by the name of the call") {
  Engine e;
  auto& agenda = e.make_agenda("a");
  const std::vector<double> bad{std::numeric_limits<double>::quiet_NaN()};
  CHECK_THROWS_AS(agenda.post_from_outside<note<std::vector<double>>>({}, bad), sac::UsageError);
  CHECK(agenda.waiting_calls() == 0);
  e.check_invariants();
}

// --- Names -----------------------------------------------------------------------------------

struct Sink final : sac::LabelSink {
  std::string all;
  void number(std::uint64_t value) override { all += std::to_string(value) + ' '; }
  void text(std::string_view value) override { all += std::string(value) + ' '; }
  void handle(std::uint32_t) override { all += "handle "; }
  void address(const void*) override { all += "address "; }
  std::ostream& print_begin() override { throw std::logic_error("printed"); }
  void print_end() override {}
  void nameless(std::uint64_t) override { all += "nameless "; }
};

TEST_CASE("the name of an argument without a name is that of its parts") {
  Sink sink;
  sac::label_arguments(
      sink, std::tuple(std::optional<int>(), std::optional(7), std::variant<int, std::string>("x"),
                       Fields{1, 2}, std::vector{std::pair(3, 4)}, WithMod{}));
  CHECK(sink.all == "0 1 7 1 x 1 2 1 3 4 handle address ");
}

}  // namespace
