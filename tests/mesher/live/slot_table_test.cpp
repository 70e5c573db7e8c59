// Records in slots, against a map; plans that are dropped leave no trace.
#include "live/slot_table.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <map>
#include <random>
#include <set>

namespace {

using mesher::kNoSlot;
using mesher::Slot;
// Few homes for many records: runs of full buckets that wrap around.
struct PoorHash {
  std::uint64_t operator()(int record) const noexcept {
    return static_cast<std::uint64_t>(record) % 7 + 13;
  }
};
using Table = mesher::detail::SlotTable<int, PoorHash>;

class Twin {
 public:
  explicit Twin(std::uint64_t seed) : random_(seed) {}

  void step() {
    const auto come = some_new(random_() % 6);
    const auto go = some_old();
    if (random_() % 3 == 0) {
      table_.plan(come, go);
      table_.drop();
      return check();
    }
    table_.plan(come, go);
    const std::vector<Slot> chosen = table_.chosen();
    const std::size_t slots = table_.planned_slots();
    table_.keep();
    REQUIRE(table_.records().size() == slots);
    free_.insert(left_.begin(), left_.end());
    left_ = {go.begin(), go.end()};
    for (const Slot s : go) slots_.erase(table_[s]);
    for (std::size_t i = 0; i < come.size(); ++i) {
      if (free_.empty()) free_.insert(end_++);
      REQUIRE(chosen[i] == *free_.begin());
      free_.erase(free_.begin());
      slots_[come[i]] = chosen[i];
    }
    check();
  }

 private:
  std::vector<int> some_new(std::size_t count) {
    std::vector<int> all;
    while (all.size() < count) all.push_back(next_++);
    return all;
  }
  std::vector<Slot> some_old() {
    std::vector<Slot> all;
    for (const auto& [record, slot] : slots_) {
      if (random_() % 8 == 0) all.push_back(slot);
    }
    return all;
  }
  void check() {
    table_.check_invariants();
    REQUIRE(table_.size() == slots_.size());
    REQUIRE(table_.records().size() == end_);
    for (int record = 0; record < next_; ++record) {
      const auto it = slots_.find(record);
      REQUIRE(table_.find(record) == (it == slots_.end() ? kNoSlot : it->second));
    }
  }

  std::mt19937_64 random_;
  Table table_;
  std::map<int, Slot> slots_;
  std::set<Slot> free_, left_;
  Slot end_ = 0;
  int next_ = 0;
};

}  // namespace

TEST_CASE("records come to the lowest slots that are free, and are found there") {
  Twin twin(GENERATE(1, 2, 3));
  for (int i = 0; i < 200; ++i) twin.step();
}

TEST_CASE(
    "a slot that is left is used again from the next plan on, and shows its record until then") {
  Table table;
  table.plan({10, 11, 12}, {});
  table.keep();
  table.plan({20}, {1});
  CHECK(table.chosen() == std::vector<Slot>{3});
  table.keep();
  CHECK_FALSE(table.is_live(1));
  CHECK(table[1] == 11);
  CHECK(table.find(11) == kNoSlot);
  table.plan({30, 31}, {});
  CHECK(table.chosen() == std::vector<Slot>{1, 4});
  table.drop();
  CHECK(table[1] == 11);
  table.plan({40}, {});
  table.keep();
  CHECK(table.find(40) == 1);
}
