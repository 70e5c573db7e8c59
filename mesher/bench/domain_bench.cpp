// Regions of a mesh: found at once, and followed through changes.
//
//   domain_bench [N]...   default: 10000 100000; N: 1000 or more
//
// The mesh of N points, uniform in the unit square; two rings of walls along mesh edges: a lake of
// radius 0.4, and a room of radius 0.02 in it that has a door. One JSON line per figure:
//   find      milliseconds of find_domain, of extract and of the first Regions; bytes a triangle
//   inside    a point inserted and removed: median and p99 in microseconds of the update of
//             regions, without the mesher's; triangles that came and went
//   join/part the door opened and closed: the same, and triangles looked at
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <memory>
#include <set>
#include <vector>

#include "bench_help.hpp"
#include "domain/regions.hpp"
#include "facade/box_mesher.hpp"
#include "mesher/domain.hpp"
#include "mesher/extra/generate.hpp"
#include "sample.hpp"

namespace {

using mesher::Mesh;
using mesher::MeshEdge;
using mesher::Point;
using mesher::PointId;
using mesher::detail::Corners;
using mesher::detail::Regions;
using mesher::detail::RegionsChange;
using Edge = mesher::detail::SideOf<2>;
using Clock = std::chrono::steady_clock;

template <class Run>
double seconds_of(Run&& run) {
  const auto start = Clock::now();
  run();
  return std::chrono::duration<double>(Clock::now() - start).count();
}

struct Sample {
  std::vector<double> microseconds;
  std::uint64_t triangles = 0, visited = 0;

