// The cost of an edit on a plot: of points in space.
//
//   space_stability [--n N]... [--edits K] [--out PATH]
//
// As `stability` does in the plane: each edit comes in one update and goes in another, and of both
// the distance D of the traces, the work W, W by weight, and microseconds of the process go against
//   lg(L/s)  the point is put at a distance s, from L / 10 to L / 10^12, from one of 1000
//   n        a point anywhere among N (default: 1000 10000 100000)
//   m_f      a row of up to 100 points, at the distance of neighbours, among 10^4, in one update:
//   m_f
//            is how many they are
// PATH.svg (default: build/space_stability.svg) and the JSON lines are as there. D is recorded
// where N is at most 10^4. N = 1000000 takes some minutes and 3.4 GB.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "bench_help.hpp"
#include "ground.hpp"
#include "mesher/extra/generate.hpp"
#include "plots.hpp"

namespace {

using bench::Against;
using bench::Plot;
using mesher::Point;
using Ground = bench::Ground<3>;

const std::vector<bench::Kind> kKinds{{"point", "#1b6ca8"}, {"patch", "#c0392b"}};

Point<3> anywhere(mesher::SplitMix64& random) {
  return {random.unit(), random.unit(), random.unit()};
}

Plot over_spread(Ground& ground, int edits) {
  Plot plot;
  mesher::SplitMix64 random(11);
  for (int tenth = 1; tenth <= 12; ++tenth) {
    for (int done = 0, tries = 0; done < edits && tries < 100 * edits; ++tries) {
      Point<3> p = ground.points()[random.below(ground.points().size())];
      const double s = std::pow(10, -tenth) / std::sqrt(3 * 0.36);  // offsets of 0.5 to 0.7 each
      for (double& x : p) x += (random.below(2) == 0 ? s : -s) * (0.5 + random.unit() / 5);
      const auto costs = ground.edit({p}, true);
      if (!costs) continue;
      add(plot, std::log2(std::pow(10, tenth)), *costs);
      ++done;
    }
  }
  return plot;
}

// Of the larger inputs there are no distances.
void over_size(Plot& plot, std::size_t n, int edits) {
  Ground ground = bench::scattered<3>(n);
  const int recorded = n <= 10000 ? edits : 0;
  mesher::SplitMix64 random(17);
  for (int done = 0; done < 10 * edits;) {
    const auto costs = ground.edit({anywhere(random)}, done < recorded);
    if (!costs) continue;
    add(plot, static_cast<double>(n), *costs);
    ++done;
  }
}

// Points in a plane, moved a little, in lines of kLine.
std::vector<Point<3>> patch(int count, mesher::SplitMix64& random) {
  constexpr int kLine = 10;
  const double step = 1 / std::cbrt(1e4);
  Point<3> corner = anywhere(random);
  for (double& x : corner) x *= 1 - step * kLine;
  std::vector<Point<3>> points;
  for (int i = 0; i < count; ++i) {
    Point<3> p = corner;
    p[0] += step * (i % kLine);
    p[1] += step * (i / kLine);
    for (double& x : p) x += 0.2 * step * random.unit();
    points.push_back(p);
  }
  return points;
}

Plot over_count(Ground& ground, int edits) {
  Plot plot;
  mesher::SplitMix64 random(23);
  for (const int count : {1, 2, 5, 10, 20, 35, 50, 75, 100}) {
    for (int done = 0; done < edits;) {
      const auto costs = ground.edit(patch(count, random), done < edits / 2);
      if (!costs) continue;
      add(plot, count, *costs);
      ++done;
    }
  }
  return plot;
}

}  // namespace

int main(int argc, char** argv) {
  if (bench::shows_help(argc, argv)) return 0;
  std::vector<std::size_t> sizes;
  int edits = 20;
  std::string out = "build/space_stability";
  for (int i = 1; i + 1 < argc; i += 2) {
    if (std::strcmp(argv[i], "--n") == 0) sizes.push_back(std::strtoull(argv[i + 1], nullptr, 10));
    if (std::strcmp(argv[i], "--edits") == 0) edits = std::max(2, std::atoi(argv[i + 1]));
    if (std::strcmp(argv[i], "--out") == 0) out = argv[i + 1];
  }
  if (sizes.empty()) sizes = {1000, 10000, 100000};
  Against spread{"lg(L/s)", "lg(L/s)", false, std::vector<Plot>(2)};
  Against size{"n", "points", true, std::vector<Plot>(2)};
  Against count{"m_f", "points of the edit", false, std::vector<Plot>(2)};
  {
    Ground ground = bench::scattered<3>(1000);
    spread.plots[0] = over_spread(ground, edits);
  }
  {
    Ground ground = bench::scattered<3>(10000);
    count.plots[1] = over_count(ground, edits);
  }
  for (const std::size_t n : sizes) over_size(size.plots[0], n, edits);
  return bench::draw("space_stability", kKinds, {spread, size, count}, out + ".svg");
}
