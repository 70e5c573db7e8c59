// The thesis's programs by their traces: concise and monotone [L 4.1.14, 4.1.19], propagated traces
// are those of fresh runs, and work follows the distance [Theorem 1.4.4], which follows lg(L/s)
// [Theorems 4.1.13, 4.3.8].
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <vector>

#include "app_subject.hpp"
#include "thesis_app.hpp"
#include "traces/audit.hpp"
#include "traces/distance.hpp"
#include "traces/stability.hpp"

namespace {

using support::ThesisApp;
using tool::AppSubject;
namespace thesis = examples::thesis;

constexpr int kSizes[] = {0, 60, 30, 10, 4};  // by dimension

}  // namespace

TEMPLATE_TEST_CASE_SIG("thesis: work is at most twice the distance, in calls and by weight",
                       "[Theorem 1.4.4]", ((int D), D), 1, 2, 3) {
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    AppSubject<ThesisApp<D>> subject(seed, kSizes[D]);
    for (const traces::StabilityRow& row : traces::stability(subject, D == 3 ? 8 : 20)) {
      INFO("seed " << seed << ": work " << row.work() << ", distance " << row.distance);
      CHECK(row.drift == 0);
      CHECK(row.work() <= 2 * row.distance);
      CHECK(row.weight_work() <= 2 * row.weight_distance);
    }
  }
}

TEMPLATE_TEST_CASE_SIG("thesis: traces of fresh runs are concise, and monotone from edit to edit",
                       "[L 4.1.14, L 4.1.19, Def 1.4.2, Def 1.4.3]", ((int D), D), 1, 2, 3, 4) {
  for (std::uint64_t seed = 10; seed < (D < 4 ? 13 : 11); ++seed) {
    AppSubject<ThesisApp<D>> subject(seed, kSizes[D]);
    traces::Trace before = subject.fresh_trace();
    for (int i = 0; i < (D < 3 ? 10 : 4); ++i) {
      subject.edit();
      traces::Trace after = subject.fresh_trace();
      INFO("seed " << seed << ", edit " << i);
      CHECK(after.unnamed == 0);
      CHECK(traces::check_concise(after).surplus == 0);
      CHECK(traces::check_monotone(before, after).moved == 0);
      before = std::move(after);
    }
  }
}

namespace {

traces::Trace tree_of(const std::vector<thesis::Point<2>>& points) {
  sac::Engine engine;
  thesis::PointMesh<sac::Engine, 2> mesh(engine, {});
  for (const auto& p : points) mesh.insert(p);
  mesh.run(true);
  return traces::Recorder(engine).trace();
}

// The distance that a point at 2^-scale from the first of them makes.
std::uint64_t distance_of(std::vector<thesis::Point<2>> points, int scale) {
  const traces::Trace before = tree_of(points);
  points.push_back({{points[0][0] + std::ldexp(1, -scale), points[0][1]}});
  return traces::distance(before, tree_of(points)).all.distance();
}

}  // namespace

// A point twice as near makes some number of splits more, whatever n is.
TEST_CASE("thesis: the distance of trees with and without a point is O(lg L/s)",
          "[Theorem 4.1.13]") {
  for (const int n : {50, 200, 800}) {
    apps::Random random(static_cast<std::uint64_t>(n));
    std::vector<thesis::Point<2>> points;
    for (int i = 0; i < n; ++i) {
      points.push_back({{std::ldexp(random(1 << 30), -30), std::ldexp(random(1 << 30), -30)}});
    }
    CAPTURE(n);
    const std::uint64_t at_10 = distance_of(points, 10), at_20 = distance_of(points, 20),
                        at_30 = distance_of(points, 30);
    CAPTURE(at_10, at_20, at_30);
    CHECK(at_20 - at_10 <= 10 * 100);
    CHECK(at_30 - at_20 <= 10 * 100);
    CHECK(at_30 <= 3000);
  }
}
