// Meshes of complexes in space with a largest volume, at rho = 2, beside TetGen.
//
//   space_sizes_bench [SURFACE V]...
//
// The volume V is 1e-2, 1e-3 and 1e-4 of what the polygons enclose; of surfaces that are named (in
// .off, .obj, .ply or .stl) it is given. One JSON line each: for each algorithm (of surfaces,
// without gap-balls) the vertices in that, the `largest` volume of its tetrahedra over V, and
// seconds of the process from the graph to the mesh, with what says where limits count; and, where
// the Debian package tetgen (1.5) is installed, TetGen's vertices and the seconds that it says it
// ran, without files. Its options are -pq2.0O0/0NEFaV. In turns, kRounds times; seconds are
// medians.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "bench_help.hpp"
#include "mesher/extra/generate.hpp"
#include "mesher/meshing.hpp"
#include "mesher/read.hpp"
#include "sample.hpp"
#include "tetgen.hpp"

namespace {

using mesher::Algorithm;
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

// An algorithm's mesh, and how long it takes.
struct Run {
  mesher::Algorithm algorithm;
  std::vector<double> seconds{};
  std::size_t vertices = 0;
  double largest = 0;  // volume
};

void print(const Run& run, double volume) {
  std::string name(name_of(run.algorithm));
  std::replace(name.begin(), name.end(), '-', '_');
  std::printf(",\"%s_vertices\":%zu,\"%s_largest\":%.4f,\"%s_s\":%.4f", name.c_str(), run.vertices,
              name.c_str(), run.largest / volume, name.c_str(), bench::quantile(run.seconds, 0.5));
}

void bench_volume(const char* name, const Graph<3>& plc, double volume, std::vector<Run> runs) {
  mesher::Options<3> options{.max_measure = volume};
  std::vector<double> theirs;
  std::size_t their_vertices = 0;
  char more[64];
  std::snprintf(more, sizeof more, "a%.17f", volume);
  for (int round = 0; round < kRounds; ++round) {
    for (Run& run : runs) {
      options.algorithm = run.algorithm;
      mesher::Meshed<3> made;
      run.seconds.push_back(bench::seconds_of([&] { made = mesh(plc, options); }));
      const auto all = volumes(made.mesh);
      run.vertices = made.mesh.vertices.size();
      run.largest = *std::max_element(all.begin(), all.end());
    }
    const auto tetgen = bench::run_tetgen(plc, more);
    if (!tetgen) continue;
    theirs.push_back(tetgen->seconds);
    their_vertices = tetgen->vertices;
  }
  std::printf("{\"bench\":\"space_sizes\",\"input\":\"%s\",\"volume\":%g", name, volume);
  for (const Run& run : runs) print(run, volume);
  if (their_vertices != 0) {
    std::printf(",\"tetgen_vertices\":%zu,\"tetgen_s\":%.4f", their_vertices,
                bench::quantile(theirs, 0.5));
  }
  std::printf("}\n");
  std::fflush(stdout);
}

void bench_plc(const char* name, const Graph<3>& plc) {
  double enclosed = 0;
  for (const double v : volumes(mesh(plc, {.algorithm = Algorithm::svr}).mesh)) enclosed += v;
  for (const double part : {1e-2, 1e-3, 1e-4}) {
    bench_volume(name, plc, part * enclosed,
                 {{Algorithm::gap_balls}, {Algorithm::svr}, {Algorithm::refine}});
  }
}

void bench_surface(const std::string& path, double volume) {
  const auto file = mesher::read<3>(path);
  bench_volume(path.substr(path.rfind('/') + 1).c_str(), file.graph, volume,
               {{Algorithm::svr}, {Algorithm::refine}});
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
  for (int i = 1; i + 1 < argc; i += 2) bench_surface(argv[i], std::strtod(argv[i + 1], nullptr));
}
