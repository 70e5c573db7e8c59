// Meshes of points and segments by each refinement: every segment is a union of edges, and what is
// wanted is of quality off small angles.
#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <string>

#include "mesher/extra/generate.hpp"
#include "pslg_judge.hpp"
#include "refined_graph.hpp"

namespace {

using mesher::Extent;
using mesher::Graph;
using mesher::Mesh;
using mesher::Options;
using mesher::PslgKind;
using support::By;
using support::fault;
using support::graph_of;
using support::mesh_of;
using support::options_for;
using support::random_graph;
using support::random_options;
using support::refusal;
using Family = support::PslgEditor::Family;

constexpr Family kFamilies[] = {Family::uniform, Family::lattice, Family::beside, Family::fan,
                                Family::wedge};

// `said`, if the mesh by gap-balls is as wrong about the same line; else nothing.
std::string cut_line(const Graph<2>& graph, const Options<2>& options, const std::string& said) {
  const std::string of_other =
      fault(mesher::mesh_statically(graph, options), graph, Extent::enclosed);
  const auto line = [](const std::string& text) { return text.substr(0, text.find(" from ")); };
  return line(of_other) == line(said) ? said : "";
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("random graphs are in their meshes, and these of quality", "", ((By B), B),
                       By::svr, By::refine) {
  int meshes = 0;
  for (const Family family : kFamilies) {
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
      INFO("family " << static_cast<int>(family) << ", seed " << seed);
      const support::Pslg random = random_graph(family, seed, seed % 2 == 0 ? 40 : 150);
      const Graph<2> graph = graph_of(random);
      const Options<2> options = random_options();
      if (family == Family::beside && refusal<B>(graph, options).code == "too_many") continue;
      const Mesh<2> all = mesh_of<B>(graph, options);
      ++meshes;
      CHECK(support::PslgJudge(all, random).fault(options) == "");
      CHECK(fault(all, graph, Extent::box) == "");
      CHECK(fault(mesh_of<B>(graph, options, Extent::enclosed), graph, Extent::enclosed) == "");
    }
  }
  CHECK(meshes >= 58);
}

TEMPLATE_TEST_CASE_SIG(
    "so it is of many random graphs, and of large and small ones, here and there", "[soak]",
    ((By B), B), By::svr, By::refine) {
  int meshes = 0;
  for (std::uint64_t seed = 1; seed <= 2000; ++seed) {
    INFO("seed " << seed);
    std::mt19937_64 random(seed);
    const int edits = 20 + static_cast<int>(random() % 200);
    Graph<2> graph = graph_of(random_graph(kFamilies[seed % 5], seed, edits));
    const double scale = std::ldexp(1.0, static_cast<int>(random() % 60) - 30);
    const double offset = random() % 2 == 0 ? 0 : 1024 * static_cast<double>(random() % 2 + 1);
    for (auto& p : graph.points) {
      for (double& x : p.at) x = scale * (offset + x);
    }
    const Extent extent = random() % 2 == 0 ? Extent::box : Extent::enclosed;
    Options<2> options = options_for(graph);
    options.max_vertices = 20000;
    try {
      const Mesh<2> mesh = mesh_of<B>(graph, options, extent);
      const std::string said = fault(mesh, graph, extent);
      // A line of which one end is kept, and not the other, is no path of what is kept.
      const bool is_cut = extent == Extent::enclosed && said.rfind("segments", 0) == 0;
      CHECK(said == (is_cut ? cut_line(graph, options, said) : ""));
      ++meshes;
    } catch (const mesher::Error& e) {
      INFO(e.what());
      if (e.code() == mesher::ErrorCode::too_many) {
        CHECK_THROWS_AS(mesher::mesh_statically(graph, options), mesher::Error);
      } else {
        CHECK(offset != 0);  // where what was apart touches
      }
    }
  }
  CHECK(meshes > 1800);
}

TEMPLATE_TEST_CASE_SIG("so it is of all families of graphs", "", ((By B), B), By::svr, By::refine) {
  for (const std::string& name : mesher::pslg_kind_names()) {
    INFO(name);
    // Nearly parallel lines ask for many vertices.
    const bool many = name == "corridors" || name == "zigzag" || name == "bundle";
    const Graph<2> graph = mesher::generate_pslg({*mesher::pslg_kind(name), many ? 20u : 300u});
    for (const Extent extent : {Extent::box, Extent::enclosed}) {
      CHECK(fault(mesh_of<B>(graph, options_for(graph), extent), graph, extent) == "");
    }
  }
}

TEMPLATE_TEST_CASE_SIG("segments that meet at small angles end", "", ((By B), B), By::svr,
                       By::refine) {
  for (const double angle : {59.0, 30.0, 10.0, 1.0, 1e-2, 1e-4, 1e-6}) {
    for (const std::size_t legs : {2u, 3u, 6u}) {
      for (const PslgKind kind : {PslgKind::fan, PslgKind::bundle}) {
        INFO(angle << " degrees, " << legs << " legs, kind " << static_cast<int>(kind));
        const Graph<2> graph = mesher::generate_pslg({kind, legs, 1, angle});
        const Mesh<2> mesh = mesh_of<B>(graph, options_for(graph));
        CHECK(fault(mesh, graph, Extent::box) == "");
        CHECK(mesh.vertices.size() < 2000);
      }
    }
  }
}
