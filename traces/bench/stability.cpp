// The cost of an edit on a plot: of points, segments and polylines in meshes with segments.
//
//   stability [--n N]... [--edits K] [--out PATH] [--of segments|points]
//
// Each edit comes in one update and goes in another. Of both: the distance D of the traces before
// and after, the work W (calls made, let go and run), W by weight (with what calls look at inside),
// and microseconds of the process. Against
//   lg(L/s)  an end of the edit is put at a distance s, from L / 10 to L / 10^12, from a point of
//            the input (1000 segments, and as many points)
//   n        N segments and as many points (default: 1000 10000 100000), the edit anywhere; with
//            `--of points` a point in N points alone, and nothing else
//   m_f      vertices that stand on the edit, up to some 200, among 10^4 points
// PATH.svg (default: build/stability.svg) shows medians as lines and 99th percentiles as ticks; one
// JSON line per place on the plot goes to standard output, and one per line on it: a fit over
// lg(L/s) and m_f, and for n the median at the last N over that at 10^4. D is recorded where N is
// at most 10^5. N = 1000000 takes some minutes and 9 GB, of points alone 2.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "../../mesher/bench/random_line.hpp"
#include "bench_help.hpp"
#include "ground.hpp"
#include "mesher/extra/generate.hpp"
#include "mesher/graph.hpp"
#include "plots.hpp"

namespace {

using bench::Against;
using bench::Plot;
using Ground = bench::Ground<2>;
using mesher::Point;
using mesher::PointId;

const std::vector<bench::Kind> kKinds{
    {"point", "#1b6ca8"}, {"segment", "#c0392b"}, {"polyline", "#2e8b57"}};

// An edit of a kind (an index of kKinds); h: the length of a segment of the input, at most.
std::vector<Point<2>> random_edit(int kind, const Point<2>& from, double h,
                                  mesher::SplitMix64& random) {
  if (kind == 0) return {from};
  const double piece = kind == 1 ? h * (0.2 + 0.8 * random.unit()) : 0.4 * h;
  const double at = 4 * random.unit();
  return bench::random_line(from, at, kind == 1 ? 1 : 9, piece, random);
}

Ground segments(std::size_t n) {
  const auto pslg = mesher::generate_pslg({mesher::PslgKind::segments, n});
  std::vector<Point<2>> points;
  std::vector<PointId> ids;
  for (const auto& v : pslg.points) points.push_back(v.at), ids.push_back(v.id);
  return Ground(points, ids, mesher::segments_of(pslg));
}

double length_of(std::size_t n) { return 1 / std::sqrt(2.0 * static_cast<double>(n)); }

// --- Against lg(L/s) -------------------------------------------------------------------------

Plot over_spread(int kind, Ground& ground, std::size_t n, int edits) {
  Plot plot;
  mesher::SplitMix64 random(11);
  for (int tenth = 1; tenth <= 12; ++tenth) {
    for (int done = 0, tries = 0; done < edits && tries < 100 * edits; ++tries) {
      Point<2> p = ground.points()[random.below(ground.points().size())];
      const double s = std::pow(10, -tenth);
      for (double& x : p) x += (random.below(2) == 0 ? s : -s) * (0.5 + random.unit() / 5);
      const auto costs = ground.edit(random_edit(kind, p, length_of(n), random), true);
      if (!costs) continue;
      add(plot, std::log2(std::pow(10, tenth)), *costs);
      ++done;
    }
  }
  return plot;
}

// --- Against n -------------------------------------------------------------------------------

// Of the larger inputs the distances are fewer. `kinds`: so many are edited.
void over_size(std::vector<Plot>& plots, Ground& ground, std::size_t n, int kinds, int edits) {
  const int recorded = n <= 10000 ? edits : n <= 100000 ? std::min(edits, 8) : 0;
  for (int kind = 0; kind < kinds; ++kind) {
    mesher::SplitMix64 random(17);
    for (int done = 0; done < 10 * edits;) {
      const Point<2> p{random.unit(), random.unit()};
      const auto line = random_edit(kind, p, length_of(n), random);
      const auto costs = ground.edit(line, done < recorded);
      if (!costs) continue;
      add(plots[static_cast<std::size_t>(kind)], static_cast<double>(n), *costs);
      ++done;
    }
  }
}

// --- Against m_f -----------------------------------------------------------------------------

// Straight, or in pieces of the points' distance; m_f is rounded down to multiples of 20.
Plot over_length(int kind, Ground& ground, int edits) {
  Plot plot;
  mesher::SplitMix64 random(23);
  for (int done = 0; done < 10 * edits; ++done) {
    const double length = 0.05 + 0.85 * random.unit();
    const double x = random.unit() * (1 - length), y = random.unit();
    std::vector<Point<2>> line{{x, y}};
    const int pieces = kind == 1 ? 1 : 1 + static_cast<int>(length * 50);
    for (int i = 1; i <= pieces; ++i) {
      const double bend = kind == 1 ? 0.01 : (i % 2 == 0 ? 0.002 : -0.002);
      line.push_back({x + length * i / pieces, y + bend});
    }
    const auto costs = ground.edit(line, done < 4 * edits);
    if (!costs) continue;
    add(plot, 20 * std::floor(static_cast<double>(costs->on_edit) / 20) + 10, *costs);
  }
  return plot;
}

}  // namespace

int main(int argc, char** argv) {
  if (bench::shows_help(argc, argv)) return 0;
  std::vector<std::size_t> sizes;
  int edits = 20;
  bool alone = false;
  std::string out = "build/stability";
  for (int i = 1; i + 1 < argc; i += 2) {
    if (std::strcmp(argv[i], "--n") == 0) sizes.push_back(std::strtoull(argv[i + 1], nullptr, 10));
    if (std::strcmp(argv[i], "--edits") == 0) edits = std::max(2, std::atoi(argv[i + 1]));
    if (std::strcmp(argv[i], "--out") == 0) out = argv[i + 1];
    if (std::strcmp(argv[i], "--of") == 0) alone = std::strcmp(argv[i + 1], "points") == 0;
  }
  if (sizes.empty()) sizes = {1000, 10000, 100000};
  Against spread{"lg(L/s)", "lg(L/s)", false, std::vector<Plot>(3)};
  Against size{"n", alone ? "points" : "segments, and points", true, std::vector<Plot>(3)};
  Against length{"m_f", "vertices on the edit", false, std::vector<Plot>(3)};
  if (!alone) {
    constexpr std::size_t kSmall = 1000;
    Ground ground = segments(kSmall);
    for (int kind = 0; kind < 3; ++kind) {
      spread.plots[static_cast<std::size_t>(kind)] = over_spread(kind, ground, kSmall, edits);
    }
  }
  if (!alone) {
    Ground ground = bench::scattered<2>(10000);
    for (int kind = 1; kind < 3; ++kind) {
      length.plots[static_cast<std::size_t>(kind)] = over_length(kind, ground, edits);
    }
  }
  for (const std::size_t n : sizes) {
    Ground ground = alone ? bench::scattered<2>(n) : segments(n);
    over_size(size.plots, ground, n, alone ? 1 : 3, edits);
  }
  const std::vector<Against> all = alone ? std::vector{size} : std::vector{spread, size, length};
  return bench::draw("stability", kKinds, all, out + ".svg");
}
