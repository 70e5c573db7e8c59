#include "traces/stability.hpp"

#include <catch2/catch.hpp>
#include <random>
#include <stdexcept>
#include <vector>

#include "programs.hpp"

namespace {

// A mapped list into which random ids are inserted; figure "n" is its length.
class Lists : public traces::Subject {
 public:
  explicit Lists(unsigned seed) : random_(seed) {}

  Edit edit() override {
    const std::size_t place = random_() % ids_.size();
    const int id = ++last_;
    const sac::Counts work = list_.insert(id, ids_[place]);
    ids_.insert(ids_.begin() + static_cast<std::ptrdiff_t>(place) + 1, id);
    return {work, {{"n", static_cast<double>(ids_.size())}}};
  }
  [[nodiscard]] traces::Trace trace() const override { return list_.trace(); }
  [[nodiscard]] traces::Trace fresh_trace() const override {
    return programs::ListMap(ids_, 7).trace();
  }

 protected:
  std::mt19937 random_;
  int last_ = 100;
  std::vector<int> ids_ = {1, 2, 3};
  programs::ListMap list_{ids_};
};

// Its propagated trace lacks the last call.
class Forgetful : public Lists {
 public:
  using Lists::Lists;
  [[nodiscard]] traces::Trace trace() const override {
    traces::Trace trace = Lists::trace();
    trace.calls.pop_back();
    return trace;
  }
};

class Nameless : public Lists {
 public:
  using Lists::Lists;
  [[nodiscard]] traces::Trace fresh_trace() const override {
    traces::Trace trace = Lists::fresh_trace();
    trace.unnamed = 1;
    return trace;
  }
};

}  // namespace

TEST_CASE("Edits of a mapped list are tabled with their distance, work and figures") {
  const unsigned seed = std::random_device{}();
  INFO("seed " << seed);
  Lists lists(seed);
  std::uint64_t told = 0;
  traces::StabilityOptions options;
  options.each = [&](const traces::StabilityRow& row) { told += row.distance; };
  const auto rows = traces::stability(lists, 20, options);
  REQUIRE(rows.size() == 20);
  double n = 3;
  std::uint64_t distance = 0;
  for (const traces::StabilityRow& row : rows) {
    REQUIRE(row.figures.size() == 1);
    CHECK(row.figures[0].value == ++n);
    CHECK(row.distance == 5);  // 3 new calls; one reads another item
    CHECK(row.drift == 0);
    CHECK(row.work() == 5);  // 3 made, 2 of 4 with a body to run
    CHECK(row.ratio() == Approx(static_cast<double>(row.work()) / double(row.distance)));
    distance += row.distance;
  }
  CHECK(told == distance);
}

TEST_CASE("Trusting propagated traces gives the same table, without looking for drift") {
  Lists lists(5), same(5);
  Forgetful forgetful(5), trusted(5);
  traces::StabilityOptions trust;
  trust.fresh = false;
  const auto rows = traces::stability(lists, 10), others = traces::stability(same, 10, trust);
  for (std::size_t i = 0; i < 10; ++i) CHECK(rows[i].distance == others[i].distance);
  for (const auto& row : traces::stability(forgetful, 3)) CHECK(row.drift == 1);
  for (const auto& row : traces::stability(trusted, 3, trust)) CHECK(row.drift == 0);
}

TEST_CASE("A trace with calls that have no name has no stability") {
  Nameless nameless(5);
  CHECK_THROWS_AS(traces::stability(nameless, 1), std::invalid_argument);
}
