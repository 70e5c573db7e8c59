// Points meshed tile after tile beside one run without a trace.
//
//   out_of_core_bench [--alone] [--folder FOLDER] [[3d:]FAMILY:N:TILES:THREADS]...
//
// default: uniform:1000000:4:1 uniform:1000000:4:2 clusters:300000:4:1 3d:uniform:300000:2:1. The
// family `even` is uniform, too, but takes no memory to make. --alone: without the run beside;
// --folder: where tiles are kept, else in memory. One JSON line each, seconds by the clock:
//   seconds, one_run_s, ratio   of the tiles; of one run; the first over the second
//   equal                       whether the meshes are
//   tiles, runs, rounds         with what is outside; runs of tiles; comparisons
//   most_points, all_points     of a tile with its halo, of all runs; over N
//   peak_mb, one_run_peak_mb    of the process, after each: with the points
#include <sys/resource.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include "bench_help.hpp"
#include "facade/mesh_statically.hpp"
#include "mesher/extra/generate.hpp"
#include "mesher/out_of_core.hpp"

namespace {

using mesher::Mesh;
using mesher::Options;
using mesher::Point;

struct Setting {
  bool is_alone = false;
  std::string folder;
};

template <class Run>
double clock_of(Run&& run) {
  const auto start = std::chrono::steady_clock::now();
  run();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double peak_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

template <int D>
std::vector<Point<D>> points_of(const std::string& family, std::size_t n) {
  if (family != "even") return mesher::generate_points<D>(*mesher::point_kind(family), n, 1);
  mesher::SplitMix64 random{1};
  std::vector<Point<D>> points(n);
  for (Point<D>& p : points) {
    for (double& x : p) x = random.unit();
  }
  return points;
}

template <int D>
void bench_case(const std::string& family, std::size_t n, std::size_t tiles, int threads,
                const Setting& setting) {
  std::vector<Point<D>> points = points_of<D>(family, n);
  Options<D> options;
  options.domain = mesher::snapped_domain<D>(points);
  std::vector<Point<D>> kept;
  if (!setting.is_alone) kept = points;
  const mesher::OutOfCore how{.folder = setting.folder, .tiles = tiles, .threads = threads};
  mesher::OutOfCoreReport report;
  Mesh<D> mesh, of_one_run;
  const double seconds = clock_of([&] {
    mesh = mesher::box_mesh_out_of_core<D>(std::move(points), options, how, {}, &report);
  });
  std::printf(
      "{\"bench\":\"out_of_core\",\"family\":\"%s\",\"dimension\":%d,\"n\":%zu,\"tiles\":%zu,"
      "\"threads\":%d,\"vertices\":%zu,\"seconds\":%.3f,\"runs\":%zu,\"rounds\":%zu,"
      "\"most_points\":%.4f,\"all_points\":%.4f,\"peak_mb\":%.0f",
      family.c_str(), D, n, report.tiles, threads, mesh.vertices.size(), seconds, report.runs,
      report.rounds, static_cast<double>(report.most_points) / static_cast<double>(n),
      static_cast<double>(report.all_points) / static_cast<double>(n), peak_mb());
  if (!setting.is_alone) {
    const double one = clock_of([&] { of_one_run = mesher::mesh_statically<D>(kept, options); });
    std::printf(",\"one_run_s\":%.3f,\"ratio\":%.2f,\"equal\":%s,\"one_run_peak_mb\":%.0f", one,
                seconds / one, mesh == of_one_run ? "true" : "false", peak_mb());
  }
  std::printf("}\n");
}

bool bench_argument(std::string_view text, const Setting& setting) {
  const bool in_space = text.substr(0, 3) == "3d:";
  if (in_space) text.remove_prefix(3);
  const std::size_t colon = text.find(':');
  if (colon == text.npos) return false;
  const std::string family(text.substr(0, colon));
  unsigned long long n = 0, tiles = 0;
  int threads = 0;
  const std::string numbers(text.substr(colon + 1));
  if (std::sscanf(numbers.c_str(), "%llu:%llu:%d", &n, &tiles, &threads) != 3) return false;
  if ((family != "even" && !mesher::point_kind(family)) || n < 2 || tiles < 1 || threads < 1) {
    return false;
  }
  in_space ? bench_case<3>(family, n, tiles, threads, setting)
           : bench_case<2>(family, n, tiles, threads, setting);
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  if (bench::shows_help(argc, argv)) return 0;
  Setting setting;
  std::vector<std::string_view> cases;
  for (int i = 1; i < argc; ++i) {
    const std::string_view argument = argv[i];
    if (argument == "--alone") {
      setting.is_alone = true;
    } else if (argument == "--folder" && i + 1 < argc) {
      setting.folder = argv[++i];
    } else {
      cases.push_back(argument);
    }
  }
  if (cases.empty()) {
    cases = {"uniform:1000000:4:1", "uniform:1000000:4:2", "clusters:300000:4:1",
             "3d:uniform:300000:2:1"};
  }
  for (const std::string_view text : cases) {
    if (bench_argument(text, setting)) continue;
    std::fprintf(stderr, "%s: not [3d:]FAMILY:N:TILES:THREADS\n", std::string(text).c_str());
    return 2;
  }
}
