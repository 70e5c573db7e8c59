// The engine's examples, recorded: their traces have names throughout, propagated traces are those
// of fresh runs, and work follows the distance [Theorem 1.4.4].
//
// `traces_tests "[.table]"` prints a line for each example: distance and work of random edits.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdint>
#include <cstdio>
#include <tuple>
#include <vector>

#include "app_subject.hpp"
#include "apps/all.hpp"
#include "traces/stability.hpp"

namespace {

using namespace apps;
using tool::AppSubject;

// The points of few places, too: many share one, or lie on a line.
using Examples = decltype(std::tuple_cat(apps::All(), std::tuple<QuickhullApp<any_point>>()));

// Inputs of `size` elements, and few.
template <class App>
void check_work(std::uint64_t seeds, int size) {
  std::uint64_t work = 0;
  std::uint64_t distance = 0;
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    const int n = seed % 4 == 0 ? static_cast<int>(seed % 12) / 2 : size;
    AppSubject<App> subject(seed, n);
    CHECK(subject.trace().unnamed == 0);
    for (const traces::StabilityRow& row : traces::stability(subject, 60)) {
      INFO(App::kName << ", size " << n << ", seed " << seed);
      REQUIRE(row.drift == 0);
      CAPTURE(row.work(), row.distance);
      if (!apps::kMovesCalls<App>) REQUIRE(row.ratio() <= 2);
      work += row.work();
      distance += row.distance;
    }
  }
  INFO(App::kName << ": " << work << " for " << distance);
  if (!apps::kMovesCalls<App>) CHECK(work <= distance * 3 / 2);
}

TEMPLATE_LIST_TEST_CASE("examples: work is at most twice the distance [Thm 1.4.4]", "", Examples) {
  check_work<TestType>(12, 60);
}

TEMPLATE_LIST_TEST_CASE("examples: the same for many edits", "[.soak]", Examples) {
  check_work<TestType>(300, 150);
}

TEMPLATE_LIST_TEST_CASE("table of distance and work", "[.table]", apps::All) {
  AppSubject<TestType> subject(1, 1000);
  std::vector<std::uint64_t> distances;
  std::vector<double> ratios;
  std::uint64_t work = 0;
  std::uint64_t confirmed = 0;
  std::uint64_t distance = 0;
  std::vector<std::uint64_t> weights;
  std::uint64_t heaviest = 0;
  traces::StabilityOptions options;
  options.fresh = false;
  for (const auto& row : traces::stability(subject, 300, options)) {
    distances.push_back(row.distance);
    ratios.push_back(row.ratio());
    work += row.work();
    confirmed += row.counts.confirmed;
    distance += row.distance;
    weights.push_back(row.weight_distance);
    heaviest = std::max(heaviest, row.heaviest);
  }
  const double all = static_cast<double>(std::max<std::uint64_t>(distance, 1));
  std::sort(distances.begin(), distances.end());
  std::sort(ratios.begin(), ratios.end());
  std::sort(weights.begin(), weights.end());
  std::printf(
      "{\"example\":\"%s\",\"n\":1000,\"edits\":300,\"distance_median\":%d,"
      "\"distance_max\":%d,\"ratio_median\":%.2f,\"ratio_max\":%.2f,\"ratio_mean\":%.2f,"
      "\"confirmed_mean\":%.2f,\"weight_distance_median\":%d,\"weight_distance_max\":%d,"
      "\"heaviest\":%d}\n",
      TestType::kName, static_cast<int>(distances[150]), static_cast<int>(distances[299]),
      ratios[150], ratios[299], static_cast<double>(work) / all,
      static_cast<double>(confirmed) / all, static_cast<int>(weights[150]),
      static_cast<int>(weights[299]), static_cast<int>(heaviest));
}

}  // namespace
