// The checker of meshes with lines, holes and regions speaks for each property that can be broken.
#include <catch2/catch.hpp>
#include <cmath>

#include "asked.hpp"
#include "facade/graph_runs.hpp"
#include "mesher/check.hpp"
#include "mesher/extra/generate.hpp"
#include "mesher/mesher.hpp"
#include "mesher/predicates.hpp"
#include "mesher/reports.hpp"

namespace {

using mesher::BoundaryRule;
using mesher::LineId;
using mesher::Mesh;
using mesher::MeshData;
using mesher::Point;
using mesher::PointId;
using mesher::VertexKind;
using mesher::predicates::orient2d;
using Asked = support::Asked<2>;

MeshData<2> mesh_of(std::vector<Point<2>> vertices, std::vector<Mesh<2>::Simplex> triangles) {
  MeshData<2> mesh;
  mesh.kinds.assign(vertices.size(), VertexKind::steiner);
  mesh.vertices = std::move(vertices);
  mesh.simplices = std::move(triangles);
  return mesh;
}

// The first property that does not hold and what is said of it, or "".
std::string trouble(const Mesh<2>& mesh, const Asked& options) {
  for (const auto& finding : mesher::check_mesh(mesh, options)) {
    if (!finding.holds) return finding.property + ": " + finding.detail;
  }
  return "";
}
std::string broken(const Mesh<2>& mesh, const Asked& options) {
  const std::string all = trouble(mesh, options);
  return all.substr(0, all.find(':'));
}

// A ring of eight triangles around the square (1,1) to (2,2), counted from 0:
//   12 13 14 15
//    8  9 10 11     with (1,1) to (2,2) left out
//    4  5  6  7
//    0  1  2  3
MeshData<2> plate(bool with_hole) {
  std::vector<Point<2>> vertices;
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 4; ++x) vertices.push_back({double(x), double(y)});
  }
  std::vector<Mesh<2>::Simplex> triangles;
  for (std::uint32_t y = 0; y < 3; ++y) {
    for (std::uint32_t x = 0; x < 3; ++x) {
      if (with_hole && x == 1 && y == 1) continue;
      const std::uint32_t a = 4 * y + x;
      triangles.push_back({a, a + 1, a + 5});
      triangles.push_back({a, a + 5, a + 4});
    }
  }
  return mesh_of(std::move(vertices), std::move(triangles));
}

mesher::GraphFile<2> square_in_square() {
  mesher::GraphFile<2> file;
  const std::vector<Point<2>> corners{{0, 0}, {3, 0}, {3, 3}, {0, 3},
                                      {1, 1}, {2, 1}, {2, 2}, {1, 2}};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    file.graph.points.push_back({PointId{static_cast<std::int64_t>(i)}, corners[i], 0});
    file.points.push_back({static_cast<long>(i + 2), 1});
  }
  for (int i = 0; i < 8; ++i) {
    const int first = i / 4 * 4;
    file.graph.segments.push_back({LineId{i + 10}, PointId{i}, PointId{first + (i + 1) % 4}, 0});
    file.segments.push_back({20 + i, 1});
  }
  return file;
}

}  // namespace

TEST_CASE("a plate with a hole has every property but to be a box") {
  const MeshData<2> mesh = plate(true);
  CHECK(broken(mesh, {}) == "hull");
  CHECK(broken(mesh, {.boundary = BoundaryRule::any}) == "");
  CHECK(broken(mesh, {.boundary = BoundaryRule::lines}) == "boundary");
  const auto graph = square_in_square();
  CHECK(trouble(mesh, {.graph = &graph, .boundary = BoundaryRule::lines}) == "");
}

TEST_CASE("triangles that overlap are found, be they crossing, within one another, or touching") {
  const Asked any{.boundary = BoundaryRule::any};
  const Point<2> o{0, 0}, a{4, 0}, b{0, 4};
  CHECK(broken(mesh_of({o, a, b, {1, 1}, {5, 1}, {1, 5}}, {{0, 1, 2}, {3, 4, 5}}), any) ==
        "overlap");
  CHECK(broken(mesh_of({o, a, b, {1, 1}, {1.5, 1}, {1, 1.5}}, {{0, 1, 2}, {3, 4, 5}}), any) ==
        "overlap");
  CHECK(broken(mesh_of({o, a, b, {2, 0}, {1, -1}, {3, -1}}, {{0, 1, 2}, {3, 4, 5}}), any) ==
        "overlap");
  CHECK(broken(mesh_of({o, a, b, {1, 0}, {2, -1}, {3, 0}}, {{0, 1, 2}, {3, 4, 5}}), any) ==
        "overlap");
  CHECK(broken(mesh_of({o, a, b, {-1, 0}, {0, -1}}, {{0, 1, 2}, {0, 3, 4}}), any) == "");
  CHECK(broken(mesh_of({}, {}), any) == "overlap");
}

