// What a mesh of a graph depends on, and what of it is refined.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <string>

#include "refined_graph.hpp"
#include "test_paths.hpp"

namespace {

using mesher::Extent;
using mesher::Graph;
using mesher::Mesh;
using mesher::Options;
using mesher::Point;
using mesher::PointId;
using support::By;
using support::fault;
using support::frame;
using support::graph_of;
using support::id_at;
using support::mesh_of;
using support::options_for;
using support::random_graph;
using Family = support::PslgEditor::Family;
constexpr Family kFamilies[] = {Family::uniform, Family::lattice, Family::beside, Family::fan,
                                Family::wedge};

// With other ids, and all in another order.
Graph<2> shuffled(const Graph<2>& graph) {
  std::mt19937_64 random(7);
  Graph<2> other = graph;
  const auto renamed = [](PointId& id) { id = PointId{9000 - 3 * static_cast<std::int64_t>(id)}; };
  std::shuffle(other.points.begin(), other.points.end(), random);
  std::shuffle(other.segments.begin(), other.segments.end(), random);
  for (auto& p : other.points) renamed(p.id);
  for (auto& s : other.segments) {
    std::swap(s.from, s.to);
    renamed(s.from), renamed(s.to);
  }
  return other;
}

std::size_t poor_ones(const Mesh<2>& mesh) {
  return static_cast<std::size_t>(
      std::count_if(mesh.simplices.begin(), mesh.simplices.end(), [&](const auto& t) {
        const auto at = [&](std::size_t i) { return mesh.vertices[t[i]]; };
        return mesher::radius_edge(at(0), at(1), at(2)) > 1.4142 * (1 + 1e-9);
      }));
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("graphs of any size are meshed alike, if doubles hold them", "", ((By B), B),
                       By::svr, By::refine) {
  const Graph<2> graph = graph_of(random_graph(Family::wedge, 5, 120));
  const std::size_t vertices = mesh_of<B>(graph, options_for(graph)).vertices.size();
  for (const double scale : {0x1p-30, 0x1p-80, 0x1p30, 0x1p90}) {
    INFO(scale);
    Graph<2> scaled = graph;
    for (auto& p : scaled.points) p.at = {scale * p.at[0], scale * p.at[1]};
    const Mesh<2> mesh = mesh_of<B>(scaled, options_for(scaled));
    CHECK(mesh.vertices.size() == vertices);
    CHECK(fault(mesh, scaled, Extent::box) == "");
  }
  for (const double scale : {1e-9, 1e9}) {
    Graph<2> far = frame();
    for (auto& p : far.points) p.at = {scale * (1e6 + p.at[0]), scale * (p.at[1] - 1e6)};
    CHECK(fault(mesh_of<B>(far, options_for(far)), far, Extent::box) == "");
  }
}

TEMPLATE_TEST_CASE_SIG("a mesh of a graph depends on no order, and on no ids", "", ((By B), B),
                       By::svr, By::refine) {
  for (const Family family : kFamilies) {
    INFO("family " << static_cast<int>(family));
    const Graph<2> graph = graph_of(random_graph(family, 3, 150));
    Mesh<2> mesh = mesh_of<B>(graph, options_for(graph), Extent::enclosed);
    Mesh<2> other = mesh_of<B>(shuffled(graph), options_for(graph), Extent::enclosed);
    for (auto* m : {&mesh, &other}) {
      for (auto& e : m->edges) e.feature = {};
    }
    CHECK(other == mesh);
  }
}

TEMPLATE_TEST_CASE_SIG("of a graph what is not wanted is not refined: the outside, and holes", "",
                       ((By B), B), By::svr, By::refine) {
  const Graph<2> lake = mesher::read<2>(std::string(test_paths::kData) + "/great_lakes.poly").graph;
  const Options<2> options = options_for(lake);
  const Mesh<2> all = mesh_of<B>(lake, options),
                enclosed = mesh_of<B>(lake, options, Extent::enclosed);
  CHECK(poor_ones(enclosed) > poor_ones(all) + 100);
  CHECK(enclosed.vertices.size() < 0.95 * static_cast<double>(all.vertices.size()));
  CHECK(fault(all, lake, Extent::box) == "");
  CHECK(fault(enclosed, lake, Extent::enclosed) == "");
  CHECK(static_cast<double>(all.vertices.size()) <
        1.15 * static_cast<double>(mesher::mesh_statically(lake, options).vertices.size()));

  Graph<2> graph = frame();  // with many points where the hole will be
  for (int i = 0; i < 40; ++i) {
    graph.points.push_back({PointId{100 + i}, {0.5 + 1e-4 * std::pow(1.1, i), 0.5}, 0});
  }
  const Mesh<2> filled = mesh_of<B>(graph, options_for(graph), Extent::enclosed);
  graph.seeds.push_back(mesher::hole_seed<2>(id_at(0).number, {0.45, 0.55}));
  const Mesh<2> holed = mesh_of<B>(graph, options_for(graph), Extent::enclosed);
  CHECK(holed.vertices.size() < filled.vertices.size());
  CHECK(fault(holed, graph, Extent::enclosed) == "");
  for (const Point<2>& p : {Point<2>{.375, .5}, Point<2>{.375, .375}, Point<2>{50, 50}}) {
    graph.seeds.back().at = p;  // on a segment, on its end, in no region
    CHECK(mesh_of<B>(graph, options_for(graph), Extent::enclosed) == filled);
  }
  const Graph<2> open = graph_of({{0, 0}, {1, 0}, {1, 1}}, {{0, 1}, {1, 2}});  // then all is wanted
  CHECK(mesh_of<B>(open, options_for(open), Extent::enclosed) ==
        mesh_of<B>(open, options_for(open)));
}

TEMPLATE_TEST_CASE_SIG("a graph without segments has the mesh of its points", "", ((By B), B),
                       By::svr, By::refine) {
  Graph<2> graph = frame();
  graph.segments.clear();
  const auto points = places_of(graph);
  const Options<2> options = options_for(graph);
  CHECK(mesh_of<B>(graph, options) ==
        (B == By::svr ? mesher::svr<2>(points, options) : mesher::refine<2>(points, options)));
  const std::vector<Point<2>> none;
  CHECK(mesh_of<B>(Graph<2>(), options) ==
        (B == By::svr ? mesher::svr<2>(none, options) : mesher::refine<2>(none, options)));
}
