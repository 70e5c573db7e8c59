// From file to file: `mesher mesh` of points in space beside TetGen 1.5, at rho = 2: the thesis's
// table [Hudson, Fig 3.4], and larger inputs.
//
//   files_bench [--large] [--algorithm NAME, default auto] [FILE.node]...
//
// Default: families of points, see kFamilies; --large: and those that take minutes and gigabytes.
// Both are processes, in turns, kRounds times (from_files.hpp). A JSON line an input: medians of
// seconds, with memory and vertices; time_ratio: TetGen's seconds over ours. TetGen is killed after
// 120 seconds or beyond 12 GB.
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "bench_help.hpp"
#include "from_files.hpp"
#include "io/point_file.hpp"

namespace {

using mesher::PointKind;

constexpr int kRounds = 3;

struct Family {
  const char* name;
  PointKind kind;
  std::size_t n;
  bool large;
};
constexpr Family kFamilies[] = {
    {"line-circle 2000", PointKind::line_circle, 2000, false},
    {"line-circle 20000", PointKind::line_circle, 20000, false},
    {"grid 125000", PointKind::grid, 125000, false},
    {"uniform 100000", PointKind::uniform, 100000, false},
    {"gaussian 100000", PointKind::gaussian, 100000, false},
    {"grid 1000000", PointKind::grid, 1000000, true},
    {"uniform 1000000", PointKind::uniform, 1000000, true},
};

}  // namespace

int main(int argc, char** argv) {
  if (bench::shows_help(argc, argv)) return 0;
  std::string algorithm = "auto";
  bool large = false;
  std::vector<std::string> files;
  for (char** word = argv + 1; *word != nullptr; ++word) {
    if (std::string(*word) == "--large") {
      large = true;
    } else if (std::string(*word) == "--algorithm" && word[1] != nullptr) {
      algorithm = *++word;
    } else {
      files.emplace_back(*word);
    }
  }
  const bool with_tetgen = bench::has_tetgen();
  if (!with_tetgen) std::fprintf(stderr, "files_bench: tetgen is not installed: without it\n");
  const bench::FromFiles both(bench::tool_beside(argv[0]), algorithm);
  const auto compare = [&](const std::string& name, const std::vector<mesher::Point<3>>& points) {
    bench::print("files", "\"input\":\"" + name + '"', algorithm,
                 both.run(points, with_tetgen, kRounds));
  };
  for (const std::string& file : files) {
    compare(std::filesystem::path(file).stem().string(), mesher::read_points<3>(file).points);
  }
  if (!files.empty()) return 0;
  for (const Family& family : kFamilies) {
    if (family.large && !large) continue;
    compare(family.name, mesher::generate_points<3>(family.kind, family.n, 1));
  }
}
