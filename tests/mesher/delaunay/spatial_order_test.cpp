// The Hilbert curve, and the order of insertion.
#include "delaunay/spatial_order.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <numeric>
#include <vector>

#include "delaunay/hilbert.hpp"
#include "delaunay_case.hpp"

namespace {

using mesher::Point;
using support::Kind;

template <int D>
std::vector<std::uint32_t> order_of(const std::vector<Point<D>>& points) {
  return mesher::detail::spatial_order<D>(points);
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("the curve visits each cell, from one to a neighbour", "[template]",
                       ((int D), D), 2, 3) {
  for (const int levels : {1, 2, 3, 4}) {
    const std::uint32_t side = 1u << levels;
    std::vector<std::array<std::uint32_t, D>> at(std::size_t{1} << (D * levels));
    std::vector<bool> seen(at.size());
    for (std::size_t i = 0; i < at.size(); ++i) {
      std::array<std::uint32_t, D> cell;
      for (std::size_t k = 0; k < D; ++k) cell[k] = i >> (k * levels) & (side - 1);
      const auto index = mesher::detail::hilbert_index<D>(cell, levels);
      REQUIRE(index < at.size());
      REQUIRE_FALSE(seen[index]);
      seen[index] = true;
      at[index] = cell;
    }
    for (std::size_t i = 1; i < at.size(); ++i) {
      int steps = 0;
      for (std::size_t k = 0; k < D; ++k) {
        steps += std::abs(static_cast<int>(at[i][k]) - static_cast<int>(at[i - 1][k]));
      }
      REQUIRE(steps == 1);
    }
  }
}

TEMPLATE_TEST_CASE_SIG("the order has each point once, and depends on the places alone",
                       "[template]", ((int D), D), 2, 3) {
  for (const Kind kind : support::kKinds) {
    for (const std::size_t n : {0u, 1u, 2u, 7u, 100u, 20000u}) {
      INFO(support::name(kind) << ", " << n << " points");
      auto points = support::distinct_points<D>(kind, n, 1);
      const auto order = order_of<D>(points);
      std::vector<std::uint32_t> sorted = order, all(points.size());
      std::sort(sorted.begin(), sorted.end());
      std::iota(all.begin(), all.end(), 0u);
      REQUIRE(sorted == all);
      std::vector<Point<D>> placed, shuffled_placed;
      for (const std::uint32_t i : order) placed.push_back(points[i]);
      mesher::SplitMix64 random(2);
      support::shuffle(points, random);
      for (const std::uint32_t i : order_of<D>(points)) shuffled_placed.push_back(points[i]);
      REQUIRE(placed == shuffled_placed);
    }
  }
}

TEMPLATE_TEST_CASE_SIG("equal points stay in their order", "[template]", ((int D), D), 2, 3) {
  auto points = support::distinct_points<D>(Kind::uniform, 300, 1);
  for (std::size_t i = 0; i < 3000; ++i) points.push_back(points[i % 7]);
  const auto order = order_of<D>(points);
  std::vector<std::uint32_t> last(7);
  for (const std::uint32_t i : order) {
    const bool copied = i >= 300 || i < 7;
    if (!copied) continue;
    std::uint32_t& before = last[i < 7 ? i : (i - 300) % 7];
    REQUIRE(i >= before);
    before = i;
  }
}

TEST_CASE("consecutive points are near each other, in clusters far smaller than the set too") {
  std::vector<Point<2>> points = support::distinct_points<2>(Kind::uniform, 1000, 1);
  const auto cluster = support::distinct_points<2>(Kind::uniform, 20000, 2);
  for (const auto& p : cluster) points.push_back({0.3 + 1e-9 * p[0], 0.3 + 1e-9 * p[1]});
  const auto order = order_of<2>(points);
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t i = 1; i < order.size(); ++i) {
    if (order[i] < 1000 || order[i - 1] < 1000) continue;
    const auto &p = points[order[i]], &q = points[order[i - 1]];
    sum += std::hypot(p[0] - q[0], p[1] - q[1]);
    ++count;
  }
  // a spacing is 1e-9 / sqrt(20000); random neighbours would be 0.5e-9 apart
  CHECK(sum / static_cast<double>(count) < 3e-9 / std::sqrt(20000));
}
