// Meshes of complexes in space at rho = 2, beside TetGen.
//
//   plc_bench [FILE.poly]...     default: all families of `mesher gen`, and some at other sizes
//
// One JSON line an input: `vertices` in what the polygons enclose, and `all_vertices`, with those
// between that and the box that we mesh; seconds of the process for the static mesh and for the
// first run of a mesher, both of all of the box; and where the Debian package tetgen (1.5) is
// installed, TetGen's vertices and the seconds that it says it ran, without files, on what the
// polygons enclose. Both in turns, kRounds times; seconds are medians. Its options are
// -pq2.0O0/0NEF. Without tetgen_vertices: it has failed, or has taken more than a minute.
#include <cstdio>
#include <filesystem>
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

using mesher::Graph;
using mesher::PlcKind;

constexpr int kRounds = 3;

mesher::Options<3> options_of(const Graph<3>& plc) {
  return {.domain = mesher::snapped_domain<3>(mesher::places_of(plc))};
}

std::size_t vertices_inside(const Graph<3>& plc) {
  auto mesh = mesher::mesh_statically(plc, options_of(plc));
  return mesher::domain_mesh(std::move(mesh), plc, mesher::Extent::enclosed).mesh.vertices.size();
}

void bench_plc(const std::string& name, const Graph<3>& plc) {
  std::vector<double> statics, firsts, theirs;
  std::size_t all = 0, their_vertices = 0;
  for (int round = 0; round < kRounds; ++round) {
    statics.push_back(bench::seconds_of(
        [&] { all = mesher::mesh_statically(plc, options_of(plc)).vertices.size(); }));
    mesher::BoxMesher<3> m(options_of(plc));
    mesher::announce(plc, m);
    firsts.push_back(bench::seconds_of([&] { m.update(); }));
    const auto tetgen = bench::run_tetgen(plc);
    if (!tetgen) continue;
    theirs.push_back(tetgen->seconds);
    their_vertices = tetgen->vertices;
  }
  const double ours = bench::quantile(statics, 0.5), first = bench::quantile(firsts, 0.5);
  const std::size_t inside = vertices_inside(plc);
  std::printf(
      "{\"bench\":\"plc\",\"input\":\"%s\",\"vertices\":%zu,\"all_vertices\":%zu,"
      "\"static_s\":%.4f,\"first_run_s\":%.4f,\"first_over_static\":%.2f",
      name.c_str(), inside, all, ours, first, first / ours);
  if (their_vertices != 0) {
    const double their = bench::quantile(theirs, 0.5);
    std::printf(
        ",\"tetgen_vertices\":%zu,\"tetgen_s\":%.4f,\"vertices_over_tetgen\":%.3f,"
        "\"static_over_tetgen\":%.1f",
        their_vertices, their, static_cast<double>(inside) / static_cast<double>(their_vertices),
        ours / their);
  }
  std::printf("}\n");
  std::fflush(stdout);
}

constexpr mesher::PlcFamily kOtherSizes[] = {{PlcKind::nested, 0.075},  {PlcKind::wedge, 5.0},
                                             {PlcKind::wedge, 1.0},     {PlcKind::cloud, 300.0},
                                             {PlcKind::spike, 8.0},     {PlcKind::pump, 64.0},
                                             {PlcKind::cloud, 20000.0}, {PlcKind::faults, 100.0}};

}  // namespace

int main(int argc, char** argv) {
  if (bench::shows_help(argc, argv)) return 0;
  if (!bench::has_tetgen())
    std::fprintf(stderr, "plc_bench: tetgen is not installed: without it\n");
  for (int i = 1; i < argc; ++i) {
    bench_plc(std::filesystem::path(argv[i]).stem().string(), mesher::read<3>(argv[i]).graph);
  }
  if (argc > 1) return 0;
  const auto& names = mesher::plc_kind_names();
  for (const std::string& name : names) {
    bench_plc(name, mesher::generate_plc({*mesher::plc_kind(name)}));
  }
  for (const mesher::PlcFamily& family : kOtherSizes) {
    char name[64];
    std::snprintf(name, sizeof name, "%s %g", names[static_cast<std::size_t>(family.kind)].c_str(),
                  *family.size);
    bench_plc(name, mesher::generate_plc(family));
  }
}
