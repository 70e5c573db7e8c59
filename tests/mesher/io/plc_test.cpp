// Complexes in space: what each format says, what is refused and where, and that what is written
// reads back equal.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdint>
#include <fstream>

#include "feature_ids.hpp"
#include "mesher/extra/generate.hpp"
#include "mesher/graph.hpp"
#include "mesher/read.hpp"
#include "mesher/write.hpp"
#include "random_mistakes.hpp"
#include "scratch_file.hpp"

namespace {

using mesher::Graph;
using mesher::GraphFile;
using mesher::hole_seed;
using mesher::Point;
using mesher::PointId;
using mesher::PolygonId;
using mesher::region_seed;
using support::error_of;
using support::failure_of;
using support::id;
using support::ids;
using support::ScratchFolder;

using Loops = std::vector<std::vector<PointId>>;

GraphFile<3> read(const std::string& name, const std::string& content) {
  const ScratchFolder folder;
  return mesher::read<3>(folder.write(name, content));
}

// A square of 4 x 4 in the plane of z = 1, points from 1 on: its corners, two nested squares in it,
// and two points in the innermost.
const std::string kSquares =
    "14 3\n1 0 0 1\n2 4 0 1\n3 4 4 1\n4 0 4 1\n5 1 1 1\n6 3 1 1\n7 3 3 1\n8 1 3 1\n"
    "9 1.5 1.5 1\n10 2.5 1.5 1\n11 2.5 2.5 1\n12 1.5 2.5 1\n13 1.75 2 1\n14 2.25 2 1\n";

std::string facet(const std::string& text) { return kSquares + "1 1\n" + text + "0\n"; }

Graph<3> read_facet(const std::string& text) { return read("a.poly", facet(text)).graph; }

}  // namespace

TEST_CASE("A .poly file says points, facets, segments, holes and regions, with their places") {
  const GraphFile<3> f = read("cube.poly",
                              "# a corner\n4 3 1 1\n0 0 0 0 0.5 7\n1 1 0 0 1.5 0\n2 0 1 0 2 0\n"
                              "3 0 0 1 3 0\n3 1\n1 0 5\n3 0 1\n 2\n1 0 6\n2 0 3\n1\n3 1 2 3\n"
                              "1\n1 0.1 0.1 0.1\n1\n2 0.2 0.2 0.2 9 0.25\n");
  REQUIRE(f.graph.points.size() == 4);
  REQUIRE(f.graph.points[0] == mesher::GraphPoint<3>{id(0), {0, 0, 0}, 7});
  REQUIRE(f.graph.attributes == std::vector<double>{0.5, 1.5, 2, 3});
  REQUIRE(f.graph.polygons.size() == 2);
  REQUIRE(f.graph.polygons[0].id == id(1));
  REQUIRE(f.graph.polygons[0].loops == Loops{ids({0, 1, 2})});
  REQUIRE(f.graph.polygons[0].marker == 5);
  REQUIRE(f.graph.polygons[1].id == id(3));
  REQUIRE(f.graph.polygons[1].marker == 0);
  REQUIRE(f.graph.segments == std::vector<mesher::Segment>{{id(1), id(0), id(3), 6}});
  REQUIRE(f.graph.holes() == std::vector{hole_seed<3>(1, {0.1, 0.1, 0.1})});
  REQUIRE(f.graph.regions() == std::vector{region_seed<3>(2, {0.2, 0.2, 0.2}, 9, 0.25)});
  REQUIRE(f.location_of_polygon(1).line == 13);
  REQUIRE(f.location_of_segment(0).line == 11);
}

TEST_CASE("A .poly file without points takes those of the .node file beside it") {
  const ScratchFolder folder;
  folder.write("a.node", "3 3\n10 0 0 0\n11 1 0 0\n12 0 1 0\n");
  const GraphFile<3> f = mesher::read<3>(folder.write("a.poly", "0 3 0 0\n1\n1\n3 10 11 12\n0\n"));
  REQUIRE(f.graph.points.size() == 3);
  REQUIRE(f.graph.polygons[0].loops == Loops{ids({10, 11, 12})});
  REQUIRE(f.location_of_point(0).file == f.point_file);
}

