// A static run of gap-balls, which makes the mesh that `edit` keeps, beside refine and svr, from
// file to file; and beside the same run of another `mesher`, and whether its mesh is the same.
//
//   one_mesh_bench [--old MESHER] [--rounds N, default 5] [FILE]...
//
// Default: 10^5 points of kKinds, in the plane and in space. All are processes, in turns. A JSON
// line an input: medians of user seconds, and gap-balls' over refine's. A process is killed after
// 120 seconds of the processor or beyond 12 GB; null then.
#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "bench_help.hpp"
#include "from_files.hpp"
#include "mesher/extra/generate.hpp"
#include "mesher/write.hpp"

namespace {

using mesher::PointKind;

constexpr std::size_t kPoints = 100000;
constexpr std::pair<const char*, PointKind> kKinds[] = {{"uniform", PointKind::uniform},
                                                        {"gaussian", PointKind::gaussian},
                                                        {"clusters", PointKind::clusters},
                                                        {"grid", PointKind::grid},
                                                        {"line-circle", PointKind::line_circle}};

struct Options {
  std::string tool, old;
  int rounds = 5;
};

std::string bytes_of(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// One way to mesh: its runs so far.
struct Way {
  const char* name;
  std::string tool;
  std::vector<std::string> options;
  std::vector<double> seconds{};
  bool fails = false;

  void run(const std::string& input, const std::string& output) {
    if (fails) return;
    std::vector<std::string> command{tool, "mesh", input, "-o", output, "--quiet"};
    command.insert(command.end(), options.begin(), options.end());
    const auto done = bench::run_process(command, bench::FromFiles::kMostSeconds,
                                         bench::FromFiles::kMostGigabytes);
    fails = !done.has_value();
    if (done) seconds.push_back(done->user_seconds);
  }
  [[nodiscard]] double median() {
    if (fails || seconds.empty()) return 0;
    std::sort(seconds.begin(), seconds.end());
    return seconds[(seconds.size() - 1) / 2];
  }
  void print() {
    fails || seconds.empty() ? std::printf(",\"%s_seconds\":null", name)
                             : std::printf(",\"%s_seconds\":%.3f", name, median());
  }
};

void compare(const std::string& name, const std::string& input, const Options& options) {
  const bench::TemporaryFolder folder;
  const std::string output = folder.file("new.node"), old_output = folder.file("old.node");
  Way gap_balls{"gap_balls", options.tool, {"--algorithm", "gap-balls", "--static"}};
  Way refine{"refine", options.tool, {"--algorithm", "refine"}};
  Way svr{"svr", options.tool, {"--algorithm", "svr"}};
  Way old{"old_gap_balls", options.old, {"--algorithm", "gap-balls", "--static"}};
  for (int round = 0; round < options.rounds; ++round) {
    gap_balls.run(input, output);
    refine.run(input, folder.file("other.node"));
    svr.run(input, folder.file("other.node"));
    if (!options.old.empty()) old.run(input, old_output);
  }
  std::printf("{\"bench\":\"one_mesh\",\"input\":\"%s\"", name.c_str());
  gap_balls.print(), refine.print(), svr.print();
  if (refine.median() > 0)
    std::printf(",\"over_refine\":%.2f", gap_balls.median() / refine.median());
  if (!options.old.empty()) {
    old.print();
    const bool same = bytes_of(folder.file("new.node")) == bytes_of(folder.file("old.node")) &&
                      bytes_of(folder.file("new.ele")) == bytes_of(folder.file("old.ele"));
    std::printf(",\"same_mesh\":%s", same ? "true" : "false");
  }
  std::printf("}\n");
  std::fflush(stdout);
}

template <int D>
void compare_families(const Options& options) {
  for (const auto& [name, kind] : kKinds) {
    const bench::TemporaryFolder folder;
    const std::string input = folder.file("points.node");
    mesher::OutputFiles files;
    mesher::write_points<D>(mesher::generate_points<D>(kind, kPoints, 1), files.open(input));
    files.commit();
    compare(name + std::string(D == 2 ? " 2D" : " 3D"), input, options);
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (bench::shows_help(argc, argv)) return 0;
  Options options{.tool = bench::tool_beside(argv[0]), .old = {}};
  std::vector<std::string> files;
  for (char** word = argv + 1; *word != nullptr; ++word) {
    if (std::string(*word) == "--old" && word[1] != nullptr) {
      options.old = *++word;
    } else if (std::string(*word) == "--rounds" && word[1] != nullptr) {
      options.rounds = std::atoi(*++word);
    } else {
      files.emplace_back(*word);
    }
  }
  for (const std::string& file : files) {
    compare(std::filesystem::path(file).stem().string(), file, options);
  }
  if (!files.empty()) return 0;
  compare_families<2>(options);
  compare_families<3>(options);
}
