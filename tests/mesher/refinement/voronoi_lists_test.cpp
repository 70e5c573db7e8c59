// The lists of points that are no vertices yet, and the queue: against plain ones.
#include "refinement/voronoi_lists.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <map>
#include <vector>

#include "mesher/extra/generate.hpp"
#include "refinement/work_queue.hpp"

namespace {

using mesher::Point;
using mesher::detail::kNone;
using mesher::detail::VoronoiLists;
using mesher::detail::WorkQueue;

using Lists = VoronoiLists<2>;

double distance2(const Point<2>& a, const Point<2>& b) {
  return (a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]);
}

// Takes everything off.
std::vector<std::uint32_t> on_list(Lists lists, std::uint32_t v) {
  std::vector<std::uint32_t> points;
  while (lists.is_crowded(v)) {
    points.push_back(lists.any(v));
    lists.drop(v, points.back());
  }
  return points;
}

}  // namespace

TEST_CASE("each point is on the list of its nearest vertex, whatever vertices come") {
  for (const double scale : {1.0, 0x1p-80, 0x1p90}) {
    INFO("scale " << scale);
    auto points = mesher::generate_points<2>(mesher::PointKind::clusters, 500, 3);
    for (auto& p : points) p = {p[0] * scale, p[1] * scale};
    Lists lists(points);
    mesher::SplitMix64 random(5);
    std::vector<Point<2>> vertices{{}, points[17]};  // from 1
    lists.add_vertex();
    lists.start(1, points[17], 17);
    CHECK(lists.left() == 499);
    std::size_t inserted = 1;
    for (std::uint32_t v = 2; v < 120; ++v) {
      const std::size_t chosen = random.below(points.size());
      const bool is_point = v % 3 == 0;
      vertices.push_back(is_point ? points[chosen]
                                  : Point<2>{random.unit() * scale, random.unit() * scale});
      lists.add_vertex();
      bool was_there = false;
      for (std::uint32_t w = 1; w < v; ++w) {
        was_there |= lists.relocate(v, vertices[v], w, vertices[w]) != kNone;
      }
      CHECK((is_point || !was_there));
      inserted += was_there ? 1 : 0;
    }
    CHECK(lists.left() == points.size() - inserted);
    std::size_t listed = 0;
    for (std::uint32_t v = 1; v < vertices.size(); ++v) {
      const auto here = on_list(lists, v);
      listed += here.size();
      double farthest2 = 0;
      for (const auto k : here) {
        farthest2 = std::max(farthest2, distance2(points[k], vertices[v]));
        for (std::uint32_t w = 1; w < vertices.size(); ++w) {
          REQUIRE(distance2(points[k], vertices[v]) <= distance2(points[k], vertices[w]));
        }
      }
      if (here.empty()) continue;
      CHECK(distance2(points[lists.farthest(v, vertices[v])], vertices[v]) == farthest2);
    }
    CHECK(listed == lists.left());
  }
}

TEST_CASE("a list finds a point in a ball just if there is one") {
  const auto points = mesher::generate_points<2>(mesher::PointKind::uniform, 200, 7);
  Lists lists(points);
  const Point<2> v = points[0];
  lists.add_vertex();
  lists.start(1, v, 0);
  mesher::SplitMix64 random(9);
  int found = 0;
  for (int round = 0; round < 2000; ++round) {
    const Point<2> c{3 * random.unit() - 1, 3 * random.unit() - 1};
    const double r = random.unit() * random.unit();
    const std::uint32_t point = lists.find(1, v, c, r);
    if (point != kNone) {
      ++found;
      CHECK(point != 0);
      CHECK(distance2(points[point], c) <= r * r);
    } else {
      CHECK(std::none_of(points.begin() + 1, points.end(),
                         [&](const auto& p) { return distance2(p, c) <= r * r; }));
    }
  }
  CHECK(found > 200);
  CHECK(found < 1800);
}

TEST_CASE("skinny simplices come before moderately skinny ones, and what is gone never comes") {
  using Wait = WorkQueue::Wait;
  WorkQueue queue;
  queue.make_room(10);
  queue.add(1, Wait::moderately_skinny);
  queue.add(2, Wait::skinny);
  queue.add(3, Wait::skinny);
  queue.add(4, Wait::skinny);
  queue.forget(3);
  CHECK(queue.take_skinny() == 4);
  queue.add(3, Wait::moderately_skinny);  // another simplex in the same place
  CHECK(queue.take_skinny() == 2);
  CHECK(queue.take_skinny() == kNone);
  CHECK(queue.take_moderate() == 3);
  CHECK(queue.take_moderate() == 1);
  CHECK(queue.take_moderate() == kNone);
  queue.add(5, Wait::skinny);
  queue.forget(5);
  queue.add(5, Wait::skinny);
  CHECK(queue.take_skinny() == 5);
  CHECK(queue.take_skinny() == kNone);
}

TEST_CASE("a crowded vertex stays in the queue until it is not") {
  WorkQueue queue;
  std::map<std::uint32_t, int> load{{7, 2}, {8, 1}};
  const auto is_crowded = [&](std::uint32_t v) { return load[v] > 0; };
  queue.add_crowded(7);
  queue.add_crowded(8);
  CHECK(queue.crowded(is_crowded) == 8);
  CHECK(queue.crowded(is_crowded) == 8);
  load[8] = 0;
  CHECK(queue.crowded(is_crowded) == 7);
  load[7] = 0;
  CHECK(queue.crowded(is_crowded) == kNone);
}
