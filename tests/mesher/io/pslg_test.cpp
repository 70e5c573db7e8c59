// Graphs of points and lines: what each format says, what is refused and where, and that what is
// written reads back equal.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <map>

#include "facade/graph_runs.hpp"
#include "feature_ids.hpp"
#include "mesher/extra/generate.hpp"
#include "mesher/graph.hpp"
#include "mesher/meshing.hpp"
#include "mesher/predicates.hpp"
#include "mesher/read.hpp"
#include "mesher/write.hpp"
#include "scratch_file.hpp"

namespace {

using mesher::Graph;
using mesher::GraphFile;
using mesher::Point;
using mesher::PointId;
using mesher::region_seed;
using support::error_of;
using support::failure_of;
using support::id;
using support::ids;
using support::ScratchFolder;

GraphFile<2> read(const std::string& name, const std::string& content) {
  const ScratchFolder folder;
  return mesher::read<2>(folder.write(name, content));
}

std::vector<std::string> notes_of(const GraphFile<2>& file) {
  std::vector<std::string> texts;
  for (const auto& note : file.notes) texts.push_back(note.text);
  return texts;
}

struct Refused {
  const char* name;
  const char* content;
  const char* failure;  // code@line:column
};

std::string geometry(const std::string& type, const std::string& coordinates) {
  return "{\"type\": \"" + type + "\", \"coordinates\": " + coordinates + "}";
}

// Random and valid: any ids, markers, attributes, holes and regions; coordinates of any magnitude.
Graph<2> random_pslg(mesher::SplitMix64& random) {
  const auto coordinate = [&] {
    const int exponent = static_cast<int>(random.below(200)) - 100;
    const double x = std::ldexp(1 + random.unit(), exponent);
    return random.below(8) == 0 ? 0.0 : random.below(2) == 0 ? x : -x;
  };
  const auto integer = [&] { return static_cast<std::int64_t>(random.bits()) >> random.below(64); };
  const auto maybe_marker = [&] { return random.below(2) == 0 ? 0 : integer(); };
  const auto shuffled_ids = [&](std::size_t n) {
    const std::int64_t first = integer() / 2, step = 1 + static_cast<std::int64_t>(random.below(3));
    std::vector<AnyId> all;
    for (std::size_t i = 0; i < n; ++i) all.push_back(id(first + step * static_cast<int>(i)));
    for (std::size_t i = n; i > 1; --i) std::swap(all[i - 1], all[random.below(i)]);
    return all;
  };
  Graph<2> pslg;
  pslg.attributes_per_point = random.below(3);
  for (const AnyId point : shuffled_ids(2 + random.below(20))) {
    pslg.points.push_back({point, {coordinate(), coordinate()}, maybe_marker()});
    for (std::size_t k = 0; k < pslg.attributes_per_point; ++k) {
      pslg.attributes.push_back(coordinate());
    }
  }
  const auto any_point = [&] { return pslg.points[random.below(pslg.points.size())].id; };
  for (const AnyId s : shuffled_ids(random.below(20))) {
    pslg.segments.push_back({s, any_point(), any_point(), maybe_marker()});
  }
  for (const AnyId h : shuffled_ids(random.below(3))) {
    pslg.seeds.push_back({mesher::hole_id(h.number), {coordinate(), coordinate()}});
  }
  for (const AnyId r : shuffled_ids(random.below(3))) {
    const bool limited = random.below(2) == 0;
    pslg.seeds.push_back({mesher::region_id(r.number),
                          {coordinate(), coordinate()},
                          coordinate(),
                          limited ? std::optional(1 + random.unit()) : std::nullopt});
  }
  return pslg;
}

}  // namespace

