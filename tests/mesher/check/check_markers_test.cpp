// The checker holds markers against those of the input's points and lines.
#include <catch2/catch.hpp>

#include "asked.hpp"
#include "mesher/check.hpp"

namespace {

using mesher::BoundaryRule;
using mesher::LineId;
using mesher::MeshData;
using mesher::PointId;

// The square (0,0) to (2,2) about the vertex 4, and the vertex 5 on the middle of its lowest side:
//   3 - 2
//   | 4 |     line 10 with the marker 7 is 0-5-1, line 11 with the marker 8 is 0-4,
//   0 5 1     line 12 without one is 1-2-3-0; the point 0 has the marker 3.
mesher::GraphFile<2> graph() {
  mesher::GraphFile<2> file;
  const mesher::Point<2> corners[] = {{0, 0}, {2, 0}, {2, 2}, {0, 2}, {1, 1}};
  for (std::int64_t i = 0; i < 5; ++i) {
    file.graph.points.push_back({PointId{i}, corners[i], i == 0 ? 3 : 0});
    file.points.push_back({2 + i, 1});
  }
  file.graph.segments = {{LineId{10}, PointId{0}, PointId{1}, 7},
                         {LineId{11}, PointId{0}, PointId{4}, 8}};
  file.segments = {{8, 1}, {9, 1}};
  file.graph.polylines = {{LineId{12}, {PointId{1}, PointId{2}, PointId{3}, PointId{0}}}};
  file.polylines = {{10, 1}};
  return file;
}

MeshData<2> mesh() {
  MeshData<2> mesh;
  mesh.vertices = {{0, 0}, {2, 0}, {2, 2}, {0, 2}, {1, 1}, {1, 0}};
  mesh.kinds.assign(6, mesher::VertexKind::steiner);
  mesh.simplices = {{0, 5, 4}, {5, 1, 4}, {1, 2, 4}, {2, 3, 4}, {0, 4, 3}};
  mesh.features.markers = {3, 7, 1, 1, 8, 7};
  mesh.features.edges = {{0, 3, LineId{12}, 1}, {0, 4, LineId{11}, 8}, {0, 5, LineId{10}, 7},
                         {1, 2, LineId{12}, 1}, {1, 5, LineId{10}, 7}, {2, 3, LineId{12}, 1}};
  return mesh;
}

std::string said(const MeshData<2>& mesh, const mesher::GraphFile<2>& graph) {
  const support::Asked<2> options{
      .graph = &graph, .boundary = BoundaryRule::lines, .features = &mesh.features};
  std::string all;
  for (const auto& finding : mesher::check_mesh(mesh, options)) {
    if (finding.property == "markers") all += finding.detail;
    CHECK((finding.holds || finding.property == "markers"));
  }
  return all;
}

}  // namespace

TEST_CASE("markers of the input's points and lines hold, and 1 or none on the rest of the border") {
  MeshData<2> m = mesh();
  CHECK(said(m, graph()) == "6 vertices and 6 edges have one");
  m.features.markers[2] = 0;
  m.features.edges[3].marker = 0;
  CHECK(said(m, graph()) == "5 vertices and 5 edges have one");
}

TEST_CASE("the points of a graph that is of no file give their markers, too") {
  MeshData<2> m = mesh();
  mesher::GraphFile<2> program;
  program.graph = graph().graph;
  CHECK(said(m, program) == "6 vertices and 6 edges have one");
  m.features.markers[0] = 7;
  CHECK(said(m, program) == "vertex 1 at (0, 0) has the marker 7, but is point 0, which has 3");
}

TEST_CASE("a wrong marker is told with the vertex or edge, and whose it should be") {
  MeshData<2> m = mesh();
  const auto file = graph();
  SECTION("of a point") {
    m.features.markers[0] = 7;
    CHECK(said(m, file) ==
          "vertex 1 at (0, 0) has the marker 7, but is point 0 (line 2), which "
          "has 3");
  }
  SECTION("of a vertex on a line") {
    m.features.markers[5] = 8;
    CHECK(said(m, file) ==
          "vertex 6 at (1, 0) has the marker 8, but is on line 10 (line 8), which "
          "has 7");
  }
  SECTION("of a vertex on lines without") {
    m.features.markers[2] = 4;
    CHECK(said(m, file) == "vertex 3 at (2, 2) has the marker 4, but is on no line with that one");
  }
  SECTION("of an edge") {
    m.features.edges[1].marker = 7;
    CHECK(said(m, file) ==
          "the edge from vertex 1 at (0, 0) to vertex 5 at (1, 1) has the marker "
          "7, but is on line 11 (line 9), which has 8");
  }
  SECTION("of an edge that is not listed") {
    m.features.edges.erase(m.features.edges.begin() + 1);
    CHECK(said(m, file) ==
          "the edge from vertex 1 at (0, 0) to vertex 5 at (1, 1) has the marker "
          "0, but is on line 11 (line 9), which has 8");
  }
  SECTION("of an edge on no line") {
    m.features.edges.insert(m.features.edges.begin() + 4, {1, 4, {}, 8});
    CHECK(said(m, file) ==
          "the edge from vertex 2 at (2, 0) to vertex 5 at (1, 1) has the marker "
          "8, but is on no line with one");
  }
}

TEST_CASE("markers are looked at where the input has some and the mesh tells of them") {
  MeshData<2> m = mesh();
  SECTION("not those of edges that no edge has") {
    for (auto& e : m.features.edges) e.marker = 0;
    CHECK(said(m, graph()) == "6 vertices and 0 edges have one");
  }
  SECTION("the mesh has none") {
    for (auto& e : m.features.edges) e.marker = 0;
    m.features.markers.clear();
    CHECK(said(m, graph()).empty());
  }
  SECTION("the input has none") {
    auto file = graph();
    file.graph.points[0].marker = file.graph.segments[0].marker = file.graph.segments[1].marker = 0;
    CHECK(said(m, file).empty());
  }
}