TEST_CASE("overlaps are found exactly where pairs of triangles say so") {
  const std::uint64_t seed = GENERATE(1, 2, 3, 4);
  mesher::SplitMix64 random(seed);
  int judged = 0, bad = 0;
  for (int round = 0; round < 20000; ++round) {
    const int side = 3 + static_cast<int>(random.below(3));
    std::vector<Point<2>> vertices;
    for (int i = 0; i < side * side; ++i) vertices.push_back({double(i % side), double(i / side)});
    MeshData<2> mesh = mesh_of(vertices, {});
    for (auto left = 1 + random.below(5); left > 0; --left) {
      Mesh<2>::Simplex t;
      for (auto& corner : t) corner = static_cast<std::uint32_t>(random.below(vertices.size()));
      const int turn = orient2d(vertices[t[0]], vertices[t[1]], vertices[t[2]]);
      if (turn < 0) std::swap(t[1], t[2]);
      if (turn != 0) mesh.simplices.push_back(t);
    }
    if (mesh.simplices.empty()) continue;
    // Only what is used.
    std::vector<std::uint32_t> number(vertices.size(), UINT32_MAX);
    mesh.vertices.clear();
    for (auto& t : mesh.simplices) {
      for (auto& corner : t) {
        if (number[corner] == UINT32_MAX) {
          number[corner] = static_cast<std::uint32_t>(mesh.vertices.size());
          mesh.vertices.push_back(vertices[corner]);
        }
        corner = number[corner];
      }
    }
    const auto findings = mesher::check_mesh(mesh, Asked{.boundary = BoundaryRule::any});
    if (findings.size() < 5) continue;
    const auto at = [&](std::uint32_t v) { return mesh.vertices[v]; };
    // Disjoint convex sets are on two sides of a side of one of them.
    const auto separated_by = [&](const Mesh<2>::Simplex& s, const Mesh<2>::Simplex& t) {
      for (int i = 0; i < 3; ++i) {
        int outside = 0;
        for (const auto v : t) outside += orient2d(at(s[i]), at(s[(i + 1) % 3]), at(v)) <= 0;
        if (outside == 3) return true;
      }
      return false;
    };
    bool overlap = false;
    for (std::size_t i = 0; i < mesh.simplices.size(); ++i) {
      for (std::size_t k = 0; k < i; ++k) {
        overlap = overlap || !(separated_by(mesh.simplices[i], mesh.simplices[k]) ||
                               separated_by(mesh.simplices[k], mesh.simplices[i]));
      }
    }
    for (const auto& t : mesh.simplices) {  // a vertex within a side
      for (int i = 0; i < 3; ++i) {
        const Point<2> p = at(t[i]), q = at(t[(i + 1) % 3]);
        for (const auto& v : mesh.vertices) {
          overlap = overlap || (orient2d(p, q, v) == 0 && std::min(p, q) < v && v < std::max(p, q));
        }
      }
    }
    INFO("seed " << seed << ", round " << round << ": " << findings[4].detail);
    REQUIRE(findings[4].property == "overlap");
    REQUIRE(findings[4].holds == !overlap);
    ++judged;
    bad += overlap;
  }
  CHECK(judged > 10000);
  CHECK((bad > judged / 10 && bad < judged * 9 / 10));
}

TEST_CASE("an edge that is listed must be there, and the boundary must be on lines") {
  MeshData<2> mesh = plate(true);
  for (const auto& [low, high] : mesher::edges(mesh)) {
    mesh.features.edges.push_back({low, high, LineId{1}, 0});
  }
  Asked options{.boundary = BoundaryRule::lines, .features = &mesh.features};
  CHECK(trouble(mesh, options) == "");
  mesh.features.edges[0].high = 15;
  CHECK(trouble(mesh, options) ==
        "lines: the edge from vertex 1 at (0, 0) to vertex 16 at (3, 3) is listed, but is no edge "
        "of a triangle");
}

