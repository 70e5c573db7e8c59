// Meshes of points and segments by each refinement: every segment is a union of edges, and what is
// wanted is of quality off small angles.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <optional>
#include <random>
#include <stop_token>
#include <string>
#include <vector>

#include "failing_new.hpp"
#include "mesher/check.hpp"
#include "mesher/domain_mesh.hpp"
#include "mesher/generate.hpp"
#include "pslg_judge.hpp"
#include "random_pslg.hpp"
#include "test_paths.hpp"

namespace {

using mesher::Extent;
using mesher::FeatureId;
using mesher::Mesh;
using mesher::Options;
using mesher::Point;
using mesher::Pslg;
using mesher::PslgKind;

enum class By { svr, refine };

template <By B>
Mesh<2> mesh_of(const Pslg& graph, const Options<2>& options, Extent extent = Extent::box,
                const mesher::RunControl& control = {}) {
  if constexpr (B == By::svr) {
    return mesher::svr(graph, options, extent, {}, nullptr, control);
  } else {
    return mesher::refine(graph, options, extent, {}, nullptr, control);
  }
}

Options<2> options_for(const Pslg& graph) {
  return {.domain = mesher::snapped_domain<2>(places_of(graph)), .max_vertices = 100000};
}

// What is wrong with a mesh of the graph, less what of it is not wanted.
std::string fault(const Mesh<2>& mesh, const Pslg& graph, Extent extent) {
  mesher::PslgFile file;
  file.pslg = graph;
  file.points.resize(graph.points.size());
  const auto kept = domain_mesh(mesh, graph, extent).kept;
  mesher::CheckOptions options;
  options.rho = 1.4142;
  options.graph = &file;
  options.features = &kept.features;
  options.boundary = mesher::BoundaryRule::lines;
  for (const mesher::Finding& f : check_mesh(kept, options)) {
    if (!f.holds) return f.property + ": " + f.detail;
  }
  return "";
}

FeatureId id(std::size_t i) { return FeatureId{static_cast<std::int64_t>(i + 1)}; }

Pslg graph_of(const std::vector<Point<2>>& points,
              const std::vector<std::pair<std::size_t, std::size_t>>& segments) {
  Pslg graph;
  for (const Point<2>& p : points) graph.points.push_back({id(graph.points.size()), p, 0});
  for (const auto& [a, b] : segments) {
    graph.segments.push_back({id(graph.segments.size()), id(a), id(b), 0});
  }
  return graph;
}

// A square of side 1, and one of side 1/4 in the middle.
Pslg frame() {
  return graph_of({{0, 0}, {1, 0}, {1, 1}, {0, 1}, {.375, .375}, {.625, .375}, {.625, .625},
                   {.375, .625}},
                  {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}});
}

// With other ids, and all in another order.
Pslg shuffled(const Pslg& graph) {
  std::mt19937_64 random(7);
  Pslg other = graph;
  const auto renamed = [](FeatureId& id) { id = FeatureId{9000 - 3 * static_cast<std::int64_t>(id)}; };
  std::shuffle(other.points.begin(), other.points.end(), random);
  std::shuffle(other.segments.begin(), other.segments.end(), random);
  for (auto& p : other.points) renamed(p.id);
  for (auto& s : other.segments) {
    std::swap(s.from, s.to);
    renamed(s.from), renamed(s.to);
  }
  return other;
}

struct Nobody {
  template <class... Edit>
  void insert(const Edit&...) {}
  template <class... Edit>
  void remove(const Edit&...) {}
  template <class... Edit>
  void insert_segment(const Edit&...) {}
  template <class... Edit>
  void remove_segment(const Edit&...) {}
};

using Family = support::PslgEditor::Family;
constexpr Family kFamilies[] = {Family::uniform, Family::lattice, Family::beside, Family::fan,
                                Family::wedge};

// Points at 10^-7 beside segments, and segments to them, ask for many vertices.
Options<2> random_options() {
  Options<2> options = support::PslgEditor::options();
  options.max_vertices = 40000;
  return options;
}

// In [0, 16]^2.
support::Pslg random_graph(Family family, std::uint64_t seed, int edits) {
  support::PslgEditor editor(family, seed);
  const mesher::detail::MeshBox<2> box =
      mesher::detail::mesh_box(support::PslgEditor::options());
  support::Pslg graph;
  Nobody nobody;
  for (int i = 0; i < edits; ++i) editor.edit(graph, box, nobody);
  return graph;
}

Pslg graph_of(const support::Pslg& random) {
  Pslg graph;
  for (const auto& [id, p] : random.points) graph.points.push_back({FeatureId{id}, p, 0});
  for (const auto& [ends, id] : random.segments) {
    graph.segments.push_back({FeatureId{id}, FeatureId{ends.first}, FeatureId{ends.second}, 0});
  }
  return graph;
}

