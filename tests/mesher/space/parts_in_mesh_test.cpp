// Which edges and faces of a mesh are parts of segments and polygons, from the mesh alone.
#include "space/parts_in_mesh.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <set>

#include "any_id.hpp"
#include "facade/box_mesher.hpp"
#include "facade/graph_runs.hpp"
#include "geometry/space_vectors.hpp"
#include "mesher/extra/generate.hpp"
#include "mesher/meshing.hpp"
#include "plc_families.hpp"

namespace {

using mesher::Feature;
using mesher::Graph;
using mesher::LineId;
using mesher::Mesh;
using mesher::Options;
using mesher::Point;
using mesher::PointId;
using mesher::PolygonId;
using support::Complex;

AnyId id(std::size_t i) { return AnyId{static_cast<std::int64_t>(i)}; }

// Segments are numbered from 1, polygons from 1001.
Graph<3> plc_of(const Complex& complex) {
  Graph<3> plc;
  for (std::size_t i = 0; i < complex.points.size(); ++i) {
    plc.points.push_back({id(i + 1), complex.points[i], 0});
  }
  for (std::size_t i = 0; i < complex.segments.size(); ++i) {
    const auto [a, b] = complex.segments[i];
    plc.segments.push_back({id(i + 1), id(a + 1), id(b + 1), 0});
  }
  for (std::size_t i = 0; i < complex.faces.size(); ++i) {
    mesher::Polygon polygon{id(i + 1001), {}};
    for (const auto& loop : complex.faces[i].loops) {
      auto& ids = polygon.loops.emplace_back();
      for (const std::size_t p : loop) ids.push_back(id(p + 1));
    }
    for (const std::size_t p : complex.faces[i].on) polygon.points.push_back(id(p + 1));
    plc.polygons.push_back(std::move(polygon));
  }
  return plc;
}

double area(const std::vector<Point<3>>& loop) {
  using namespace mesher::detail;
  Point<3> sum{};
  for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
    sum = plus(sum, cross(minus(loop[i], loop[0]), minus(loop[i + 1], loop[0])));
  }
  return std::sqrt(squared(sum)) / 2;
}

struct Reference {
  std::map<PointId, Point<3>> places;
  explicit Reference(const Graph<3>& plc) {
    for (const auto& p : plc.points) places[p.id] = p.at;
  }
  double area_of(const mesher::Polygon& polygon) const {
    double sum = 0;
    for (std::size_t l = 0; l < polygon.loops.size(); ++l) {
      std::vector<Point<3>> loop;
      for (const PointId p : polygon.loops[l]) loop.push_back(places.at(p));
      sum += l == 0 ? area(loop) : -area(loop);
    }
    return sum;
  }
  double length(PointId a, PointId b) const {
    return std::sqrt(mesher::detail::squared_distance(places.at(a), places.at(b)));
  }
};

using Ends = std::array<std::uint32_t, 2>;

// The lengths of lines' edges and the areas of polygons' faces are those of the complex, faces of a
// polygon meet in pairs but on its border, and all are parts of tetrahedra.
void require_parts(const Mesh<3>& mesh, const Graph<3>& plc) {
  const Reference reference(plc);
  std::set<Ends> edges;
  std::set<std::array<std::uint32_t, 3>> faces;
  for (auto s : mesh.simplices) {
    std::sort(s.begin(), s.end());
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t k = i + 1; k < 4; ++k) edges.insert({s[i], s[k]});
    }
    faces.insert({{s[0], s[1], s[2]}, {s[0], s[1], s[3]}, {s[0], s[2], s[3]}, {s[1], s[2], s[3]}});
  }
  std::map<LineId, double> lengths;
  std::map<PolygonId, double> areas;
  std::set<Ends> on_edges;
  for (const auto& e : mesh.edges) {
    REQUIRE(edges.count({e.low, e.high}) == 1);
    REQUIRE(on_edges.insert({e.low, e.high}).second);
    const double length =
        std::sqrt(mesher::detail::squared_distance(mesh.vertices[e.low], mesh.vertices[e.high]));
    if (const auto line = e.feature.line()) lengths[*line] += length;
  }
  std::map<std::pair<PolygonId, Ends>, int> sides;
  for (const auto& f : mesh.faces) {
    const auto [a, b, c] = f.corners;
    REQUIRE(faces.count(f.corners) == 1);
    areas[f.polygon] += area({mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]});
    for (const Ends& e : {Ends{a, b}, Ends{a, c}, Ends{b, c}}) ++sides[{f.polygon, e}];
  }
  for (const auto& [side, count] : sides) {
    if (count != 2) CHECK((count == 1 && on_edges.count(side.second) == 1));
  }
  for (const auto& s : plc.segments) {
    CHECK(lengths[s.id] == Approx(reference.length(s.from, s.to)).epsilon(1e-12));
  }
  CHECK(lengths.size() == plc.segments.size());
  for (const auto& f : plc.polygons) {
    CHECK(areas[f.id] == Approx(reference.area_of(f)).epsilon(1e-11));
  }
  CHECK(areas.size() == plc.polygons.size());
}

