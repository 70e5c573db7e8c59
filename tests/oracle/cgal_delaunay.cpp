// CGAL's Delaunay triangulation of the points of a file: the reference of delaunay_bench.
//
//   cgal_delaunay D FILE [EDITS]
//
// FILE: coordinates as doubles, D = 2 or 3 a point. Prints simplices, seconds of the process,
// megabytes that the peak of memory rose, and microseconds of inserting a random point and of
// removing it again (0 without EDITS). The triangulation is the plain one for the bulk; edits go to
// one that locates points fast (CGAL's hierarchy).
#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_hierarchy_2.h>
#include <sys/resource.h>

#include <array>
#include <cstdint>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

struct Plane {
  static constexpr std::size_t kDimension = 2;
  using Point = Kernel::Point_2;
  using Bulk = CGAL::Delaunay_triangulation_2<Kernel>;
  using Vertices = CGAL::Triangulation_data_structure_2<
      CGAL::Triangulation_hierarchy_vertex_base_2<CGAL::Triangulation_vertex_base_2<Kernel>>>;
  using Edited = CGAL::Triangulation_hierarchy_2<CGAL::Delaunay_triangulation_2<Kernel, Vertices>>;
  static Point point(const std::array<double, 2>& p) { return {p[0], p[1]}; }
  static std::size_t simplices(const Bulk& t) { return t.number_of_faces(); }
};
struct Space {
  static constexpr std::size_t kDimension = 3;
  using Point = Kernel::Point_3;
  using Bulk = CGAL::Delaunay_triangulation_3<Kernel>;
  using Edited = CGAL::Delaunay_triangulation_3<Kernel, CGAL::Fast_location>;
  static Point point(const std::array<double, 3>& p) { return {p[0], p[1], p[2]}; }
  static std::size_t simplices(const Bulk& t) { return t.number_of_finite_cells(); }
};

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

double peak_megabytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

// splitmix64
class Random {
 public:
  std::uint64_t bits() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return z ^ (z >> 31);
  }
  double unit() { return static_cast<double>(bits() >> 11) * 0x1p-53; }

 private:
  std::uint64_t state_ = 1;
};

template <class D>
std::vector<typename D::Point> read(const char* path,
                                    std::array<std::array<double, D::kDimension>, 2>& box) {
  std::ifstream file(path, std::ios::binary);
  std::vector<typename D::Point> points;
  std::array<double, D::kDimension> p;
  while (file.read(reinterpret_cast<char*>(p.data()), sizeof p)) {
    if (points.empty()) box = {p, p};
    for (std::size_t i = 0; i < p.size(); ++i) {
      box[0][i] = std::min(box[0][i], p[i]);
      box[1][i] = std::max(box[1][i], p[i]);
    }
    points.push_back(D::point(p));
  }
  points.shrink_to_fit();
  return points;
}

template <class D>
void run(const char* path, std::size_t edits) {
  std::array<std::array<double, D::kDimension>, 2> box{};
  const auto points = read<D>(path, box);
  const double before = peak_megabytes(), start = cpu_seconds();
  std::size_t simplices = 0;
  double seconds = 0, megabytes = 0, inserting = 0, removing = 0;
  {
    const typename D::Bulk t(points.begin(), points.end());
    seconds = cpu_seconds() - start;
    megabytes = peak_megabytes() - before;
    simplices = D::simplices(t);
  }
  if (edits != 0) {
    typename D::Edited t(points.begin(), points.end());
    Random random;
    std::vector<typename D::Point> places;
    for (std::size_t k = 0; k < edits; ++k) {
      std::array<double, D::kDimension> p;
      for (std::size_t i = 0; i < p.size(); ++i) {
        p[i] = box[0][i] + random.unit() * (box[1][i] - box[0][i]);
      }
      places.push_back(D::point(p));
    }
    std::vector<typename D::Edited::Vertex_handle> vertices;
    inserting = -cpu_seconds();
    for (const auto& p : places) vertices.push_back(t.insert(p));
    inserting += cpu_seconds();
    for (std::size_t i = edits; i > 1; --i) std::swap(vertices[i - 1], vertices[random.bits() % i]);
    removing = -cpu_seconds();
    for (const auto v : vertices) t.remove(v);
    removing += cpu_seconds();
  }
  const double per_edit = edits == 0 ? 0 : 1e6 / static_cast<double>(edits);
  std::cout << simplices << ' ' << seconds << ' ' << megabytes << ' ' << per_edit * inserting << ' '
            << per_edit * removing << '\n';
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) return 2;
  const std::size_t edits = argc > 3 ? std::strtoul(argv[3], nullptr, 10) : 0;
  std::string(argv[1]) == "2" ? run<Plane>(argv[2], edits) : run<Space>(argv[2], edits);
}
