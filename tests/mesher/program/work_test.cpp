// What calls look at inside, in runs of growing size: no search is hidden in a constant.
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <vector>

#include "facade/box_mesher.hpp"
#include "mesher/extra/generate.hpp"
#include "mesher/graph.hpp"

namespace {

using mesher::BoxMesher;
using mesher::LineId;
using mesher::Options;
using mesher::Point;
using mesher::PointId;

const Options<2> kWeighed{.domain = {{0, 0}, {1, 1}}, .record_weights = true};

struct Work {
  std::uint64_t calls = 0;
  std::uint64_t weight = 0;
};

// Of `n` points that come in one update, after those that are there.
Work work_of(BoxMesher<2>& m, std::size_t n, std::int64_t first_id) {
  const auto points = mesher::generate_points<2>(mesher::PointKind::uniform, n, 7);
  for (const auto& p : points) m.insert(PointId{first_id++}, p);
  const auto counts = m.update().calls;
  return {counts.executed, counts.weight};
}

Work first_run(std::size_t n) {
  BoxMesher<2> m(kWeighed);
  return work_of(m, n, 1);
}

double per_point(std::uint64_t count, std::size_t n) {
  return static_cast<double>(count) / static_cast<double>(n);
}

// A line beside which `n` points stand, so that it has at least as many pieces; the counts of the
// update in which its end moves by a unit in the last place, for each piece.
double calls_per_piece(std::size_t n) {
  BoxMesher<2> m(kWeighed);
  const Point<2> from{0.1, 0.5}, to{0.9, 0.5123};
  m.insert(PointId{1}, from);
  m.insert(PointId{2}, to);
  for (std::size_t i = 0; i < n; ++i) {
    const double t = (static_cast<double>(i) + 0.5) / static_cast<double>(n);
    const double y = from[1] + t * (to[1] - from[1]) + 0.4 / static_cast<double>(n);
    m.insert(PointId{10 + static_cast<std::int64_t>(i)}, {from[0] + t * (to[0] - from[0]), y});
  }
  m.insert_segment(LineId{1}, PointId{1}, PointId{2});
  const std::size_t pieces = m.update().edges_added.size();
  CHECK(pieces > n);
  m.move(PointId{2}, {to[0], std::nextafter(to[1], 1)});
  const auto calls = m.update().calls;
  return static_cast<double>(calls.executed + calls.created + calls.discarded) /
         static_cast<double>(pieces);
}

// A round, tilted polygon of n corners; the first run.
BoxMesher<3> round_polygon(int n, Work& first) {
  BoxMesher<3> m({.domain = {{-1, -1, -1}, {1, 1, 1}}, .record_weights = true});
  mesher::Polygon f{.id = mesher::PolygonId{1}, .loops = {{}}};
  for (int i = 0; i < n; ++i) {
    const double at = 6.283185307179586 * i / n, r = 0.8 + 0.02 * std::sin(7 * at);
    f.loops[0].push_back(PointId{i + 1});
    m.insert(f.loops[0].back(), {r * std::cos(at), r * std::sin(at), 0.1 * r * std::cos(at)});
  }
  m.insert_polygon(f);
  const auto calls = m.update().calls;
  first = {calls.executed, calls.weight};
  return m;
}

// Of points that come and go above and below it, one by one.
Work edits_beside(BoxMesher<3>& m) {
  mesher::SplitMix64 random(5);
  Work sum;
  const auto update = [&] {
    const auto calls = m.update().calls;
    sum.calls += calls.executed, sum.weight += calls.weight;
  };
  for (int i = 0; i < 10; ++i) {
    m.insert(PointId{100000},
             {1.6 * random.unit() - 0.8, 1.6 * random.unit() - 0.8, 0.2 * random.unit() + 0.05});
    update();
    m.remove(PointId{100000});
    update();
  }
  return sum;
}

}  // namespace

TEST_CASE("what a first run looks at grows with its points, and no faster") {
  const Work small = first_run(2000);
  const Work large = first_run(32000);
  CHECK(per_point(large.calls, 32000) < 1.1 * per_point(small.calls, 2000));
  CHECK(per_point(large.weight, 32000) < 1.2 * per_point(small.weight, 2000));
}

TEST_CASE("many points that come at once cost about what they cost in a first run") {
  for (const std::size_t n : {1000, 8000}) {
    BoxMesher<2> m(kWeighed);
    m.insert(PointId{1}, {0.5, 0.5});
    m.update();
    const Work batch = work_of(m, n, 2);
    const Work fresh = first_run(n);
    INFO(n << " points: " << batch.weight << " against " << fresh.weight);
    CHECK(per_point(batch.calls, n) < 1.5 * per_point(fresh.calls, n));
    CHECK(per_point(batch.weight, n) < 2.0 * per_point(fresh.weight, n));
  }
}

TEST_CASE(
    "a line whose end moves costs as many calls for each of its pieces, be it short or long") {
  const double of_short = calls_per_piece(32);
  const double of_long = calls_per_piece(512);
  INFO(of_short << " and " << of_long);
  CHECK(of_short < 40);
  CHECK(of_long < 1.2 * of_short);
}

TEST_CASE("a call beside a polygon looks at about as much if that has 16 times as many corners") {
  Work first_of_few, first_of_many;
  BoxMesher<3> few = round_polygon(100, first_of_few), many = round_polygon(1600, first_of_many);
  CHECK(per_point(first_of_many.weight, first_of_many.calls) <
        1.5 * per_point(first_of_few.weight, first_of_few.calls));
  const Work beside_few = edits_beside(few), beside_many = edits_beside(many);
  const double per_few = per_point(beside_few.weight, beside_few.calls);
  const double per_many = per_point(beside_many.weight, beside_many.calls);
  INFO(per_few << " and " << per_many);
  CHECK(per_many < 1.5 * per_few);
  CHECK(beside_many.calls < 2 * beside_few.calls);
}
