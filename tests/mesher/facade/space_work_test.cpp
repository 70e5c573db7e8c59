// How many calls an edit of polygons runs again.
#include <catch2/catch.hpp>
#include <cstdint>
#include <vector>

#include "facade/box_mesher.hpp"
#include "mesher/extra/generate.hpp"

namespace {

using mesher::PointId;
using mesher::PolygonId;

constexpr int kSquares = 12;

// A cloud, and the corners of a bent strip of squares in it: those of a pair are i and i + 1.
std::int64_t insert_points(mesher::BoxMesher<3>& m) {
  mesher::SplitMix64 random(5);
  std::int64_t id = 1;
  for (int i = 0; i < 300; ++i) {
    m.insert(PointId{id++}, {random.unit(), random.unit(), random.unit()});
  }
  const std::int64_t first = id;
  for (int i = 0; i <= kSquares; ++i) {
    for (int j = 0; j < 2; ++j) {
      m.insert(PointId{id++}, {0.2 + 0.05 * i, 0.4 + 0.05 * j, 0.5 + 0.01 * ((7 * i + 3 * j) % 5)});
    }
  }
  return first;
}

}  // namespace

TEST_CASE("a triangle concerns the calls that have asked for features as far as it is away") {
  mesher::Options<3> options{.domain = {{0, 0, 0}, {1, 1, 1}}};
  mesher::BoxMesher<3> m(options);
  const std::int64_t first = insert_points(m);
  m.update();
  std::uint64_t calls = 0;
  for (std::int64_t i = 0; i < 2 * kSquares; ++i) {
    const std::int64_t corner = first + i;
    m.insert_polygon(
        {PolygonId{1000 + i}, {{PointId{corner}, PointId{corner + 1}, PointId{corner + 2}}}});
    calls += m.update().calls.executed;
  }
  CHECK(calls < 600 * 2 * kSquares);  // 840 each, were all told whose cells' surroundings it is in
}

TEST_CASE("a point that moves a little changes the vertices around it, and few others") {
  const mesher::Options<3> options{.domain = {{0, 0, 0}, {1, 1, 1}}};
  mesher::BoxMesher<3> m(options);
  mesher::SplitMix64 random(19);
  constexpr std::int64_t kPoints = 1000;
  std::vector<mesher::Point<3>> places;
  for (std::int64_t i = 0; i < kPoints; ++i) {
    places.push_back({random.unit(), random.unit(), random.unit()});
    m.insert(PointId{i}, places.back());
  }
  m.update();
  std::size_t changed = 0;
  constexpr int kMoves = 200;
  for (int i = 0; i < kMoves; ++i) {
    const std::size_t moved = random.below(places.size());
    for (double& x : places[moved]) x += 1e-6 * (0.5 - x);
    m.move(PointId{static_cast<std::int64_t>(moved)}, places[moved]);
    const auto change = m.update();
    changed += change.vertices_added.size() + change.vertices_removed.size();
  }
  CHECK(changed < 8 * kMoves);
}
