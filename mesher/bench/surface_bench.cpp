// Updates of a surface: a vertex of it moves, with the polygons and edges that it has.
//
//   surface_bench FILE[:MOVES[:THREADS]]...
//
// FILE: a surface (.off, .obj, .ply, .stl), meshed in a box that is larger by a twentieth on each
// side. MOVES: how many random vertices move, each by up to 10^-4 of the box along each axis (100).
// One JSON line per figure:
//   first_run       points, polygons, vertices in the box, seconds of the processor
//   move            median and p99 of single updates in microseconds, and per update the calls that
//                   ran, and the vertices that came and went
// and, with THREADS, by the clock and not the processor, of one thread and of so many:
//   threads         seconds of the first run; median of single updates, of vertices that move and
//                   move back, in microseconds, and the calls of a move; whether meshes are equal
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "bench_help.hpp"
#include "geometry/box.hpp"
#include "mesher/extra/generate.hpp"
#include "mesher/mesher.hpp"
#include "mesher/read.hpp"
#include "sample.hpp"

namespace {

using mesher::Point;

double longest_side(const mesher::Box<3>& box) {
  double longest = 0;
  for (int i = 0; i < 3; ++i) longest = std::max(longest, box.hi[i] - box.lo[i]);
  return longest;
}

// Of one thread, and of several.
void bench_threads(const std::string& file, const mesher::Graph<3>& graph,
                   mesher::Options<3> options, int moves, int threads) {
  const double side = longest_side(options.domain);
  const auto clock = [](auto&& act) {
    const auto start = std::chrono::steady_clock::now();
    act();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  mesher::Mesh<3> first;
  for (const int count : {1, threads}) {
    options.threads = count;
    mesher::Mesher<3> m(options);
    m.insert(graph);
    const double seconds = clock([&] { m.update(); });
    mesher::SplitMix64 random(1);
    std::vector<double> us;
    std::uint64_t calls = 0;
    for (int i = 0; i < moves; ++i) {
      const auto& p = graph.points[random.below(graph.points.size())];
      Point<3> to = p.at;
      for (double& x : to) x += 1e-4 * side * (2 * random.unit() - 1);
      m.move(p.id, to);
      us.push_back(1e6 * clock([&] { calls += m.update().calls.executed; }));
      m.move(p.id, p.at);
      m.update();
    }
    if (count == 1) first = m.mesh();
    std::printf(
        "{\"bench\":\"surface\",\"input\":\"%s\",\"figure\":\"threads\",\"threads\":%d,"
        "\"first_s\":%.3f,\"move_us\":%.0f,\"calls\":%.1f,\"vertices\":%zu,\"same\":%s}\n",
        file.c_str(), count, seconds, bench::quantile(us, 0.5), static_cast<double>(calls) / moves,
        m.stats().vertices, m.mesh() == first ? "true" : "false");
    std::fflush(stdout);
  }
}

void bench_surface(const std::string& file, int moves, int threads) {
  mesher::Graph<3> graph = mesher::read<3>(file).graph;
  std::vector<Point<3>> places;
  for (const auto& p : graph.points) places.push_back(p.at);
  mesher::Options<3> options;
  options.domain = mesher::detail::bounding_box<3>(places);
  const double side = longest_side(options.domain);
  for (double& x : options.domain.lo) x -= side / 20;
  for (double& x : options.domain.hi) x += side / 20;

  if (threads > 1) bench_threads(file, graph, options, moves, threads);
  mesher::Mesher<3> m(options);
  const double seconds = bench::seconds_of([&] { m.insert(graph), m.update(); });
  std::printf(
      "{\"bench\":\"surface\",\"input\":\"%s\",\"figure\":\"first_run\",\"points\":%zu,"
      "\"polygons\":%zu,\"vertices\":%zu,\"total_s\":%.3f}\n",
      file.c_str(), graph.points.size(), graph.polygons.size(), m.stats().vertices, seconds);
  std::fflush(stdout);

  mesher::SplitMix64 random(graph.points.size());
  bench::Sample sample;
  for (int i = 0; i < moves; ++i) {
    auto& p = graph.points[random.below(graph.points.size())];
    for (double& x : p.at) x += 1e-4 * side * (2 * random.unit() - 1);
    m.move(p.id, p.at);
    sample.update(m);
  }
  sample.print("surface", file, "move");
}

}  // namespace

int main(int argc, char** argv) {
  if (bench::shows_help(argc, argv)) return 0;
  for (int i = 1; i < argc; ++i) {
    std::string file = argv[i];
    std::vector<int> numbers;
    for (std::size_t colon; (colon = file.rfind(':')) != std::string::npos;) {
      numbers.insert(numbers.begin(), std::max(std::atoi(file.c_str() + colon + 1), 1));
      file.erase(colon);
    }
    if (numbers.empty()) numbers.push_back(100);
    bench_surface(file, numbers[0], numbers.size() > 1 ? numbers[1] : 1);
  }
}
