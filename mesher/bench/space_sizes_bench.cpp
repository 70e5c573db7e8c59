// Meshes of complexes in space with a largest volume, at rho = 2, beside TetGen.
//
//   space_sizes_bench
//
// The volume V is 1e-2, 1e-3 and 1e-4 of what the polygons enclose. One JSON line each: `vertices`
// in that, `largest` volume of its tetrahedra over V; seconds of the process for the static mesh,
// with the mesh without limits that says where they count; and, where the Debian package tetgen
// (1.5) is installed, TetGen's vertices and the seconds that it says it ran, without files. Its
// options are -pq2.0O0/0NEFaV. In turns, kRounds times; seconds are medians.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "bench_help.hpp"
#include "facade/graph_runs.hpp"
#include "mesher/extra/generate.hpp"
#include "mesher/meshing.hpp"
#include "sample.hpp"
#include "tetgen.hpp"

namespace {

using mesher::Extent;
using mesher::Graph;
using mesher::Mesh;
using mesher::PlcKind;

constexpr int kRounds = 3;

std::vector<double> volumes(const Mesh<3>& mesh) {
  std::vector<double> all;
  for (const auto& s : mesh.simplices) {
    double e[3][3];
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        e[i][k] = mesh.vertices[s[i + 1]][k] - mesh.vertices[s[0]][k];
      }
    }
    double six = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t l = (k + 1) % 3, m = (k + 2) % 3;
      six += e[0][k] * (e[1][l] * e[2][m] - e[1][m] * e[2][l]);
    }
    all.push_back(std::abs(six) / 6);
  }
  return all;
}

Mesh<3> inside(const Graph<3>& plc, Mesh<3> mesh) {
  return mesher::domain_mesh(std::move(mesh), plc, Extent::enclosed).mesh;
}

void bench_volume(const char* name, const Graph<3>& plc, double part, double volume) {
  mesher::Options<3> options{.domain = mesher::snapped_domain<3>(mesher::places_of(plc))};
  std::vector<double> ours, theirs;
  std::size_t their_vertices = 0;
  Mesh<3> mesh;
  char more[64];
  std::snprintf(more, sizeof more, "a%.17f", volume);
  for (int round = 0; round < kRounds; ++round) {
    ours.push_back(bench::seconds_of([&] {
      options.max_measure = volume;
      options.region_limits =
          region_limits(plc, options, Extent::enclosed, mesher::RegionAreas::ignored);
      mesh = mesher::mesh_statically(plc, options);
    }));
    const auto tetgen = bench::run_tetgen(plc, more);
    if (!tetgen) continue;
    theirs.push_back(tetgen->seconds);
    their_vertices = tetgen->vertices;
  }
  const Mesh<3> kept = inside(plc, std::move(mesh));
  const auto all = volumes(kept);
  std::printf(
      "{\"bench\":\"space_sizes\",\"input\":\"%s\",\"part\":%g,\"vertices\":%zu,\"largest\":%.4f,"
      "\"static_s\":%.4f",
      name, part, kept.vertices.size(), *std::max_element(all.begin(), all.end()) / volume,
      bench::quantile(ours, 0.5));
  if (their_vertices != 0) {
    std::printf(",\"tetgen_vertices\":%zu,\"tetgen_s\":%.4f", their_vertices,
                bench::quantile(theirs, 0.5));
  }
  std::printf("}\n");
  std::fflush(stdout);
}

void bench_plc(const char* name, const Graph<3>& plc) {
  const mesher::Options<3> free{.domain = mesher::snapped_domain<3>(mesher::places_of(plc))};
  double enclosed = 0;
  for (const double v : volumes(inside(plc, mesher::mesh_statically(plc, free)))) enclosed += v;
  for (const double part : {1e-2, 1e-3, 1e-4}) bench_volume(name, plc, part, part * enclosed);
}

}  // namespace

int main(int argc, char** argv) {
  if (bench::shows_help(argc, argv)) return 0;
  if (!bench::has_tetgen()) {
    std::fprintf(stderr, "space_sizes_bench: tetgen is not installed: without it\n");
  }
  bench_plc("cube", mesher::generate_plc({PlcKind::cube}));
  bench_plc("pump", mesher::generate_plc({PlcKind::pump}));
  bench_plc("shells", mesher::generate_plc({PlcKind::shells}));
}
