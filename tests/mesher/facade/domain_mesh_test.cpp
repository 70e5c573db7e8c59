// From a graph to its mesh: whose vertices and edges are, and what is kept.
#include <catch2/catch.hpp>
#include <set>

#include "facade/box_mesher.hpp"
#include "facade/graph_runs.hpp"
#include "mesher/meshing.hpp"

namespace {

using mesher::DomainMesh;
using mesher::Extent;
using mesher::Feature;
using mesher::Graph;
using mesher::LineId;
using mesher::MeshData;
using mesher::PointId;
using mesher::VertexKind;

const mesher::Options<2> kOptions{.domain = {{0, 0}, {16, 16}}};

// A square by a polyline, a segment across it, and a point outside.
Graph<2> parted_square() {
  Graph<2> graph;
  const std::vector<mesher::Point<2>> places{{2, 2}, {14, 2}, {14, 14}, {2, 14}, {0.5, 0.5}};
  for (const auto& p : places) {
    const auto i = static_cast<std::int64_t>(graph.points.size()) + 1;
    graph.points.push_back({PointId{10 * i}, p, i == 3 ? 7 : 0});
  }
  const auto id = [&](std::size_t i) { return graph.points[i].id; };
  graph.segments.push_back({LineId{1}, id(0), id(2), 5});
  graph.polylines.push_back({LineId{2}, {id(0), id(1), id(2), id(3), id(0)}, -4});
  graph.seeds.push_back(mesher::region_seed<2>(1, {12, 4}, 2.5, 0.125));
  return graph;
}

}  // namespace

TEST_CASE("vertices and edges know their points and lines, and have their markers") {
  const Graph<2> graph = parted_square();
  const MeshData<2> data = with_features(mesh_statically(graph, kOptions), graph);
  const auto& features = data.features;
  REQUIRE(features.edges.size() == data.edges.size());
  for (const auto& e : features.edges) CHECK(e.marker == (e.line == LineId{1} ? 5 : -4));
  std::set<Feature> points, lines;
  for (std::size_t v = 0; v < data.vertices.size(); ++v) {
    const auto& p = data.vertices[v];
    if (data.kinds[v] == VertexKind::input) points.insert(features.origins[v]);
    if (data.kinds[v] == VertexKind::segment) {
      lines.insert(features.origins[v]);
      CHECK((features.origins[v] == Feature(LineId{1})) == (p[0] == p[1]));
    }
    CHECK(features.markers[v] == (p == mesher::Point<2>{14, 14} ? 7 : 0));
    const bool free = data.kinds[v] == VertexKind::steiner || data.kinds[v] == VertexKind::boundary;
    if (free) CHECK(features.origins[v] == Feature());
  }
  CHECK(points ==
        std::set<Feature>{PointId{10}, PointId{20}, PointId{30}, PointId{40}, PointId{50}});
}

TEST_CASE("what is enclosed is kept, with attributes and limits of regions; or all of the box") {
  const Graph<2> graph = parted_square();
  const auto mesh = mesh_statically(graph, kOptions);
  const DomainMesh<2> inside = domain_mesh(mesh, graph, Extent::enclosed);
  CHECK_FALSE(inside.keeps_all);
  for (const auto& p : inside.mesh.vertices) CHECK(std::min(p[0], p[1]) >= 2);
  CHECK(inside.mesh.features.regions.size() == inside.mesh.simplices.size());
  std::size_t limited = 0;
  for (const auto& region : inside.regions) limited += region.max_measure == 0.125;
  CHECK(limited == 1);
  const DomainMesh<2> box = domain_mesh(mesh, graph, Extent::box);
  CHECK(box.mesh.simplices == mesh.simplices);
  CHECK(box.keeps_all);
}

TEST_CASE("points alone have one region and no features; a marker is a feature") {
  Graph<2> graph;
  graph.points = {{PointId{1}, {3, 3}, 0}, {PointId{2}, {5, 3}, 0}};
  CHECK(is_bare(graph));
  const auto mesh = mesh_statically(graph, kOptions);
  const DomainMesh<2> bare = domain_mesh(mesh, graph, Extent::enclosed);
  CHECK(static_cast<const mesher::Mesh<2>&>(bare.mesh) == mesh);
  CHECK(bare.mesh.features.empty());
  REQUIRE(bare.regions.size() == 1);
  CHECK(bare.regions[0].triangles == mesh.simplices.size());
  graph.points[1].marker = 3;
  CHECK_FALSE(is_bare(graph));
  const DomainMesh<2> marked = domain_mesh(mesh, graph, Extent::enclosed);
  CHECK(marked.regions == bare.regions);
  CHECK_FALSE(marked.mesh.features.markers.empty());
}

TEST_CASE("a graph announced to a mesher of domains is its input, and has the mesh made at once") {
  const Graph<2> graph = parted_square();
  mesher::Mesher<2> m(kOptions);
  announce(graph, m);
  m.update();
  CHECK(m.input() == graph);
  CHECK(m.box_mesh() == mesh_statically(graph, kOptions));
  mesher::BoxMesher<2> plain(kOptions);
  announce(graph, plain);
  plain.update();
  CHECK(plain.mesh() == m.box_mesh());
}
