// Meshes of points and lines in the plane by svr and refine at rho = 1.4142, beside gap-balls
// without the engine, and beside CGAL.
//
//   svr_graph_bench [--cgal PROGRAM] [FILE.poly | lines:N | points:N]...
//       default: lines:10000 lines:100000 points:100000 points:1000000
//
// lines:N are N random segments and as many points (family `segments` of `mesher gen`), points:N
// are uniform ones. PROGRAM is cgal_reference, which is built with the tests: it gets the same
// input, with lines as constraints, so that its triangles are Delaunay but for these. One JSON line
// an input and algorithm: `vertices` in what lines enclose, `all_vertices` with those between that
// and the box, of what is refined alone; `seconds` of the process, with all checks of the input;
// CGAL's vertices and seconds, and ours over its. All in turns, kRounds times; seconds are medians.
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <stdexcept>
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
using mesher::PointId;

constexpr int kRounds = 3;

mesher::Options<2> options_of(const Graph<2>& graph) {
  return {.domain = mesher::snapped_domain<2>(places_of(graph))};
}

Mesh<2> by_gap_balls(const Graph<2>& graph) { return mesh_statically(graph, options_of(graph)); }
Mesh<2> by_svr(const Graph<2>& graph) { return svr(graph, options_of(graph), Extent::enclosed); }
Mesh<2> by_refine(const Graph<2>& graph) {
  return refine(graph, options_of(graph), Extent::enclosed);
}

struct Algorithm {
  const char* name;
  Mesh<2> (*make)(const Graph<2>&);
  std::vector<double> seconds{};
  std::size_t vertices = 0, all = 0;
};

/// What the reference prints of its mesh of a file; nothing if it fails.
std::optional<bench::Figures> run_cgal(const std::string& program, const std::string& file) {
  const std::string command = program + " " + file + " --edits 0 --rho 1.4142 2>/dev/null";
  FILE* out = popen(command.c_str(), "r");
  if (out == nullptr) return std::nullopt;
  std::optional<bench::Figures> found;
  const auto number = [](const std::string& line, const std::string& name) {
    const std::size_t at = line.find("\"" + name + "\":");
    return at == std::string::npos ? 0 : std::strtod(line.c_str() + at + name.size() + 3, nullptr);
  };
  for (char text[1024]; std::fgets(text, sizeof text, out) != nullptr;) {
    const std::string line = text;
    if (line.find("\"figure\":\"mesh\"") == std::string::npos) continue;
    found = {static_cast<std::size_t>(number(line, "vertices")), number(line, "seconds")};
  }
  return pclose(out) == 0 ? found : std::nullopt;
}

void print(const std::string& name, const Graph<2>& graph, const Algorithm& a,
           const std::optional<bench::Figures>& cgal) {
  const double seconds = bench::quantile(a.seconds, 0.5);
  std::printf(
      "{\"bench\":\"svr_graph\",\"input\":\"%s\",\"points\":%zu,\"algorithm\":\"%s\","
      "\"vertices\":%zu,\"all_vertices\":%zu,\"seconds\":%.4f",
      name.c_str(), graph.points.size(), a.name, a.vertices, a.all, seconds);
  if (cgal) {
    std::printf(",\"cgal_vertices\":%zu,\"cgal_s\":%.4f,\"over_cgal\":%.3f", cgal->vertices,
                cgal->seconds, seconds / cgal->seconds);
  }
  std::printf("}\n");
  std::fflush(stdout);
}

void bench_graph(const std::string& name, const Graph<2>& graph, const std::string& cgal_program) {
  Algorithm algorithms[] = {{"gap-balls", by_gap_balls}, {"svr", by_svr}, {"refine", by_refine}};
  const bench::TemporaryFolder folder;
  const std::string file = folder.file("input.poly");
  if (!cgal_program.empty()) write_graph(mesher::without_polylines(graph), file);
  std::optional<bench::Figures> cgal;
  std::vector<double> theirs;
  for (int round = 0; round < kRounds; ++round) {
    for (Algorithm& a : algorithms) {
      Mesh<2> mesh;
      a.seconds.push_back(bench::seconds_of([&] { mesh = a.make(graph); }));
      a.all = mesh.vertices.size();
      a.vertices = domain_mesh(std::move(mesh), graph, Extent::enclosed).mesh.vertices.size();
    }
    if (!cgal_program.empty()) cgal = run_cgal(cgal_program, file);
    if (cgal) theirs.push_back(cgal->seconds);
  }
  if (cgal) cgal->seconds = bench::quantile(theirs, 0.5);
  for (const Algorithm& a : algorithms) print(name, graph, a, cgal);
}

Graph<2> uniform(std::size_t n) {
  Graph<2> graph;
  for (const auto& p : mesher::generate_points<2>(mesher::PointKind::uniform, n, 1)) {
    graph.points.push_back({PointId{static_cast<std::int64_t>(graph.points.size() + 1)}, p, 0});
  }
  return graph;
}

Graph<2> graph_of(const std::string& input) {
  const auto count = [&] {
    return std::strtoull(input.c_str() + input.find(':') + 1, nullptr, 10);
  };
  if (input.rfind("points:", 0) == 0) return uniform(count());
  if (input.rfind("lines:", 0) == 0) {
    return mesher::generate_pslg({mesher::PslgKind::segments, count()});
  }
  return mesher::read<2>(input).graph;
}

}  // namespace

int main(int argc, char** argv) {
  if (bench::shows_help(argc, argv)) return 0;
  std::vector<std::string> inputs(argv + 1, argv + argc);
  std::string cgal;
  if (inputs.size() >= 2 && inputs[0] == "--cgal") {
    cgal = inputs[1];
    inputs.erase(inputs.begin(), inputs.begin() + 2);
  }
  if (inputs.empty()) inputs = {"lines:10000", "lines:100000", "points:100000", "points:1000000"};
  for (const std::string& input : inputs) {
    const bool is_file = std::filesystem::exists(input);
    bench_graph(is_file ? std::filesystem::path(input).stem().string() : input, graph_of(input),
                cgal);
  }
}
