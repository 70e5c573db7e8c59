// Weights in traces: the distance by weight, and that no example hides work inside of its calls.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

#include "app_subject.hpp"
#include "apps/all.hpp"
#include "scratch_file.hpp"
#include "traces/distance.hpp"
#include "traces/recorder.hpp"
#include "traces/stability.hpp"

namespace {

using namespace apps;
using tool::AppSubject;

// Uniform in a square: nearly all points are dropped by the second filters.
Point point_in_square(Random& random, std::uint32_t id) {
  return random_point(random, id, 0, 1 << 28);
}
// On a parabola: all are corners, no filter drops any but at its end.
Point point_on_curve(Random& random, std::uint32_t id) {
  const int x = random(1 << 14) - (1 << 13);
  return {x, x * x, id};
}
// In a triangle: the first filter keeps all or none, the next drop nearly all.
Point point_in_corner(Random& random, std::uint32_t id) {
  const int x = random(1 << 20);
  return {x, random(x + 1), id};
}
// The least come first: the first pivot is one of them, and nearly all are dropped below it.
struct LeastFirst : QuicksortApp {
  static Input random_input(Random& random, int size) {
    Input input = QuicksortApp::random_input(random, size);
    for (int i = 0; i < std::min(size, 100); ++i) {
      input.elements[static_cast<std::size_t>(i)].value = i - 1000;
    }
    return input;
  }
};

using Hard =
    std::tuple<QuickhullApp<point_in_square>, DiameterApp<point_in_square>, DistanceApp<1 << 27>,
               QuickhullApp<point_on_curve>, QuickhullApp<point_in_corner>, LeastFirst>;
using Examples = decltype(std::tuple_cat(apps::All(), Hard()));

// Far above what is seen, some 600, and far below the sizes of the inputs.
constexpr std::uint64_t kHeaviest = 1024;

template <class App>
void check_weights(int size, std::uint64_t edits) {
  AppSubject<App> subject(static_cast<std::uint64_t>(size), size);
  traces::StabilityOptions trust;
  trust.fresh = false;
  for (const traces::StabilityRow& row : traces::stability(subject, edits, trust)) {
    INFO(App::kName << ", size " << size);
    CAPTURE(row.work(), row.distance, row.weight_work(), row.weight_distance);
    if (!apps::kMovesCalls<App>) REQUIRE(row.weight_work() <= 2 * row.weight_distance);
    REQUIRE(row.heaviest <= kHeaviest);
  }
}

// Calls that said so much, with labels that hash so.
traces::Trace trace_of(const std::vector<std::uint64_t>& hashes,
                       const std::vector<std::uint64_t>& said) {
  traces::Trace trace;
  trace.functions = {"f"};
  for (std::size_t i = 0; i < hashes.size(); ++i) trace.add({{hashes[i], 0}, 0, 0, 0}, said[i]);
  return trace;
}

}  // namespace

TEMPLATE_LIST_TEST_CASE("no call of an example is heavy in an update, however large the input", "",
                        Examples) {
  check_weights<TestType>(300, 100);
  check_weights<TestType>(8000, 20);
}

TEMPLATE_LIST_TEST_CASE("the same for many edits", "[.soak]", Examples) {
  check_weights<TestType>(20'000, 300);
}

TEST_CASE("By weight, a call that one trace alone has counts as much as it weighs") {
  const traces::Trace a = trace_of({1, 2, 3}, {0, 10, 100});
  const traces::Trace b = trace_of({1, 3, 4, 5}, {0, 200, 20, 0});
  CHECK(a.weight_of(0) == 1);
  CHECK(a.weight_of(1) == 11);
  const traces::CallCounts all = traces::distance(a, b).all;
  CHECK(all.distance() == 3);
  CHECK(all.weight_a == 113);
  CHECK(all.weight_b == 224);
  CHECK(all.weight_distance == 11 + 21 + 1);
  CHECK(all.heaviest == 21);
}

TEST_CASE("A trace in which no call says anything takes no memory for weights") {
  const traces::Trace a = trace_of({1, 2}, {0, 0}), b = trace_of({1, 3}, {0, 0});
  CHECK(a.weights.empty());
  const traces::CallCounts all = traces::distance(a, b).all;
  CHECK(all.weight_distance == all.distance());
  CHECK(all.heaviest == 1);
}

TEST_CASE("Weights are the same in a trace file, in memory and in a run from scratch") {
  support::ScratchFolder folder;
  AppSubject<QuickhullApp<point_in_square>> subject(1, 1000);
  for (int i = 0; i < 20; ++i) subject.edit();
  subject.record(folder.path("t"), traces::Edges::no);
  const traces::Trace loaded = traces::load_trace(folder.path("t"));
  CHECK(!loaded.weights.empty());
  CHECK(loaded.weights == subject.trace().weights);
  CHECK(loaded.weights == subject.fresh_trace().weights);
}