TEST_CASE("a .poly file is read with markers, attributes, holes, regions, comments and any ids") {
  const auto file = read("a.poly",
                         "# a square with a hole\r\n"
                         "4 2 1 1 # points\n"
                         "0 0 0 0.5 7\n"
                         "-1 4 0 1.5 8  # corner\n"
                         "\n"
                         "2 4 4 2.5 -9\n"
                         "3 -0 4 3.5 0\n"
                         "2 1\n"
                         "0 0 -1 5\n"
                         "1 -1 2 0\n"
                         "1 # hole\n"
                         "9 1 1\n"
                         "3\n"
                         "0 2 2 17 0.25\n"
                         "1 3 3 -2.5 -1\n"
                         "2 3 1 4\n");
  const Graph<2>& pslg = file.graph;
  CHECK(pslg.points ==
        std::vector<mesher::GraphPoint<2>>{
            {id(0), {0, 0}, 7}, {id(-1), {4, 0}, 8}, {id(2), {4, 4}, -9}, {id(3), {0, 4}, 0}});
  CHECK_FALSE(std::signbit(pslg.points[3].at[0]));
  CHECK(pslg.attributes_per_point == 1);
  CHECK(pslg.attributes == std::vector<double>{0.5, 1.5, 2.5, 3.5});
  CHECK(pslg.segments ==
        std::vector<mesher::Segment>{{id(0), id(0), id(-1), 5}, {id(1), id(-1), id(2), 0}});
  CHECK(pslg.holes() == std::vector{mesher::hole_seed<2>(9, {1, 1})});
  CHECK(pslg.regions() == std::vector{region_seed<2>(0, {2, 2}, 17, 0.25),
                                      region_seed<2>(1, {3, 3}, -2.5),
                                      region_seed<2>(2, {3, 1}, 4)});
  CHECK(file.location_of_point(1).line == 4);
  CHECK(file.location_of_segment(1).line == 10);
  CHECK(file.location_of_seed(0).line == 12);
  CHECK(file.location_of_seed(3).line == 16);
  REQUIRE(file.notes.size() == 1);
  CHECK(file.notes[0].location.line == 16);
  CHECK(file.notes[0].location.column == 7);
}

TEST_CASE("a .poly file without points takes those of the .node file beside it") {
  const ScratchFolder folder;
  folder.write("a.node", "2 2 0 1\n7 1 2 3\n8 4 5 6\n");
  const auto file = mesher::read<2>(folder.write("a.poly", "0 2 0 1\n1 0\n1 7 8\n0\n"));
  CHECK(file.graph.points ==
        std::vector<mesher::GraphPoint<2>>{{id(7), {1, 2}, 3}, {id(8), {4, 5}, 6}});
  CHECK(file.location_of_point(1).file == folder.path("a.node"));
  CHECK(file.location_of_segment(0).file == folder.path("a.poly"));
  folder.write("a.node", "2 2 0 1\n7 1 2 3\n8 4 x 6\n");
  CHECK(error_of([&] { (void)mesher::read<2>(folder.path("a.poly")); }).location().file ==
        folder.path("a.node"));
}

TEST_CASE("markers of a .node file's points are read, and written at the vertices that they are") {
  const ScratchFolder folder;
  const auto file =
      mesher::read<2>(folder.write("a.node",
                                   "4 2 1 1\n1 0.25 0.25 9 5\n2 0.75 0.25 9 0\n3 0.5 0.75 9 -7\n"
                                   "4 0.5 0.25 9 12\n"));
  const Graph<2>& g = file.graph;
  CHECK(g.points == std::vector<mesher::GraphPoint<2>>{{id(1), {0.25, 0.25}, 5},
                                                       {id(2), {0.75, 0.25}, 0},
                                                       {id(3), {0.5, 0.75}, -7},
                                                       {id(4), {0.5, 0.25}, 12}});
  CHECK(file.location_of_point(2).line == 4);
  const mesher::Options<2> options{.domain = {{0, 0}, {1, 1}}};
  const auto mesh = domain_mesh(mesh_statically(g, options), g, mesher::Extent::box).mesh;
  mesher::write_mesh(mesh, folder.path("b.node"));
  const auto again = mesher::read_mesh(folder.path("b.node"));
  REQUIRE(again.vertices == mesh.vertices);
  std::map<Point<2>, std::int64_t> markers;
  for (std::size_t v = 0; v < again.vertices.size(); ++v) {
    if (again.kinds[v] == mesher::VertexKind::input) {
      markers[again.vertices[v]] = again.features.markers[v];
    }
  }
  REQUIRE(markers.size() == g.points.size());
  for (const auto& p : g.points) CHECK(markers.at(p.at) == p.marker);
  CHECK(support::failure_of([&] {
          (void)mesher::read<2>(folder.write("c.node", "1 2 0 1\n1 0.5 0.5 x\n"));
        }) == "bad_number@2:11");
}

