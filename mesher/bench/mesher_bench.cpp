// The mesher against itself: static run, first run with the engine, updates.
//
//   mesher_bench [[3d:]N[:RHO[:UPDATES]]]...
//
// default: 10000 100000 10000:1.1 3d:100000 (1000000 takes a minute and 2 GB, 3d:1000000 minutes
// and 6 GB). Points uniform in the unit square or cube, rho = 1.4142 or 2 if not given, rule
// radius_edge, 2000 points that come and 2000 that go. One JSON line per figure:
//   static        vertices, seconds of the phases (by the clock), and in all, canonical output
//                 included (of the process, as of all that follows)
//   first_run     the same with the engine, its ratio to static, bytes of trace per output vertex
//   insert/remove median and p99 of single updates in microseconds, and per update: calls
//                 executed, edges touched, vertices and simplices changed
// Run cgal_reference in the same session for what CGAL takes.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string_view>
#include <vector>

#include "bench_help.hpp"
#include "facade/box_mesher.hpp"
#include "facade/mesh_statically.hpp"
#include "sample.hpp"

namespace {

using mesher::Point;
using mesher::PointId;
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
  template <int D>
  Point<D> point() {
    Point<D> p;
    for (double& x : p) x = uniform();
    return p;
  }
};

struct Sample {
  std::vector<double> microseconds, changed;
  double executed = 0, edges = 0, vertices = 0, simplices = 0;

  template <int D, class Edit>
  void update(mesher::BoxMesher<D>& m, Edit edit) {
    mesher::Change<D> change;
    microseconds.push_back(1e6 * bench::seconds_of([&] {
                             edit();
                             change = m.update();
                           }));
    executed += static_cast<double>(change.calls.executed);
    edges += static_cast<double>(change.calls.edges);
    changed.push_back(
        static_cast<double>(change.vertices_added.size() + change.vertices_removed.size()));
    vertices += changed.back();
    simplices +=
        static_cast<double>(change.simplices_added.size() + change.simplices_removed.size());
  }
  void print(const char* figure, std::size_t n, int dimension, double rho) const {
    const auto k = static_cast<double>(microseconds.size());
    std::printf(
        "{\"bench\":\"mesher\",\"figure\":\"%s\",\"dimension\":%d,\"n\":%zu,\"rho\":%g,\"updates\":"
        "%zu,\"median_"
        "us\":%.1f,"
        "\"p99_us\":%.1f,\"calls_executed\":%.1f,\"edges\":%.1f,\"vertices\":%.2f,"
        "\"vertices_median\":%.0f,\"vertices_p99\":%.0f,"
        "\"simplices\":%.2f}\n",
        figure, dimension, n, rho, microseconds.size(), bench::quantile(microseconds, 0.5),
        bench::quantile(microseconds, 0.99), executed / k, edges / k, vertices / k,
        bench::quantile(changed, 0.5), bench::quantile(changed, 0.99), simplices / k);
  }
};

template <int D>
double print_static(const std::vector<Point<D>>& points, const mesher::Options<D>& options) {
  mesher::MeshStats stats;
  const double total = bench::seconds_of(
      [&] { static_cast<void>(mesher::mesh_statically<D>(points, options, {}, &stats)); });
  std::printf(
      "{\"bench\":\"mesher\",\"figure\":\"static\",\"dimension\":%d,\"n\":%zu,\"vertices\":%zu,"
      "\"simplices\":%zu,\"quadtree_s\":%.4f,\"steiner_s\":%.4f,\"triangulate_s\":%.4f,"
      "\"total_s\":%.4f}\n",
      D, points.size(), stats.vertices, stats.simplices, stats.seconds_quadtree,
      stats.seconds_steiner, stats.seconds_triangulate, total);
  return total;
}

void print_first_run(const mesher::MeshStats& s, std::size_t n, int dimension, double total,
                     double static_total) {
  std::printf(
      "{\"bench\":\"mesher\",\"figure\":\"first_run\",\"dimension\":%d,\"n\":%zu,\"quadtree_s\":%."
      "4f,"
      "\"steiner_s\":%.4f,\"triangulate_s\":%.4f,\"total_s\":%.4f,\"over_static\":%.3f,"
      "\"calls\":%llu,\"edges\":%llu,\"trace_bytes\":%llu,\"bytes_per_vertex\":%.1f}\n",
      dimension, n, s.seconds_quadtree, s.seconds_steiner, s.seconds_triangulate, total,
      total / static_total, static_cast<unsigned long long>(s.calls),
      static_cast<unsigned long long>(s.edges), static_cast<unsigned long long>(s.trace_bytes),
      static_cast<double>(s.trace_bytes) / static_cast<double>(s.vertices));
}

template <int D>
void bench_updates(mesher::BoxMesher<D>& m, std::vector<PointId> ids, std::size_t updates,
                   Random& random) {
  const std::size_t n = ids.size();
  Sample insert;
  Sample remove;
  for (std::size_t k = 0; k < updates; ++k) {
    const PointId id{static_cast<std::int64_t>(n + k)};
    const Point<D> p = random.point<D>();
    const PointId gone = ids[k % n];
    insert.update(m, [&] { m.insert(id, p); });
    remove.update(m, [&] { m.remove(gone); });
    ids[k % n] = id;
  }
  insert.print("insert", n, D, m.options().rho);
  remove.print("remove", n, D, m.options().rho);
}

template <int D>
void bench_points(std::size_t n, std::optional<double> rho, std::size_t updates) {
  Random random{n};
  mesher::Options<D> options;
  options.domain.hi.fill(1);
  if (rho) options.rho = *rho;
  std::vector<Point<D>> points(n);
  std::vector<PointId> ids(n);
  for (std::size_t i = 0; i < n; ++i) {
    points[i] = random.point<D>();
    ids[i] = PointId{static_cast<std::int64_t>(i)};
  }
  const double static_total = print_static<D>(points, options);
  mesher::BoxMesher<D> m(options);
  const double total = bench::seconds_of([&] {
    m.insert(ids, points);
    m.update();
    static_cast<void>(m.mesh());
  });
  print_first_run(m.stats(), n, D, total, static_total);
  bench_updates(m, ids, updates, random);
}

void bench_argument(std::string_view text) {
  const bool in_space = text.substr(0, 3) == "3d:";
  if (in_space) text.remove_prefix(3);
  char* rest = nullptr;
  const std::size_t n = std::strtoull(text.data(), &rest, 10);
  std::optional<double> rho;
  if (*rest == ':') rho = std::strtod(rest + 1, &rest);
  const std::size_t updates = *rest == ':' ? std::strtoull(rest + 1, nullptr, 10) : 2000;
  in_space ? bench_points<3>(n, rho, updates) : bench_points<2>(n, rho, updates);
}

}  // namespace

int main(int argc, char** argv) {
  if (bench::shows_help(argc, argv)) return 0;
  if (argc == 1) {
    for (const char* input : {"10000", "100000", "10000:1.1", "3d:100000"}) bench_argument(input);
  }
  for (int i = 1; i < argc; ++i) bench_argument(argv[i]);
}
