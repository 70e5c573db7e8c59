// What CGAL takes for the mesher's work on the same machine: the reference of our benchmarks.
//
//   cgal_reference [FILE] [--n N]... [--rho R]... [--edits K] [--seed S]
//
// FILE: a .node file, or a .poly file with points, between which its segments are constraints; then
// there are no edits. Without a file: N points uniform in the unit square (default 10000 and
// 100000). The meshed domain is a square around the points' bounding box, of side 6 times its
// longest side. Default rho is 1.4142135623730951, K is 1000 edits (0: none). Prints one JSON line
// per figure, times in process CPU seconds:
//   delaunay   the Delaunay triangulation of the points alone
//   mesh       Mesh_2 from the points: all steps after reading, and the vertices that result
//   insert     a random point put into that mesh, bad triangles around it refined (median, p99)
//   remove     the same points taken out in another order, bad triangles refined (median, p99);
//              Steiner points stay, see `vertices_after`
#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_mesh_face_base_2.h>
#include <CGAL/Delaunay_mesh_size_criteria_2.h>
#include <CGAL/Delaunay_mesher_2.h>
#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <cstdint>
#include <ctime>
#include <iostream>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "node_file.hpp"

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_2;
using VertexBase = CGAL::Triangulation_vertex_base_2<Kernel>;
using FaceBase = CGAL::Delaunay_mesh_face_base_2<Kernel>;
using Mesh = CGAL::Constrained_Delaunay_triangulation_2<
    Kernel, CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>>;
using Criteria = CGAL::Delaunay_mesh_size_criteria_2<Mesh>;
using Mesher = CGAL::Delaunay_mesher_2<Mesh, Criteria>;

struct Settings {
  std::string file;
  std::vector<std::size_t> sizes;
  std::vector<double> rhos;
  std::size_t edits = 1000;
  std::uint64_t seed = 1;
};

struct Input {
  std::string name;
  std::vector<Point> points;
  std::vector<std::pair<std::size_t, std::size_t>> segments = {};  // positions in points
};

/// Process CPU time, to the nanosecond (std::clock is too coarse for one edit).
double cpu_seconds() {
  std::timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

template <class Work>
double time_of(Work work) {
  const double start = cpu_seconds();
  work();
  return cpu_seconds() - start;
}

double quantile(std::vector<double> values, double q) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(q * static_cast<double>(values.size() - 1))];
}

/// A quality mesh that can be edited in Mesh_2's way.
class EditableMesh {
 public:
  /// The bound on squared sines is (1 / (2 rho))^2.
  EditableMesh(const Input& input, double rho)
      : criteria_(1 / (4 * rho * rho), 0), mesher_(mesh_, criteria_) {
    mesh_.insert(input.points.begin(), input.points.end());
    for (const auto& [a, b] : input.segments) {
      mesh_.insert_constraint(input.points[a], input.points[b]);
    }
    add_box(input.points);
    mesher_.refine_mesh();
  }

  std::size_t size() const { return mesh_.number_of_vertices(); }

  Mesh::Vertex_handle insert(const Point& point) {
    const Mesh::Vertex_handle vertex = mesh_.insert(point);
    refine_around({vertex});
    return vertex;
  }

  void remove(Mesh::Vertex_handle vertex) {
    std::vector<Mesh::Vertex_handle> ring;
    Mesh::Vertex_circulator next = mesh_.incident_vertices(vertex), first = next;
    do {
      ring.push_back(next);
    } while (++next != first);
    mesh_.remove(vertex);
    refine_around(ring);
  }

 private:
  void add_box(const std::vector<Point>& points) {
    const CGAL::Bbox_2 box = CGAL::bbox_2(points.begin(), points.end());
    const double half = 3 * std::max(box.xmax() - box.xmin(), box.ymax() - box.ymin());
    const double x = (box.xmin() + box.xmax()) / 2;
    const double y = (box.ymin() + box.ymax()) / 2;
    const Point corners[] = {
        {x - half, y - half}, {x + half, y - half}, {x + half, y + half}, {x - half, y + half}};
    for (int i = 0; i < 4; ++i) mesh_.insert_constraint(corners[i], corners[(i + 1) % 4]);
  }

  /// Refines what is bad around vertices whose triangles are new.
  void refine_around(const std::vector<Mesh::Vertex_handle>& vertices) {
    std::vector<Mesh::Face_handle> bad;
    for (const Mesh::Vertex_handle vertex : vertices) {
      Mesh::Face_circulator face = mesh_.incident_faces(vertex), first = face;
      do {
        if (mesh_.is_infinite(face)) continue;
        face->set_in_domain(true);
        if (is_bad(face)) bad.push_back(face);
      } while (++face != first);
    }
    std::sort(bad.begin(), bad.end());
    bad.erase(std::unique(bad.begin(), bad.end()), bad.end());
    mesher_.set_bad_faces(bad.begin(), bad.end());
    while (!mesher_.is_refinement_done()) mesher_.step_by_step_refine_mesh();
  }