TEST_CASE("a bad .poly file is refused with the code and the place of the mistake") {
  const Refused refused = GENERATE(values<Refused>({
      {"a.poly", "", "truncated@0:0"},
      {"a.poly", "1 2 0 0\n1 0 0\n", "truncated@2:6"},
      {"a.poly", "1 2 0 0\n1 0 0\n0 0\n", "truncated@3:4"},
      {"a.poly", "2 2 0 0\n1 0 0\n", "truncated@2:6"},
      {"a.poly", "2 2 0 0\n1 0 0\n0 0\n0\n", "wrong_count@3:4"},
      {"a.poly", "1 3 0 0\n1 0 0 0\n0 0\n0\n", "bad_dimension@1:3"},
      {"a.poly", "1 2 1 0\n1 0 0 x\n0 0\n0\n", "bad_number@2:7"},
      {"a.poly", "1 2 1 0\n1 0 0 inf\n0 0\n0\n", "not_finite@2:7"},
      {"a.poly", "1 2 0 1\n1 0 0 1.5\n0 0\n0\n", "bad_number@2:7"},
      {"a.poly", "1 2 0 0\n1 0 1e31\n0 0\n0\n", "magnitude@2:5"},
      {"a.poly", "2 2 0 0\n1 0 0\n1 1 0\n0 0\n0\n", "repeated_id@3:1"},
      {"a.poly", "2 2 0 0\n1 0 0\n2 1 0\n1 0\n1 1\n0\n", "wrong_count@5:4"},
      {"a.poly", "2 2 0 0\n1 0 0\n2 1 0\n1 0\n1 1 2 3\n0\n", "wrong_count@5:7"},
      {"a.poly", "2 2 0 0\n1 0 0\n2 1 0\n1 1\n1 1 2\n0\n", "wrong_count@5:6"},
      {"a.poly", "2 2 0 0\n1 0 0\n2 1 0\n1 2\n1 1 2 3\n0\n", "bad_header@4:3"},
      {"a.poly", "2 2 0 0\n1 0 0\n2 1 0\n1 0 0\n1 1 2\n0\n", "bad_header@4:5"},
      {"a.poly", "2 2 0 0\n1 0 0\n2 1 0\n1 0\n1 1 3\n0\n", "unknown_id@5:1"},
      {"a.poly", "2 2 0 0\n1 0 0\n2 1 0\n2 0\n4 1 2\n4 2 1\n0\n", "repeated_id@6:1"},
      {"a.poly", "2 2 0 0\n1 0 0\n2 1 0\n-1 0\n0\n", "bad_header@4:1"},
      {"a.poly", "2 2 0 0\n1 0 0\n2 1 0\n9000000000000000000 0\n1 1 2\n", "truncated@5:6"},
      {"a.poly", "0 2 0 0\n1 0\n1 1 2\n0\n", "unknown_id@3:1"},
      {"a.poly", "1 2 0 0\n1 0 0\n0 0\n1\n1 0\n", "truncated@5:4"},
      {"a.poly", "1 2 0 0\n1 0 0\n0 0\n2\n1 0 0\n1 1 1\n", "repeated_id@6:1"},
      {"a.poly", "1 2 0 0\n1 0 0\n0 0\n1\n1 0 nan\n", "not_finite@5:5"},
      {"a.poly", "1 2 0 0\n1 0 0\n0 0\n0\n1\n1 0 0\n", "truncated@6:6"},
      {"a.poly", "1 2 0 0\n1 0 0\n0 0\n0\n1\n1 0 0 x 1\n", "bad_number@6:7"},
      {"a.poly", "1 2 0 0\n1 0 0\n0 0\n0\n1\n1 0 0 1 1 1\n", "wrong_count@6:11"},
      {"a.poly", "1 2 0 0\n1 0 0\n0 0\n0\n0\n1 0 0 1 1\n", "wrong_count@6:1"},
      {"a.poly", "1 2 0 0\n1 0 0\n0 0\n0\n2\n5 0 0 1 1\n5 0 0 2 1\n", "repeated_id@7:1"},
      {"a.dxf", "", "unknown_format@0:0"},
  }));
  INFO(refused.content);
  CHECK(failure_of([&] { (void)read(refused.name, refused.content); }) == refused.failure);
}

