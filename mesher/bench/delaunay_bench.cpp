// Delaunay triangulations alone: how long, how much memory, beside CGAL's.
//
//   delaunay_bench [FILE.node]...    default: families of points, see kFamilies; a file's
//                                    dimension is its own
//   delaunay_bench --one D FILE [EDITS]    one run, points read from FILE as doubles; for itself
//
// Both triangulate the same points in processes of their own, in turns; of kRounds runs the
// quickest counts. One JSON line an input: simplices; seconds of the process from points in memory
// to simplices and neighbours in memory (CGAL: to a triangulation); megabytes that the peak of
// memory rose meanwhile. Where the bench cgal_delaunay was built (it needs CGAL), its figures, and
// ours over them. edit_us: microseconds of inserting random points into the box of the triangulated
// ones, n/50 or at least 1000, and of removing these again, in another order; the first insertion
// makes the grids by which places are found. CGAL's part is
// tests/oracle/cgal_delaunay.cpp.
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <span>
#include <sstream>
#include <string>
#include <vector>

#include "bench_help.hpp"
#include "io/point_file.hpp"
#include "mesher/delaunay.hpp"
#include "mesher/extra/generate.hpp"
#include "mesher/read.hpp"
#include "sample.hpp"

namespace {

using mesher::Point;
using mesher::PointKind;

constexpr int kRounds = 3;

struct Family {
  const char* name;
  int dimension;
  PointKind kind;
  std::size_t n;
};
constexpr Family kFamilies[] = {
    {"2D uniform 100000", 2, PointKind::uniform, 100000},
    {"2D uniform 1000000", 2, PointKind::uniform, 1000000},
    {"2D clusters 1000000", 2, PointKind::clusters, 1000000},
    {"2D grid 1000000", 2, PointKind::grid, 1000000},
    {"3D uniform 100000", 3, PointKind::uniform, 100000},
    {"3D uniform 1000000", 3, PointKind::uniform, 1000000},
    {"3D gaussian 100000", 3, PointKind::gaussian, 100000},
    {"3D grid 1000000", 3, PointKind::grid, 1000000},
    {"3D line-circle 2000", 3, PointKind::line_circle, 2000},
};

struct Figures {
  std::size_t simplices = 0;
  double seconds = 0, megabytes = 0, insert_us = 0, remove_us = 0;
};

double peak_megabytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

// ---- one run ----

template <int D>
std::vector<Point<D>> read_raw(const std::string& path) {
  std::vector<Point<D>> points(std::filesystem::file_size(path) / sizeof(Point<D>));
  std::ifstream file(path, std::ios::binary);
  file.read(reinterpret_cast<char*>(points.data()),
            static_cast<std::streamsize>(points.size() * sizeof(Point<D>)));
  if (!file) throw std::runtime_error("cannot read " + path);
  return points;
}

template <int D>
void time_edits(const std::vector<Point<D>>& points, std::size_t edits, Figures& figures) {
  mesher::DynamicDelaunay<D> t{std::span<const Point<D>>(points)};
  mesher::Box<D> box{points.front(), points.front()};
  for (const auto& p : points) {
    for (std::size_t i = 0; i < D; ++i) {
      box.lo[i] = std::min(box.lo[i], p[i]);
      box.hi[i] = std::max(box.hi[i], p[i]);
    }
  }
  mesher::SplitMix64 random(1);
  std::vector<Point<D>> places(edits);
  for (auto& p : places) {
    for (std::size_t i = 0; i < D; ++i) p[i] = box.lo[i] + random.unit() * (box.hi[i] - box.lo[i]);
  }
  std::vector<std::uint32_t> vertices;
  const double inserting = bench::seconds_of([&] {
    for (const auto& p : places) vertices.push_back(t.insert(p).vertex);
  });
  for (std::size_t i = vertices.size(); i > 1; --i) {
    std::swap(vertices[i - 1], vertices[random.below(i)]);
  }
  const double removing = bench::seconds_of([&] {
    for (const std::uint32_t v : vertices) t.remove(v);
  });
  figures.insert_us = 1e6 * inserting / static_cast<double>(edits);
  figures.remove_us = 1e6 * removing / static_cast<double>(edits);
}

template <int D>
void run_one(const std::string& path, std::size_t edits) {
  const std::vector<Point<D>> points = read_raw<D>(path);
  const double before = peak_megabytes();
  Figures f;
  mesher::Delaunay<D> t;
  f.seconds = bench::seconds_of([&] { t = mesher::delaunay<D>(points); });
  f.megabytes = peak_megabytes() - before;
  f.simplices = t.simplices.size();
  t = {};
  if (edits != 0) time_edits<D>(points, edits, f);
  std::printf("%zu %.6f %.2f %.3f %.3f\n", f.simplices, f.seconds, f.megabytes, f.insert_us,
              f.remove_us);
}

// ---- the comparison ----

class RawFile {
 public:
  template <std::size_t D>
  explicit RawFile(const std::vector<std::array<double, D>>& points) {
    std::string name = (std::filesystem::temp_directory_path() / "delaunay_bench.XXXXXX").string();
    const int file = mkstemp(name.data());
    if (file < 0) throw std::runtime_error("no file for the points");
    path_ = name;
    std::FILE* const out = fdopen(file, "wb");
    std::fwrite(points.data(), sizeof points[0], points.size(), out);
    std::fclose(out);
  }
  RawFile(const RawFile&) = delete;
  RawFile& operator=(const RawFile&) = delete;
  ~RawFile() { std::filesystem::remove(path_); }
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  std::string path_;
};

// What a program prints: nothing if it does not run, or does not end well.
std::optional<Figures> run(const std::string& command) {
  std::FILE* const pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return std::nullopt;
  std::string text;
  for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) text += static_cast<char>(c);
  if (pclose(pipe) != 0) return std::nullopt;
  Figures f;
  std::istringstream words(text);
  words >> f.simplices >> f.seconds >> f.megabytes >> f.insert_us >> f.remove_us;
  return words ? std::optional(f) : std::nullopt;
}