TEST_CASE("A .smesh file has one polygon on a line, which may go on") {
  const GraphFile<3> f = read("a.smesh", kSquares + "2 1\n4 1 2\n 3 4 8\n3 5 6 7\n0\n");
  REQUIRE(f.graph.polygons.size() == 2);
  REQUIRE(f.graph.polygons[0].loops == Loops{ids({1, 2, 3, 4})});
  REQUIRE(f.graph.polygons[0].marker == 8);
  REQUIRE(f.graph.polygons[1].marker == 0);
}

TEST_CASE(
    "A polygon in a facet is a hole where a hole's seed is in it, else its edges lie inside") {
  const Graph<3> hole = read_facet("2 1\n4 1 2 3 4\n4 5 6 7 8\n1 2 2 1\n");
  REQUIRE(hole.polygons.size() == 1);
  REQUIRE(hole.polygons[0].loops == Loops{ids({1, 2, 3, 4}), ids({5, 6, 7, 8})});
  const Graph<3> inner = read_facet("2 0\n4 1 2 3 4\n4 5 6 7 8\n");
  REQUIRE(inner.polygons[0].loops.size() == 1);
  REQUIRE(inner.polygons[0].edges.size() == 4);
}

TEST_CASE("A polygon in a hole of a facet is filled, whatever the order") {
  const Graph<3> plc = read_facet("3 1\n4 9 10 11 12\n4 5 6 7 8\n4 1 2 3 4\n1 1.25 2 1\n");
  REQUIRE(plc.polygons.size() == 1);
  REQUIRE(plc.polygons[0].loops ==
          Loops{ids({1, 2, 3, 4}), ids({5, 6, 7, 8}), ids({9, 10, 11, 12})});
}

TEST_CASE("A facet's polygons of one and of two corners are points and edges inside") {
  const Graph<3> plc = read_facet("3 0\n4 1 2 3 4\n2 13 14\n1 9\n");
  REQUIRE(plc.polygons[0].edges == std::vector<std::array<PointId, 2>>{{id(13), id(14)}});
  REQUIRE(plc.polygons[0].points == ids({9}));
  const Graph<3> alone = read_facet("2 0\n2 13 14\n2 9 10\n");
  REQUIRE(alone.polygons.empty());
  REQUIRE(alone.segments.size() == 2);
}

TEST_CASE("Parts of a facet that lie apart are polygons of their own") {
  const Graph<3> plc = read_facet("3 1\n3 1 2 5\n3 8 3 4\n2 13 14\n1 1 0.25 1\n");
  REQUIRE(plc.polygons.size() == 1);
  REQUIRE(plc.segments.size() == 4);  // the empty triangle's edges, and one that lies in no part
  const Graph<3> two =
      read("a.poly", kSquares + "2\n2 0\n3 1 2 5\n3 8 3 4\n1 0\n3 9 10 11\n0\n").graph;
  REQUIRE(two.polygons.size() == 3);
  REQUIRE(two.polygons[1].id == id(2));
  REQUIRE(two.polygons[2].id == id(3));
}

TEST_CASE("What a .poly file in space may not say is refused where it stands") {
  struct Refused {
    std::string content;
    const char* failure;
  };
  const Refused all[] = {
      {"", "truncated@0:0"},
      {"3 2\n1 0 0\n", "bad_dimension@1:3"},
      {"1 3\n1 0 0 0\n", "truncated@2:8"},
      {"2 3\n1 0 0 0\n1 1 0 0\n0\n0\n", "repeated_id@3:1"},
      {facet("1\n3 1 2 99\n"), "unknown_id@18:7"},
      {facet("1\n3 1 2\n"), "unknown_id@19:1"},
      {facet("1\n3 1 2 3 4\n"), "wrong_count@18:9"},
      {facet("1\n0\n"), "wrong_count@18:1"},
      {facet("1 1\n4 1 2 3 4\n1 9 9 1\n"), "bad_syntax@19:1"},
      {facet("1 -1\n"), "bad_header@17:3"},
      {facet("1 0 1 1\n4 1 2 3 4\n"), "wrong_count@17:7"},
      {facet("1 0 x\n4 1 2 3 4\n"), "bad_number@17:5"},
      {kSquares + "1 2\n", "bad_header@16:3"},
      {kSquares + "1\n1\n3 1 2 3\n", "truncated@18:8"},
      {kSquares + "0\n1\n1 0 0\n", "truncated@18:"},
      {kSquares + "0\n0\n1\n1 0 0 0\n", "truncated@19:"},
      {kSquares + "0\n0\n0\n7\n", "wrong_count@19:1"},
      {kSquares + "0\n2\n1 0 0 0\n1 1 1 1\n", "repeated_id@19:1"},
  };
  for (const Refused& refused : all) {
    INFO(refused.content);
    const std::string failure =
        failure_of([&] { static_cast<void>(read("a.poly", refused.content)); });
    CHECK(failure.substr(0, std::string(refused.failure).size()) == refused.failure);
  }
}

