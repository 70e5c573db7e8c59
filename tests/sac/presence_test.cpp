// A presence: who sees a thing that several calls produce, and who is told when that changes.
#include "sac/presence.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <memory>
#include <vector>

#include "random.hpp"
#include "sac/sac.hpp"

namespace {

// One thing; calls put it there and ask whether it is there.
class Thing : public sac::Structure {
 public:
  explicit Thing(sac::Engine& engine)
      : engine_(engine), presences_(engine), id_(engine.add_structure(*this)) {}

  void produce(sac::Scope& s) {
    const auto any = [](const Producing&) { return true; };
    if (s.recall<Producing>(id_, kProducing, any) != nullptr) return;
    auto& edge = s.effect<Producing>(id_, kProducing);
    tell(presences_.produced(presence_, edge, s.place()));
  }
  bool is_there(sac::Scope& s) {
    const auto any = [](const Asking&) { return true; };
    if (s.recall<Asking>(id_, kAsking, any) == nullptr) {
      auto& edge = s.observe<Asking>(id_, kAsking);
      edge.place = s.place();
      asking_.push_back(edge.place);
    }
    return presences_.seen_at(presence_, s.place());
  }
  void retract(sac::Call&, sac::Edge& edge) noexcept override {
    if (edge.kind == kProducing) {
      return tell(presences_.retracted(presence_, static_cast<Producing&>(edge)));
    }
    asking_.erase(std::find(asking_.begin(), asking_.end(), static_cast<Asking&>(edge).place));
  }
  [[nodiscard]] const sac::Presence& presence() const { return presence_; }
  void check_invariants() const override { presences_.check_invariants(presence_); }

 private:
  static constexpr std::uint8_t kProducing = 0;
  static constexpr std::uint8_t kAsking = 1;
  struct Producing : sac::ProducerEdge {};
  struct Asking : sac::Edge {
    sac::Place place;
  };

  void tell(const std::optional<sac::Window>& window) noexcept {
    if (!window.has_value()) return;
    for (const sac::Place h : asking_) {
      if (window->contains(engine_, engine_.time(h))) engine_.invalidate(h);
    }
  }

  sac::Engine& engine_;
  sac::Presences presences_;
  sac::Presence presence_;
  std::uint8_t id_;
  std::vector<sac::Place> asking_;
};

// Calls in turn: the i-th pair produces the thing if it is told to, and asks whether it is there.
struct Row {
  sac::Engine engine;
  Thing thing{engine};
  std::vector<sac::Mod<bool>> told, answer;

  explicit Row(std::size_t n);
  std::uint64_t set(std::size_t i, bool on) {
    engine.set(told[i], on);
    return engine.propagate().executed;
  }
  [[nodiscard]] std::vector<bool> answers() const {
    std::vector<bool> all;
    for (const auto& a : answer) all.push_back(engine.get(a));
    return all;
  }
};

struct Produce {
  void operator()(sac::Scope& s, std::size_t i) const {
    auto& row = s.environment<Row>();
    if (s.read(row.told[i])) row.thing.produce(s);
  }
};
inline constexpr Produce produce{};

struct Ask {
  void operator()(sac::Scope& s, std::size_t i) const {
    auto& row = s.environment<Row>();
    s.write(row.answer[i], row.thing.is_there(s));
  }
};
inline constexpr Ask ask{};

struct InTurn {
  void operator()(sac::Scope& s) const {
    const std::size_t n = s.environment<Row>().told.size();
    for (std::size_t i = 0; i < n; ++i) {
      s.call<produce>(i);
      s.call<ask>(i);
    }
  }
};
inline constexpr InTurn in_turn{};

Row::Row(std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) {
    told.push_back(engine.input(false));
    answer.push_back(engine.cell<bool>());
  }
  engine.set_environment(this);
  engine.run<in_turn>();
}

}  // namespace

TEST_CASE("a thing is there from its earliest producer on") {
  Row row(4);
  CHECK(row.answers() == std::vector{false, false, false, false});
  row.set(2, true);
  CHECK(row.answers() == std::vector{false, false, true, true});
  row.set(1, true);
  CHECK(row.answers() == std::vector{false, true, true, true});
  row.set(2, false);
  CHECK(row.answers() == std::vector{false, true, true, true});
  row.set(1, false);
  CHECK(row.answers() == std::vector{false, false, false, false});
  CHECK_FALSE(row.thing.presence().there());
}

TEST_CASE("a thing that stays with a later producer is taken from those between the two only") {
  Row row(6);
  row.set(1, true);
  row.set(4, true);
  CHECK(row.set(1, false) == 1 + 3);  // the producer, and those who ask at 1, 2, 3
  CHECK(row.answers() == std::vector{false, false, false, false, true, true});
}

TEST_CASE("an earlier producer gives a thing to those before the old one only, a later to nobody") {
  Row row(6);
  row.set(4, true);
  CHECK(row.set(1, true) == 1 + 3);
  CHECK(row.set(5, true) == 1);
  CHECK(row.set(5, false) == 1);
  CHECK(row.answers() == std::vector{false, true, true, true, true, true});
}

TEST_CASE(
    "after random edits everybody has the answer of a run from scratch, and no one ran more") {
  constexpr std::size_t kPairs = 24;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    INFO("seed " << seed);
    support::Random random(seed);
    Row row(kPairs);
    std::vector<bool> told(kPairs, false);
    for (int step = 0; step < 200; ++step) {
      const auto i = static_cast<std::size_t>(random(kPairs));
      const std::vector<bool> before = row.answers();
      told[i] = !told[i];
      const std::uint64_t executed = row.set(i, told[i]);
      std::vector<bool> expected(kPairs);
      bool there = false;
      for (std::size_t k = 0; k < kPairs; ++k) expected[k] = there = there || told[k];
      REQUIRE(row.answers() == expected);
      std::uint64_t changed = 0;
      for (std::size_t k = 0; k < kPairs; ++k) changed += before[k] != expected[k];
      REQUIRE(executed == 1 + changed);
      row.thing.check_invariants();
      row.engine.check_invariants();
    }
  }
}
