// Complexes in space: what each format says, what is refused and where, and that what is written
// reads back equal.
#include "mesher/plc.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdint>
#include <fstream>

#include "feature_ids.hpp"
#include "mesher/generate.hpp"
#include "random_mistakes.hpp"
#include "scratch_file.hpp"

namespace {

using mesher::FeatureId;
using mesher::Plc;
using mesher::PlcFile;
using mesher::Point;
using support::error_of;
using support::failure_of;
using support::id;
using support::ids;
using support::ScratchFolder;

using Loops = std::vector<std::vector<FeatureId>>;

PlcFile read(const std::string& name, const std::string& content) {
  const ScratchFolder folder;
  return mesher::read_plc(folder.write(name, content));
}

// A square of 4 x 4 in the plane of z = 1, points from 1 on: its corners, two nested squares in it,
// and two points in the innermost.
const std::string kSquares =
    "14 3\n1 0 0 1\n2 4 0 1\n3 4 4 1\n4 0 4 1\n5 1 1 1\n6 3 1 1\n7 3 3 1\n8 1 3 1\n"
    "9 1.5 1.5 1\n10 2.5 1.5 1\n11 2.5 2.5 1\n12 1.5 2.5 1\n13 1.75 2 1\n14 2.25 2 1\n";

std::string facet(const std::string& text) { return kSquares + "1 1\n" + text + "0\n"; }

Plc read_facet(const std::string& text) { return read("a.poly", facet(text)).plc; }

}  // namespace

TEST_CASE("A .poly file says points, facets, segments, holes and regions, with their places") {
  const PlcFile f = read("cube.poly",
                         "# a corner\n4 3 1 1\n0 0 0 0 0.5 7\n1 1 0 0 1.5 0\n2 0 1 0 2 0\n"
                         "3 0 0 1 3 0\n3 1\n1 0 5\n3 0 1\n 2\n1 0 6\n2 0 3\n1\n3 1 2 3\n"
                         "1\n1 0.1 0.1 0.1\n1\n2 0.2 0.2 0.2 9 0.25\n");
  REQUIRE(f.plc.points.size() == 4);
  REQUIRE(f.plc.points[0] == Plc::Vertex{id(0), {0, 0, 0}, 7});
  REQUIRE(f.plc.attributes == std::vector<double>{0.5, 1.5, 2, 3});
  REQUIRE(f.plc.facets.size() == 2);
  REQUIRE(f.plc.facets[0].polygon.id == id(1));
  REQUIRE(f.plc.facets[0].polygon.loops == Loops{ids({0, 1, 2})});
  REQUIRE(f.plc.facets[0].marker == 5);
  REQUIRE(f.plc.facets[1].polygon.id == id(3));
  REQUIRE(f.plc.facets[1].marker == 0);
  REQUIRE(f.plc.segments == std::vector<Plc::Segment>{{id(1), id(0), id(3), 6}});
  REQUIRE(f.plc.holes == std::vector<Plc::Hole>{{id(1), {0.1, 0.1, 0.1}}});
  REQUIRE(f.plc.regions == std::vector<Plc::Region>{{id(2), {0.2, 0.2, 0.2}, 9, 0.25}});
  REQUIRE(f.location_of_facet(1).line == 13);
  REQUIRE(f.location_of_segment(0).line == 11);
}

TEST_CASE("A .poly file without points takes those of the .node file beside it") {
  const ScratchFolder folder;
  folder.write("a.node", "3 3\n10 0 0 0\n11 1 0 0\n12 0 1 0\n");
  const PlcFile f = mesher::read_plc(folder.write("a.poly", "0 3 0 0\n1\n1\n3 10 11 12\n0\n"));
  REQUIRE(f.plc.points.size() == 3);
  REQUIRE(f.plc.facets[0].polygon.loops == Loops{ids({10, 11, 12})});
  REQUIRE(f.location_of_point(0).file == f.point_file);
}

