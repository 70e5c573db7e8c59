// What an update costs does not depend on how small its surroundings are.
#include <catch2/catch.hpp>
#include <cmath>

#include "facade/box_mesher.hpp"
#include "mesher/extra/generate.hpp"

namespace {

using mesher::Options;
using mesher::Point;
using mesher::PointId;

// Calls executed by 20 insertions into a row of n points that is 2^-shift long, each taken back.
// The places are the same relative to the row, for every shift.
std::size_t calls_in_a_row(int n, int shift) {
  const auto at = [&](double x) {
    return Point<2>{0.5 + std::ldexp(std::floor(x * 0x1p14), -14 - shift), 0.5};
  };
  mesher::BoxMesher<2> m({.domain = {{0, 0}, {1, 1}}});
  for (int i = 0; i < n; ++i) m.insert(PointId{i}, at((i + 0.5) / n));
  m.update();
  mesher::SplitMix64 random(7);
  std::size_t calls = 0;
  for (int i = 0; i < 20; ++i) {
    const auto place = (std::floor(n * random.unit()) + 0.2) / n;
    m.insert(PointId{n}, at(place));
    calls += m.update().calls.executed;
    m.remove(PointId{n});
    m.update();
  }
  return calls;
}

}  // namespace

TEST_CASE("updates in a row of points make no more calls where it is 2^-34 long [L 4.3.6]") {
  const std::size_t large = calls_in_a_row(300, 20);
  const std::size_t small = calls_in_a_row(300, 34);
  INFO(large << " and " << small << " calls");
  CHECK(small < 1.6 * static_cast<double>(large));
}
