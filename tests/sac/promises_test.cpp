// Promises that a reader of the engine has broken once, each by a program.
#include <array>
#include <catch2/catch.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "sac/sac.hpp"

namespace {

using Catch::Contains;
using sac::Engine;
using sac::Mod;
using sac::PlainScope;
using sac::Scope;

// --- The order of functions --------------------------------------------------------------------

struct Digits {
  Mod<bool> swapped;
  Mod<int> x;
  sac::Agenda& agenda;
};
void append(Scope& s, int digit) {
  auto& d = s.environment<Digits>();
  s.write(d.x, s.read(d.x) * 10 + digit);
}
constexpr auto one = [](Scope& s, int) { append(s, 1); };
constexpr auto two = [](Scope& s, int) { append(s, 2); };

template <auto F, auto G>
void post_two(Scope& s) {
  auto& d = s.environment<Digits>();
  s.write(d.x, 0);
  if (s.read(d.swapped)) d.agenda.post<G>(s, {}, 1);
  d.agenda.post<F>(s, {}, 1);
  if (!s.read(d.swapped)) d.agenda.post<G>(s, {}, 1);
  d.agenda.drain(s);
}

template <auto F, auto G>
int digits(bool swapped, bool swapped_before) {
  Engine e;
  Digits d{e.input(swapped_before), e.cell<int>(), e.make_agenda("digits")};
  e.set_environment(&d);
  e.run<post_two<F, G>>();
  e.set(d.swapped, swapped);
  e.propagate();
  e.check_invariants();
  return e.get(d.x);
}

TEST_CASE("two lambdas of one signature are two functions, in an order of their own") {
  const int order = digits<one, two>(false, false);
  CHECK((order == 12 || order == 21));
  for (const bool now : {false, true}) {
    for (const bool before : {false, true}) CHECK(digits<one, two>(now, before) == order);
  }
}

// --- Agendas as arguments ----------------------------------------------------------------------

struct Draining {
  Mod<bool> calls;
  sac::Agenda* agenda;
};
void takes_agenda(Scope&, sac::Agenda*) {}
void calls_with_agenda(Scope& s) {
  auto& d = s.environment<Draining>();
  if (s.read(d.calls)) s.call<takes_agenda>(d.agenda);
}

TEST_CASE("an agenda that is an argument of a call cannot be released") {
  Engine e;
  auto& agenda = e.make_agenda("a");
  Draining d{e.input(true), &agenda};
  e.set_environment(&d);
  e.run<calls_with_agenda>();
  CHECK_THROWS_WITH(e.release(agenda), Contains("argument of takes_agenda("));
  e.set(d.calls, false);
  e.propagate();
  e.release(agenda);
  e.check_invariants();
}

// --- Arguments ---------------------------------------------------------------------------------

void keep_text(Scope& s, std::string_view text, Mod<int> length) {
  s.write(length, static_cast<int>(text.size()));
  CHECK(text == std::string(text.size(), 'x'));
}
void keep_texts(Scope& s, Mod<int> in, Mod<int> length) {
  s.call<keep_text>(std::string(static_cast<std::size_t>(s.read(in)), 'x'), length);
}

TEST_CASE("a view of characters as a parameter keeps the characters") {
  Engine e;
  const auto in = e.input(50), length = e.cell<int>();
  e.run<keep_texts>(in, length);
  e.set(in, 60);
  e.propagate();
  e.set(in, 50);
  CHECK(e.propagate().executed == 2);
  CHECK(e.get(length) == 50);
}

struct Length {
  template <class S, class M>
  void operator()(S& s, std::string_view text, M length) const {
    s.write(length, static_cast<int>(text.find_first_not_of('y') == text.npos ? text.size() : 0));
  }
};
constexpr Length length_of{};
struct LengthOfLocal {
  template <class S, class M>
  void operator()(S& s, M length) const {
    const std::string local(60, 'y');
    s.template tail<length_of>(std::string_view(local), length);
  }
};
constexpr LengthOfLocal length_of_local{};

TEST_CASE("a tail call keeps the characters of a view, plain and traced") {
  Engine e;
  PlainScope plain;
  const auto traced_length = e.cell<int>();
  const auto plain_length = plain.cell<int>();
  e.run<length_of_local>(traced_length);
  plain.run<length_of_local>(plain_length);
  CHECK(e.get(traced_length) == 60);
  CHECK(plain.get(plain_length) == 60);
}

using Big = std::array<char, 4096>;
void take_big(Scope& s, const Big& big, Mod<int> out) { s.write(out, big[5]); }
TEST_CASE("a large array is an argument like another") {
  Engine e;
  const auto out = e.cell<int>();
  Big big{};
  big[5] = 7;
  e.run<take_big>(big, out);
  CHECK(e.get(out) == 7);
}

template <class S>
struct Pair {
  typename S::template CellType<int> in, out;
};
struct CopyCell {
  template <class S, class M>
  void operator()(S& s, M in, M out) const {
    s.write(out, s.read(in) + 1);
  }
};
constexpr CopyCell copy_cell{};
void copy_int(Scope& s, Mod<int> in, Mod<int> out) { s.write(out, s.read(in) + 1); }
struct CopyPair {
  template <class S>
  void operator()(S& s, Pair<S>* pair) const {
    s.template call<copy_cell>(pair->in, pair->out);
  }
};
constexpr CopyPair copy_pair{};

TEST_CASE("a cell as an argument is its modifiable") {
  Engine e;
  auto& pair = e.make<Pair<Scope>>();
  e.set(pair.in, 1);
  e.run<copy_pair>(&pair);
  CHECK(e.get(pair.out) == 2);
  e.set(pair.in, 5);
  e.propagate();
  CHECK(e.get(pair.out) == 6);
  Engine other;
  auto& typed = other.make<Pair<Scope>>();
  other.set(typed.in, 1);
  other.run<copy_int>(typed.in, typed.out);
  CHECK(other.get(typed.out) == 2);
  PlainScope plain;
  auto& same = plain.make<Pair<PlainScope>>();
  plain.set(same.in, 1);
  plain.run<copy_pair>(&same);
  CHECK(plain.get(same.out) == 2);
}

// --- Plain runs --------------------------------------------------------------------------------

struct NameOf {
  template <class S, class M>
  const std::string& operator()(S& s, M m) const {
    return s.read(m);
  }
};
constexpr NameOf name_of{};
struct Shout {
  template <class S, class M>
  void operator()(S& s, M in, M out) const {
    const std::string before = s.template call<name_of>(in);
    s.write(out, s.template call<name_of>(in) + "!");
    CHECK(before + "!" == s.read(out));
  }
};
constexpr Shout shout{};

template <class Host>
std::string shouted(Host& host) {
  const auto in = host.input(std::string(60, 'a'));
  const auto out = host.template cell<std::string>();
  host.template run<shout>(in, out);
  return host.get(out);
}

TEST_CASE("a plain run returns references as values, as a traced one does") {
  Engine e;
  PlainScope plain;
  CHECK(shouted(e) == shouted(plain));
}

struct ReadNull {
  template <class S>
  void operator()(S& s) const {
    static_cast<void>(s.read(typename S::template ModType<int>()));
  }
};
TEST_CASE("a modifiable that is null is refused, plain and traced") {
  Engine e;
  PlainScope plain;
  CHECK_THROWS_WITH(e.run<ReadNull{}>(), Contains("null"));
  CHECK_THROWS_WITH(plain.run<ReadNull{}>(), Contains("null"));
}

struct Nothing {
  template <class S>
  void operator()(S&, const std::string&) const {}
};
constexpr Nothing nothing{};
struct FailsBehindTail {
  template <class S>
  void operator()(S& s, bool fails) const {
    s.template tail<nothing>(std::string(60, 'b'));
    if (fails) throw std::domain_error("fails");
  }
};
constexpr FailsBehindTail fails_behind_tail{};
struct Posts {
  template <class S>
  void operator()(S& s, typename S::AgendaType* agenda, bool fails) const {
    agenda->template post<fails_behind_tail>(s, {}, fails);
    agenda->drain(s);
  }
};
constexpr Posts posts{};

TEST_CASE("a plain scope goes on after an exception, as an engine does") {
  Engine e;
  PlainScope plain;
  CHECK_THROWS_AS(e.run<fails_behind_tail>(true), std::domain_error);
  CHECK_THROWS_AS(plain.run<fails_behind_tail>(true), std::domain_error);
  CHECK_NOTHROW(e.run<fails_behind_tail>(false));
  CHECK_NOTHROW(plain.run<fails_behind_tail>(false));
  auto& agenda = e.make_agenda("a");
  auto& plain_agenda = plain.make_agenda("a");
  CHECK_THROWS_AS(e.run<posts>(&agenda, true), std::domain_error);
  CHECK_THROWS_AS(plain.run<posts>(&plain_agenda, true), std::domain_error);
  CHECK_NOTHROW(e.run<posts>(&agenda, false));
  CHECK_NOTHROW(plain.run<posts>(&plain_agenda, false));
}

// --- Agendas whose drain has left --------------------------------------------------------------

struct Unposting {
  Mod<bool> drains;
  std::vector<Mod<int>> keys;
  sac::Agenda& agenda;
};
void work(Scope&, int, int) {}
void post_work(Scope& s, int i) {
  auto& u = s.environment<Unposting>();
  const int key = s.read(u.keys[static_cast<std::size_t>(i)]);
  u.agenda.post<work>(s, {.bucket = key}, i, key);
}
void drain_perhaps(Scope& s) {
  auto& u = s.environment<Unposting>();
  if (s.read(u.drains)) u.agenda.drain(s);
}
void post_all(Scope& s) {
  auto& u = s.environment<Unposting>();
  for (int i = 0; i < static_cast<int>(u.keys.size()); ++i) s.call<post_work>(i);
  s.call<drain_perhaps>();
}

TEST_CASE("what waits for another drain is found at once when nobody posts it any more") {
  Engine e;
  Unposting u{e.input(true), {}, e.make_agenda("a")};
  for (int i = 0; i < 200; ++i) u.keys.push_back(e.input(i % 7));
  e.set_environment(&u);
  e.run<post_all>();
  e.set(u.drains, false);
  e.propagate();
  for (int i = 0; i < 200; i += 3) {
    e.set(u.keys[static_cast<std::size_t>(i)], 50 + i);
    e.propagate();
    e.check_invariants();
    CHECK(u.agenda.waiting_calls() == 200);
  }
  e.set(u.drains, true);
  e.propagate();
  e.check_invariants();
  CHECK(u.agenda.waiting_calls() == 0);
}

// --- Sequences ---------------------------------------------------------------------------------

TEST_CASE("an id of a saved element leaves room for new ones") {
  Engine e;
  using Saved = sac::Sequence<int>::Saved;
  CHECK_THROWS_WITH((sac::Sequence<int>(e, std::vector<Saved>{{{~std::uint64_t{0}}, 1}})),
                    Contains("id"));
  sac::Sequence<int> s(e, std::vector<Saved>{{{std::uint64_t{1} << 63}, 1}});
  CHECK(s.push_back(2).value == (std::uint64_t{1} << 63) + 1);
}

}  // namespace
