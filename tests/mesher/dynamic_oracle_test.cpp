// After every edit the dynamic mesh is what a run from scratch gives, for every family of points.
#include <cstdlib>
#include <fstream>

#include "edit_sequence.hpp"
#include "mesher/read.hpp"
#include "mesher/write.hpp"
#include "scratch_file.hpp"

namespace {

using mesher::Mesh;
using mesher::Options;
using mesher::Rule;
using support::Family;
using support::PointSet;
using support::Sequence;

struct Setting {
  Rule rule;
  double rho;
};
constexpr Setting kSettings[] = {
    {Rule::radius_edge, 1.4142}, {Rule::radius_edge, 2.0},       {Rule::radius_edge, 1.15},
    {Rule::radius_edge, 1.1},    {Rule::voronoi_aspect, 1.4142}, {Rule::voronoi_aspect, 2.0},
    {Rule::voronoi_aspect, 1.2},
};

// Small rho and the paper's rule give larger meshes: fewer edits for the same time.
int edits(const Setting& s, int most) {
  return s.rho < 1.3 ? most / 4 : s.rule == Rule::voronoi_aspect ? most / 2 : most;
}

// Meshes written for the exact judge, one in `every`.
class Samples {
 public:
  Samples(int every, double rho) : every_(every), rho_(rho) {}

  void operator()(const Mesh<2>& mesh, const PointSet& points) {
    if (count_++ % every_ != 0) return;
    const std::string stem = "m" + std::to_string(batch_size_++);
    write_mesh(mesh, folder_.path(stem + ".node"));
    std::ofstream input(folder_.path(stem + ".input"));
    input << points.size() << " 2 0 0\n";
    input.precision(17);
    for (const auto& [id, p] : points) input << id << ' ' << p[0] << ' ' << p[1] << '\n';
    std::ofstream batch(folder_.path("batch"), std::ios::app);
    batch.precision(17);
    batch << folder_.path(stem + ".node") << ' ' << folder_.path(stem + ".ele") << " --input "
          << folder_.path(stem + ".input") << " --rho " << rho_ << '\n';
  }
  /// "" if the judge accepts all, else what it says.
  [[nodiscard]] std::string verdict() const {
    const std::string command = std::string(test_paths::kCgalCheck) + " --batch " +
                                folder_.path("batch") + " > " + folder_.path("verdict") + " 2>&1";
    if (std::system(command.c_str()) == 0) return "";
    std::string text;
    std::ifstream lines(folder_.path("verdict"));
    for (std::string line; std::getline(lines, line);) {
      if (!line.starts_with("ok")) text += line + "\n";
    }
    return text.empty() ? "the judge failed" : text;
  }

 private:
  support::ScratchFolder folder_;
  int every_;
  double rho_;
  int count_ = 0;
  int batch_size_ = 0;
};

void run(Family family, const Setting& setting, int n, int most, std::uint64_t seed, int judged) {
  Options<2> options;
  options.rule = setting.rule;
  options.rho = setting.rho;
  const Sequence sequence = random_sequence(family, options, n, edits(setting, most), seed);
  INFO(name(family) << ", rho " << setting.rho << ", rule " << static_cast<int>(setting.rule)
                    << ", seed " << seed);
  Samples samples(judged, setting.rho);
  const bool judge = *test_paths::kCgalCheck != 0 && judged > 0;
  support::Checks checks;
  if (judge) checks.each = [&](const auto& mesh, const auto& points) { samples(mesh, points); };
  CHECK(verdict(sequence, checks) == "");
  if (judge) CHECK(samples.verdict() == "");
}

}  // namespace

TEST_CASE(
    "after every edit the mesh, and the change that led to it, is that of a run from scratch") {
  for (const Family family : support::kFamilies) {
    for (const Setting& setting : kSettings) run(family, setting, 24, 120, 7, 6);
  }
}

TEST_CASE("soak: the same over many seeds", "[.soak][soak]") {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    for (const Family family : support::kFamilies) {
      for (const Setting& setting : kSettings) {
        run(family, setting, 5 + static_cast<int>(seed * 7 % 60), 300, seed, 25);
      }
    }
  }
}
