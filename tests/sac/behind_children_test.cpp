// What a call does behind children that have run: seen by a structure that does not look itself.
#include <algorithm>
#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "sac/sac.hpp"

namespace {

using Catch::Contains;
using sac::Call;
using sac::Edge;
using sac::Engine;
using sac::Handle;
using sac::Mod;
using sac::Scope;

// Numbers under keys. A call that asks for a key sees the sum of what calls up to itself have
// added.
class Sums final : public sac::Structure {
 public:
  // Whom an addition concerns: those who would see another sum; all, to be asked; all.
  enum class Care { exact, doubtful, nervous };
  Sums(Engine& engine, Care care, bool hides = true)
      : engine_(engine), id_(engine.add_structure(*this)), care_(care), hides_(hides) {}

  void add(Scope& s, int key, int value) {
    const auto same = [&](const Entry& e) { return e.key == key && e.value == value; };
    if (s.recall<Entry>(id_, kAdd, same) != nullptr) return;
    tell(enter(s, kAdd, key, value), 0);
  }
  int sum(Scope& s, int key) {
    const auto same = [&](const Entry& e) { return e.key == key; };
    Entry* asked = s.recall<Entry>(id_, kAsk, same);
    if (asked == nullptr) asked = &enter(s, kAsk, key, 0);
    return asked->value = sum_at(s.self(), key);
  }

  void retract(Call&, Edge& edge) noexcept override {
    auto& entry = static_cast<Entry&>(edge);
    std::erase(entries_, &entry);
    if (edge.kind == kAdd) tell(entry, 0);
  }
  void hide(Call&, Edge& edge, Handle end) noexcept override {
    if (hides_ && edge.kind == kAdd) tell(static_cast<Entry&>(edge), end);
  }
  bool unchanged(Call& call, Edge& edge) override {
    const auto& entry = static_cast<const Entry&>(edge);
    return edge.kind == kAdd || entry.value == sum_at(call, entry.key);
  }

 private:
  static constexpr std::uint8_t kAsk = 0, kAdd = 1;
  struct Entry : Edge {
    Handle call;
    int key;
    int value;  // added, or seen
  };

  Entry& enter(Scope& s, std::uint8_t kind, int key, int value) {
    auto& entry = s.effect<Entry>(id_, kind);
    entry.call = engine_.handle_of(s.self());
    entry.key = key;
    entry.value = value;
    entries_.push_back(&entry);
    return entry;
  }
  int sum_at(const Call& call, int key) const {
    int sum = 0;
    for (const Entry* e : entries_) {
      const Call& by = engine_.call(e->call);
      const bool counts = e->kind == kAdd && e->key == key && !(hides_ && unrepeated(by, *e));
      if (counts && (&by == &call || engine_.precedes(by, call))) sum += e->value;
    }
    return sum;
  }
  void tell(const Entry& added, Handle end) noexcept {
    for (const Entry* e : entries_) {
      Call& call = engine_.call(e->call);
      if (e->kind != kAsk || !engine_.lies_between(engine_.call(added.call), call, end)) continue;
      if (care_ == Care::doubtful) {
        engine_.doubt(call);
      } else if (care_ == Care::nervous || e->value != sum_at(call, e->key)) {
        engine_.invalidate(call, e);
      }
    }
  }

  Engine& engine_;
  std::uint8_t id_;
  Care care_;
  bool hides_;
  std::vector<Entry*> entries_;
};

struct Adding {
  Sums& sums;
  Mod<int> key;  // what the parent adds to behind its child; 0: nothing
  Mod<int> out;
};
void ask_for_1(Scope& s) {
  auto& a = s.environment<Adding>();
  s.write(a.out, a.sums.sum(s, 1));
}
void add_behind_child(Scope& s) {
  auto& a = s.environment<Adding>();
  const int key = s.read(a.key);
  s.call<ask_for_1>();
  if (key != 0) a.sums.add(s, key, 7);
}

constexpr auto kRefused =
    "add_behind_child() has done something behind its own child ask_for_1(), which should have "
    "seen "
    "it";

TEST_CASE(
    "what a call does behind a child that should have seen it is refused, whatever the "
    "structure lets pass") {
  for (const auto care : {Sums::Care::exact, Sums::Care::doubtful, Sums::Care::nervous}) {
    Engine e;
    Sums sums(e, care);
    Adding a{sums, e.input(1), e.cell<int>()};
    e.set_environment(&a);
    CHECK_THROWS_WITH(e.run<add_behind_child>(), Contains(kRefused));
    CHECK(e.live_calls() == 0);
    CHECK(e.settled());
    e.set(a.key, 0);
    e.run<add_behind_child>();
    e.set(a.key, 1);
    CHECK_THROWS_WITH(e.propagate(), Contains(kRefused));
    CHECK(e.get(a.key) == 0);
    CHECK(e.get(a.out) == 0);
    e.check_invariants();
  }
}

TEST_CASE(
    "what does not concern a child may be done behind it, unless the structure says otherwise") {
  for (const auto care : {Sums::Care::exact, Sums::Care::doubtful, Sums::Care::nervous}) {
    Engine e;
    Sums sums(e, care);
    Adding a{sums, e.input(2), e.cell<int>()};
    e.set_environment(&a);
    if (care == Sums::Care::nervous) {
      CHECK_THROWS_WITH(e.run<add_behind_child>(), Contains(kRefused));
      continue;
    }
    e.run<add_behind_child>();
    for (const int key : {0, 3, 2}) {
      e.set(a.key, key);
      e.propagate();
      CHECK(e.get(a.out) == 0);
      e.check_invariants();
    }
  }
}

// --- A link that runs again --------------------------------------------------------------------

struct Summing {
  Sums& sums;
  Mod<int> on, out;
};
int ask_for_2(Scope& s) { return s.environment<Summing>().sums.sum(s, 2); }
void take_sum(Scope& s, int sum) { s.write(s.environment<Summing>().out, sum); }
void pass_by(Scope&, int) {}
void add_or_ask(Scope& s) {
  auto& a = s.environment<Summing>();
  if (s.read(a.on) == 0) return a.sums.add(s, 2, 7);
  const int sum = s.call<ask_for_2>();
  if (sum != 0) s.call<pass_by>(sum);
  s.tail<take_sum>(sum);
}
void add_or_ask_between(Scope& s) {
  s.call<pass_by>(-1);
  s.call<add_or_ask>();
  s.call<pass_by>(-2);
}
std::vector<std::string> calls_of(const Engine& e) {
  std::vector<std::string> calls;
  e.walk([&](const Call& c, std::size_t depth) {
    calls.push_back(std::string(depth, ' ') + Engine::describe(c));
  });
  return calls;
}

// The structure shows children what their parent has not repeated: they are put right when that is
// taken back, and the parent after them, before its tail call.
TEST_CASE("a call that was a leaf runs again before its tail call if a child's result changes") {
  Engine e, fresh;
  Sums sums(e, Sums::Care::exact, false), fresh_sums(fresh, Sums::Care::exact, false);
  Summing a{sums, e.input(0), e.cell<int>()};
  Summing b{fresh_sums, fresh.input(1), fresh.cell<int>()};
  e.set_environment(&a);
  fresh.set_environment(&b);
  e.run<add_or_ask_between>();
  fresh.run<add_or_ask_between>();
  e.set(a.on, 1);
  CHECK(e.propagate().executed == 6);  // add_or_ask and ask_for_2 twice, pass_by(7), take_sum(0)
  e.check_invariants();
  CHECK(calls_of(e) == calls_of(fresh));
  CHECK(e.get(a.out) == 0);
}

}  // namespace