TEST_CASE("an end that is no point is an error with the ids of the segment and the point") {
  const ScratchFolder folder;
  const auto path = folder.write("a.poly", "2 2 0 0\n1 0 0\n2 1 0\n1 0\n7 1 3\n0\n");
  const auto error = error_of([&] { (void)mesher::read<2>(path); });
  CHECK(support::ids_of(error) == ids({7, 3}));
  CHECK(error.what() == path +
                            ":5:1: error[unknown_id]: segment 7 ends at point 3, which is not "
                            "there; there are 2 points in " +
                            path);
  const auto alone = folder.write("b.poly", "0 2 0 0\n1 0\n7 1 3\n0\n");
  const auto no_points = error_of([&] { (void)mesher::read<2>(alone); });
  CHECK(no_points.message().ends_with("there are 0 points in " + alone +
                                      ", and no .node file beside it"));
}

TEST_CASE("random graphs written as .poly read back equal, to the last bit") {
  const ScratchFolder folder;
  const std::uint64_t seed = GENERATE(1, 2, 3);
  mesher::SplitMix64 random(seed);
  for (int round = 0; round < 300; ++round) {
    INFO("seed " << seed << ", round " << round);
    const Graph<2> pslg = random_pslg(random);
    mesher::write_graph(pslg, folder.path("a.poly"));
    REQUIRE(mesher::read<2>(folder.path("a.poly")).graph == pslg);
  }
}

TEST_CASE("the pieces of polylines become segments of a .poly file") {
  const ScratchFolder folder;
  Graph<2> pslg;
  pslg.points = {{id(5), {0, 0}, 0}, {id(6), {1, 0}, 0}, {id(7), {1, 1}, 0}};
  pslg.segments = {{id(2), id(5), id(6), 0}};
  pslg.polylines = {{id(9), ids({6, 7, 5}), 4}};
  mesher::write_graph(pslg, folder.path("a.poly"));
  CHECK(mesher::read<2>(folder.path("a.poly")).graph.segments ==
        std::vector<mesher::Segment>{
            {id(2), id(5), id(6), 0}, {id(10), id(6), id(7), 4}, {id(11), id(7), id(5), 4}});
}

TEST_CASE("an .obj file is read with lines of any length, and ids counted from either end") {
  const auto file = read("a.obj",
                         "# made by hand\n"
                         "mtllib a.mtl\n"
                         "o outline\n"
                         "v 0 0 2.5\n"
                         "v 1 0 2.5 0.1 0.2 0.3\n"
                         "v 1 1 2.5\n"
                         "l 1 2\n"
                         "l -3 2/7 3 1\n"
                         "p 3\n");
  CHECK(file.graph.points == std::vector<mesher::GraphPoint<2>>{
                                 {id(1), {0, 0}, 0}, {id(2), {1, 0}, 0}, {id(3), {1, 1}, 0}});
  CHECK(file.graph.segments == std::vector<mesher::Segment>{{id(1), id(1), id(2), 0}});
  CHECK(file.graph.polylines == std::vector<mesher::Polyline>{{id(2), ids({1, 2, 3, 1}), 0}});
  CHECK(file.location_of_polyline(0).line == 8);
  CHECK(notes_of(file) == std::vector<std::string>{
                              "the statement 'mtllib' is not used", "the statement 'o' is not used",
                              "a weight or colour is not used", "a texture or normal is not used"});
}

TEST_CASE("a bad .obj file of lines is refused with the code and the place of the mistake") {
  const Refused refused = GENERATE(values<Refused>({
      {"a.obj", "v 0 0 0\nv 1 0 1\n", "bad_dimension@2:7"},
      {"a.obj", "v 0\n", "wrong_count@1:4"},
      {"a.obj", "v 0 0 0 1 2\n", "wrong_count@1:12"},
      {"a.obj", "v 0 zero 0\n", "bad_number@1:5"},
      {"a.obj", "v 0 0 0\nl 1\n", "wrong_count@2:4"},
      {"a.obj", "v 0 0 0\nl 1 2\n", "bad_mesh@2:5"},
      {"a.obj", "v 0 0 0\nl 1 0\n", "bad_mesh@2:5"},
      {"a.obj", "v 0 0 0\nl 1 -2\n", "bad_mesh@2:5"},
      {"a.obj", "v 0 0 0\nl 1 1.5\n", "bad_number@2:5"},
      {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "unsupported@4:1"},
      {"a.obj", "v 0 0 0\ncurv 0 1 1\n", "bad_syntax@2:1"},
      {"a.obj", "v 1e40 0 0\n", "magnitude@1:3"},
  }));
  INFO(refused.content);
  CHECK(failure_of([&] { (void)read(refused.name, refused.content); }) == refused.failure);
}