TEST_CASE("No memory is set aside on the word of a header of a complex") {
  CHECK(failure_of([] { static_cast<void>(read("a.poly", "1000000000000 3\n1 0 0 0\n")); }) ==
        "truncated@2:8");
  CHECK(failure_of([] {
          static_cast<void>(read("a.poly", kSquares + "1000000000000\n1\n3 1 2 3\n"));
        }) == "truncated@18:8");
}

TEST_CASE("What is written as .poly reads back equal: loops, holes, islands, edges and points") {
  Graph<3> plc = read_facet("3 1 4\n4 1 2 3 4\n4 5 6 7 8\n4 9 10 11 12\n1 1.25 2 1\n");
  plc.segments = {{id(1), id(1), id(7), 3}};
  plc.polygons[0].edges = {{id(13), id(14)}};
  plc.polygons[0].points = ids({10});
  plc.seeds = {hole_seed<3>(4, {0.1, 0.2, 0.3}), region_seed<3>(5, {1, 2, 3}, 0.5),
               region_seed<3>(6, {3, 2, 1}, 0.25, 1e-3)};
  const ScratchFolder folder;
  const std::string path = folder.path("a.poly");
  write_graph(plc, path);
  REQUIRE(mesher::read<3>(path).graph == plc);
  REQUIRE(error_of([&] { write_graph(plc, folder.path("a.smesh")); }).code() ==
          mesher::ErrorCode::unsupported);
  plc.polygons[0] = {id(1), {ids({1, 2, 3, 4})}, {}, {}, plc.polygons[0].marker};
  write_graph(plc, folder.path("a.smesh"));
  REQUIRE(mesher::read<3>(folder.path("a.smesh")).graph == plc);
}

TEST_CASE("A complex with random mistakes is read or refused, with its place") {
  mesher::SplitMix64 random(1);
  const ScratchFolder folder;
  const std::string good =
      facet("3 1 4\n4 1 2 3 4\n4 5 6 7 8\n4 9 10 11 12\n1 1.25 2 1\n") + "1\n2 1 2 3 9 0.5\n";
  folder.write("a.poly", good);
  const auto poly = [&] { static_cast<void>(mesher::read<3>(folder.path("a.poly"))); };
  REQUIRE(support::refused_with_mistakes(folder, "a.poly", random, poly) > 50);
  folder.write("a.smesh", kSquares + "2 1\n4 1 2\n 3 4 8\n3 5 6 7\n0\n");
  const auto smesh = [&] { static_cast<void>(mesher::read<3>(folder.path("a.smesh"))); };
  REQUIRE(support::refused_with_mistakes(folder, "a.smesh", random, smesh) > 50);
}

TEST_CASE("TetGen's example is read as its facets are") {
  const char* path = "/usr/share/doc/tetgen/examples/example.poly";
  if (!std::ifstream(path)) return;
  const Graph<3> plc = mesher::read<3>(path).graph;
  REQUIRE(plc.points.size() == 28);
  REQUIRE(plc.polygons.size() == 23);
  REQUIRE(plc.polygons[2].loops.size() == 2);
  const ScratchFolder folder;
  write_graph(plc, folder.path("a.poly"));
  REQUIRE(mesher::read<3>(folder.path("a.poly")).graph == plc);
}