Options<3> options_for(const Graph<3>& plc) {
  return {.domain = mesher::snapped_domain<3>(places_of(plc)), .max_vertices = 100000};
}

}  // namespace

TEST_CASE("edges add up to their segments, faces to their polygons, along axes and across") {
  constexpr std::pair<const char*, double> kFamilies[] = {
      {"cube", 0},  {"cubepoly", 0}, {"dumbbell", 0}, {"nested", 0.1},  {"lhole", 0},
      {"wedge", 5}, {"fan", 8},      {"vee", 5},      {"plates", 0.1},  {"skew", 1e-3},
      {"spike", 5}, {"segfac", 5},   {"tet", 0.01},   {"cloudbox", 100}};
  for (const auto& [name, parameter] : kFamilies) {
    for (const bool is_turned : {false, true}) {
      INFO(name << ' ' << parameter << (is_turned ? ", turned" : ""));
      Complex complex = support::complex_of(name, parameter);
      if (is_turned) complex = turned(std::move(complex));
      const Graph<3> plc = plc_of(complex);
      require_parts(mesh_statically(plc, options_for(plc)), plc);
    }
  }
}

TEST_CASE("so do those that a mesher tells of, which are the static run's") {
  for (const auto kind : {mesher::PlcKind::island, mesher::PlcKind::tee, mesher::PlcKind::pump}) {
    const Graph<3> plc = mesher::generate_plc({kind});
    const Options<3> options = options_for(plc);
    mesher::BoxMesher<3> m(options);
    announce(plc, m);
    m.update();
    const Mesh<3> mesh = m.mesh();
    CHECK(mesh == mesh_statically(plc, options));
    CHECK(!mesh.faces.empty());
    for (const auto& f : plc.polygons) {
      CHECK(std::count_if(mesh.faces.begin(), mesh.faces.end(),
                          [&](const auto& x) { return x.polygon == f.id; }) > 0);
    }
  }
}

TEST_CASE("an edge is called by its segment, else by the least polygon that has it") {
  Graph<3> plc;
  const Point<3> places[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (std::size_t i = 0; i < 4; ++i) plc.points.push_back({id(i + 1), places[i], 0});
  plc.polygons.push_back({id(7), {{id(1), id(2), id(3)}}});
  plc.polygons.push_back({id(3), {{id(1), id(2), id(4)}}});
  plc.segments.push_back({id(9), id(3), id(1), 0});
  const Options<3> options{.domain = {{0, 0, 0}, {1, 1, 1}}};
  const auto names = [&] {
    const Mesh<3> mesh = mesh_statically(plc, options);
    std::map<Point<3>, Feature> by_middle;
    for (const auto& e : mesh.edges) {
      const auto sum = mesher::detail::plus(mesh.vertices[e.low], mesh.vertices[e.high]);
      by_middle[mesher::detail::scaled(0.5, sum)] = e.feature;
    }
    return by_middle;
  };
  const auto all = names();
  for (const auto& [p, name] : all) {
    INFO(p[0] << ' ' << p[1] << ' ' << p[2]);
    const bool on_x = p[1] == 0 && p[2] == 0, on_y = p[0] == 0 && p[2] == 0;
    const bool of_7 = p[2] == 0 && !on_x && !on_y;
    CHECK(name == (on_y ? Feature(LineId{9}) : PolygonId{of_7 ? 7 : 3}));
  }
  CHECK(!all.empty());
}
