// The interface that users meet: one graph, one mesh(), one Mesher, ids with types.
#include <catch2/catch.hpp>
#include <concepts>
#include <filesystem>
#include <fstream>
#include <limits>
#include <type_traits>

#include "handle_an_error.hpp"
#include "mesh_a_file.hpp"
#include "mesher/all.hpp"
#include "mesher/extra/generate.hpp"
#include "snippets.hpp"
#include "test_paths.hpp"

namespace {

using namespace mesher;

// --- What does not compile -------------------------------------------------------------------

template <class M>
concept TakesPolygons = requires(M& m, const Polygon& f) {
  m.insert_polygon(f);
};
template <class M>
concept RemovesPolygons = requires(M& m) {
  m.remove_polygon(PolygonId{});
};
template <class G>
concept HasPolygons = requires(G& g) {
  g.polygons;
};
template <class M, class Id>
concept Moves = requires(M& m, Id id) {
  m.move(id, {});
};
template <class M, class Id>
concept RemovesLine = requires(M& m, Id id) {
  m.remove_line(id);
};
template <class O>
concept BoundsDihedrals = requires(O& o) {
  o.min_dihedral = 5.0;
};
template <class O>
concept IsConstrained = requires(O& o) {
  o.constrained = true;
};
template <class O>
concept ChecksTies = requires(O& o) {
  o.ties = true;
};

static_assert(TakesPolygons<Mesher<3>> && !TakesPolygons<Mesher<2>>);
static_assert(RemovesPolygons<Mesher<3>> && !RemovesPolygons<Mesher<2>>);
static_assert(HasPolygons<Graph<3>> && !HasPolygons<Graph<2>>);
static_assert(BoundsDihedrals<Options<3>> && !BoundsDihedrals<Options<2>>);
static_assert(IsConstrained<CheckOptions<2>> && !IsConstrained<CheckOptions<3>>);
static_assert(ChecksTies<CheckOptions<3>> && !ChecksTies<CheckOptions<2>>);

static_assert(Moves<Mesher<2>, PointId> && !Moves<Mesher<2>, LineId>);
static_assert(!Moves<Mesher<2>, int> && !Moves<Mesher<2>, PolygonId>);
static_assert(RemovesLine<Mesher<3>, LineId> && !RemovesLine<Mesher<3>, PointId>);
static_assert(!std::is_convertible_v<PointId, LineId> && !std::is_convertible_v<LineId, PointId>);
static_assert(!std::is_convertible_v<std::int64_t, PointId>);
static_assert(!std::equality_comparable_with<PointId, LineId>);
static_assert(!std::equality_comparable_with<LineId, PolygonId>);
static_assert(std::is_convertible_v<PointId, Feature> && std::is_convertible_v<SeedId, Feature>);
static_assert(!std::is_convertible_v<Feature, PointId>);

// --- Graphs ----------------------------------------------------------------------------------

Graph<2> square() {
  Graph<2> graph;
  const std::vector<Point<2>> corners{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  for (std::int64_t i = 0; i < 4; ++i) {
    graph.points.push_back({PointId{i}, corners[static_cast<std::size_t>(i)]});
  }
  graph.polylines.push_back(
      {LineId{1}, {PointId{0}, PointId{1}, PointId{2}, PointId{3}, PointId{0}}, 5});
  graph.points.push_back({PointId{10}, {0.4, 0.45}});
  graph.points.push_back({PointId{11}, {0.7, 0.55}});
  graph.segments.push_back({LineId{2}, PointId{10}, PointId{11}});
  graph.seeds.push_back(region_seed<2>(1, {0.1, 0.1}, 7));
  return graph;
}

Graph<3> box() {
  Graph<3> graph;
  for (std::int64_t i = 0; i < 8; ++i) {
    graph.points.push_back({PointId{i}, {double(i & 1), double(i >> 1 & 1), double(i >> 2 & 1)}});
  }
  const std::int64_t sides[6][4] = {{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                    {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}};
  for (std::int64_t i = 0; i < 6; ++i) {
    Polygon side{.id = PolygonId{i}, .loops = {{}}, .marker = i + 1};
    for (const std::int64_t corner : sides[i]) side.loops[0].push_back(PointId{corner});
    graph.polygons.push_back(side);
  }
  graph.points.push_back({PointId{20}, {0.3, 0.4, 0.5}});
  graph.points.push_back({PointId{21}, {0.6, 0.5, 0.45}});
  graph.points.push_back({PointId{22}, {0.7, 0.3, 0.6}});
  graph.polylines.push_back({LineId{3}, {PointId{20}, PointId{21}, PointId{22}}, 9});
  return graph;
}

template <int D>
void require_good(const Meshed<D>& made, const Graph<D>& graph, double rho) {
  GraphFile<D> file;
  file.graph = graph;
  CheckOptions<D> options;
  options.graph = &file;
  options.features = &made.mesh.features;
  options.rho = rho;
  options.boundary = BoundaryRule::lines;
  for (const Finding& f : check_mesh(made.mesh, options)) {
    INFO(f.property << ": " << f.detail);
    CHECK(f.holds);
  }
}

TEST_CASE("mesh() of a square, by every algorithm") {
  const Graph<2> graph = square();
  for (const Algorithm a :
       {Algorithm::automatic, Algorithm::refine, Algorithm::svr, Algorithm::gap_balls}) {
    const auto made = mesh(graph, {.algorithm = a});
    INFO(name_of(a));
    CHECK(made.report.algorithm == (a == Algorithm::automatic ? Algorithm::refine : a));
    CHECK_FALSE(made.report.gave_up);
    CHECK_FALSE(made.keeps_all);
    CHECK(made.faults.empty());
    REQUIRE(made.mesh.features.regions.size() == made.mesh.simplices.size());
    CHECK(made.mesh.features.regions[0] == 7);
    require_good(made, graph, 1.4142);
  }
}

TEST_CASE("where svr gives up, refine is next") {
  const Graph<3> graph = generate_plc({PlcKind::shells});
  const auto in_box = [&](Algorithm a) {
    return box_mesh(graph, Options<3>{.algorithm = a}).vertices.size();
  };
  const std::size_t by_svr = in_box(Algorithm::svr), by_refine = in_box(Algorithm::refine);
  REQUIRE(by_refine < by_svr);
  const auto made = mesh(graph, Options<3>{.max_vertices = (by_svr + by_refine) / 2});
  CHECK(made.report.tried == Algorithm::svr);
  REQUIRE(made.report.gave_up);
  CHECK(made.report.gave_up->code() == ErrorCode::too_many);
  CHECK(made.report.algorithm == Algorithm::refine);
  require_good(made, graph, 2);
}

TEST_CASE("mesh() of a box with a polyline in it, by every algorithm") {
  const Graph<3> graph = box();
  for (const Algorithm a :
       {Algorithm::automatic, Algorithm::refine, Algorithm::svr, Algorithm::gap_balls}) {
    const auto made = mesh(graph, {.algorithm = a});
    INFO(name_of(a));
    CHECK(made.report.algorithm == (a == Algorithm::automatic ? Algorithm::svr : a));
    require_good(made, graph, 2);
    bool on_line = false;
    for (const MeshEdge& e : made.mesh.features.edges) {
      on_line = on_line || (e.line == LineId{3} && e.marker == 9);
    }
    CHECK(on_line);
  }
}

TEST_CASE("mesh() chooses gap-balls for what others do not know") {
  Graph<2> graph = square();
  CHECK(mesh(graph, {.rho = 1.2}).report.algorithm == Algorithm::gap_balls);
  CHECK(mesh(graph, {.max_measure = 0.01}).report.algorithm == Algorithm::refine);
  CHECK(mesh(graph, {.max_measure = 0.01, .growth = 2}).report.algorithm == Algorithm::refine);
}

TEST_CASE("min_angle stands for rho") {
  const Graph<2> graph = square();
  const auto made = mesh(graph, {.min_angle = 28});
  CHECK(quality(made.mesh).min_angle_deg >= 28);
  CHECK(made.mesh == mesh(graph, {.rho = radius_edge_bound(Options<2>{.min_angle = 28})}).mesh);
  CHECK_THROWS_AS(mesh(graph, {.min_angle = 30}), Error);
  CHECK_THROWS_AS(mesh(graph, {.min_angle = -1}), Error);
  CHECK_THROWS_AS(Mesher<2>({.domain = {{0, 0}, {1, 1}}, .min_angle = 29.7}), Error);
  CHECK(Mesher<2>({.domain = {{0, 0}, {1, 1}}, .min_angle = 20}).options().rho ==
        Approx(1.4619).epsilon(1e-4));
}

TEST_CASE("region areas are limits if asked for") {
  Graph<2> graph = square();
  graph.seeds[0].max_measure = 0.001;
  const auto without = mesh(graph, {});
  const auto with = mesh(graph, {.region_areas = RegionAreas::limits});
  CHECK(with.report.algorithm == Algorithm::refine);
  CHECK(with.mesh.simplices.size() > 1000);
  CHECK(without.mesh.simplices.size() < 200);
}

template <int D>
void require_followed(const Graph<D>& graph, const Options<D>& options) {
  Mesher<D> m(options);
  m.insert(graph);
  m.update();
  const auto made = mesh(m.input(), m.options());
  CHECK(made.report.algorithm == Algorithm::gap_balls);
  CHECK(m.mesh() == made.mesh);
  CHECK(m.mesh().features == made.mesh.features);
  m.check_invariants();
}

TEST_CASE("a Mesher has the mesh that mesh() makes of its input and options") {
  for (const Extent extent : {Extent::enclosed, Extent::box}) {
    require_followed<2>(square(), {.domain = {{0, 0}, {1, 1}}, .extent = extent});
    require_followed<3>(box(), {.domain = {{0, 0, 0}, {1, 1, 1}}, .extent = extent});
  }
  require_followed<2>(square(), {.domain = {{0, 0}, {1, 1}}, .max_measure = 0.01, .min_angle = 22});
}

TEST_CASE("a Mesher takes a graph as a whole, or nothing") {
  Graph<2> graph = square();
  Mesher<2> m({.domain = {{0, 0}, {1, 1}}});
  m.insert(graph);
  m.update();
  const auto before = m.mesh();
  Graph<2> more;
  more.points = {{PointId{30}, {0.2, 0.8}}, {PointId{10}, {0.3, 0.8}}};  // the second is there
  CHECK_THROWS_AS(m.insert(more), Error);
  CHECK_FALSE(m.contains(PointId{30}));
  m.update();
  CHECK(m.mesh() == before);
  CHECK(m.contains(PointId{10}));
  CHECK(m.contains(LineId{1}));
  CHECK_FALSE(m.contains(LineId{10}));
  CHECK(m.contains(region_id(1)));
  CHECK_FALSE(m.contains(hole_id(1)));
}

TEST_CASE("a Mesher keeps the mesh of gap-balls alone") {
  CHECK_THROWS_AS(Mesher<2>({.domain = {{0, 0}, {1, 1}}, .algorithm = Algorithm::svr}), Error);
}

TEST_CASE("read_any reads either dimension") {
  const auto plane = read_any(std::string(test_paths::kData) + "/great_lakes.poly");
  REQUIRE(std::holds_alternative<GraphFile<2>>(plane));
}

TEST_CASE("features say which kind they are") {
  const Feature line = LineId{3};
  CHECK(line.line() == LineId{3});
  CHECK_FALSE(line.point());
  CHECK(text_of(line) == "segment 3");
  CHECK(Feature(hole_id(2)).seed() == hole_id(2));
  CHECK(text_of(region_id(4)) == "region 4");
  CHECK(text_of(Feature()) == "");
}

template <int D>
void require_refused(const Graph<D>& graph, ErrorCode code, const Feature& to_blame) {
  for (const Algorithm a :
       {Algorithm::automatic, Algorithm::refine, Algorithm::svr, Algorithm::gap_balls}) {
    INFO(name_of(a) << ", " << code_name(code));
    try {
      static_cast<void>(mesh(graph, {.algorithm = a}));
      FAIL_CHECK("nothing is refused");
    } catch (const Error& error) {
      CHECK(error.code() == code);
      REQUIRE_FALSE(error.features().empty());
      CHECK(error.features()[0] == to_blame);
    }
  }
}

TEST_CASE("mesh() refuses graphs whose ids or places are wrong, by every algorithm") {
  Graph<2> graph = square();
  graph.points.push_back({PointId{2}, {0.5, 0.7}});
  require_refused(graph, ErrorCode::repeated_id, PointId{2});
  graph = square();
  graph.segments.push_back({LineId{1}, PointId{10}, PointId{2}});  // the polyline's
  require_refused(graph, ErrorCode::repeated_id, LineId{1});
  graph = square();
  graph.polylines.push_back({LineId{9}, {PointId{10}}});
  require_refused(graph, ErrorCode::bad_option, LineId{9});
  graph = square();
  graph.segments.push_back({LineId{9}, PointId{10}, PointId{77}});
  require_refused(graph, ErrorCode::unknown_id, LineId{9});
  graph = square();
  graph.seeds.push_back(region_seed<2>(1, {0.5, 0.2}));
  require_refused(graph, ErrorCode::repeated_id, region_id(1));
  graph = square();
  graph.points.push_back({PointId{9}, {1e200, 0}});
  require_refused(graph, ErrorCode::magnitude, PointId{9});
  graph.points.back().at[0] = std::numeric_limits<double>::quiet_NaN();
  require_refused(graph, ErrorCode::not_finite, PointId{9});
  Graph<3> complex = box();
  complex.polygons.push_back(complex.polygons[2]);
  require_refused(complex, ErrorCode::repeated_id, PolygonId{2});
}

TEST_CASE("a Mesher's options do for another graph: its limits in regions are its own") {
  Graph<2> graph = square();
  graph.seeds[0].max_measure = 0.01;
  Mesher<2> m({.domain = {{0, 0}, {2, 2}}, .region_areas = RegionAreas::limits});
  m.insert(graph);
  m.update();
  Graph<2> other = graph;
  for (auto& p : other.points) p.at = {p.at[0] / 2 + 1.2, p.at[1] / 2 + 1.2};
  other.seeds[0].at = {1.25, 1.25};
  Options<2> fresh{.domain = {{0, 0}, {2, 2}}, .region_areas = RegionAreas::limits};
  fresh.algorithm = Algorithm::gap_balls;
  CHECK(mesh(other, m.options()).mesh == mesh(other, fresh).mesh);
  m.remove_line(LineId{1});  // now nothing is enclosed
  m.update();
  CHECK(m.mesh() == mesh(m.input(), m.options()).mesh);
}

TEST_CASE("a polygon that comes back under another marker changes that alone") {
  Mesher<3> m({.domain = {{0, 0, 0}, {1, 1, 1}}});
  m.insert(box());
  m.update();
  Polygon side = box().polygons[0];
  side.marker = 77;
  m.remove_polygon(side.id);
  m.insert_polygon(side);
  const auto change = m.update();
  CHECK(change.simplices_added.empty());
  CHECK(change.faces_added.empty());
  CHECK(m.input().polygons[0] == side);
  CHECK(m.mesh().features == mesh(m.input(), m.options()).mesh.features);
}

TEST_CASE("features of a graph that is of no file stand nowhere") {
  GraphFile<2> file;
  file.graph = square();
  for (const Feature f : {Feature(PointId{10}), Feature(LineId{1}), Feature(LineId{2}),
                          Feature(LineId{99}), Feature(region_id(1)), Feature(PolygonId{1})}) {
    CHECK(location_of(f, file).line == 0);
  }
  const Error error =
      located(Error(ErrorCode::crossing_segments, "they cross", {}, {LineId{1}, LineId{2}}), file);
  CHECK(error.location().line == 0);
}

// --- A stranger's programs -------------------------------------------------------------------

TEST_CASE("the README's program meshes a file") {
  const auto folder = std::filesystem::temp_directory_path() / "mesher_interface_test";
  std::filesystem::create_directories(folder);
  const std::string output = (folder / "lake.vtu").string();
  example::mesh_a_file(std::string(test_paths::kData) + "/great_lakes.poly", output);
  const MeshData<2> mesh = read_mesh<2>(output);
  CheckOptions<2> options;  // small angles between shores are excused
  options.features = &mesh.features;
  options.rho = radius_edge_bound(Options<2>{.min_angle = 28});
  options.boundary = BoundaryRule::lines;
  for (const Finding& f : check_mesh(mesh, options)) {
    INFO(f.property << ": " << f.detail);
    CHECK(f.holds);
  }
  std::filesystem::remove_all(folder);
  CHECK(support::is_mesher_snippet("README.md",
                                   "inline void mesh_a_file(const std::string& input, "
                                   "const std::string& output) {",
                                   "examples/mesh_a_file.hpp"));
}

TEST_CASE("the README's program handles an error by its features") {
  const auto folder = std::filesystem::temp_directory_path() / "mesher_interface_error_test";
  std::filesystem::create_directories(folder);
  const std::string path = (folder / "roads.poly").string();
  std::ofstream(path) << "4 2 0 0\n1 0 0\n2 1 1\n3 0 1\n4 1 0\n2\n7 1 2\n9 3 4\n0\n";
  CHECK(example::lines_to_mark(path) == std::vector<LineId>{LineId{7}, LineId{9}});
  std::filesystem::remove_all(folder);
  CHECK(support::is_mesher_snippet(
      "README.md", "// The lines of a file that keep it from being meshed; none if nothing does.",
      "examples/handle_an_error.hpp"));
}

}  // namespace