TEST_CASE("a segment is a union of edges, its vertices on it but for rounding") {
  auto graph = square_in_square();
  const Asked options{.graph = &graph, .boundary = BoundaryRule::lines};
  MeshData<2> mesh = plate(true);
  const auto segments_hold = [&] {
    const auto findings = mesher::check_mesh(mesh, options);
    REQUIRE(findings[4].property == "segments");
    return findings[4].holds;
  };
  mesh.vertices[2][1] = 0x1p-50;  // on the lower side, rounded
  CHECK(segments_hold());
  mesh.vertices[2][1] = 0x1p-40;  // then it is outside, and what bounds the mesh is no line
  CHECK(segments_hold());
  CHECK(broken(mesh, options) == "boundary");
  CHECK(broken(mesh, {.graph = &graph, .boundary = BoundaryRule::any}) == "segments");
  mesh = plate(true);
  graph.graph.segments[4].to = PointId{6};  // across the hole
  CHECK(segments_hold());
  CHECK(broken(mesh, options) == "boundary");
  CHECK(trouble(mesh, {.graph = &graph, .boundary = BoundaryRule::box}) ==
        "segments: line 14 from (1, 1) to (2, 2): no edge on it goes on from vertex 6 at (1, 1)");
  graph.graph.segments[4].to = PointId{5};
  graph.graph.points[6].at = {2, 1.75};
  CHECK(broken(mesh, options) == "segments");
}

TEST_CASE("an edge that names a line is on it") {
  const auto graph = square_in_square();
  MeshData<2> mesh = plate(true);
  const Asked options{.graph = &graph, .boundary = BoundaryRule::lines, .features = &mesh.features};
  mesh.features.edges = {{0, 1, LineId{10}, 0}, {1, 2, {}, 0}, {2, 3, LineId{10}, 0}};
  CHECK(trouble(mesh, options) == "");
  mesh.features.edges[2].line = LineId{11};
  CHECK(trouble(mesh, options) ==
        "segments: the edge from vertex 3 at (2, 0) to vertex 4 at "
        "(3, 0) is not on line 11, which it names");
  mesh.features.edges[2].line = LineId{99};
  CHECK(broken(mesh, options) == "segments");
}

TEST_CASE("lines and points outside of what is meshed are told, those inside must be there") {
  auto graph = square_in_square();
  const auto add = [&](std::int64_t id, Point<2> at) {
    graph.graph.points.push_back({PointId{id}, at, 0});
    graph.points.push_back({99, 1});
  };
  add(20, {5, 5});
  add(21, {6, 5});
  add(22, {1.5, 1.25});
  graph.graph.segments.push_back({LineId{30}, PointId{20}, PointId{21}, 0});
  graph.segments.push_back({50, 1});
  const Asked options{.graph = &graph, .boundary = BoundaryRule::lines};
  CHECK(trouble(plate(true), options) == "");
  CHECK(broken(plate(false), options) == "input");  // 22 is in no hole then
  graph.graph.points.back().at = {0.5, 0.5};
  CHECK(trouble(plate(true), options) ==
        "input: input point 22 at (0.5, 0.5) (line 99) is no vertex");
}

TEST_CASE("of a line with an end outside of what is meshed the part inside must be there") {
  auto graph = square_in_square();
  const auto add = [&](std::int64_t id, Point<2> at) {
    graph.graph.points.push_back({PointId{id}, at, 0});
    graph.points.push_back({99, 1});
  };
  add(20, {2, 1});
  add(21, {2, -1});
  graph.graph.segments.push_back({LineId{30}, PointId{20}, PointId{21}, 0});
  graph.segments.push_back({50, 1});
  const Asked options{.graph = &graph, .boundary = BoundaryRule::lines};
  const auto said = [&](double x, double y) {
    graph.graph.points.back().at = {x, y};
    for (const auto& finding : mesher::check_mesh(plate(true), options)) {
      if (finding.property == "segments") return finding.detail;
    }
    return std::string();
  };
  CHECK(said(2, -1) == "9 segments are unions of 17 edges, 1 in part");
  CHECK(said(2, -9) == "9 segments are unions of 17 edges, 1 in part");
  CHECK(said(2, 9) == "9 segments are unions of 18 edges, 1 in part");  // along the hole first
  CHECK(said(1.5, -1) == "line 30 from (2, 1) to (1.5, -1): its end at (1.5, -1) is no vertex");
  CHECK(said(0, -9) == "line 30 from (2, 1) to (0, -9): its end at (0, -9) is no vertex");
  std::swap(graph.graph.segments.back().from, graph.graph.segments.back().to);
  CHECK(said(2, -9) == "9 segments are unions of 17 edges, 1 in part");
  CHECK(said(0, -9) == "line 30 from (0, -9) to (2, 1): its end at (0, -9) is no vertex");
}

TEST_CASE("regions end at lines, are those of their seeds, and leave holes out") {
  MeshData<2> mesh = plate(false);
  auto graph = square_in_square();
  for (const auto& t : mesh.simplices) {
    mesh.features.regions.push_back(t[0] == 5 && t[1] != 9 && t[2] != 4 ? 2 : 1);
  }
  const Asked options{.graph = &graph, .boundary = BoundaryRule::lines, .features = &mesh.features};
  CHECK(trouble(mesh, options) == "");
  graph.graph.seeds = {mesher::region_seed<2>(1, {0.5, 0.25}, 1),
                       mesher::region_seed<2>(2, {1.5, 1.25}, 2)};
  CHECK(trouble(mesh, options) == "");
  graph.graph.seeds[1].attribute = 3;
  CHECK(broken(mesh, options) == "regions");
  graph.graph.seeds = {mesher::hole_seed<2>(1, {1.5, 1.25})};
  CHECK(broken(mesh, options) == "regions");
  graph.graph.seeds.clear();
  mesh.features.regions[0] = 2;
  CHECK(broken(mesh, options) == "regions");
}