TEST_CASE("random graphs written as .obj keep places and lines") {
  const ScratchFolder folder;
  mesher::SplitMix64 random(11);
  for (int round = 0; round < 100; ++round) {
    INFO("round " << round);
    Graph<2> pslg = random_pslg(random);
    mesher::write_graph(pslg, folder.path("a.obj"));
    const Graph<2> back = mesher::read<2>(folder.path("a.obj")).graph;
    REQUIRE(back.points.size() == pslg.points.size());
    for (std::size_t i = 0; i < back.points.size(); ++i) {
      REQUIRE(back.points[i].at == pslg.points[i].at);
    }
    REQUIRE(back.segments.size() == pslg.segments.size());
    const auto place = [](const Graph<2>& of, PointId point) {
      return std::find_if(of.points.begin(), of.points.end(),
                          [&](const auto& p) { return p.id == point; })
          ->at;
    };
    for (std::size_t i = 0; i < back.segments.size(); ++i) {
      REQUIRE(place(back, back.segments[i].from) == place(pslg, pslg.segments[i].from));
      REQUIRE(place(back, back.segments[i].to) == place(pslg, pslg.segments[i].to));
    }
  }
}

TEST_CASE("every geometry of GeoJSON is read, single, as a feature or in a collection") {
  const std::string point = geometry("Point", "[1, 2]");
  const std::string line = geometry("LineString", "[[0, 0], [1, 2], [3, 1]]");
  const auto points = [](const GraphFile<2>& f) { return f.graph.points.size(); };
  CHECK(points(read("a.json", point)) == 1);
  CHECK(points(read("a.geojson", geometry("MultiPoint", "[[1, 2], [3, 4], [1, 2]]"))) == 2);
  CHECK(read("a.geojson", line).graph.polylines ==
        std::vector<mesher::Polyline>{{id(1), ids({1, 2, 3}), 0}});
  const auto lines =
      read("a.geojson", geometry("MultiLineString", "[[[0,0],[1,1]],[[1,1],[2,0]]]"));
  CHECK(lines.graph.segments ==
        std::vector<mesher::Segment>{{id(1), id(1), id(2), 0}, {id(2), id(2), id(3), 0}});
  const auto both = read("a.geojson", "{\"type\": \"GeometryCollection\", \"geometries\": [" +
                                          point + ", " + line + "]}");
  CHECK(points(both) == 3);
  CHECK(both.graph.polylines.front().points == ids({2, 1, 3}));
  const std::string feature =
      "{\"type\": \"Feature\", \"properties\": {\"marker\": 5, \"kind\": \"pier\"}, "
      "\"geometry\": " +
      line + "}";
  const auto marked = read("a.geojson", feature);
  CHECK(marked.graph.polylines.front().marker == 5);
  CHECK(marked.graph.points.front().marker == 5);
  CHECK(notes_of(marked) == std::vector<std::string>{"the property 'kind' is not used"});
  const auto all = read(
      "a.geojson", "{\"type\": \"FeatureCollection\", \"bbox\": [0, 0, 1, 1], \"features\": [" +
                       feature + ",\n" + feature +
                       ",\n{\"type\": \"Feature\", \"properties\": null, \"geometry\": null}]}");
  CHECK(points(all) == 3);
  CHECK(all.graph.polylines.size() == 2);
  CHECK(all.location_of_polyline(1).line == 2);
  CHECK(notes_of(all) == std::vector<std::string>{"the member 'bbox' is not used",
                                                  "the property 'kind' is not used (2 times)",
                                                  "a feature without geometry"});
}

