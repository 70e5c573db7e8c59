// The cost of an edit on a plot: of points, segments and polygons in space.
//
//   plc_stability [--n N]... [--edits K] [--out PATH]
//
// As `stability` does in the plane: each edit comes in one update and goes in another, and of both
// the distance D of the traces, the work W, W by weight, and microseconds of the process go against
//   lg(L/s)  an end or a corner is put at a distance s, from L / 10 to L / 10^9, from a corner of
//   one
//            of 1000 features
//   n        the edit anywhere among N features, segments and triangles by turns, each in its own
//            cube of a grid (default: 10^3, 16^3 and 22^3; N is rounded to a cube)
// Segments and triangles of an edit are as long as those there. PATH.svg (default:
// build/plc_stability.svg) and the JSON lines are as there. D is recorded of two edits a place,
// where N is at most 1000.
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
using mesher::LineId;
using mesher::Point;
using mesher::PointId;
using mesher::PolygonId;
using Ground = bench::Ground<3>;

const std::vector<bench::Kind> kKinds{
    {"point", "#1b6ca8"}, {"segment", "#c0392b"}, {"polygon", "#2e8b57"}};
constexpr int kRecorded = 2;  // edits a place

Point<3> within(const Point<3>& lo, double side, mesher::SplitMix64& random) {
  Point<3> p;
  for (std::size_t i = 0; i < 3; ++i) p[i] = lo[i] + side * random.unit();
  return p;
}

// A grid of cubes with a segment or a triangle in each, well inside.
Ground features(int across) {
  mesher::SplitMix64 random(5);
  std::vector<Point<3>> points;
  std::vector<PointId> ids;
  std::vector<mesher::Segment> segments;
  std::vector<mesher::Polygon> polygons;
  const double side = 1.0 / across;
  for (int cell = 0; cell < across * across * across; ++cell) {
    const Point<3> lo{(cell % across + 0.1) * side, (cell / across % across + 0.1) * side,
                      (cell / across / across + 0.1) * side};
    std::vector<PointId> corners;
    for (int k = 0; k < 2 + cell % 2; ++k) {
      points.push_back(within(lo, 0.8 * side, random));
      ids.push_back(PointId{static_cast<std::int64_t>(points.size())});
      corners.push_back(ids.back());
    }
    if (cell % 2 == 0) {
      segments.push_back({LineId{cell + 1}, corners[0], corners[1]});
    } else {
      mesher::Polygon polygon;
      polygon.id = PolygonId{cell + 1}, polygon.loops = {corners};
      polygons.push_back(polygon);
    }
  }
  return Ground(points, ids, segments, polygons);
}

// A point, and what it is an end or a corner of; `kind`: of kKinds.
std::vector<Point<3>> edit_at(const Point<3>& p, int kind, double side,
                              mesher::SplitMix64& random) {
  std::vector<Point<3>> line{p};
  for (int k = 0; k < kind; ++k) {
    line.push_back(
        within({p[0] - 0.4 * side, p[1] - 0.4 * side, p[2] - 0.4 * side}, 0.8 * side, random));
  }
  return line;
}

Plot over_spread(int kind, Ground& ground, double side, int edits) {
  Plot plot;
  mesher::SplitMix64 random(11);
  for (int tenth = 1; tenth <= 9; ++tenth) {
    for (int done = 0, tries = 0; done < edits && tries < 100 * edits; ++tries) {
      Point<3> p = ground.points()[random.below(ground.points().size())];
      const double s = std::pow(10, -tenth) / std::sqrt(3 * 0.36);  // offsets of 0.5 to 0.7 each
      for (double& x : p) x += (random.below(2) == 0 ? s : -s) * (0.5 + random.unit() / 5);
      const auto costs = ground.edit(edit_at(p, kind, side, random), done < kRecorded);
      if (!costs) continue;
      add(plot, std::log2(std::pow(10, tenth)), *costs);
      ++done;
    }
  }
  return plot;
}

void over_size(std::vector<Plot>& plots, int across, int edits) {
  Ground ground = features(across);
  const int n = across * across * across;
  for (int kind = 0; kind < 3; ++kind) {
    mesher::SplitMix64 random(17);
    for (int done = 0; done < 4 * edits;) {
      const auto line = edit_at(within({0, 0, 0}, 1, random), kind, 1.0 / across, random);
      const auto costs = ground.edit(line, n <= 1000 && done < kRecorded);
      if (!costs) continue;
      add(plots[static_cast<std::size_t>(kind)], n, *costs);
      ++done;
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (bench::shows_help(argc, argv)) return 0;
  std::vector<int> across;
  int edits = 20;
  std::string out = "build/plc_stability";
  for (int i = 1; i + 1 < argc; i += 2) {
    if (std::strcmp(argv[i], "--n") == 0) {
      across.push_back(
          std::max(2, static_cast<int>(std::lround(std::cbrt(std::atof(argv[i + 1]))))));
    }
    if (std::strcmp(argv[i], "--edits") == 0) edits = std::max(2, std::atoi(argv[i + 1]));
    if (std::strcmp(argv[i], "--out") == 0) out = argv[i + 1];
  }
  if (across.empty()) across = {10, 16, 22};
  Against spread{"lg(L/s)", "lg(L/s)", false, std::vector<Plot>(3)};
  Against size{"n", "features", true, std::vector<Plot>(3)};
  {
    constexpr int kSmall = 10;
    Ground ground = features(kSmall);
    for (int kind = 0; kind < 3; ++kind) {
      spread.plots[static_cast<std::size_t>(kind)] = over_spread(kind, ground, 1.0 / kSmall, edits);
    }
  }
  for (const int n : across) over_size(size.plots, n, edits);
  return bench::draw("plc_stability", kKinds, {spread, size}, out + ".svg");
}
