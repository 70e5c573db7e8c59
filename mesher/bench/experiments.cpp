// The thesis's experiments in small [Hudson, Fig 2.2, 2.3, 3.2]: a JSON line a run, and pictures.
//
//   experiments [FOLDER [FILE.node]...]
//
// FOLDER gets quadratic.svg, line_circle.svg and one k_*.svg an input; without it no pictures.
// FILEs: inputs in space of the experiment with k beside its own, as the thesis has the bunny.
//   Fig 2.2  points that are slow for a strict order by shortest edges: seconds by n
//   Fig 2.3  a line and a circle around it: the most simplices that there ever were, by n; and
//            those of the mesh over n, which the thesis says are 42. TetGen's seconds beside, if
//            installed.
//   Fig 3.2  vertices and seconds of SVR by k
//   Fig 3.5  from file to file by the number of points, beside TetGen if installed: grids, lines
//   and
//            circles, and of each FILE points out of 27 copies in a 3 x 3 x 3 grid. 3.4 is
//            files_bench.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

#include "bench_help.hpp"
#include "chart.hpp"
#include "from_files.hpp"
#include "io/point_file.hpp"
#include "mesher/extra/generate.hpp"
#include "refinement/refine.hpp"
#include "refinement/svr.hpp"
#include "sample.hpp"

