// What a bound of dihedral angles costs under edits, of uniform points in space.
//
//   slivers_bench [N [EDITS]]
//
// N: points (10000). EDITS: how many random points come, and go again (200). For no bound, and for
// bounds of 10, 12 and 15 degrees, one JSON line per figure:
//   first_run       vertices, tetrahedra below the bound, the least angle in degrees, processor
//                   seconds; those of a run without the engine
//   insert, remove  median and p99 of single updates in microseconds, and per update the calls that
//                   ran, and the vertices that came and went
#include <cstdlib>
#include <string>

#include "bench_help.hpp"
#include "facade/graph_runs.hpp"
#include "mesher/check.hpp"
#include "mesher/extra/generate.hpp"
#include "mesher/mesher.hpp"
#include "sample.hpp"

namespace {

using mesher::Point;
using mesher::PointId;

void bench_bound(std::size_t n, int edits, double bound) {
  mesher::Options<3> options;
  options.domain = {{0, 0, 0}, {1, 1, 1}};
  options.min_dihedral = bound;
  const std::vector<Point<3>> points = mesher::generate_points<3>(mesher::PointKind::uniform, n, 1);
  const std::string input =
      "uniform " + std::to_string(n) + ", " + std::to_string(static_cast<int>(bound)) + " degrees";

  mesher::Mesher<3> m(options);
  for (std::size_t i = 0; i < n; ++i) m.insert(static_cast<PointId>(i), points[i]);
  const double first = bench::seconds_of([&] { m.update(); });
  const double plain =
      bench::seconds_of([&] { static_cast<void>(mesher::mesh_statically<3>(points, options)); });
  const auto mesh = m.mesh();
  const auto quality = mesher::quality(mesh);
  std::printf(
      "{\"bench\":\"slivers\",\"input\":\"%s\",\"figure\":\"first_run\",\"vertices\":%zu,"
      "\"least_degrees\":%.3f,\"total_s\":%.3f,\"static_s\":%.3f}\n",
      input.c_str(), mesh.vertices.size(), quality.min_dihedral_deg, first, plain);
  std::fflush(stdout);

  mesher::SplitMix64 random(n);
  bench::Sample inserts, removals;
  for (int i = 0; i < edits; ++i) {
    const auto id = static_cast<PointId>(n + static_cast<std::size_t>(i));
    m.insert(id, {random.unit(), random.unit(), random.unit()});
    inserts.update(m);
    m.remove(id);
    removals.update(m);
  }
  inserts.print("slivers", input, "insert");
  removals.print("slivers", input, "remove");
}

}  // namespace

int main(int argc, char** argv) {
  if (bench::shows_help(argc, argv)) return 0;
  const std::size_t n = argc > 1 ? std::strtoul(argv[1], nullptr, 10) : 10000;
  const int edits = argc > 2 ? std::atoi(argv[2]) : 200;
  for (const double bound : {0.0, 10.0, 12.0, 15.0}) bench_bound(n, edits, bound);
}
