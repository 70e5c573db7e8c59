// Static meshes of points in space at rho = 2: how many vertices, how long, beside TetGen.
//
//   space_bench [FILE.node]...   default: families of points, see kFamilies
//
// One JSON line an input: vertices and seconds of the process for mesh_statically; over_model: the
// vertices over those of a model of the same rule, where these are known; and, where the Debian
// package tetgen (1.5) is installed, TetGen's vertices, and the seconds that it says it ran,
// without files, of the same points in a box six times as wide; over_tetgen: our seconds over
// these. Its options are -pq2.0O0/0NEF: with others it leaves tetrahedra above its own bound.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "mesher/generate.hpp"
#include "mesher/io.hpp"
#include "mesher/mesher.hpp"
#include "sample.hpp"

namespace {

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

// n points at distances 1 to 10^-12 from a corner of the unit cube, evenly by their logarithm.
std::vector<Point<3>> spread(std::size_t n) {
  mesher::SplitMix64 random(1);
  std::vector<Point<3>> points(n);
  for (auto& p : points) {
    const double r = std::pow(10, -12 * random.unit());
    for (double& x : p) x = r * random.unit();
  }
  return points;
}

struct Figures {
  std::size_t vertices = 0;
  double seconds = 0;
};

class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "space_bench.XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no folder for TetGen's input");
    path_ = name;
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }
  [[nodiscard]] std::string file(const char* name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
};

// The points and a box around them, as TetGen reads it.
void write_boxed(const std::vector<Point<3>>& points, const std::string& path) {
  const auto domain = mesher::snapped_domain<3>(points);
  double side = 0;
  for (std::size_t i = 0; i < 3; ++i) side = std::max(side, domain.hi[i] - domain.lo[i]);
  mesher::OutputFiles files;
  auto& file = files.open(path);
  file << points.size() + 8 << " 3 0 0\n";
  std::size_t id = 0;
  for (const auto& p : points) file << ++id << ' ' << p[0] << ' ' << p[1] << ' ' << p[2] << '\n';
  const std::size_t first = id + 1;
  for (int corner = 0; corner < 8; ++corner) {
    file << ++id;
    for (std::size_t i = 0; i < 3; ++i) {
      const double middle = (domain.lo[i] + domain.hi[i]) / 2;
      file << ' ' << ((corner >> i & 1) != 0 ? middle + 3 * side : middle - 3 * side);
    }
    file << '\n';
  }
  file << "6 0\n";
  for (const auto& [a, b, c, d] : std::vector<std::array<std::size_t, 4>>{
           {0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}}) {
    file << "1\n4 " << first + a << ' ' << first + b << ' ' << first + c << ' ' << first + d
         << '\n';
  }
  file << "0\n";
  files.commit();
}

// What follows `label` in a line of what TetGen says.
std::optional<double> said(const std::string& text, const std::string& label) {
  const auto at = text.find(label);
  if (at == std::string::npos) return std::nullopt;
  return std::strtod(text.c_str() + at + label.size(), nullptr);
}

// Nothing if TetGen does not run, or does not end well.
std::optional<Figures> run_tetgen(const std::vector<Point<3>>& points) {
  const TemporaryFolder folder;
  write_boxed(points, folder.file("points.poly"));
  const std::string command = "tetgen -pq2.0O0/0NEF " + folder.file("points.poly") + " 2>&1";
  std::FILE* const pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return std::nullopt;
  std::string text;
  for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) text += static_cast<char>(c);
  if (pclose(pipe) != 0) return std::nullopt;
  const auto vertices = said(text, "Mesh points:"), seconds = said(text, "Total running seconds:");
  if (!vertices || !seconds) return std::nullopt;
  return Figures{static_cast<std::size_t>(*vertices), *seconds};
}

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
  if (const auto tetgen = run_tetgen(points)) {
    std::printf(",\"tetgen_vertices\":%zu,\"tetgen_seconds\":%.3f,\"over_tetgen\":%.2f",
                tetgen->vertices, tetgen->seconds, ours.seconds / tetgen->seconds);
  }
  std::printf("}\n");
  std::fflush(stdout);
}

bool has_tetgen() { return std::system("command -v tetgen >/dev/null") == 0; }

}  // namespace

int main(int argc, char** argv) {
  if (!has_tetgen()) std::fprintf(stderr, "space_bench: tetgen is not installed: without it\n");
  for (int i = 1; i < argc; ++i) {
    bench_points(std::filesystem::path(argv[i]).stem().string(),
                 mesher::read_points<3>(argv[i]).points);
  }
  if (argc > 1) return 0;
  for (const Family& family : kFamilies) {
    bench_points(family.name, mesher::generate_points<3>(family.kind, family.n, 1), family.model);
  }
  bench_points("spread 2000", spread(2000));
}
