// TetGen on points in a box and on complexes, as a program of its own: vertices and seconds to
// compare with.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "mesher/extra/generate.hpp"
#include "mesher/graph.hpp"
#include "mesher/mesh.hpp"
#include "mesher/write.hpp"

namespace bench {

using mesher::Point;

/// n points at distances 1 to 10^-12 from a corner of the unit cube, evenly by their logarithm.
inline std::vector<Point<3>> spread(std::size_t n) {
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
    std::string name = (std::filesystem::temp_directory_path() / "mesher_bench.XXXXXX").string();
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

/// The points and a box around them, as TetGen reads it.
inline void write_boxed(const std::vector<Point<3>>& points, const std::string& path) {
  const auto domain = mesher::snapped_domain<3>(points);
  double side = 0;
  for (std::size_t i = 0; i < 3; ++i) side = std::max(side, domain.hi[i] - domain.lo[i]);
  mesher::OutputFiles files;
  auto& file = files.open(path);
  std::vector<Point<3>> all = points;
  for (int corner = 0; corner < 8; ++corner) {
    Point<3> p;
    for (std::size_t i = 0; i < 3; ++i) {
      const double middle = (domain.lo[i] + domain.hi[i]) / 2;
      p[i] = (corner >> i & 1) != 0 ? middle + 3 * side : middle - 3 * side;
    }
    all.push_back(p);
  }
  mesher::write_points<3>(all, file);
  const std::size_t first = points.size() + 1;
  file << "6 0\n";
  for (const auto& [a, b, c, d] : std::vector<std::array<std::size_t, 4>>{
           {0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}}) {
    file << "1\n4 " << first + a << ' ' << first + b << ' ' << first + c << ' ' << first + d
         << '\n';
  }
  file << "0\n";
  files.commit();
}

/// What follows `label` in a line of what TetGen says.
inline std::optional<double> said(const std::string& text, const std::string& label) {
  const auto at = text.find(label);
  if (at == std::string::npos) return std::nullopt;
  return std::strtod(text.c_str() + at + label.size(), nullptr);
}

/// A file. Its options are -pq2.0O0/0NEF: with others it leaves tetrahedra above its own bound; no
/// files. `more`: options as well. Nothing if it does not run, or does not end well, or not in a
/// minute.
inline std::optional<Figures> run_tetgen(const std::string& path, const std::string& more = "") {
  const std::string command = "timeout 60 tetgen -pq2.0O0/0NEF" + more + ' ' + path + " 2>&1";
  std::FILE* const pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return std::nullopt;
  std::string text;
  for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) text += static_cast<char>(c);
  if (pclose(pipe) != 0) return std::nullopt;
  const auto vertices = said(text, "Mesh points:"), seconds = said(text, "Total running seconds:");
  if (!vertices || !seconds) return std::nullopt;
  return Figures{static_cast<std::size_t>(*vertices), *seconds};
}

/// The points in a box six times as wide.
inline std::optional<Figures> run_tetgen(const std::vector<Point<3>>& points) {
  const TemporaryFolder folder;
  write_boxed(points, folder.file("points.poly"));
  return run_tetgen(folder.file("points.poly"));
}

/// What the polygons enclose.
inline std::optional<Figures> run_tetgen(const mesher::Graph<3>& plc,
                                         const std::string& more = "") {
  const TemporaryFolder folder;
  mesher::write_graph(plc, folder.file("complex.poly"));
  return run_tetgen(folder.file("complex.poly"), more);
}

inline bool has_tetgen() { return std::system("command -v tetgen >/dev/null") == 0; }

}  // namespace bench