std::size_t poor_ones(const Mesh<2>& mesh) {
  return static_cast<std::size_t>(
      std::count_if(mesh.simplices.begin(), mesh.simplices.end(), [&](const auto& t) {
        const auto at = [&](std::size_t i) { return mesh.vertices[t[i]]; };
        return mesher::radius_edge(at(0), at(1), at(2)) > 1.4142 * (1 + 1e-9);
      }));
}

// The error of a run: its code, its text, and the ids that it names.
struct Refusal {
  std::string code, text;
  std::vector<FeatureId> ids;
};
template <By B>
Refusal refusal(const Pslg& graph, const Options<2>& options, const mesher::RunControl& control = {}) {
  try {
    static_cast<void>(mesh_of<B>(graph, options, Extent::box, control));
  } catch (const mesher::Error& e) {
    return {std::string(mesher::code_name(e.code())), e.what(), e.ids()};
  }
  return {};
}

}  // namespace

namespace {

// `said`, if the mesh by gap-balls is as wrong about the same line; else nothing.
std::string cut_line(const Pslg& graph, const Options<2>& options, const std::string& said) {
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
      const Pslg graph = graph_of(random);
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

TEMPLATE_TEST_CASE_SIG("so it is of many random graphs, and of large and small ones, here and there",
                       "[soak]", ((By B), B), By::svr, By::refine) {
  int meshes = 0;
  for (std::uint64_t seed = 1; seed <= 2000; ++seed) {
    INFO("seed " << seed);
    std::mt19937_64 random(seed);
    const int edits = 20 + static_cast<int>(random() % 200);
    Pslg graph = graph_of(random_graph(kFamilies[seed % 5], seed, edits));
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
    const Pslg graph = mesher::generate_pslg({*mesher::pslg_kind(name), many ? 20u : 300u});
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
        const Pslg graph = mesher::generate_pslg({kind, legs, 1, angle});
        const Mesh<2> mesh = mesh_of<B>(graph, options_for(graph));
        CHECK(fault(mesh, graph, Extent::box) == "");
        CHECK(mesh.vertices.size() < 2000);
      }
    }
  }
}

