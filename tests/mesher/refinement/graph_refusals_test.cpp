// What refinements of graphs refuse, and tell.
#include <catch2/catch.hpp>
#include <cmath>
#include <stop_token>
#include <string>

#include "failing_new.hpp"
#include "mesher/extra/generate.hpp"
#include "refined_graph.hpp"

namespace {

using mesher::Extent;
using mesher::Graph;
using mesher::Mesh;
using mesher::Options;
using mesher::PslgKind;
using support::By;
using support::fault;
using support::frame;
using support::graph_of;
using support::id_at;
using support::mesh_of;
using support::options_for;
using support::refusal;
using support::Refusal;

}  // namespace

TEMPLATE_TEST_CASE_SIG("at angles below double precision it ends, or names who is to blame", "",
                       ((By B), B), By::svr, By::refine) {
  const Graph<2> two = mesher::generate_pslg({PslgKind::fan, 2, 1, 1e-8});
  CHECK(fault(mesh_of<B>(two, options_for(two)), two, Extent::box) == "");
  int fine = 0, lost = 0;
  for (double angle = 1e-5; angle > 1e-10; angle *= 0.37) {
    for (const std::size_t legs : {2u, 3u, 6u, 12u}) {
      INFO(legs << " legs at " << angle);
      const Graph<2> graph = mesher::generate_pslg({PslgKind::fan, legs, 1, angle});
      const Refusal refused = refusal<B>(graph, options_for(graph));
      if (refused.code.empty()) {
        ++fine;
        CHECK(fault(mesh_of<B>(graph, options_for(graph)), graph, Extent::box) == "");
        continue;
      }
      ++lost;
      CHECK(refused.code == "too_close");
      CHECK(refused.ids.size() >= 2);
      CHECK_THAT(refused.text, Catch::Contains("too small for double precision: no edge joins"));
    }
  }
  CHECK(fine > 15);
  CHECK(lost > 5);
}

TEMPLATE_TEST_CASE_SIG("graphs that cannot be meshed are refused, by name", "", ((By B), B),
                       By::svr, By::refine) {
  const Graph<2> graph = frame();
  const auto changed = [&](auto&& change) {
    Options<2> options = options_for(graph);
    change(options);
    return refusal<B>(graph, options).code;
  };
  CHECK(changed([](auto& o) { o.rho = 1.41; }) == "bad_option");
  CHECK(changed([](auto& o) { o.rho = std::nan(""); }) == "bad_option");
  CHECK(changed([](auto& o) { o.max_measure = -1; }) == "bad_option");
  CHECK(changed([](auto& o) { o.rule = mesher::Rule::voronoi_aspect; }) == "bad_option");
  CHECK(changed([](auto& o) { o.domain = {{0, 0}, {0.5, 1}}; }) == "outside_domain");
  const auto edited = [&](auto&& edit) {
    Graph<2> bad = graph;
    edit(bad);
    return refusal<B>(bad, options_for(graph));
  };
  const auto add = [](Graph<2>& g, std::size_t a, std::size_t b) {
    g.segments.push_back({mesher::LineId{77}, id_at(a), id_at(b), 0});
  };
  const Refusal crossing = edited([&](Graph<2>& g) { add(g, 0, 2); });
  CHECK(crossing.code == "point_on_segment");
  CHECK(crossing.ids.size() == 2);
  CHECK(edited([&](Graph<2>& g) {
          add(g, 3, 4), add(g, 0, 7), g.segments.back().id = id_at(77);
        }).code == "crossing_segments");
  CHECK(edited([&](Graph<2>& g) { add(g, 0, 1); }).code == "repeated_segment");
  CHECK(edited([&](Graph<2>& g) { add(g, 0, 99); }).code == "unknown_id");
  CHECK(edited([&](Graph<2>& g) { add(g, 3, 3); }).code == "zero_length");
  const Graph<2> bundle = mesher::generate_pslg({PslgKind::bundle, 8, 1, 1.0});
  Options<2> few = options_for(bundle);
  few.max_vertices = 300;
  const Refusal too_many = refusal<B>(bundle, few);
  CHECK(too_many.code == "too_many");
  CHECK(too_many.ids.size() == 2);
  std::stop_source stop;
  stop.request_stop();
  CHECK(refusal<B>(graph, options_for(graph), {.progress = {}, .stop = stop.get_token()}).code ==
        "cancelled");
  int reports = 0;
  const mesher::RunControl third{.progress = [&](const auto&) { return ++reports < 3; },
                                 .stop = {}};
  const Graph<2> many = mesher::generate_pslg({PslgKind::segments, 500});
  CHECK(refusal<B>(many, options_for(many), third).code == "cancelled");
  CHECK(reports == 3);
}

TEMPLATE_TEST_CASE_SIG("without memory a mesh of a graph fails, and nothing is lost", "",
                       ((By B), B), By::svr, By::refine) {
  const Graph<2> graph = frame();
  const Options<2> options = options_for(graph);
  const Mesh<2> mesh = mesh_of<B>(graph, options, Extent::enclosed);
  bool burnt = true;
  int failures = 0;
  for (std::uint64_t count = 1; burnt; count += 1 + count / 8) {
    Mesh<2> other;
    const bool failed =
        support::fails(count, burnt, [&] { other = mesh_of<B>(graph, options, Extent::enclosed); });
    failures += failed ? 1 : 0;
    if (!failed) CHECK(other == mesh);
  }
  CHECK(failures > 10);
}

TEST_CASE("what happened in a run on a graph is told") {
  const Graph<2> graph = mesher::generate_pslg({PslgKind::segments, 200});
  mesher::SvrStats svr;
  const Mesh<2> mesh = mesher::svr(graph, options_for(graph), Extent::box, {}, &svr);
  CHECK(svr.vertices == mesh.vertices.size());
  CHECK(svr.warped + svr.crowded > 100);
  CHECK(svr.worst_radius_edge > 1.4142);
  mesher::RefineStats refined;
  const Mesh<2> other = mesher::refine(graph, options_for(graph), Extent::box, {}, &refined);
  CHECK(refined.simplices == other.simplices.size());
  CHECK(refined.made > other.simplices.size());
}