TEST_CASE("a polygon of GeoJSON is closed lines, a region, and a hole for each inner ring") {
  const auto file = read("a.geojson",
                         "{\"type\": \"Feature\", \"properties\": {\"max_area\": 0.5},\n"
                         "\"geometry\": " +
                             geometry("MultiPolygon",
                                      "[[[[0,0],[8,0],[8,8],[0,8],[0,0]],\n"
                                      "[[2,2],[2,6],[6,6],[6,2],[2,2]]],\n"
                                      "[[[3,3],[5,3],[5,5],[3,5],[3,3]]]]") +
                             "}");
  CHECK(file.graph.polylines.size() == 3);
  CHECK(file.graph.polylines[1].points.front() == file.graph.polylines[1].points.back());
  const auto regions = file.graph.regions(), holes = file.graph.holes();
  REQUIRE(regions.size() == 2);
  CHECK(regions[0].attribute == 1);
  CHECK(regions[1].attribute == 2);
  CHECK(regions[0].max_measure == 0.5);
  REQUIRE(holes.size() == 1);
  REQUIRE(file.graph.seeds[1] == holes[0]);
  CHECK(file.location_of_seed(1).line == 3);
  const auto within = [](const Point<2>& p, double lo, double hi) {
    return lo < p[0] && p[0] < hi && lo < p[1] && p[1] < hi;
  };
  const Point<2> ring = regions[0].at, hole = holes[0].at;
  CHECK((within(ring, 0, 8) && !within(ring, 2, 6)));
  CHECK((within(hole, 2, 6) && !within(hole, 3, 5)));
  CHECK(within(regions[1].at, 3, 5));
}

TEST_CASE("polygons of GeoJSON share borders: a piece is a line once, and each keeps its region") {
  // 1 | 2  with 3 below both; all three have borders in common.
  const auto file = read("a.geojson", geometry("MultiPolygon",
                                               "[[[[0,0],[1,0],[1,1],[0,1],[0,0]]],\n"
                                               "[[[1,0],[2,0],[2,1],[1,1],[1,0]]],\n"
                                               "[[[0,0],[0,-1],[2,-1],[2,0],[1,0],[0,0]]]]"));
  CHECK(file.graph.points.size() == 8);
  CHECK(file.graph.polylines == std::vector<mesher::Polyline>{{id(1), ids({1, 2, 3, 4, 1}), 0},
                                                              {id(2), ids({2, 5, 6, 3}), 0},
                                                              {id(3), ids({1, 7, 8, 5}), 0}});
  CHECK(file.graph.segments.empty());
  CHECK(file.location_of_polyline(2).line == 3);
  REQUIRE(file.graph.regions().size() == 3);
  CHECK(file.graph.regions()[2].at[1] < 0);
  CHECK(notes_of(file) ==
        std::vector<std::string>{"a border that polygons share is a line of the first of them (2 "
                                 "times)"});
}

TEST_CASE("what is left of a ring between borders that it shares is a line for each run") {
  // A frame of a square, whose corners and every other side belong to others.
  const auto file = read("a.geojson", geometry("MultiPolygon",
                                               "[[[[0,0],[1,0],[0.5,-1],[0,0]]],\n"
                                               "[[[0,1],[1,1],[0.5,2],[0,1]]],\n"
                                               "[[[0.5,1],[0.25,0.5],[0.75,0.5],[0.5,1]]],\n"
                                               "[[[0,1],[0,0],[1,0],[1,1],[0,1]]]]"));
  CHECK(file.graph.polylines.size() == 3);
  CHECK(file.graph.segments ==
        std::vector<mesher::Segment>{{id(4), id(2), id(5), 0}, {id(5), id(4), id(1), 0}});
}

TEST_CASE("an inner ring that another polygon fills makes no hole; one that none does is one") {
  const std::string hole = "[[2,2],[2,6],[6,6],[6,2],[2,2]]";
  const std::string outer = "[[0,0],[8,0],[8,8],[0,8],[0,0]]";
  const std::string around = "[" + outer + "," + hole + "]";
  for (const std::string& polygons :
       {"[" + around + ",[" + hole + "]]", "[[" + hole + "]," + around + "]",
        "[" + around + ",[[[2,2],[2,6],[6,6],[2,2]]],[[[6,6],[6,2],[2,2],[6,6]]]]"}) {
    const auto file = read("a.geojson", geometry("MultiPolygon", polygons));
    INFO(polygons);
    CHECK(file.graph.holes().empty());
    CHECK(file.graph.regions().size() >= 2);
  }
  // Twice the same polygon fills no hole.
  CHECK(read("a.geojson", geometry("MultiPolygon", "[" + around + "," + around + "]"))
            .graph.holes()
            .size() == 2);
  // An outer ring and its own hole that have a side in common.
  CHECK(read("a.geojson", geometry("Polygon",
                                   "[[[0,0],[2,0],[6,0],[8,0],[8,8],[0,0]],"
                                   "[[2,0],[6,0],[6,1],[3,1],[2,0]]]"))
            .graph.holes()
            .size() == 1);
}

