// What other languages are compared with: the same work by C++ alone, as mesher/python/bench does
// it by Python.
//
//   facade_bench [N]...
//
// default: 10000 100000 1000000. Points uniform in the unit square by SplitMix64(1). One JSON line
// per figure:
//   mesh     seconds of mesh() of the points, from a Graph to a mesh
//   update   the median of updates of a mesher that keeps slots, microseconds: each inserts a point
//            and removes it in the next one
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "bench_help.hpp"
#include "mesher/extra/generate.hpp"
#include "mesher/mesher.hpp"
#include "sample.hpp"

namespace {

using mesher::Point;
using mesher::PointId;

std::vector<double> update_times(const mesher::Graph<2>& graph, mesher::SplitMix64& random) {
  mesher::Mesher<2> m({.domain = {{0, 0}, {1, 1}}});
  m.keep_slots(true);
  m.insert(graph);
  m.update();
  std::vector<double> times;
  const PointId id{static_cast<std::int64_t>(graph.points.size())};
  for (int i = 0; i < 500; ++i) {
    const double x = random.unit();
    const Point<2> p{x, random.unit()};
    times.push_back(1e6 * bench::seconds_of([&] {
                      m.insert(id, p);
                      m.update();
                    }));
    times.push_back(1e6 * bench::seconds_of([&] {
                      m.remove(id);
                      m.update();
                    }));
  }
  return times;
}

void run(std::size_t n) {
  mesher::SplitMix64 random(1);
  mesher::Graph<2> graph;
  for (std::size_t i = 0; i < n; ++i) {
    const double x = random.unit();
    graph.points.push_back({PointId{static_cast<std::int64_t>(i)}, {x, random.unit()}});
  }
  std::size_t vertices = 0;
  const double seconds =
      bench::seconds_of([&] { vertices = mesher::mesh(graph).mesh.vertices.size(); });
  std::printf(
      "{\"bench\":\"facade\",\"figure\":\"mesh\",\"n\":%zu,\"vertices\":%zu,\"seconds\":%.4f}\n", n,
      vertices, seconds);
  std::vector<double> times = update_times(graph, random);
  std::sort(times.begin(), times.end());
  std::printf("{\"bench\":\"facade\",\"figure\":\"update\",\"n\":%zu,\"median_us\":%.1f}\n", n,
              times[times.size() / 2]);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  if (bench::shows_help(argc, argv)) return 0;
  std::vector<std::size_t> sizes{10000, 100000, 1000000};
  if (argc > 1) sizes.clear();
  for (int i = 1; i < argc; ++i) sizes.push_back(std::strtoull(argv[i], nullptr, 10));
  for (const std::size_t n : sizes) run(n);
}
