// Traditional refinement: what it alone has. (Its meshes: refinements_test.cpp.)
#include "refinement/refine.hpp"

#include <catch2/catch.hpp>
#include <vector>

#include "mesher/delaunay.hpp"
#include "mesher/extra/generate.hpp"

namespace {

using mesher::Point;
using mesher::PointKind;
using mesher::RefineOrder;
using mesher::RefineStats;

template <int D>
RefineStats stats_of(const std::vector<Point<D>>& points, RefineOrder order, bool strict = false) {
  RefineStats stats;
  const auto mesh = mesher::refine<D>(points, {.domain = mesher::snapped_domain<D>(points)},
                                      {order, strict}, {}, &stats);
  CHECK(stats.vertices == mesh.vertices.size());
  CHECK(stats.simplices == mesh.simplices.size());
  CHECK(stats.on_sides == 0);
  CHECK(stats.most_simplices > stats.simplices);
  return stats;
}

}  // namespace

TEST_CASE("refinement begins with the triangulation of all points, however large") {
  const auto points = mesher::generate_points<3>(PointKind::line_circle, 300, 1);
  const auto stats = stats_of<3>(points, RefineOrder::largest_first);
  CHECK(stats.most_simplices > mesher::delaunay<3>(points).simplices.size());
  CHECK(stats.largest_degree > 140);  // the line's points: all of the circle's are neighbours
  CHECK(stats.most_simplices > 150 * 149);
}

TEST_CASE("the two orders are two meshes; with the shortest edge first it has fewer vertices") {
  for (const PointKind kind : {PointKind::uniform, PointKind::clusters, PointKind::spiral}) {
    INFO("family " << static_cast<int>(kind));
    const auto points = mesher::generate_points<2>(kind, 3000, 5);
    const auto largest = stats_of<2>(points, RefineOrder::largest_first);
    const auto shortest = stats_of<2>(points, RefineOrder::shortest_edge_first);
    CHECK(shortest.vertices < largest.vertices);
  }
}

// The example of [Fig 2.2]: points on a line, a little farther apart each, all seen from the
// off-centre of the first two.
TEST_CASE(
    "shortest edge first is slow in the worst case, and is not where buckets approximate it") {
  const auto made_a_vertex = [](std::size_t n, bool strict) {
    const auto points = mesher::generate_quadratic(n);
    const auto stats = stats_of<2>(points, RefineOrder::shortest_edge_first, strict);
    return static_cast<double>(stats.made) / static_cast<double>(stats.vertices - n);
  };
  CHECK(made_a_vertex(3200, true) > 2 * made_a_vertex(800, true));
  CHECK(made_a_vertex(3200, true) > 10 * made_a_vertex(3200, false));
  CHECK(made_a_vertex(3200, false) < 1.3 * made_a_vertex(800, false));
}