// The less of each figure.
void keep_least(std::optional<Figures>& best, const std::optional<Figures>& f) {
  if (!best || !f) {
    best = f;
    return;
  }
  for (double Figures::*figure :
       {&Figures::seconds, &Figures::megabytes, &Figures::insert_us, &Figures::remove_us}) {
    *best.*figure = std::min(*best.*figure, *f.*figure);
  }
}

void print(const char* who, const Figures& f) {
  std::printf(
      ",\"%ssimplices\":%zu,\"%sseconds\":%.3f,\"%smegabytes\":%.1f,\"%sedit_us\":[%.2f,%.2f]", who,
      f.simplices, who, f.seconds, who, f.megabytes, who, f.insert_us, f.remove_us);
}

template <int D>
void compare(const std::string& name, const std::vector<Point<D>>& points,
             const std::filesystem::path& self) {
  const RawFile file(points);
  const std::size_t edits = std::max<std::size_t>(1000, points.size() / 50);
  const std::string arguments =
      ' ' + std::to_string(D) + ' ' + file.path() + ' ' + std::to_string(edits);
  const auto peer = self.parent_path() / "cgal_delaunay";
  const bool has_peer = std::filesystem::exists(peer);
  std::optional<Figures> ours, cgal;
  for (int round = 0; round < kRounds; ++round) {
    const auto mine = run(self.string() + " --one" + arguments);
    if (!mine) throw std::runtime_error("a run failed: " + name);
    keep_least(ours, mine);
    const auto theirs = has_peer ? run(peer.string() + arguments) : std::nullopt;
    if (round == 0) cgal = theirs;
    keep_least(cgal, theirs);
  }
  std::printf("{\"bench\":\"delaunay\",\"input\":\"%s\",\"n\":%zu", name.c_str(), points.size());
  print("", *ours);
  if (cgal) {
    print("cgal_", *cgal);
    std::printf(
        ",\"time_over_cgal\":%.3f,\"memory_over_cgal\":%.3f,\"edits_over_cgal\":[%.2f,%.2f]",
        ours->seconds / cgal->seconds, ours->megabytes / cgal->megabytes,
        ours->insert_us / cgal->insert_us, ours->remove_us / cgal->remove_us);
  }
  std::printf("}\n");
  std::fflush(stdout);
}

void compare_file(const std::string& path, const std::filesystem::path& self) {
  const std::string name = std::filesystem::path(path).stem().string();
  if (mesher::dimension_of(path) == 2) {
    compare<2>(name, mesher::read_points<2>(path).points, self);
  } else {
    compare<3>(name, mesher::read_points<3>(path).points, self);
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (bench::shows_help(argc, argv)) return 0;
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  const std::filesystem::path self = std::filesystem::canonical(argv[0]);
  if (arguments.size() >= 3 && arguments[0] == "--one") {
    const std::size_t edits = arguments.size() > 3 ? std::stoul(arguments[3]) : 0;
    arguments[1] == "2" ? run_one<2>(arguments[2], edits) : run_one<3>(arguments[2], edits);
    return 0;
  }
  for (const std::string& path : arguments) compare_file(path, self);
  if (!arguments.empty()) return 0;
  for (const Family& f : kFamilies) {
    if (f.dimension == 2) {
      compare<2>(f.name, mesher::generate_points<2>(f.kind, f.n, 1), self);
    } else {
      compare<3>(f.name, mesher::generate_points<3>(f.kind, f.n, 1), self);
    }
  }
}