namespace {

using mesher::Point;
using mesher::RefineOrder;
using mesher::RefineStats;

constexpr int kRounds = 3;

template <int D>
mesher::Options<D> options_for(const std::vector<Point<D>>& points) {
  return {.domain = mesher::snapped_domain<D>(points)};
}

// A way to mesh points; with statistics, if they are asked for.
template <int D>
struct Way {
  const char* name;
  const char* colour;
  RefineStats (*run)(const std::vector<Point<D>>& points, bool with_stats);
};

template <int D>
RefineStats by_svr(const std::vector<Point<D>>& points, bool with_stats) {
  mesher::SvrStats stats;
  static_cast<void>(
      mesher::svr<D>(points, options_for<D>(points), {}, {}, with_stats ? &stats : nullptr));
  return stats;
}
template <int D, RefineOrder kOrder, bool kStrict>
RefineStats by_refine(const std::vector<Point<D>>& points, bool with_stats) {
  RefineStats stats;
  static_cast<void>(mesher::refine<D>(points, options_for<D>(points), {kOrder, kStrict}, {},
                                      with_stats ? &stats : nullptr));
  return stats;
}
template <int D>
constexpr Way<D> kWays[] = {
    {"svr", "#1b6", by_svr<D>},
    {"refine, shortest edge first", "#26c", by_refine<D, RefineOrder::shortest_edge_first, false>},
    {"refine, largest first", "#c62", by_refine<D, RefineOrder::largest_first, false>},
    {"refine, shortest edge first, strictly", "#a2a",
     by_refine<D, RefineOrder::shortest_edge_first, true>},
};

template <class Run>
double least_seconds(Run&& run) {
  double least = HUGE_VAL;
  for (int i = 0; i < kRounds; ++i) least = std::min(least, bench::seconds_of(run));
  return least;
}

// All ways for points of several sizes; draws what value(stats, seconds) says.
template <int D, class Make, class Value>
std::vector<bench::Series> compare(const char* figure, const std::vector<std::size_t>& sizes,
                                   Make&& make, Value&& value) {
  std::vector<bench::Series> all;
  for (const auto& way : kWays<D>) {
    bench::Series series{way.name, way.colour, {}};
    for (const std::size_t n : sizes) {
      const auto points = make(n);
      const double seconds = least_seconds([&] { way.run(points, false); });
      const RefineStats stats = way.run(points, true);
      std::printf(
          "{\"bench\":\"experiments\",\"figure\":\"%s\",\"way\":\"%s\",\"n\":%zu,\"seconds\":%.5f,"
          "\"vertices\":%zu,\"simplices_over_n\":%.1f,\"most_simplices\":%zu,\"made\":%zu,"
          "\"largest_degree\":%zu}\n",
          figure, way.name, n, seconds, stats.vertices,
          static_cast<double>(stats.simplices) / static_cast<double>(n), stats.most_simplices,
          stats.made, stats.largest_degree);
      std::fflush(stdout);
      series.points.push_back({static_cast<double>(n), value(stats, seconds)});
    }
    all.push_back(series);
  }
  return all;
}

bench::Panel quadratic() {
  const auto seconds = [](const RefineStats&, double seconds) { return seconds; };
  return {"Figure 2.2: seconds", "points", true,
          compare<2>("2.2", {400, 800, 1600, 3200, 6400}, mesher::generate_quadratic, seconds),
          true};
}

bench::Panel line_circle() {
  const auto make = [](std::size_t n) {
    return mesher::generate_points<3>(mesher::PointKind::line_circle, n, 1);
  };
  const std::vector<std::size_t> sizes{250, 500, 1000, 2000};
  const auto most = [](const RefineStats& stats, double) {
    return static_cast<double>(stats.most_simplices);
  };
  const bench::Panel panel{"Figure 2.3: the most simplices that there ever were", "points", true,
                           compare<3>("2.3", sizes, make, most), true};
  for (const std::size_t n : sizes) {
    const auto tetgen = bench::run_tetgen(make(n));
    if (!tetgen) continue;
    std::printf(
        "{\"bench\":\"experiments\",\"figure\":\"2.3\",\"way\":\"tetgen\",\"n\":%zu,"
        "\"seconds\":%.5f,\"vertices\":%zu}\n",
        n, tetgen->seconds, tetgen->vertices);
  }
  return panel;
}

// Each relative to the one at k = 0.9.
bench::Panel by_k(const std::string& name, const std::vector<Point<3>>& points) {
  bench::Series seconds{"seconds", "#1b6", {}}, vertices{"vertices", "#26c", {}};
  const auto measure = [&](double k) {
    std::size_t count = 0;
    const double time = least_seconds(
        [&] { count = mesher::svr<3>(points, options_for<3>(points), {k}).vertices.size(); });
    return std::pair{time, static_cast<double>(count)};
  };
  const auto [time, count] = measure(mesher::SvrSettings{}.k);
  for (const double k : {0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.75, 0.8, 0.85, 0.9, 0.93, 0.96, 0.99}) {
    const auto [time_k, count_k] = measure(k);
    std::printf(
        "{\"bench\":\"experiments\",\"figure\":\"3.2\",\"input\":\"%s\",\"k\":%g,"
        "\"seconds\":%.4f,\"vertices\":%.0f}\n",
        name.c_str(), k, time_k, count_k);
    std::fflush(stdout);
    seconds.points.push_back({k, time_k / time});
    vertices.points.push_back({k, count_k / count});
  }
  return {"Figure 3.2: " + name + ", over that at k = 0.9", "k", true, {seconds, vertices}};
}

// Figure 3.5: seconds and vertices by n, in thousands.
using Scaling = std::vector<bench::Panel>;

template <class Make>
Scaling by_size(const bench::FromFiles& both, const std::string& name,
                const std::vector<std::size_t>& sizes, Make&& make) {
  bench::Series ours{both.algorithm(), "#1b6", {}}, tetgen{"TetGen", "#c62", {}};
  bench::Series our_vertices = ours, their_vertices = tetgen;
  bool with_tetgen = bench::has_tetgen();
  for (const std::size_t size : sizes) {
    const auto result = both.run(make(size), with_tetgen, 1);
    bench::print("experiments", "\"figure\":\"3.5\",\"input\":\"" + name + '"', both.algorithm(),
                 result);
    const double n = 1e-3 * static_cast<double>(result.n);
    const auto add = [&](const std::optional<bench::Process>& run, bench::Series& seconds,
                         bench::Series& vertices) {
      if (!run) return;
      seconds.points.push_back({n, run->seconds});
      vertices.points.push_back({n, 1e-3 * static_cast<double>(run->vertices)});
    };
    add(result.ours, ours, our_vertices);
    add(result.tetgen, tetgen, their_vertices);
    with_tetgen = result.tetgen.has_value();  // it ends at what is too large for it
  }
  return {{"Figure 3.5: " + name + ", seconds", "thousands of points", false, {ours, tetgen}},
          {name + ", thousands of vertices",
           "thousands of points",
           false,
           {our_vertices, their_vertices}}};
}

// n points out of 27 copies; each point's copies have a rank in a fixed random order.
std::vector<Point<3>> of_copies(const std::vector<Point<3>>& points, std::size_t n) {
  const auto box = mesher::snapped_domain<3>(points);
  std::vector<std::size_t> order(27 * points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  mesher::SplitMix64 random(1);
  for (std::size_t i = 0; i < n; ++i) {
    std::swap(order[i], order[i + random.below(order.size() - i)]);
  }
  std::vector<Point<3>> some(n);
  for (std::size_t i = 0; i < n; ++i) {
    some[i] = points[order[i] / 27];
    std::size_t copy = order[i] % 27;
    for (std::size_t k = 0; k < 3; ++k, copy /= 3) {
      some[i][k] += static_cast<double>(copy % 3) * (box.hi[k] - box.lo[k]);
    }
  }
  return some;
}

}  // namespace

int main(int argc, char** argv) {
  if (bench::shows_help(argc, argv)) return 0;
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  if (!arguments.empty()) std::filesystem::create_directories(arguments[0]);
  const auto draw = [&](const std::vector<bench::Panel>& panels, const std::string& name) {
    if (arguments.empty()) return;
    const auto path = std::filesystem::path(arguments[0]) / (name + ".svg");
    std::ofstream file(path);
    file << bench::Chart::draw(panels, static_cast<int>(panels.size()));
    if (!file.flush()) throw std::runtime_error("cannot write " + path.string());
  };
  draw({quadratic()}, "quadratic");
  draw({line_circle()}, "line_circle");
  draw({by_k("line-circle 10000",
             mesher::generate_points<3>(mesher::PointKind::line_circle, 10000, 1))},
       "k_line_circle");
  const bench::FromFiles both(bench::tool_beside(argv[0]), "svr");
  const auto of_kind = [](mesher::PointKind kind) {
    return [kind](std::size_t n) { return mesher::generate_points<3>(kind, n, 1); };
  };
  draw(by_size(both, "line and circle", {1000, 2000, 4000, 8000, 16000, 40000, 100000},
               of_kind(mesher::PointKind::line_circle)),
       "size_line_circle");
  draw(by_size(both, "grid", {8000, 27000, 64000, 125000, 216000, 343000},
               of_kind(mesher::PointKind::grid)),
       "size_grid");
  for (std::size_t i = 1; i < arguments.size(); ++i) {
    const std::string name = std::filesystem::path(arguments[i]).stem().string();
    const auto points = mesher::read_points<3>(arguments[i]).points;
    draw({by_k(name, points)}, "k_" + name);
    std::vector<std::size_t> sizes;
    for (const double part : {0.05, 0.1, 0.2, 0.4, 0.7, 1.0}) {
      sizes.push_back(static_cast<std::size_t>(part * 27 * static_cast<double>(points.size())));
    }
    draw(by_size(both, "27 of " + name, sizes, [&](std::size_t n) { return of_copies(points, n); }),
         "size_" + name);
  }
}
