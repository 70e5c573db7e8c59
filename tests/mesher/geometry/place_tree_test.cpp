// The places in a ball, beside a look at all of them.
#include "geometry/place_tree.hpp"

#include <catch2/catch.hpp>

#include "random.hpp"

namespace {

using mesher::Point;
using mesher::detail::PlaceTree;
using mesher::detail::RelativeBall;

// Places of a coarse grid, so that many are on the ball's rim, and some twice.
template <int D>
void check_balls(std::size_t n, std::uint64_t seed) {
  CAPTURE(D, n, seed);
  support::Random random(seed);
  const auto place = [&] {
    Point<D> p;
    for (double& x : p) x = static_cast<double>(random(9));
    return p;
  };
  std::vector<Point<D>> places(n);
  for (Point<D>& p : places) p = place();
  const PlaceTree<D> tree(places);
  for (int k = 0; k < 40; ++k) {
    RelativeBall<D> ball{place(), place(), static_cast<double>(random(5))};
    for (double& x : ball.center) x -= 4;
    std::vector<std::uint32_t> found, expected;
    tree.for_each_in(ball, [&](std::uint32_t i) { found.push_back(i); });
    for (std::uint32_t i = 0; i < n; ++i) {
      if (ball.contains(places[i])) expected.push_back(i);
    }
    std::sort(found.begin(), found.end());
    REQUIRE(found == expected);
  }
}

}  // namespace

TEST_CASE("the places in a ball are found, those on its rim, too") {
  std::uint64_t seed = 1;
  for (const std::size_t n : {0, 1, 8, 9, 100, 3000}) {
    check_balls<2>(n, seed++);
    check_balls<3>(n, seed++);
  }
}