TEST_CASE("A .smesh file has one polygon on a line, which may go on") {
  const PlcFile f = read("a.smesh", kSquares + "2 1\n4 1 2\n 3 4 8\n3 5 6 7\n0\n");
  REQUIRE(f.plc.facets.size() == 2);
  REQUIRE(f.plc.facets[0].polygon.loops == Loops{ids({1, 2, 3, 4})});
  REQUIRE(f.plc.facets[0].marker == 8);
  REQUIRE(f.plc.facets[1].marker == 0);
}

TEST_CASE(
    "A polygon in a facet is a hole where a hole's seed is in it, else its edges lie inside") {
  const Plc hole = read_facet("2 1\n4 1 2 3 4\n4 5 6 7 8\n1 2 2 1\n");
  REQUIRE(hole.facets.size() == 1);
  REQUIRE(hole.facets[0].polygon.loops == Loops{ids({1, 2, 3, 4}), ids({5, 6, 7, 8})});
  const Plc inner = read_facet("2 0\n4 1 2 3 4\n4 5 6 7 8\n");
  REQUIRE(inner.facets[0].polygon.loops.size() == 1);
  REQUIRE(inner.facets[0].polygon.edges.size() == 4);
}

TEST_CASE("A polygon in a hole of a facet is filled, whatever the order") {
  const Plc plc = read_facet("3 1\n4 9 10 11 12\n4 5 6 7 8\n4 1 2 3 4\n1 1.25 2 1\n");
  REQUIRE(plc.facets.size() == 1);
  REQUIRE(plc.facets[0].polygon.loops ==
          Loops{ids({1, 2, 3, 4}), ids({5, 6, 7, 8}), ids({9, 10, 11, 12})});
}

TEST_CASE("A facet's polygons of one and of two corners are points and edges inside") {
  const Plc plc = read_facet("3 0\n4 1 2 3 4\n2 13 14\n1 9\n");
  REQUIRE(plc.facets[0].polygon.edges == std::vector<std::array<FeatureId, 2>>{{id(13), id(14)}});
  REQUIRE(plc.facets[0].polygon.points == ids({9}));
  const Plc alone = read_facet("2 0\n2 13 14\n2 9 10\n");
  REQUIRE(alone.facets.empty());
  REQUIRE(alone.segments.size() == 2);
}

TEST_CASE("Parts of a facet that lie apart are polygons of their own") {
  const Plc plc = read_facet("3 1\n3 1 2 5\n3 8 3 4\n2 13 14\n1 1 0.25 1\n");
  REQUIRE(plc.facets.size() == 1);
  REQUIRE(plc.segments.size() == 4);  // the empty triangle's edges, and one that lies in no part
  const Plc two = read("a.poly", kSquares + "2\n2 0\n3 1 2 5\n3 8 3 4\n1 0\n3 9 10 11\n0\n").plc;
  REQUIRE(two.facets.size() == 3);
  REQUIRE(two.facets[1].polygon.id == id(2));
  REQUIRE(two.facets[2].polygon.id == id(3));
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
  Plc plc = read_facet("3 1 4\n4 1 2 3 4\n4 5 6 7 8\n4 9 10 11 12\n1 1.25 2 1\n");
  plc.segments = {{id(1), id(1), id(7), 3}};
  plc.facets[0].polygon.edges = {{id(13), id(14)}};
  plc.facets[0].polygon.points = ids({10});
  plc.holes = {{id(4), {0.1, 0.2, 0.3}}};
  plc.regions = {{id(5), {1, 2, 3}, 0.5, std::nullopt}, {id(6), {3, 2, 1}, 0.25, 1e-3}};
  const ScratchFolder folder;
  const std::string path = folder.path("a.poly");
  write_plc(plc, path);
  REQUIRE(mesher::read_plc(path).plc == plc);
  REQUIRE(error_of([&] { write_plc(plc, folder.path("a.smesh")); }).code() ==
          mesher::ErrorCode::unsupported);
  plc.facets[0].polygon = {id(1), {ids({1, 2, 3, 4})}};
  write_plc(plc, folder.path("a.smesh"));
  REQUIRE(mesher::read_plc(folder.path("a.smesh")).plc == plc);
}