TEST_CASE("an edge on a line that is not Delaunay is constrained, not conforming") {
  MeshData<2> mesh = mesh_of({{0, 0}, {4, 0}, {2, 0.5}, {2, -0.5}}, {{0, 1, 2}, {0, 3, 1}});
  mesh.features.edges = {{0, 1, LineId{1}, 0}};
  Asked options{.boundary = BoundaryRule::any, .features = &mesh.features};
  CHECK(broken(mesh, options) == "conforming");
  options.constrained = true;
  CHECK(broken(mesh, options) == "");
  mesh.features.edges.clear();
  CHECK(broken(mesh, options) == "delaunay");
}

TEST_CASE("a poor triangle is excused at a small angle of the input, and nowhere else") {
  const double small = 0.1;
  MeshData<2> mesh = mesh_of({{0, 0}, {1, 0}, {std::cos(small), std::sin(small)}}, {{0, 1, 2}});
  mesher::GraphFile<2> graph;
  for (std::int64_t i = 0; i < 3; ++i) {
    graph.graph.points.push_back({PointId{i}, mesh.vertices[static_cast<std::size_t>(i)], 0});
    graph.points.push_back({1, 1});
  }
  graph.graph.segments = {{LineId{1}, PointId{0}, PointId{1}, 0}};
  Asked options{.graph = &graph, .rho = 2, .boundary = BoundaryRule::any};
  CHECK(broken(mesh, options) == "quality");
  graph.graph.segments.push_back({LineId{2}, PointId{0}, PointId{2}, 0});
  CHECK(broken(mesh, options) == "");
}

// Two lines of two edges each, as a polyline of one id, at 0.1 radians.
TEST_CASE("without an input small angles are those of the mesh's own lines") {
  MeshData<2> mesh = mesh_of({{0, 0}, {1, -0.05}, {1, 0.05}, {2, -0.1}, {2, 0.1}},
                             {{0, 1, 2}, {1, 3, 4}, {1, 4, 2}});
  Asked options{.rho = 2, .boundary = BoundaryRule::any, .features = &mesh.features};
  const LineId line{7};
  mesh.features.edges = {{0, 1, line, 0}, {0, 2, line, 0}, {1, 3, line, 0}, {2, 4, line, 0}};
  CHECK(broken(mesh, options) == "");
  for (auto& e : mesh.features.edges) e.line.reset();  // not known
  CHECK(broken(mesh, options) == "");
  mesh.features.edges = {{0, 1, line, 0}, {1, 3, line, 0}, {2, 4, line, 0}};
  CHECK(broken(mesh, options) == "quality");
}

TEST_CASE("a triangle above the limit of area is found") {
  const MeshData<2> mesh = plate(true);
  CHECK(broken(mesh, {.boundary = BoundaryRule::any, .max_measure = 0.5}) == "");
  CHECK(broken(mesh, {.boundary = BoundaryRule::any, .max_measure = 0.49}) == "area");
}

// Distances from the apex are equal but for the rounding of coordinates, which is much there.
TEST_CASE("triangles at a small angle are excused however near to its apex they are") {
  for (const double e : {1e-9, 1e-11, 1e-12}) {
    INFO("features " << e << " apart");
    const mesher::Options<2> options{.domain = {{0, 0}, {16, 16}}};
    const std::vector<Point<2>> points{{9, 8.75}, {12.2, 8.75}, {11, 7.875}, {9 - e, 8.75 + e / 3}};
    const std::vector<mesher::Segment> legs{{LineId{1}, PointId{1}, PointId{2}},
                                            {LineId{2}, PointId{1}, PointId{3}}};
    const auto mesh = mesher::mesh_statically(points, legs, options);
    const auto report = mesher::angle_report(mesh, options);
    CHECK(report.forced > 20);
    CHECK(report.smallest_elsewhere_deg >= report.promised_deg - 1e-3);
    MeshData<2> data = mesh_of(mesh.vertices, mesh.simplices);
    for (const auto& edge : mesh.edges) {
      data.features.edges.push_back({edge.low, edge.high, edge.feature.line(), 0});
    }
    CHECK(trouble(data, {.rho = options.rho, .features = &data.features}) == "");
  }
}
