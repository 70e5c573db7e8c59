// Updates of a surface: a vertex of it moves, with the polygons and edges that it has.
//
//   surface_bench FILE[:MOVES]...
//
// FILE: a surface (.off, .obj, .ply, .stl), meshed in a box that is larger by a twentieth on each
// side. MOVES: how many random vertices move, each by up to 10^-4 of the box along each axis (100).
// One JSON line per figure:
//   first_run       points, polygons, vertices in the box, seconds of the processor
//   move            median and p99 of single updates in microseconds, and per update the calls that
//                   ran, and the vertices that came and went
#include <algorithm>
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

void bench_surface(const std::string& file, int moves) {
  mesher::Graph<3> graph = mesher::read<3>(file).graph;
  std::vector<Point<3>> places;
  for (const auto& p : graph.points) places.push_back(p.at);
  mesher::Options<3> options;
  options.domain = mesher::detail::bounding_box<3>(places);
  const double side = longest_side(options.domain);
  for (double& x : options.domain.lo) x -= side / 20;
  for (double& x : options.domain.hi) x += side / 20;

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
    const std::string argument = argv[i];
    const std::size_t colon = argument.rfind(':');
    const bool has_moves = colon != std::string::npos;
    bench_surface(argument.substr(0, colon),
                  has_moves ? std::max(std::atoi(argument.c_str() + colon + 1), 1) : 100);
  }
}