TEST_CASE("Surfaces are read with a polygon for each face") {
  const Loops faces{ids({1, 2, 3, 4}), ids({1, 2, 5})};
  const auto loops_of = [](const GraphFile<3>& f) {
    Loops loops;
    for (const auto& facet : f.graph.polygons) loops.push_back(facet.loops.at(0));
    return loops;
  };
  const std::string vertices = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n";
  const GraphFile<3> off =
      read("a.off", "OFF\n5 2 0\n" + vertices + "4 0 1 2 3\n3 0 1 4 0.5 0.5\n");
  REQUIRE(off.graph.points.size() == 5);
  REQUIRE(loops_of(off) == faces);
  REQUIRE(off.location_of_polygon(1).line == 9);
  REQUIRE(off.notes.size() == 1);
  const GraphFile<3> obj =
      read("a.obj",
           "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1/1 2/2 3/3 4\nv 0 0 1\ng x\n"
           "f -5 2 -1\n");
  REQUIRE(loops_of(obj) == faces);
  REQUIRE(obj.location_of_polygon(1).line == 8);
  const std::string header =
      "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\n"
      "property float z\nelement face 2\nproperty uchar red\n"
      "property list uchar int vertex_indices\nend_header\n";
  const GraphFile<3> ply = read("a.ply", header + vertices + "9 4 0 1 2 3\n9 3 0 1 4\n");
  REQUIRE(loops_of(ply) == faces);
  REQUIRE(ply.location_of_polygon(1).line == 17);
  const GraphFile<3> stl =
      read("a.stl",
           "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
           "vertex 1 1 0\nendloop\nendfacet\nfacet normal 0 0 1\nouter loop\n"
           "vertex 0 0 0\nvertex 1 0 0\nvertex 0 0 1\nendloop\nendfacet\n"
           "endsolid\n");
  REQUIRE(loops_of(stl) == Loops{ids({1, 2, 3}), ids({1, 2, 4})});
  REQUIRE(stl.location_of_polygon(1).line == 11);
}

TEST_CASE("Faces of grids are polygons with their markers, and with their ids if all differ") {
  // Two triangles, a quadrilateral and a tetrahedron.
  const auto vtu = [](const std::string& polygons) {
    const auto ints = [](const std::string& name, const std::string& values) {
      return "<DataArray type=\"Int64\" Name=\"" + name + "\" format=\"ascii\">" + values +
             "</DataArray>\n";
    };
    return "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\">\n"
           "<UnstructuredGrid><Piece NumberOfPoints=\"5\" NumberOfCells=\"4\">\n<Points>"
           "<DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">"
           "0 0 0 1 0 0 1 1 0 0 1 0 0 0 1</DataArray></Points>\n<Cells>\n" +
           ints("connectivity", "0 1 4 0 1 2 3 1 2 4 0 1 2 4") + ints("offsets", "3 7 10 14") +
           ints("types", "5 9 5 10") + "</Cells>\n<CellData>\n" + ints("marker", "7 8 9 0") +
           ints("polygon", polygons) + "</CellData></Piece></UnstructuredGrid></VTKFile>\n";
  };
  const auto facets_of = [&](const std::string& polygons) {
    return read("a.vtu", vtu(polygons)).graph.polygons;
  };
  const auto named = facets_of("12 11 10 0"), numbered = facets_of("12 11 12 0");
  REQUIRE(named.size() == 3);
  CHECK(named[1].loops == Loops{ids({1, 2, 3, 4})});
  CHECK(named[2].loops == Loops{ids({2, 3, 5})});
  for (std::size_t i = 0; i < 3; ++i) {
    const auto n = static_cast<std::int64_t>(i);
    CHECK(named[i].marker == 7 + n);
    CHECK(named[i].id == PolygonId{12 - n});
    CHECK(numbered[i].id == PolygonId{1 + n});
  }
  CHECK(read("a.vtu", vtu("1 2 3 0")).notes.size() == 1);
  std::string bad = vtu("1 2 3 0");
  bad.replace(bad.find("5 9 5 10"), 8, "5 5 5 10");
  CHECK_THROWS_AS(read("a.vtu", bad), mesher::Error);
}

TEST_CASE("A face's corner that is no vertex is refused where it stands") {
  const auto failure = [](const char* name, const std::string& content) {
    return failure_of([&] { static_cast<void>(read(name, content)); });
  };
  CHECK(failure("a.off", "OFF\n1 1 0\n0 0 0\n3 0 1 0\n") == "bad_mesh@4:5");
  CHECK(failure("a.obj", "v 0 0 0\nf 1 2 1\n") == "bad_mesh@2:5");
  CHECK(failure("a.obj", "v 0 0 0\nf 1 -2 1\n") == "bad_mesh@2:5");
  const std::string header =
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
      "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
  CHECK(failure("a.ply", header + "0 0 0\n3 0 1 0\n").substr(0, 12) == "bad_mesh@11:");
  CHECK(failure("a.ply", header + "0 0 0\n3 0 -1 0\n").substr(0, 12) == "bad_mesh@11:");
}
