#include "traces/distance.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <random>
#include <vector>

#include "programs.hpp"
#include "scratch_file.hpp"

namespace {

using support::ScratchFolder;

traces::Trace loaded(const ScratchFolder& folder, const std::string& name) {
  return traces::load_trace(folder.path(name));
}

// Labels as numbers; every third belongs to another function.
traces::Trace trace_of(const std::vector<int>& labels) {
  traces::Trace trace;
  trace.functions = {"f", "g"};
  for (const int label : labels) {
    const auto word = static_cast<std::uint64_t>(label);
    trace.calls.push_back({{word * 17, word}, label % 3 == 0 ? 1u : 0u});
  }
  return trace;
}

std::vector<int> random_labels(std::mt19937& random) {
  std::vector<int> labels(random() % 30);
  for (int& label : labels) label = static_cast<int>(random() % 12);
  return labels;
}

}  // namespace

TEST_CASE("The distance of a trace to itself is 0") {
  ScratchFolder folder;
  programs::ListMap({1, 2, 3}).record(folder.path("a"));
  const auto d = traces::distance(loaded(folder, "a"), loaded(folder, "a"));
  CHECK(d.all.distance() == 0);
  CHECK(d.all.common == 10);
}

TEST_CASE("One insertion into a mapped list makes three calls and changes one, at any length") {
  for (const int length : {1, 10, 1000}) {
    ScratchFolder folder;
    std::vector<int> ids, more;
    for (int i = 1; i <= length; ++i) {
      ids.push_back(2 * i);
      more.push_back(2 * i);
      if (i == (length + 1) / 2) more.push_back(2 * i + 1);
    }
    programs::ListMap(ids).record(folder.path("a"));
    programs::ListMap(more, 77).record(folder.path("b"));
    const auto d = traces::distance(loaded(folder, "a"), loaded(folder, "b"));
    // New: the call for the new item, its copy, its cell. The call before reads another item.
    CHECK(d.all.distance() == 5);
    CHECK(d.by_function.at("map").distance() == 3);
    CHECK(d.by_function.at("make Item").distance() == 1);
    CHECK(d.by_function.at("make Cell").distance() == 1);
    CHECK(d.all.calls_a == static_cast<std::uint64_t>(3 * length + 1));
    CHECK(d.all.calls_b == d.all.calls_a + 3);
    CHECK(d.all.common == d.all.calls_a - 1);
  }
}

TEST_CASE("Propagation after an insertion does the work that the distance says") {
  ScratchFolder folder;
  programs::ListMap list({1, 2, 4});
  list.record(folder.path("a"));
  const sac::Counts work = list.insert(3, 2);
  list.record(folder.path("b"));
  const auto d = traces::distance(loaded(folder, "a"), loaded(folder, "b"));
  CHECK(work.created + work.discarded + work.executed == d.all.distance());
}

TEST_CASE("The distance equals a count over multisets by definition [Def 1.4.2]") {
  const unsigned seed = std::random_device{}();
  INFO("seed " << seed);
  std::mt19937 random(seed);
  for (int round = 0; round < 300; ++round) {
    auto a = random_labels(random), b = random_labels(random);
    const auto d = traces::distance(trace_of(a), trace_of(b));
    std::sort(a.begin(), a.end());
    std::sort(b.begin(), b.end());
    std::vector<int> only_one;
    std::set_symmetric_difference(a.begin(), a.end(), b.begin(), b.end(),
                                  std::back_inserter(only_one));
    REQUIRE(d.all.distance() == only_one.size());
    const auto of_g =
        std::count_if(only_one.begin(), only_one.end(), [](int x) { return x % 3 == 0; });
    REQUIRE(d.by_function.at("g").distance() == static_cast<std::uint64_t>(of_g));
  }
}