TEMPLATE_TEST_CASE_SIG("at angles below double precision it ends, or names who is to blame", "",
                       ((By B), B), By::svr, By::refine) {
  const Pslg two = mesher::generate_pslg({PslgKind::fan, 2, 1, 1e-8});
  CHECK(fault(mesh_of<B>(two, options_for(two)), two, Extent::box) == "");
  int fine = 0, lost = 0;
  for (double angle = 1e-5; angle > 1e-10; angle *= 0.37) {
    for (const std::size_t legs : {2u, 3u, 6u, 12u}) {
      INFO(legs << " legs at " << angle);
      const Pslg graph = mesher::generate_pslg({PslgKind::fan, legs, 1, angle});
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
  CHECK(fine > 20);
  CHECK(lost > 5);
}

TEMPLATE_TEST_CASE_SIG("graphs of any size are meshed alike, if doubles hold them", "", ((By B), B),
                       By::svr, By::refine) {
  const Pslg graph = graph_of(random_graph(Family::wedge, 5, 120));
  const std::size_t vertices = mesh_of<B>(graph, options_for(graph)).vertices.size();
  for (const double scale : {0x1p-30, 0x1p-80, 0x1p30, 0x1p90}) {
    INFO(scale);
    Pslg scaled = graph;
    for (auto& p : scaled.points) p.at = {scale * p.at[0], scale * p.at[1]};
    const Mesh<2> mesh = mesh_of<B>(scaled, options_for(scaled));
    CHECK(mesh.vertices.size() == vertices);
    CHECK(fault(mesh, scaled, Extent::box) == "");
  }
  for (const double scale : {1e-9, 1e9}) {
    Pslg far = frame();
    for (auto& p : far.points) p.at = {scale * (1e6 + p.at[0]), scale * (p.at[1] - 1e6)};
    CHECK(fault(mesh_of<B>(far, options_for(far)), far, Extent::box) == "");
  }
}

TEMPLATE_TEST_CASE_SIG("a mesh of a graph depends on no order, and on no ids", "", ((By B), B),
                       By::svr, By::refine) {
  for (const Family family : kFamilies) {
    INFO("family " << static_cast<int>(family));
    const Pslg graph = graph_of(random_graph(family, 3, 150));
    Mesh<2> mesh = mesh_of<B>(graph, options_for(graph), Extent::enclosed);
    Mesh<2> other = mesh_of<B>(shuffled(graph), options_for(graph), Extent::enclosed);
    for (auto* m : {&mesh, &other}) {
      for (auto& e : m->edges) e.line = {};
    }
    CHECK(other == mesh);
  }
}

TEMPLATE_TEST_CASE_SIG("of a graph what is not wanted is not refined: the outside, and holes", "",
                       ((By B), B), By::svr, By::refine) {
  const Pslg lake = mesher::read_pslg(std::string(test_paths::kData) + "/great_lakes.poly").pslg;
  const Options<2> options = options_for(lake);
  const Mesh<2> all = mesh_of<B>(lake, options), enclosed = mesh_of<B>(lake, options, Extent::enclosed);
  CHECK(poor_ones(enclosed) > poor_ones(all) + 100);
  CHECK(enclosed.vertices.size() < 0.95 * static_cast<double>(all.vertices.size()));
  CHECK(fault(all, lake, Extent::box) == "");
  CHECK(fault(enclosed, lake, Extent::enclosed) == "");
  CHECK(static_cast<double>(all.vertices.size()) <
        1.15 * static_cast<double>(mesher::mesh_statically(lake, options).vertices.size()));

  Pslg graph = frame();  // with many points where the hole will be
  for (int i = 0; i < 40; ++i) {
    graph.points.push_back({FeatureId{100 + i}, {0.5 + 1e-4 * std::pow(1.1, i), 0.5}, 0});
  }
  const Mesh<2> filled = mesh_of<B>(graph, options_for(graph), Extent::enclosed);
  graph.holes.push_back({id(0), {0.45, 0.55}});
  const Mesh<2> holed = mesh_of<B>(graph, options_for(graph), Extent::enclosed);
  CHECK(holed.vertices.size() < filled.vertices.size());
  CHECK(fault(holed, graph, Extent::enclosed) == "");
  for (const Point<2>& p : {Point<2>{.375, .5}, Point<2>{.375, .375}, Point<2>{50, 50}}) {
    graph.holes[0].seed = p;  // on a segment, on its end, in no region
    CHECK(mesh_of<B>(graph, options_for(graph), Extent::enclosed) == filled);
  }
  const Pslg open = graph_of({{0, 0}, {1, 0}, {1, 1}}, {{0, 1}, {1, 2}});  // then all is wanted
  CHECK(mesh_of<B>(open, options_for(open), Extent::enclosed) == mesh_of<B>(open, options_for(open)));
}

TEMPLATE_TEST_CASE_SIG("a graph without segments has the mesh of its points", "", ((By B), B),
                       By::svr, By::refine) {
  Pslg graph = frame();
  graph.segments.clear();
  const auto points = places_of(graph);
  const Options<2> options = options_for(graph);
  CHECK(mesh_of<B>(graph, options) ==
        (B == By::svr ? mesher::svr<2>(points, options) : mesher::refine<2>(points, options)));
  CHECK(mesh_of<B>(Pslg(), options) ==
        (B == By::svr ? mesher::svr<2>({}, options) : mesher::refine<2>({}, options)));
}

TEMPLATE_TEST_CASE_SIG("graphs that cannot be meshed are refused, by name", "", ((By B), B), By::svr,
                       By::refine) {
  const Pslg graph = frame();
  const auto changed = [&](auto&& change) {
    Options<2> options = options_for(graph);
    change(options);
    return refusal<B>(graph, options).code;
  };
  CHECK(changed([](auto& o) { o.rho = 1.41; }) == "bad_option");
  CHECK(changed([](auto& o) { o.rho = std::nan(""); }) == "bad_option");
  CHECK(changed([](auto& o) { o.max_measure = 1; }) == "bad_option");
  CHECK(changed([](auto& o) { o.rule = mesher::Rule::voronoi_aspect; }) == "bad_option");
  CHECK(changed([](auto& o) { o.domain = {{0, 0}, {0.5, 1}}; }) == "outside_domain");
  const auto edited = [&](auto&& edit) {
    Pslg bad = graph;
    edit(bad);
    return refusal<B>(bad, options_for(graph));
  };
  const auto add = [](Pslg& g, std::size_t a, std::size_t b) {
    g.segments.push_back({FeatureId{77}, id(a), id(b), 0});
  };
  const Refusal crossing = edited([&](Pslg& g) { add(g, 0, 2); });
  CHECK(crossing.code == "point_on_segment");
  CHECK(crossing.ids.size() == 2);
  CHECK(edited([&](Pslg& g) { add(g, 3, 4), add(g, 0, 7), g.segments.back().id = id(77); }).code ==
        "crossing_segments");
  CHECK(edited([&](Pslg& g) { add(g, 0, 1); }).code == "repeated_segment");
  CHECK(edited([&](Pslg& g) { add(g, 0, 99); }).code == "unknown_id");
  CHECK(edited([&](Pslg& g) { add(g, 3, 3); }).code == "zero_length");
  const Pslg bundle = mesher::generate_pslg({PslgKind::bundle, 8, 1, 1.0});
  Options<2> few = options_for(bundle);
  few.max_vertices = 300;
  const Refusal too_many = refusal<B>(bundle, few);
  CHECK(too_many.code == "too_many");
  CHECK(too_many.ids.size() == 2);
  std::stop_source stop;
  stop.request_stop();
  CHECK(refusal<B>(graph, options_for(graph), {.progress = {}, .stop = stop.get_token()}).code ==
        "cancelled");
}

TEMPLATE_TEST_CASE_SIG("without memory a mesh of a graph fails, and nothing is lost", "",
                       ((By B), B), By::svr, By::refine) {
  const Pslg graph = frame();
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
  const Pslg graph = mesher::generate_pslg({PslgKind::segments, 200});
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
