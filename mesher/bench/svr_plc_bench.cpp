// Meshes of complexes in space by svr and refine at rho = 2, beside TetGen.
//
//   svr_plc_bench [FILE.poly]...     default: all families of `mesher gen`, and closed surfaces of
//                                    20480 and 81920 triangles
//
// One JSON line an input and algorithm: `vertices` in what the polygons enclose, `all_vertices`
// with those between that and the box, of what is refined alone; `seconds` of the process for that,
// and with it the domain taken out, `seconds_with_domain`; the worst radius-edge ratio that there
// ever was, and the largest degree. Where the Debian package tetgen (1.5) is installed, its
// vertices and the seconds that it says it ran, without files; its options are -pq2.0O0/0NEF. All
// in turns, kRounds times; seconds are medians.
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "bench_help.hpp"
#include "facade/graph_runs.hpp"
#include "mesher/extra/generate.hpp"
#include "mesher/meshing.hpp"
#include "mesher/read.hpp"
#include "sample.hpp"
#include "tetgen.hpp"

namespace {

using mesher::Extent;
using mesher::Graph;
using mesher::Mesh;
using mesher::Point;
using mesher::PointId;
using mesher::PolygonId;

constexpr int kRounds = 3;

mesher::Options<3> options_of(const Graph<3>& plc) {
  return {.domain = mesher::snapped_domain<3>(mesher::places_of(plc))};
}

Mesh<3> by_svr(const Graph<3>& plc, mesher::RefineStats* figures) {
  mesher::SvrStats all;
  Mesh<3> mesh =
      mesher::svr(plc, options_of(plc), Extent::enclosed, {}, figures == nullptr ? nullptr : &all);
  if (figures != nullptr) *figures = all;
  return mesh;
}
Mesh<3> by_refine(const Graph<3>& plc, mesher::RefineStats* figures) {
  return mesher::refine(plc, options_of(plc), Extent::enclosed, {}, figures);
}

struct Algorithm {
  const char* name;
  Mesh<3> (*make)(const Graph<3>&, mesher::RefineStats*);
  std::vector<double> seconds{}, with_domain{};
  std::size_t vertices = 0, all = 0;
};

void bench_plc(const std::string& name, const Graph<3>& plc) {
  Algorithm algorithms[] = {{"svr", by_svr}, {"refine", by_refine}};
  std::vector<double> theirs;
  std::size_t their_vertices = 0;
  for (int round = 0; round < kRounds; ++round) {
    for (Algorithm& a : algorithms) {
      Mesh<3> mesh;
      a.seconds.push_back(bench::seconds_of([&] { mesh = a.make(plc, nullptr); }));
      a.all = mesh.vertices.size();
      const double domain = bench::seconds_of([&] {
        a.vertices = domain_mesh(std::move(mesh), plc, Extent::enclosed).mesh.vertices.size();
      });
      a.with_domain.push_back(a.seconds.back() + domain);
    }
    const auto tetgen = bench::run_tetgen(plc);
    if (!tetgen) continue;
    theirs.push_back(tetgen->seconds);
    their_vertices = tetgen->vertices;
  }
  for (const Algorithm& a : algorithms) {
    mesher::RefineStats figures;
    static_cast<void>(a.make(plc, &figures));
    const double ours = bench::quantile(a.seconds, 0.5);
    std::printf(
        "{\"bench\":\"svr_plc\",\"input\":\"%s\",\"algorithm\":\"%s\",\"vertices\":%zu,"
        "\"all_vertices\":%zu,\"seconds\":%.4f,\"seconds_with_domain\":%.4f,"
        "\"worst_radius_edge\":%.1f,\"largest_degree\":%zu",
        name.c_str(), a.name, a.vertices, a.all, ours, bench::quantile(a.with_domain, 0.5),
        figures.worst_radius_edge, figures.largest_degree);
    if (their_vertices != 0) {
      const double their = bench::quantile(theirs, 0.5);
      std::printf(
          ",\"tetgen_vertices\":%zu,\"tetgen_s\":%.4f,\"vertices_over_tetgen\":%.3f,"
          "\"tetgen_over_seconds\":%.2f",
          their_vertices, their,
          static_cast<double>(a.vertices) / static_cast<double>(their_vertices), their / ours);
    }
    std::printf("}\n");
    std::fflush(stdout);
  }
}

// --- A closed surface of triangles: an icosahedron, quartered and bent -----------------------

class Surface {
 public:
  explicit Surface(int levels) {
    const double t = (1 + std::sqrt(5.0)) / 2;
    for (const double x : {-1.0, 1.0}) {
      for (const double y : {-t, t}) {
        add({x, y, 0}), add({0, x, y}), add({y, 0, x});
      }
    }
    std::vector<std::array<std::size_t, 3>> faces;
    for (std::size_t i = 0; i < 12; ++i) {
      for (std::size_t j = i + 1; j < 12; ++j) {
        for (std::size_t k = j + 1; k < 12; ++k) {
          if (are_near(i, j) && are_near(j, k) && are_near(i, k)) faces.push_back({i, j, k});
        }
      }
    }
    for (; levels > 0; --levels) {
      std::vector<std::array<std::size_t, 3>> finer;
      for (const auto& [a, b, c] : faces) {
        const std::size_t x = middle(a, b), y = middle(b, c), z = middle(c, a);
        finer.insert(finer.end(), {{a, x, z}, {b, y, x}, {c, z, y}, {x, y, z}});
      }
      faces = std::move(finer);
    }
    for (const auto& face : faces) {
      mesher::Polygon polygon{.id = polygon_id(plc_.polygons.size()), .loops = {{}}};
      for (const std::size_t i : face) polygon.loops[0].push_back(id(i));
      plc_.polygons.push_back(polygon);
    }
    for (auto& p : plc_.points) bend(p.at);
  }
  [[nodiscard]] const Graph<3>& plc() const noexcept { return plc_; }