TEST_CASE("seeds lie inside their ring, and no line cuts them off from it") {
  mesher::SplitMix64 random(3);
  for (int round = 0; round < 200; ++round) {
    // A star-shaped ring around 0, and a smaller copy that may be another polygon or a hole.
    const bool is_hole = random.below(2) == 0;
    std::vector<Point<2>> outer, inner;
    const int corners = 3 + static_cast<int>(random.below(9));
    for (int i = 0; i < corners; ++i) {
      const double angle = 6.28 * (i + 0.8 * random.unit()) / corners;
      const double radius = 0.5 + random.unit();
      outer.push_back({radius * std::cos(angle), radius * std::sin(angle)});
      inner.push_back({outer.back()[0] / 4, outer.back()[1] / 4});
    }
    const auto ring = [](const std::vector<Point<2>>& places) {
      std::string text = "[";
      for (std::size_t i = 0; i <= places.size(); ++i) {
        const auto& [x, y] = places[i % places.size()];
        char buffer[80];
        std::snprintf(buffer, sizeof buffer, "%s[%.17g, %.17g]", i > 0 ? ", " : "", x, y);
        text += buffer;
      }
      return text + "]";
    };
    const std::string between = is_hole ? ", " : "], [";
    const auto file = read(
        "a.geojson", geometry("MultiPolygon", "[[" + ring(outer) + between + ring(inner) + "]]"));
    INFO("round " << round);
    const auto regions = file.graph.regions(), holes = file.graph.holes();
    REQUIRE(regions.size() + holes.size() == 2);
    const auto inside = [](const std::vector<Point<2>>& places, const Point<2>& p) {
      bool odd = false;
      for (std::size_t i = 0; i < places.size(); ++i) {
        const Point<2>&a = places[i], &b = places[(i + 1) % places.size()];
        if ((a[1] <= p[1]) == (b[1] <= p[1])) continue;
        odd ^= mesher::predicates::orient2d(a, b, p) == (a[1] < b[1] ? -1 : 1);
      }
      return odd;
    };
    const Point<2> between_rings = regions[0].at;
    const Point<2> in_inner = is_hole ? holes[0].at : regions[1].at;
    REQUIRE((inside(outer, between_rings) && !inside(inner, between_rings)));
    REQUIRE(inside(inner, in_inner));
  }
}

TEST_CASE("bad GeoJSON is refused with the code and the place of the mistake") {
  const Refused refused = GENERATE(values<Refused>({
      {"a.json", "", "bad_syntax@1:1"},
      {"a.json", "{\"type\": \"Point\",\n \"coordinates\": [1, 2}", "bad_syntax@2:22"},
      {"a.json", "[1, 2]", "bad_syntax@1:1"},
      {"a.json", "{}", "bad_syntax@1:1"},
      {"a.json", "{\"type\": 5}", "bad_syntax@1:10"},
      {"a.json", "{\"type\": \"Circle\"}", "bad_syntax@1:1"},
      {"a.json", "{\"type\": \"Point\"}", "bad_syntax@1:1"},
      {"a.json", "{\"type\": \"Point\", \"coordinates\": 5}", "bad_syntax@1:34"},
      {"a.json", "{\"type\": \"Point\", \"coordinates\": [5]}", "bad_syntax@1:34"},
      {"a.json", "{\"type\": \"Point\", \"coordinates\": [5, \"6\"]}", "bad_syntax@1:40"},
      {"a.json", "{\"type\": \"Point\", \"coordinates\": [5, 1e40]}", "magnitude@1:38"},
      {"a.json", "{\"type\": \"Point\", \"coordinates\": [5, 1e999]}", "bad_syntax@1:42"},
      {"a.json", "{\"type\": \"Point\", \"coordinates\": [5, NaN]}", "bad_syntax@1:38"},
      {"a.json", "{\"type\": \"Point\", \"type\": \"Point\"}", "bad_syntax@1:1"},
      {"a.json", "{\"type\": \"LineString\", \"coordinates\": [[1, 2]]}", "bad_syntax@1:39"},
      {"a.json", "{\"type\": \"LineString\",\n\"coordinates\": [[1, 2], 3]}", "bad_syntax@2:25"},
      {"a.json", "{\"type\": \"Polygon\", \"coordinates\": [[[0,0],[1,0],[0,0]]]}",
       "bad_syntax@1:37"},
      {"a.json", "{\"type\": \"Polygon\", \"coordinates\":\n[[[0,0],[1,0],[1,1],[0,1]]]}",
       "bad_syntax@2:2"},
      {"a.json", "{\"type\": \"Feature\", \"properties\": {}}", "bad_syntax@1:1"},
      {"a.json", "{\"type\": \"FeatureCollection\", \"features\": [{\"type\": \"Point\"}]}",
       "bad_syntax@1:44"},
      {"a.json", "{\"type\": \"Feature\", \"geometry\": null, \"properties\": {\"marker\": 1.5}}",
       "bad_number@1:64"},
      {"a.json", "{\"type\": \"Feature\", \"geometry\": null, \"properties\": {\"max_area\": 0}}",
       "bad_syntax@1:66"},
  }));
  INFO(refused.content);
  CHECK(failure_of([&] { (void)read(refused.name, refused.content); }) == refused.failure);
}

