// Sparse Voronoi refinement in space at rho = 2: how many vertices, how long, beside TetGen.
//
//   svr_bench [--k K] [FILE.node]...              default: families of points, see kFamilies
//   svr_bench --locations [NAME] [FILE.node]...   by each structure for point location, or one
//
// Ours and TetGen in turns, kRounds times, in processes of their own; the medians of seconds of the
// processes count, of ours from points in memory to a mesh in memory, and of TetGen what it says it
// ran, without files, of the same points in a box six times as wide. One JSON line an input:
// vertices, seconds, megabytes that the peak of memory rises to, with the points; TetGen's vertices
// and seconds; time_ratio: its seconds over ours; vertex_ratio: our vertices over its. In a line of
// its own what happened in the run: how many points were inserted for a new vertex, how many since
// they crowded one; the worst radius-edge ratio and the largest degree that there ever were.
// --locations: without TetGen; how many times points were looked at for one near a new vertex, and
// to move them.
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "bench_help.hpp"
#include "io/point_file.hpp"
#include "refinement/svr.hpp"
#include "sample.hpp"
#include "tetgen.hpp"

namespace {

using mesher::Point;
using mesher::PointKind;

constexpr int kRounds = 3;

struct Family {
  const char* name;
  PointKind kind;
  std::size_t n;
};
constexpr Family kFamilies[] = {
    {"uniform 100000", PointKind::uniform, 100000},
    {"gaussian 100000", PointKind::gaussian, 100000},
    {"clusters 100000", PointKind::clusters, 100000},
    {"grid 125000", PointKind::grid, 125000},
    {"line-circle 2000", PointKind::line_circle, 2000},
};

struct Run {
  std::size_t vertices = 0;
  double seconds = 0, megabytes = 0;
};

Run run_here(const std::vector<Point<3>>& points, const mesher::Options<3>& options,
             const mesher::SvrSettings& settings) {
  Run run;
  run.seconds = bench::seconds_of(
      [&] { run.vertices = mesher::svr<3>(points, options, settings).vertices.size(); });
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  run.megabytes = static_cast<double>(usage.ru_maxrss) / 1024;
  return run;
}

// In a process of its own, so that runs before leave no memory.
Run run_apart(const std::vector<Point<3>>& points, const mesher::Options<3>& options,
              const mesher::SvrSettings& settings) {
  int ends[2];
  if (pipe(ends) != 0) throw std::runtime_error("no pipe");
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("no process");
  Run run;
  if (child == 0) {
    run = run_here(points, options, settings);
    _exit(write(ends[1], &run, sizeof run) == sizeof run ? 0 : 1);
  }
  close(ends[1]);
  const bool well = read(ends[0], &run, sizeof run) == sizeof run;
  close(ends[0]);
  waitpid(child, nullptr, 0);
  if (!well) throw std::runtime_error("a run failed");
  return run;
}

void print_events(const std::string& name, const std::vector<Point<3>>& points,
                  const mesher::Options<3>& options, const mesher::SvrSettings& settings) {
  mesher::SvrStats s;
  static_cast<void>(mesher::svr<3>(points, options, settings, {}, &s));
  std::printf(
      "{\"bench\":\"svr\",\"input\":\"%s\",\"figure\":\"events\",\"warped\":%zu,\"crowded\":%zu,"
      "\"on_sides\":%zu,\"worst_radius_edge\":%.2f,\"largest_degree\":%zu}\n",
      name.c_str(), s.warped, s.crowded, s.on_sides, s.worst_radius_edge, s.largest_degree);
}

void bench_points(const std::string& name, const std::vector<Point<3>>& points,
                  const mesher::SvrSettings& settings) {
  const mesher::Options<3> options{.domain = mesher::snapped_domain<3>(points)};
  std::vector<double> ours, theirs;
  Run run;
  std::size_t their_vertices = 0;
  for (int round = 0; round < kRounds; ++round) {
    run = run_apart(points, options, settings);
    ours.push_back(run.seconds);
    const auto tetgen = bench::run_tetgen(points);
    if (!tetgen) continue;
    theirs.push_back(tetgen->seconds);
    their_vertices = tetgen->vertices;
  }
  const double seconds = bench::quantile(ours, 0.5);
  std::printf(
      "{\"bench\":\"svr\",\"input\":\"%s\",\"n\":%zu,\"k\":%g,\"vertices\":%zu,"
      "\"seconds\":%.3f,\"megabytes\":%.1f",
      name.c_str(), points.size(), settings.k, run.vertices, seconds, run.megabytes);
  if (!theirs.empty()) {
    const double their_seconds = bench::quantile(theirs, 0.5);
    std::printf(
        ",\"tetgen_vertices\":%zu,\"tetgen_seconds\":%.3f,\"time_ratio\":%.2f,"
        "\"vertex_ratio\":%.3f",
        their_vertices, their_seconds, their_seconds / seconds,
        static_cast<double>(run.vertices) / static_cast<double>(their_vertices));
  }
  std::printf("}\n");
  print_events(name, points, options, settings);
  std::fflush(stdout);
}

struct Location {
  const char* name;
  mesher::PointLocation location;
};
constexpr Location kLocations[] = {
    {"voronoi", mesher::PointLocation::voronoi},
    {"voronoi-shells", mesher::PointLocation::voronoi_shells},
    {"simplex", mesher::PointLocation::simplex},
    {"circumball", mesher::PointLocation::circumball},
};

// `only`: a location, or "".
void bench_locations(const std::string& name, const std::vector<Point<3>>& points,
                     mesher::SvrSettings settings, const std::string& only) {
  const mesher::Options<3> options{.domain = mesher::snapped_domain<3>(points)};
  for (const Location& l : kLocations) {
    if (!only.empty() && only != l.name) continue;
    settings.location = l.location;
    std::vector<double> seconds;
    Run run;
    for (int round = 0; round < kRounds; ++round) {
      run = run_apart(points, options, settings);
      seconds.push_back(run.seconds);
    }
    mesher::SvrStats s;
    static_cast<void>(mesher::svr<3>(points, options, settings, {}, &s));
    std::printf(
        "{\"bench\":\"svr\",\"input\":\"%s\",\"figure\":\"location\",\"location\":\"%s\","
        "\"vertices\":%zu,\"seconds\":%.3f,\"megabytes\":%.1f,\"looked_at_to_find\":%llu,"
        "\"looked_at_to_move\":%llu,\"worst_radius_edge\":%.2f}\n",
        name.c_str(), l.name, run.vertices, bench::quantile(seconds, 0.5), run.megabytes,
        static_cast<unsigned long long>(s.looked_at_to_find),
        static_cast<unsigned long long>(s.looked_at_to_move), s.worst_radius_edge);
    std::fflush(stdout);
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (bench::shows_help(argc, argv)) return 0;
  std::vector<std::string> files(argv + 1, argv + argc);
  const auto take = [&] {
    std::string word = files.front();
    files.erase(files.begin());
    return word;
  };
  mesher::SvrSettings settings;
  bool locations = false;
  std::string only;
  if (files.size() >= 2 && files[0] == "--k") take(), settings.k = std::stod(take());
  if (!files.empty() && files[0] == "--locations") {
    locations = true;
    take();
    for (const Location& l : kLocations) {
      if (!files.empty() && files[0] == l.name) only = take();
    }
  }
  if (!locations && !bench::has_tetgen())
    std::fprintf(stderr, "svr_bench: tetgen is not installed: without it\n");
  const auto run = [&](const std::string& name, const std::vector<Point<3>>& points) {
    locations ? bench_locations(name, points, settings, only)
              : bench_points(name, points, settings);
  };
  for (const std::string& file : files) {
    run(std::filesystem::path(file).stem().string(), mesher::read_points<3>(file).points);
  }
  if (!files.empty()) return 0;
  for (const Family& family : kFamilies) {
    run(family.name, mesher::generate_points<3>(family.kind, family.n, 1));
  }
}