  void update(Regions& regions, const RegionsChange& change) {
    mesher::detail::RegionsDifference difference;
    microseconds.push_back(1e6 * seconds_of([&] { difference = regions.update(change); }));
    triangles += difference.removed.size() + difference.added.size();
    visited += difference.visited;
  }
  void print(const char* figure, std::size_t n) const {
    const auto k = static_cast<double>(microseconds.size());
    std::printf(
        "{\"bench\":\"domain\",\"figure\":\"%s\",\"n\":%zu,\"updates\":%zu,\"median_us\":%.2f,"
        "\"p99_us\":%.2f,\"triangles\":%.1f,\"visited\":%.1f}\n",
        figure, n, microseconds.size(), bench::quantile(microseconds, 0.5),
        bench::quantile(microseconds, 0.99), static_cast<double>(triangles) / k,
        static_cast<double>(visited) / k);
  }
};

// The edges around the triangles whose middles are in a disc around the centre of the square.
std::vector<Edge> ring(const Mesh<2>& mesh, double radius) {
  const auto inside = [&](std::uint32_t t) {
    double x = -0.5, y = -0.5;
    for (const auto v : mesh.simplices[t]) {
      x += mesh.vertices[v][0] / 3;
      y += mesh.vertices[v][1] / 3;
    }
    return x * x + y * y < radius * radius;
  };
  const auto next = neighbours(mesh);
  std::vector<Edge> edges;
  for (std::uint32_t t = 0; t < next.size(); ++t) {
    for (int i = 0; i < 3; ++i) {
      if (!inside(t) || next[t][i] == mesher::kNoTriangle || inside(next[t][i])) continue;
      edges.push_back({mesh.simplices[t][(i + 1) % 3], mesh.simplices[t][(i + 2) % 3]});
    }
  }
  return edges;
}

// Vertices by number, those of a mesh first.
struct Numbers {
  explicit Numbers(const Mesh<2>& mesh) {
    for (const auto& p : mesh.vertices) of(p);
  }
  std::uint32_t of(const Point<2>& p) {
    const auto [it, fresh] = numbers.emplace(p, static_cast<std::uint32_t>(places.size()));
    if (fresh) places.push_back(p);
    return it->second;
  }
  RegionsChange change(const mesher::Change<2>& from) {
    RegionsChange to;
    for (const auto& t : from.simplices_removed) {
      to.triangles_out.push_back({of(t[0]), of(t[1]), of(t[2])});
    }
    for (const auto& t : from.simplices_added) {
      to.triangles_in.push_back({of(t[0]), of(t[1]), of(t[2])});
    }
    return to;
  }
  std::map<Point<2>, std::uint32_t> numbers;
  std::vector<Point<2>> places;
};

void insert_points(mesher::BoxMesher<2>& m, std::size_t n) {
  const auto points = mesher::generate_points<2>(mesher::PointKind::uniform, n, 1);
  for (std::size_t i = 0; i < n; ++i) m.insert(PointId{static_cast<std::int64_t>(i)}, points[i]);
  m.update();
}

std::vector<MeshEdge> mesh_edges(const std::vector<Edge>& walls) {
  std::vector<MeshEdge> edges;
  for (const Edge& e : walls) edges.push_back({std::min(e[0], e[1]), std::max(e[0], e[1]), {}, 0});
  return edges;
}

void print_find(const mesher::MeshData<2>& whole, const std::vector<mesher::Seed<2>>& seeds,
                const Regions& regions, double seconds_regions, std::size_t n) {
  mesher::Domain<2> domain;
  const double find = seconds_of(
      [&] { domain = find_domain(whole, whole.features.edges, seeds, mesher::Extent::enclosed); });
  std::size_t kept = 0;
  const double cut = seconds_of([&] { kept = extract(whole, domain).mesh.simplices.size(); });
  std::printf(
      "{\"bench\":\"domain\",\"figure\":\"find\",\"n\":%zu,\"triangles\":%zu,\"kept\":%zu,"
      "\"find_ms\":%.2f,\"extract_ms\":%.2f,\"regions_ms\":%.2f,\"bytes_a_triangle\":%.1f}\n",
      n, whole.simplices.size(), kept, 1e3 * find, 1e3 * cut, 1e3 * seconds_regions,
      static_cast<double>(regions.bytes()) / static_cast<double>(regions.triangles()));
}

// Points in the lake, far from its walls.
void print_inside(mesher::BoxMesher<2>& m, Numbers& numbers, Regions& regions, std::size_t n) {
  Sample inside;
  mesher::SplitMix64 random(2);
  const PointId id{-1};
  for (int i = 0; i < 1000; ++i) {
    m.insert(id, {0.65 + 0.1 * random.unit(), 0.45 + 0.1 * random.unit()});
    inside.update(regions, numbers.change(m.update()));
    m.remove(id);
    inside.update(regions, numbers.change(m.update()));
  }
  inside.print("inside", n);
}

void print_door(Regions& regions, const Edge& door, std::size_t n) {
  Sample join, part;
  RegionsChange open, close;
  open.walls_out = close.walls_in = {door};
  for (int i = 0; i < 100; ++i) {
    join.update(regions, open);
    part.update(regions, close);
  }
  join.print("join", n);
  part.print("part", n);
}

void run(std::size_t n) {
  mesher::BoxMesher<2> m(mesher::Options<2>{.domain = {{0, 0}, {1, 1}}});
  insert_points(m, n);
  mesher::MeshData<2> whole(m.mesh());
  Numbers numbers(whole);
  std::vector<Edge> walls = ring(whole, 0.4);
  const std::vector<Edge> room = ring(whole, 0.02);
  walls.insert(walls.end(), room.begin(), room.end());
  whole.features.edges = mesh_edges(walls);
  const std::vector<mesher::Seed<2>> seeds{mesher::region_seed<2>(2, {0.501, 0.502}, 1),
                                           mesher::region_seed<2>(1, {0.7, 0.6}, 2)};
  std::unique_ptr<Regions> regions;
  const double seconds = seconds_of([&] {
    regions = std::make_unique<Regions>(whole.simplices, walls, seeds,
                                        [&](std::uint32_t v) { return numbers.places[v]; });
  });
  print_find(whole, seeds, *regions, seconds, n);
  print_inside(m, numbers, *regions, n);
  print_door(*regions, room.front(), n);
}

}  // namespace

int main(int argc, char** argv) {
  if (bench::shows_help(argc, argv)) return 0;
  std::vector<std::size_t> sizes;
  for (int i = 1; i < argc; ++i) sizes.push_back(std::strtoul(argv[i], nullptr, 10));
  if (sizes.empty()) sizes = {10000, 100000};
  for (const std::size_t n : sizes) run(std::max<std::size_t>(n, 1000));
}
