// The mesher against itself: static run, first run with the engine, updates.
//
//   mesher_bench [N[:RHO]]...   default: 10000 100000 10000:1.1 (1000000 takes a minute and 2 GB)
//
// Points uniform in the unit square, rho = 1.4142 if not given, rule radius_edge. One JSON line per
// figure:
//   static        vertices, seconds of the phases, of canonical output, and in all
//   first_run     the same with the engine, its ratio to static, bytes of trace per output vertex
//   insert/remove median and p99 of single updates in microseconds, and per update: calls
//                 executed, edges touched, vertices and triangles changed
// Run cgal_reference in the same session for what CGAL takes.
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "mesher/mesher.hpp"
#include "sample.hpp"

namespace {

using mesher::FeatureId;
using mesher::Point;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// splitmix64: the same points everywhere.
struct Random {
  std::uint64_t state;
  std::uint64_t next() {
    std::uint64_t z = (state += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }
  double uniform() { return static_cast<double>(next() >> 11) * 0x1p-53; }
  Point<2> point() {
    const double x = uniform();
    return {x, uniform()};
  }
};

struct Sample {
  std::vector<double> microseconds;
  double executed = 0, edges = 0, vertices = 0, triangles = 0;

  void add(double seconds, const mesher::Change<2>& change) {
    microseconds.push_back(1e6 * seconds);
    executed += static_cast<double>(change.calls.executed);
    edges += static_cast<double>(change.calls.edges);
    vertices += static_cast<double>(change.vertices_added.size() + change.vertices_removed.size());
    triangles +=
        static_cast<double>(change.simplices_added.size() + change.simplices_removed.size());
  }
  void print(const char* figure, std::size_t n, double rho) const {
    const auto k = static_cast<double>(microseconds.size());
    std::printf(
        "{\"bench\":\"mesher\",\"figure\":\"%s\",\"n\":%zu,\"rho\":%g,\"updates\":%zu,\"median_"
        "us\":%.1f,"
        "\"p99_us\":%.1f,\"calls_executed\":%.1f,\"edges\":%.1f,\"vertices\":%.2f,"
        "\"triangles\":%.2f}\n",
        figure, n, rho, microseconds.size(), bench::quantile(microseconds, 0.5),
        bench::quantile(microseconds, 0.99), executed / k, edges / k, vertices / k, triangles / k);
  }
};

double print_static(const std::vector<Point<2>>& points, const mesher::Options<2>& options) {
  mesher::MeshStats stats;
  const auto start = Clock::now();
  const auto mesh = mesher::mesh_statically<2>(points, options, {}, &stats);
  const double total = seconds_since(start);
  std::printf(
      "{\"bench\":\"mesher\",\"figure\":\"static\",\"n\":%zu,\"vertices\":%zu,"
      "\"triangles\":%zu,\"quadtree_s\":%.4f,\"steiner_s\":%.4f,\"triangulate_s\":%.4f,"
      "\"total_s\":%.4f}\n",
      points.size(), stats.vertices, stats.simplices, stats.seconds_quadtree, stats.seconds_steiner,
      stats.seconds_triangulate, total);
  return stats.seconds_quadtree + stats.seconds_steiner + stats.seconds_triangulate;
}

void print_first_run(const mesher::MeshStats& s, std::size_t n, double static_seconds) {
  const double run = s.seconds_quadtree + s.seconds_steiner + s.seconds_triangulate;
  std::printf(
      "{\"bench\":\"mesher\",\"figure\":\"first_run\",\"n\":%zu,\"quadtree_s\":%.4f,"
      "\"steiner_s\":%.4f,\"triangulate_s\":%.4f,\"run_s\":%.4f,\"over_static\":%.3f,"
      "\"calls\":%llu,\"edges\":%llu,\"trace_bytes\":%llu,\"bytes_per_vertex\":%.1f}\n",
      n, s.seconds_quadtree, s.seconds_steiner, s.seconds_triangulate, run, run / static_seconds,
      static_cast<unsigned long long>(s.calls), static_cast<unsigned long long>(s.edges),
      static_cast<unsigned long long>(s.trace_bytes),
      static_cast<double>(s.trace_bytes) / static_cast<double>(s.vertices));
}

void bench_points(std::size_t n, double rho = 1.4142) {
  Random random{n};
  mesher::Options<2> options{.domain = {{0, 0}, {1, 1}}, .rho = rho};
  std::vector<Point<2>> points(n);
  std::vector<FeatureId> ids(n);
  for (std::size_t i = 0; i < n; ++i) {
    points[i] = random.point();
    ids[i] = FeatureId{static_cast<std::int64_t>(i)};
  }
  const double static_seconds = print_static(points, options);
  mesher::Mesher<2> m(options);
  m.insert(ids, points);
  m.update();
  print_first_run(m.stats(), n, static_seconds);
  Sample insert;
  Sample remove;
  for (std::size_t k = 0; k < 2000; ++k) {
    const FeatureId id{static_cast<std::int64_t>(n + k)};
    const Point<2> p = random.point();
    const FeatureId gone = ids[k % n];
    auto start = Clock::now();
    m.insert(id, p);
    auto change = m.update();
    insert.add(seconds_since(start), change);
    start = Clock::now();
    m.remove(gone);
    change = m.update();
    remove.add(seconds_since(start), change);
    ids[k % n] = id;
  }
  insert.print("insert", n, rho);
  remove.print("remove", n, rho);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 1) {
    bench_points(10000);
    bench_points(100000);
    bench_points(10000, 1.1);
  }
  for (int i = 1; i < argc; ++i) {
    char* rest = nullptr;
    const std::size_t n = std::strtoull(argv[i], &rest, 10);
    bench_points(n, *rest == ':' ? std::strtod(rest + 1, nullptr) : 1.4142);
  }
}
