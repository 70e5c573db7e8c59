// Static meshes of points in space at rho = 2: how many vertices, how long, beside TetGen.
//
//   space_bench [FILE.node]...   default: families of points, see kFamilies
//
// One JSON line an input: vertices and seconds of the process for mesh_statically; over_model: the
// vertices over those of a model of the same rule, where these are known; and, where the Debian
// package tetgen (1.5) is installed, TetGen's vertices, and the seconds that it says it ran,
// without files, of the same points in a box six times as wide; over_tetgen: our seconds over
// these. Its options are -pq2.0O0/0NEF: with others it leaves tetrahedra above its own bound.
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "bench_help.hpp"
#include "facade/mesh_statically.hpp"
#include "io/point_file.hpp"
#include "mesher/extra/generate.hpp"
#include "sample.hpp"
#include "tetgen.hpp"

namespace {

using bench::Figures;
using mesher::Point;
using mesher::PointKind;

struct Family {
  const char* name;
  PointKind kind;
  std::size_t n;
  std::size_t model;  // its vertices; 0: not known
};
constexpr Family kFamilies[] = {
    {"uniform 10000", PointKind::uniform, 10000, 17321},
    {"uniform 100000", PointKind::uniform, 100000, 159907},
    {"gaussian 10000", PointKind::gaussian, 10000, 0},
    {"clusters 10000", PointKind::clusters, 10000, 0},
    {"grid 125000", PointKind::grid, 125000, 130710},
    {"line-circle 2000", PointKind::line_circle, 2000, 13713},
};

Figures run_ours(const std::vector<Point<3>>& points) {
  const mesher::Options<3> options{.domain = mesher::snapped_domain<3>(points)};
  Figures figures;
  figures.seconds = bench::seconds_of(
      [&] { figures.vertices = mesher::mesh_statically<3>(points, options).vertices.size(); });
  return figures;
}

void bench_points(const std::string& name, const std::vector<Point<3>>& points,
                  std::size_t model = 0) {
  const Figures ours = run_ours(points);
  std::printf("{\"bench\":\"space\",\"input\":\"%s\",\"n\":%zu,\"vertices\":%zu,\"seconds\":%.3f",
              name.c_str(), points.size(), ours.vertices, ours.seconds);
  if (model != 0) {
    std::printf(",\"over_model\":%.4f",
                static_cast<double>(ours.vertices) / static_cast<double>(model));
  }
  if (const auto tetgen = bench::run_tetgen(points)) {
    std::printf(",\"tetgen_vertices\":%zu,\"tetgen_seconds\":%.3f,\"over_tetgen\":%.2f",
                tetgen->vertices, tetgen->seconds, ours.seconds / tetgen->seconds);
  }
  std::printf("}\n");
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  if (bench::shows_help(argc, argv)) return 0;
  if (!bench::has_tetgen())
    std::fprintf(stderr, "space_bench: tetgen is not installed: without it\n");
  for (int i = 1; i < argc; ++i) {
    bench_points(std::filesystem::path(argv[i]).stem().string(),
                 mesher::read_points<3>(argv[i]).points);
  }
  if (argc > 1) return 0;
  for (const Family& family : kFamilies) {
    bench_points(family.name, mesher::generate_points<3>(family.kind, family.n, 1), family.model);
  }
  bench_points("spread 2000", bench::spread(2000));
}
