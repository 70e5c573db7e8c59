// The clipped cell in any dimension: against space's, and in four dimensions against balls found
// from nothing.
#include "cells/voronoi_cell_any.hpp"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <random>
#include <set>
#include <vector>

#include "brute_balls.hpp"
#include "cells/voronoi_cell3.hpp"

namespace {

using mesher::Point;
using mesher::detail::Vertex;
using mesher::detail::VertexHandle;
using mesher::detail::VertexPool;
using mesher::detail::VoronoiCell3;
using mesher::detail::VoronoiCellAny;
using Record = std::vector<std::uint32_t>;

// A centre, the first, and other vertices.
template <int D>
struct Scene {
  explicit Scene(const std::vector<Point<D>>& places) {
    for (const auto& p : places) handles.push_back(pool.create(p).self);
  }
  [[nodiscard]] const Vertex<D>& center() const { return pool[handles[0]]; }
  [[nodiscard]] std::vector<VertexHandle> others() const {
    return {handles.begin() + 1, handles.end()};
  }
  VertexPool<D> pool;
  std::vector<VertexHandle> handles;
};

template <int D>
std::vector<Point<D>> random_places(std::mt19937_64& random, int count, bool on_grid) {
  std::set<Point<D>> places;
  while (places.size() < static_cast<std::size_t>(count)) {
    Point<D> p;
    for (double& x : p) {
      x = on_grid ? static_cast<double>(random() % 4)
                  : static_cast<double>(random() >> 11) * 0x1p-53;
    }
    places.insert(p);
  }
  std::vector<Point<D>> all(places.begin(), places.end());
  std::shuffle(all.begin(), all.end(), random);
  return all;
}

template <class Cell, int D>
Cell cell_of(const Scene<D>& scene, const std::vector<VertexHandle>& others, double radius) {
  Cell cell;
  cell.reset(scene.center(), radius);
  for (const VertexHandle u : others) {
    if (cell.cuts(scene.pool[u].p)) cell.cut(u);
  }
  return cell;
}

template <class Cell>
Record record_of(const Cell& cell) {
  Record record;
  cell.write(record);
  return record;
}

// The simplices of a link, each ascending.
template <class Cell>
auto link_of(const Cell& cell) {
  const Record record = record_of(cell);
  std::set<std::vector<std::uint32_t>> link;
  Cell::for_each_link_simplex(record, [&](const auto& codes) {
    std::vector<std::uint32_t> simplex(codes.begin(), codes.end());
    std::sort(simplex.begin(), simplex.end());
    link.insert(simplex);
  });
  return link;
}

}  // namespace

TEST_CASE("in space the cell for any dimension is space's cell") {
  std::mt19937_64 random(1);
  int whole = 0;
  for (int round = 0; round < 200; ++round) {
    INFO("round " << round);
    const bool on_grid = round % 2 == 0;
    const Scene<3> scene(random_places<3>(random, 60, on_grid));
    const double radius = on_grid ? 100 : 20;
    const auto any = cell_of<VoronoiCellAny<3>>(scene, scene.others(), radius);
    const auto cell = cell_of<VoronoiCell3>(scene, scene.others(), radius);
    any.check_invariants();
    const auto is_virtual = [](const auto& s) { return s.back() >= VoronoiCell3::kVirtual; };
    const auto expected = link_of(cell);
    if (std::any_of(expected.begin(), expected.end(), is_virtual)) continue;
    CHECK(link_of(any) == expected);
    ++whole;
  }
  CHECK(whole > 5);
}

TEST_CASE("in four dimensions no vertex is in a gap ball, in whatever order the cell is cut") {
  std::mt19937_64 random(2);
  for (int round = 0; round < 40; ++round) {
    INFO("round " << round);
    const bool on_grid = round % 2 == 0;
    const Scene<4> scene(random_places<4>(random, 100, on_grid));
    auto others = scene.others();
    const auto cell = cell_of<VoronoiCellAny<4>>(scene, others, on_grid ? 3 : 0.7);
    cell.check_invariants();
    for (int t = 0; t < cell.corners(); ++t) {
      std::array<Point<4>, 5> simplex;
      for (std::size_t k = 0; k < 4; ++k) simplex[k] = cell.place(cell.ends(t)[k]);
      simplex[4] = scene.center().p;
      const auto ball = support::ball_of<4>(simplex);
      for (const VertexHandle u : others) {
        REQUIRE(support::is_outside<4>(ball, scene.pool[u].p));
      }
    }
    std::shuffle(others.begin(), others.end(), random);
    const auto again = cell_of<VoronoiCellAny<4>>(scene, others, on_grid ? 3 : 0.7);
    REQUIRE(record_of(again) == record_of(cell));
  }
}

TEST_CASE("a cell in four dimensions that is repaired is one from nothing, and may be cut") {
  std::mt19937_64 random(3);
  for (int round = 0; round < 40; ++round) {
    INFO("round " << round);
    const bool on_grid = round % 2 == 0;
    const double radius = on_grid ? 3 : 0.7;
    const Scene<4> scene(random_places<4>(random, 100, on_grid));
    const auto others = scene.others();
    const std::vector<VertexHandle> before(others.begin(), others.begin() + 80);
    const Record record = record_of(cell_of<VoronoiCellAny<4>>(scene, before, radius));
    const auto gone = [&](std::uint32_t u) {
      return u % 7 == static_cast<std::uint32_t>(round) % 7;
    };
    VoronoiCellAny<4> cell;
    cell.restore(
        scene.pool, scene.center(), radius, record, [&](auto u) { return !gone(u); }, true);
    cell.check_invariants();
    std::vector<VertexHandle> after;
    for (const VertexHandle u : others) {
      const bool is_new = std::find(before.begin(), before.end(), u) == before.end();
      if (!is_new && gone(u)) continue;
      after.push_back(u);
      const bool may =
          VoronoiCellAny<4>::may_cut(scene.pool, scene.center(), radius, record, scene.pool[u].p);
      VoronoiCellAny<4> last;
      last.restore(
          scene.pool, scene.center(), radius, record, [](auto) { return true; }, false);
      CHECK((!last.cuts(scene.pool[u].p) || may));
      if (cell.cuts(scene.pool[u].p)) cell.cut(u);
    }
    REQUIRE(record_of(cell) == record_of(cell_of<VoronoiCellAny<4>>(scene, after, radius)));
  }
}

TEST_CASE("centres of balls in four dimensions are right to the last places, however flat") {
  std::mt19937_64 random(4);
  const auto unit = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  for (int round = 0; round < 2000; ++round) {
    const double flat = std::ldexp(1, -static_cast<int>(random() % 40));
    std::array<Point<4>, 5> simplex;
    for (auto& p : simplex) p = {unit(), unit(), unit(), flat * unit()};
    const auto ball = support::ball_of<4>(simplex);
    const auto centre = mesher::detail::ball_centre<4>(
        simplex[4], {simplex[0], simplex[1], simplex[2], simplex[3]});
    const double r = static_cast<double>(std::sqrt(ball.radius2));
    for (std::size_t i = 0; i < 4; ++i) {
      const auto off = static_cast<double>(ball.centre[i] - simplex[4][i]) - centre.q[i];
      CHECK(std::abs(off) <= 2e-6 * r);
    }
  }
}