TEST_CASE("A complex with random mistakes is read or refused, with its place") {
  mesher::SplitMix64 random(1);
  const ScratchFolder folder;
  const std::string good =
      facet("3 1 4\n4 1 2 3 4\n4 5 6 7 8\n4 9 10 11 12\n1 1.25 2 1\n") + "1\n2 1 2 3 9 0.5\n";
  folder.write("a.poly", good);
  const auto poly = [&] { static_cast<void>(mesher::read_plc(folder.path("a.poly"))); };
  REQUIRE(support::refused_with_mistakes(folder, "a.poly", random, poly) > 50);
  folder.write("a.smesh", kSquares + "2 1\n4 1 2\n 3 4 8\n3 5 6 7\n0\n");
  const auto smesh = [&] { static_cast<void>(mesher::read_plc(folder.path("a.smesh"))); };
  REQUIRE(support::refused_with_mistakes(folder, "a.smesh", random, smesh) > 50);
}

TEST_CASE("TetGen's example is read as its facets are") {
  const char* path = "/usr/share/doc/tetgen/examples/example.poly";
  if (!std::ifstream(path)) return;
  const Plc plc = mesher::read_plc(path).plc;
  REQUIRE(plc.points.size() == 28);
  REQUIRE(plc.facets.size() == 23);
  REQUIRE(plc.facets[2].polygon.loops.size() == 2);
  const ScratchFolder folder;
  write_plc(plc, folder.path("a.poly"));
  REQUIRE(mesher::read_plc(folder.path("a.poly")).plc == plc);
}

TEST_CASE("Surfaces are read with a polygon for each face") {
  const Loops faces{ids({1, 2, 3, 4}), ids({1, 2, 5})};
  const auto loops_of = [](const PlcFile& f) {
    Loops loops;
    for (const auto& facet : f.plc.facets) loops.push_back(facet.polygon.loops.at(0));
    return loops;
  };
  const std::string vertices = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n";
  const PlcFile off = read("a.off", "OFF\n5 2 0\n" + vertices + "4 0 1 2 3\n3 0 1 4 0.5 0.5\n");
  REQUIRE(off.plc.points.size() == 5);
  REQUIRE(loops_of(off) == faces);
  REQUIRE(off.location_of_facet(1).line == 9);
  REQUIRE(off.notes.size() == 1);
  const PlcFile obj = read("a.obj",
                           "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1/1 2/2 3/3 4\nv 0 0 1\ng x\n"
                           "f -5 2 -1\n");
  REQUIRE(loops_of(obj) == faces);
  REQUIRE(obj.location_of_facet(1).line == 8);
  const std::string header =
      "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\n"
      "property float z\nelement face 2\nproperty uchar red\n"
      "property list uchar int vertex_indices\nend_header\n";
  const PlcFile ply = read("a.ply", header + vertices + "9 4 0 1 2 3\n9 3 0 1 4\n");
  REQUIRE(loops_of(ply) == faces);
  REQUIRE(ply.location_of_facet(1).line == 17);
  const PlcFile stl = read("a.stl",
                           "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
                           "vertex 1 1 0\nendloop\nendfacet\nfacet normal 0 0 1\nouter loop\n"
                           "vertex 0 0 0\nvertex 1 0 0\nvertex 0 0 1\nendloop\nendfacet\n"
                           "endsolid\n");
  REQUIRE(loops_of(stl) == Loops{ids({1, 2, 3}), ids({1, 2, 4})});
  REQUIRE(stl.location_of_facet(1).line == 11);
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
    return read("a.vtu", vtu(polygons)).plc.facets;
  };
  const auto named = facets_of("12 11 10 0"), numbered = facets_of("12 11 12 0");
  REQUIRE(named.size() == 3);
  CHECK(named[1].polygon.loops == Loops{ids({1, 2, 3, 4})});
  CHECK(named[2].polygon.loops == Loops{ids({2, 3, 5})});
  for (std::size_t i = 0; i < 3; ++i) {
    const auto n = static_cast<std::int64_t>(i);
    CHECK(named[i].marker == 7 + n);
    CHECK(named[i].polygon.id == FeatureId{12 - n});
    CHECK(numbered[i].polygon.id == FeatureId{1 + n});
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
