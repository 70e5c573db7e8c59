// What is around an edge of a triangulation in space, and how it is found.
#include "refinement/at_edge.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <vector>

#include "delaunay/build.hpp"
#include "delaunay/simplex_layout.hpp"
#include "delaunay_case.hpp"

namespace {

using mesher::SplitMix64;
using mesher::detail::BallLayout;
using mesher::detail::DelaunayKernel;
using support::Kind;

}  // namespace

TEST_CASE(
    "around an edge are the simplices of its ends' stars that have both; none, if it is none") {
  for (const Kind kind : {Kind::uniform, Kind::grid}) {
    const auto points = support::distinct_points<3>(kind, 150, 5);
    DelaunayKernel<3, BallLayout<3>> kernel;
    std::vector<std::uint32_t> vertices;
    for (const auto& p : points) vertices.push_back(kernel.add_place(p));
    REQUIRE(mesher::detail::build<3>(kernel, vertices, [](std::uint32_t, std::uint32_t) {}));
    SplitMix64 random(7);
    std::size_t edges = 0;
    std::vector<std::uint32_t> star, found;
    for (int round = 0; round < 3000; ++round) {
      const std::uint32_t a = vertices[random.below(vertices.size())],
                          b = vertices[random.below(vertices.size())];
      if (a == b || !kernel.has(a) || !kernel.has(b)) continue;
      kernel.find_in_star(a, star, [](std::uint32_t) { return false; });
      std::erase_if(star, [&](std::uint32_t s) {
        const auto& corners = kernel.simplices().corners(s);
        return std::find(corners.begin(), corners.end(), b) == corners.end();
      });
      mesher::detail::find_at_edge(kernel, a, b, found);
      std::sort(star.begin(), star.end());
      std::sort(found.begin(), found.end());
      REQUIRE(found == star);
      edges += star.empty() ? 0 : 1;
    }
    CHECK(edges > 100);
  }
}