  bool is_bad(Mesh::Face_handle face) const {
    Criteria::Quality quality;
    return criteria_.is_bad_object()(face, quality) != CGAL::Mesh_2::NOT_BAD;
  }

  Mesh mesh_;
  Criteria criteria_;
  Mesher mesher_;
};

class Line {
 public:
  Line(const char* figure, const Input& input) {
    std::cout << R"({"bench":"cgal_reference","figure":")" << figure << R"(","input":")"
              << input.name << R"(","n":)" << input.points.size();
  }
  ~Line() { std::cout << '}' << std::endl; }
  template <class Value>
  Line& field(const char* name, const Value& value) {
    std::cout << ",\"" << name << "\":" << value;
    return *this;
  }
};

void bench_delaunay(const Input& input) {
  CGAL::Delaunay_triangulation_2<Kernel> triangulation;
  const double seconds =
      time_of([&] { triangulation.insert(input.points.begin(), input.points.end()); });
  Line("delaunay", input).field("seconds", seconds);
}

void bench_edits(const Input& input, double rho, const Settings& settings, EditableMesh& mesh) {
  const CGAL::Bbox_2 box = CGAL::bbox_2(input.points.begin(), input.points.end());
  std::mt19937_64 random(settings.seed + 1);  // not the stream of the input
  std::uniform_real_distribution<double> x(box.xmin(), box.xmax()), y(box.ymin(), box.ymax());
  std::vector<double> times;
  std::vector<Mesh::Vertex_handle> inserted;
  const auto report = [&](const char* figure) {
    Line(figure, input)
        .field("rho", rho)
        .field("edits", times.size())
        .field("seconds_median", quantile(times, 0.5))
        .field("seconds_p99", quantile(times, 0.99))
        .field("vertices_after", mesh.size());
    times.clear();
  };
  for (std::size_t i = 0; i < settings.edits; ++i) {
    const double px = x(random);
    const Point point(px, y(random));
    times.push_back(time_of([&] { inserted.push_back(mesh.insert(point)); }));
  }
  report("insert");
  std::shuffle(inserted.begin(), inserted.end(), random);
  for (const Mesh::Vertex_handle vertex : inserted)
    times.push_back(time_of([&] { mesh.remove(vertex); }));
  report("remove");
}

void bench_input(const Input& input, const Settings& settings) {
  if (input.points.size() < 2) throw std::runtime_error(input.name + ": fewer than two points");
  bench_delaunay(input);
  for (const double rho : settings.rhos) {
    const double start = cpu_seconds();
    EditableMesh mesh(input, rho);
    const double seconds = cpu_seconds() - start;
    Line("mesh", input).field("rho", rho).field("vertices", mesh.size()).field("seconds", seconds);
    if (settings.edits > 0 && input.segments.empty()) bench_edits(input, rho, settings, mesh);
  }
}

Input uniform_input(std::size_t n, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  Input input{"uniform", {}, {}};
  for (std::size_t i = 0; i < n; ++i) {
    const double x = unit(random);
    input.points.emplace_back(x, unit(random));
  }
  return input;
}

Input file_input(const std::string& path) {
  Input input{path.substr(path.rfind('/') + 1), {}, {}};
  oracle::TokenLines lines(path);
  const auto places = oracle::read_places<2>(lines);
  for (const auto& [x, y] : places.items) input.points.emplace_back(x, y);
  if (path.size() < 5 || path.substr(path.size() - 5) != ".poly") return input;
  std::unordered_map<long, std::size_t> position;
  for (std::size_t i = 0; i < places.ids.size(); ++i) position[places.ids[i]] = i;
  const auto count = lines.parse<std::size_t>(lines.next(1)[0]);
  for (std::size_t i = 0; i < count; ++i) {
    const auto tokens = lines.next(3);
    input.segments.emplace_back(position.at(lines.parse<long>(tokens[1])),
                                position.at(lines.parse<long>(tokens[2])));
  }
  return input;
}

Settings parse(int argc, char** argv) {
  Settings settings;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word.rfind("--", 0) != 0) {
      settings.file = word;
      continue;
    }
    if (i + 1 == argc) throw std::runtime_error(word + " needs a value");
    const std::string value = argv[++i];
    if (word == "--n")
      settings.sizes.push_back(std::stoull(value));
    else if (word == "--rho")
      settings.rhos.push_back(std::stod(value));
    else if (word == "--edits")
      settings.edits = std::stoull(value);
    else if (word == "--seed")
      settings.seed = std::stoull(value);
    else
      throw std::runtime_error("unknown option " + word);
  }
  if (settings.rhos.empty()) settings.rhos = {1.4142135623730951};
  if (settings.sizes.empty()) settings.sizes = {10000, 100000};
  return settings;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const Settings settings = parse(argc, argv);
    if (!settings.file.empty()) {
      bench_input(file_input(settings.file), settings);
    } else {
      for (const std::size_t n : settings.sizes)
        bench_input(uniform_input(n, settings.seed), settings);
    }
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "cgal_reference: " << error.what() << '\n';
    return 2;
  }
}