TEST_CASE("values of JSON within each other to no end are refused, not followed") {
  const std::string deep(100000, '[');
  CHECK(failure_of([&] { (void)read("a.json", deep); }) == "bad_syntax@1:65");
  std::string nested = geometry("Point", "[1, 2]");
  for (int i = 0; i < 100; ++i) {
    nested = "{\"type\": \"GeometryCollection\", \"geometries\": [" + nested + "]}";
  }
  CHECK(error_of([&] { (void)read("a.json", nested); }).code() == mesher::ErrorCode::bad_syntax);
}

TEST_CASE("a background of sizes is read from .node and .csv") {
  const ScratchFolder folder;
  const std::vector<mesher::SizeSample<2>> expected{{{0, 0}, 0.5}, {{1, 2}, 0.25}};
  const auto node = mesher::read_sizes(folder.write("a.node", "2 2 1 0\n1 0 0 .5\n2 1 2 .25\n"));
  CHECK(node.samples == expected);
  CHECK(node.positions[1].line == 3);
  CHECK(mesher::read_sizes(folder.write("a.csv", "0,0,.5\n1,2,.25\n")).samples == expected);
  CHECK(
      mesher::read_sizes(folder.write("b.csv", "h;name;lat;lon\n.5;a;0;0\n.25;b;2;1\n")).samples ==
      expected);
}

TEST_CASE("a bad background of sizes is refused with the code and the place of the mistake") {
  const Refused refused = GENERATE(values<Refused>({
      {"a.node", "1 2 0 0\n1 0 0\n", "bad_header@1:5"},
      {"a.node", "1 2 2 0\n1 0 0 1 1\n", "bad_header@1:5"},
      {"a.node", "1 2 1 0\n1 0 0 -1\n", "bad_number@2:1"},
      {"a.node", "1 2 1 0\n1 0 0 0\n", "bad_number@2:1"},
      {"a.node", "1 2 1 0\n1 0 0 x\n", "bad_number@2:7"},
      {"a.node", "2 2 1 0\n1 0 0 1\n2 0 0 2\n", "duplicate_point@3:1"},
      {"a.node", "2 2 1 0\n1 0 0 1\n1 1 0 2\n", "repeated_id@3:1"},
      {"a.node", "2 2 1 0\n1 0 0 1\n", "truncated@2:8"},
      {"a.csv", "x,y\n0,0\n", "bad_header@1:1"},
      {"a.csv", "0,0\n", "truncated@1:4"},
      {"a.csv", "0,0,0\n", "bad_number@1:1"},
      {"a.xyz", "0 0 1\n", "unknown_format@0:0"},
  }));
  INFO(refused.content);
  const ScratchFolder folder;
  const auto path = folder.write(refused.name, refused.content);
  CHECK(failure_of([&] { (void)mesher::read_sizes(path); }) == refused.failure);
}