 private:
  static PointId id(std::size_t i) { return PointId{static_cast<std::int64_t>(i + 1)}; }
  static PolygonId polygon_id(std::size_t i) { return PolygonId{static_cast<std::int64_t>(i + 1)}; }
  std::size_t add(const Point<3>& p) {
    const double length = std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
    plc_.points.push_back(
        {id(plc_.points.size()), {p[0] / length, p[1] / length, p[2] / length}, 0});
    return plc_.points.size() - 1;
  }
  // Of the icosahedron, whose edges are 1.05 times its radius.
  [[nodiscard]] bool are_near(std::size_t i, std::size_t j) const {
    double gap2 = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      gap2 += std::pow(plc_.points[i].at[axis] - plc_.points[j].at[axis], 2);
    }
    return gap2 < 1.5;
  }
  std::size_t middle(std::size_t i, std::size_t j) {
    const auto [it, is_new] = middles_.try_emplace(std::minmax(i, j), 0);
    if (!is_new) return it->second;
    const Point<3>&p = plc_.points[i].at, &q = plc_.points[j].at;
    return it->second = add({p[0] + q[0], p[1] + q[1], p[2] + q[2]});
  }
  static void bend(Point<3>& p) {
    const double r = 1 + 0.15 * std::sin(5 * p[0] + 1) * std::cos(4 * p[1]) +
                     0.1 * std::sin(7 * p[2] + 2 * p[0]);
    for (double& x : p) x *= r;
  }

  Graph<3> plc_;
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> middles_;
};

}  // namespace

int main(int argc, char** argv) {
  if (bench::shows_help(argc, argv)) return 0;
  if (!bench::has_tetgen()) {
    std::fprintf(stderr, "svr_plc_bench: tetgen is not installed: without it\n");
  }
  for (int i = 1; i < argc; ++i) {
    bench_plc(std::filesystem::path(argv[i]).stem().string(), mesher::read<3>(argv[i]).graph);
  }
  if (argc > 1) return 0;
  for (const std::string& name : mesher::plc_kind_names()) {
    bench_plc(name, mesher::generate_plc({*mesher::plc_kind(name)}));
  }
  bench_plc("cloud 20000", mesher::generate_plc({mesher::PlcKind::cloud, 20000.0}));
  bench_plc("pump 64", mesher::generate_plc({mesher::PlcKind::pump, 64.0}));
  for (const int levels : {5, 6}) {
    const Surface surface(levels);
    bench_plc("surface " + std::to_string(surface.plc().polygons.size()), surface.plc());
  }
}
