// Names of groups: which are refused, what files make of them, and how they read back.
#include <catch2/catch.hpp>
#include <string>

#include "mesher/meshing.hpp"
#include "mesher/read.hpp"
#include "mesher/repair.hpp"
#include "mesher/write.hpp"
#include "scratch_file.hpp"

namespace {

using mesher::ErrorCode;
using mesher::Graph;
using mesher::GroupNames;
using mesher::LineId;
using mesher::MshVersion;
using mesher::PointId;
using support::error_of;
using support::ScratchFolder;
using Markers = std::map<std::int64_t, std::string>;
using Regions = std::map<double, std::string>;

// Two squares side by side: lines 1 to 7 with markers 1 to 7, of which 7 is between them.
Graph<2> two_squares() {
  Graph<2> graph;
  const mesher::Point<2> places[] = {{0, 0}, {1, 0}, {2, 0}, {2, 1}, {1, 1}, {0, 1}};
  std::int64_t id = 0;
  for (const auto& at : places) graph.points.push_back({PointId{++id}, at});
  const auto add = [&](std::int64_t line, std::int64_t from, std::int64_t to) {
    graph.segments.push_back({LineId{line}, PointId{from}, PointId{to}, line});
  };
  for (std::int64_t i = 1; i <= 6; ++i) add(i, i, i % 6 + 1);
  add(7, 2, 5);
  graph.seeds = {mesher::region_seed<2>(1, {.5, .5}, 3), mesher::region_seed<2>(2, {1.5, .5}, 4)};
  graph.names.facets = {{6, "inlet"}, {7, "wall"}};
  graph.names.regions = {{3, "rock"}};
  return graph;
}

bool has_line(const std::string& text, const std::string& line) {
  return ("\n" + text).find("\n" + line + "\n") != std::string::npos;
}

std::string written(const mesher::MeshData<2>& mesh, const std::string& name,
                    const mesher::WriteOptions& options = {}) {
  const ScratchFolder folder;
  mesher::write_mesh(mesh, folder.path(name), options);
  return folder.read(name);
}

}  // namespace

TEST_CASE("a group has the name that is given, or one by its number") {
  GroupNames names;
  names.facets[7] = "inlet";
  CHECK(names.of_facets(7) == "inlet");
  CHECK(names.of_facets(-8) == "marker_-8");
  CHECK(names.of_lines(7) == "line_7");
  CHECK(names.of_region(2.5) == "region_2.5");
  CHECK(names.of_region(-0.0) == "region_0");
  GroupNames more;
  more.facets = {{7, "outlet"}, {8, "wall"}};
  names.add(more);
  CHECK(names.facets == Markers{{7, "outlet"}, {8, "wall"}});
}

TEST_CASE("names that readers would not read whole, or would take for others, are refused") {
  const auto refused = [](const std::string& name) {
    GroupNames names;
    names.facets[1] = name;
    const mesher::Error error = error_of([&] { mesher::require_names(names); });
    CHECK(error.code() == ErrorCode::bad_option);
    return error.message();
  };
  CHECK(refused("") == "the name '' is empty");
  CHECK(refused("a b") == "the name 'a b' has a blank: write _ instead");
  CHECK(refused("a\tb").find("has a control character") != std::string::npos);
  CHECK(refused("\"a").find("has a quote") != std::string::npos);
  CHECK(refused(std::string(81, 'a')).find("more than 80") != std::string::npos);
  CHECK(refused("marker_2").find("is that of a group without a name") != std::string::npos);
  CHECK(refused("region_-2.5").find("is that of a group without a name") != std::string::npos);
  GroupNames names;
  names.facets = {{1, std::string(80, 'a')}, {2, "marker_a"}, {3, "Süd"}, {4, "line"}};
  CHECK_NOTHROW(mesher::require_names(names));
  names.regions[9] = "line";
  CHECK(error_of([&] { mesher::require_names(names); }).message() ==
        "the name 'line' is given to two groups");
  mesher::MeshData<2> mesh;
  mesh.features.names = names;
  const ScratchFolder folder;
  CHECK(error_of([&] { mesher::write_mesh(mesh, folder.path("m.msh")); }).code() ==
        ErrorCode::bad_option);
  CHECK(folder.count() == 0);
}

TEST_CASE("names go from the graph to .msh of both versions, and read back") {
  const auto made = mesher::mesh(two_squares());
  CHECK(made.mesh.features.names == two_squares().names);
  for (const MshVersion version : {MshVersion::v4_1, MshVersion::v2_2}) {
    const ScratchFolder folder;
    mesher::write_mesh(made.mesh, folder.path("m.msh"), {.msh = version});
    const std::string text = folder.read("m.msh");
    CHECK(has_line(text, version == MshVersion::v2_2 ? "2.2 0 8" : "4.1 0 8"));
    for (const char* line : {"1 6 \"inlet\"", "1 7 \"wall\"", "1 1 \"marker_1\"", "2 3 \"rock\"",
                             "2 4 \"region_4\""}) {
      INFO(line);
      CHECK(has_line(text, line));
    }
    const auto back = mesher::read_mesh(folder.path("m.msh"));
    CHECK(back.features.names == made.mesh.features.names);
    CHECK(back.vertices == made.mesh.vertices);
    CHECK(back.features.edges.size() == made.mesh.features.edges.size());
    for (std::size_t i = 0; i < back.features.edges.size(); ++i) {
      CHECK(back.features.edges[i].marker == made.mesh.features.edges[i].marker);
    }
    CHECK(back.notes.empty());
    mesher::write_mesh(back, folder.path("again.msh"), {.msh = version});
    CHECK(folder.read("again.msh") == text);
  }
}

TEST_CASE("what has no marker, or no region, may have a name") {
  Graph<2> graph = two_squares();
  graph.segments.back().marker = 0;
  graph.seeds.pop_back();
  graph.names.facets = {{0, "inside"}};
  graph.names.regions = {{0, "rest"}};
  const std::string text = written(mesher::mesh(graph).mesh, "m.msh");
  CHECK(has_line(text, "1 7 \"inside\""));
  CHECK(has_line(text, "2 4 \"rest\""));
  graph.seeds.clear();
  CHECK(has_line(written(mesher::mesh(graph).mesh, "m.msh"), "2 1 \"rest\""));
}

TEST_CASE("groups of version 2.2 without names have their numbers") {
  const ScratchFolder folder;
  const auto read = [&](const std::string& text) {
    return mesher::read_mesh(folder.write("m.msh", text));
  };
  const std::string head = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n";
  const std::string nodes = "7 0 0 0\n2 1 0 0\n5 0 1 0\n9 1 1 0\n$EndNodes\n";
  const auto mesh = read(head + nodes +
                         "$Elements\n4\n1 15 2 5 1 7\n2 1 2 6 1 7 2\n3 2 2 3 1 7 2 5\n"
                         "4 2 3 4 1 8 2 9 5\n$EndElements\n");
  CHECK(mesh.simplices == std::vector<mesher::Mesh<2>::Simplex>{{0, 1, 2}, {1, 3, 2}});
  CHECK(mesh.features.regions == std::vector<double>{3, 4});
  REQUIRE(mesh.features.edges.size() == 1);
  CHECK(mesh.features.edges[0].marker == 6);
  REQUIRE(mesh.notes.size() == 1);
  CHECK(mesh.notes[0].text == "elements that are points are not used");
  const auto failure = [&](const std::string& text) {
    return support::failure_of([&] { (void)read(text); });
  };
  CHECK(failure(head + "7 0 0 0\n") == "truncated@7:1");
  CHECK(failure(head + "7 0 0 0\n7 1 0 0\n") == "repeated_id@7:1");
  CHECK(failure(head + nodes + "$Elements\n1\n1 2 2 3 1 7 2 6\n") == "bad_mesh@13:15");
  CHECK(failure(head + nodes + "$Elements\n1\n1 3 2 3 1 7 2 5 9\n") == "unsupported@13:3");
  CHECK(failure(head + nodes + "$Elements\n-1\n") == "bad_header@12:1");
  CHECK(failure(head + nodes + "$Elements\n1\n1 2 2 3 1 7 2 2\n") == "bad_mesh@13:1");
}

TEST_CASE(".inp has sets of elements and nodes, and surfaces, by names that Abaqus reads") {
  Graph<2> graph = two_squares();
  graph.names.facets = {{6, "Süd"}, {7, "nall"}, {1, "A*"}, {2, "a_"}};
  const std::string text = written(mesher::mesh(graph).mesh, "m.inp");
  for (const char* line :
       {"*NODE, NSET=Nall", "*ELEMENT, TYPE=CPS3, ELSET=rock",
        "*ELEMENT, TYPE=CPS3, ELSET=region_4", "*ELSET, ELSET=Eall", "rock,", "region_4,",
        "*NSET, NSET=S__d", "*SURFACE, NAME=S__d, TYPE=ELEMENT", "*NSET, NSET=nall_2",
        "*NSET, NSET=A_", "*NSET, NSET=a__2", "*NSET, NSET=marker_3"}) {
    INFO(line);
    CHECK(has_line(text, line));
  }
}

TEST_CASE("numbers in .inp have 20 characters or fewer, as near as these allow") {
  mesher::MeshData<2> mesh;
  mesh.vertices = {{-1.2345678901234567e-05, 0.1}, {-12345678.901234567, 1e-300}, {1e22, -0.0}};
  mesh.kinds.resize(3);
  mesh.simplices = {{0, 1, 2}};
  const std::string text = written(mesh, "m.inp");
  CHECK(has_line(text, "1, -1.2345678901235e-05, 0.1, 0"));
  CHECK(has_line(text, "2, -12345678.901234567, 1e-300, 0"));
  CHECK(has_line(text, "3, 1e+22, -0, 0"));
}

TEST_CASE(".su2 has the boundary by markers, and no lines inside") {
  const std::string text = written(mesher::mesh(two_squares()).mesh, "m.su2");
  CHECK(has_line(text, "NDIME= 2"));
  CHECK(has_line(text, "NMARK= 6"));
  CHECK(has_line(text, "MARKER_TAG= inlet"));
  CHECK(has_line(text, "MARKER_TAG= marker_1"));
  CHECK(text.find("wall") == std::string::npos);
  mesher::Graph<2> points;
  points.points = two_squares().points;
  const auto bare = mesher::mesh(points);
  CHECK(has_line(written(bare.mesh, "m.su2"), "MARKER_TAG= marker_1"));
}

TEST_CASE("an edge that no triangle has is refused by .inp and .su2") {
  mesher::MeshData<2> mesh = mesher::mesh(two_squares()).mesh;
  mesh.features.edges.push_back({0, static_cast<std::uint32_t>(mesh.vertices.size() - 1), {}, 9});
  const ScratchFolder folder;
  for (const char* name : {"m.inp", "m.su2"}) {
    const auto error = error_of([&] { mesher::write_mesh(mesh, folder.path(name)); });
    CHECK(error.code() == ErrorCode::bad_mesh);
  }
}

TEST_CASE("solids of .stl and groups of .obj are markers with names, if there are several") {
  const ScratchFolder folder;
  const auto facet = [](const std::string& z) {
    return "facet normal 0 0 1\nouter loop\nvertex 0 0 " + z + "\nvertex 1 0 " + z +
           "\nvertex 0 1 " + z + "\nendloop\nendfacet\n";
  };
  const auto stl = mesher::read<3>(folder.write(
      "a.stl", "solid  in let \n" + facet("0") + facet("1") + "endsolid in let\nsolid\n" +
                   facet("2") + "endsolid\nsolid none\nendsolid\nsolid wall\n" + facet("3") +
                   "endsolid wall\nsolid in let\n" + facet("4") + "endsolid\n"));
  std::vector<std::int64_t> markers;
  for (const auto& f : stl.graph.polygons) markers.push_back(f.marker);
  CHECK(markers == std::vector<std::int64_t>{1, 1, 2, 3, 1});
  CHECK(stl.graph.names.facets == Markers{{1, "in_let"}, {3, "wall"}});
  REQUIRE(stl.notes.size() == 1);
  CHECK(stl.notes[0].text == "a name with blanks or quotes gets _ in their place");
  const auto one =
      mesher::read<3>(folder.write("b.stl", "solid a\n" + facet("0") + "endsolid a\n"));
  CHECK(one.graph.polygons[0].marker == 0);
  CHECK(one.graph.names.empty());

  const std::string points = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
  const auto obj = mesher::read<3>(folder.write(
      "a.obj", points + "f 1 2 3\no base\ng side\nf 1 2 4\nf 1 3 4\ng top\nf 2 3 4\n"));
  markers.clear();
  for (const auto& f : obj.graph.polygons) markers.push_back(f.marker);
  CHECK(markers == std::vector<std::int64_t>{1, 2, 2, 3});
  CHECK(obj.graph.names.facets == Markers{{2, "side"}, {3, "top"}});
}

TEST_CASE("in space names of polygons are those of solids of .stl and of groups of .obj") {
  // A box cut in two: marker 9 is between the parts, and not on the boundary.
  Graph<3> graph;
  std::int64_t id = 0;
  for (const double x : {0.0, 1.0, 2.0}) {
    for (const double y : {0.0, 1.0}) {
      for (const double z : {0.0, 1.0}) graph.points.push_back({PointId{++id}, {x, y, z}});
    }
  }
  const std::vector<std::vector<std::int64_t>> loops = {
      {1, 2, 4, 3},   {9, 10, 12, 11}, {5, 6, 8, 7},  {1, 5, 7, 3}, {5, 9, 11, 7}, {2, 6, 8, 4},
      {6, 10, 12, 8}, {1, 2, 6, 5},    {5, 6, 10, 9}, {3, 4, 8, 7}, {7, 8, 12, 11}};
  const std::int64_t markers[] = {5, 6, 9, 1, 1, 1, 1, 2, 2, 2, 2};
  for (std::size_t i = 0; i < loops.size(); ++i) {
    mesher::Polygon polygon{mesher::PolygonId{static_cast<std::int64_t>(i + 1)}};
    polygon.loops.emplace_back();
    for (const std::int64_t point : loops[i]) polygon.loops[0].push_back(PointId{point});
    polygon.marker = markers[i];
    graph.polygons.push_back(std::move(polygon));
  }
  const auto plain = mesher::mesh(graph).mesh;
  graph.names.facets = {{5, "inlet"}, {6, "Süd"}, {9, "between"}};
  const auto mesh = mesher::mesh(graph).mesh;
  const ScratchFolder folder;
  const auto text_of = [&](const auto& data, const std::string& name) {
    mesher::write_mesh(data, folder.path(name));
    return folder.read(name);
  };
  const std::string stl = text_of(mesh, "m.stl"), obj = text_of(mesh, "m.obj");
  for (const char* name : {"marker_1", "marker_2", "inlet", "Süd"}) {
    INFO(name);
    CHECK(has_line(stl, std::string("solid ") + name));
    CHECK(has_line(stl, std::string("endsolid ") + name));
    CHECK(has_line(obj, std::string("g ") + name));
  }
  CHECK((stl + obj).find("between") == std::string::npos);
  for (const char* name : {"m.stl", "m.obj"}) {
    INFO(name);
    const auto back = mesher::read<3>(folder.path(name));
    CHECK(back.graph.names.facets == Markers{{3, "inlet"}, {4, "Süd"}});
    std::size_t boundary = 0;
    for (const auto& face : mesh.features.faces) boundary += face.marker != 9 ? 1 : 0;
    CHECK(back.graph.polygons.size() == boundary);
    std::map<PointId, double> x;
    for (const auto& point : back.graph.points) x[point.id] = point.at[0];
    for (const auto& polygon : back.graph.polygons) {
      if (polygon.marker < 3) continue;
      for (const PointId corner : polygon.loops[0]) CHECK(x[corner] == (polygon.marker - 3) * 2);
    }
  }
  // Without names there are no groups, and the same faces.
  const std::string bare = text_of(plain, "p.obj");
  CHECK(bare.find("\ng ") == std::string::npos);
  CHECK(text_of(plain, "p.stl").rfind("solid mesh\n", 0) == 0);
  CHECK(text_of(mesh, "m.off") == text_of(plain, "p.off"));
}

TEST_CASE("names of GeoJSON are those of regions of polygons and of markers of lines") {
  const ScratchFolder folder;
  const auto feature = [](const std::string& properties, const std::string& type,
                          const std::string& coordinates) {
    return R"({"type": "Feature", "properties": {)" + properties + R"(}, "geometry": {"type": ")" +
           type + R"(", "coordinates": )" + coordinates + "}}";
  };
  const auto file = mesher::read<2>(folder.write(
      "a.geojson", R"({"type": "FeatureCollection", "features": [)" +
                       feature(R"("name": "Lake One", "attribute": 5)", "Polygon",
                               "[[[0,0],[1,0],[1,1],[0,0]]]") +
                       "," +
                       feature(R"("name": "pier", "marker": 8)", "LineString", "[[0,5],[1,5]]") +
                       "," + feature(R"("name": "loose")", "LineString", "[[0,6],[1,6]]") + "," +
                       feature(R"("name": "pier", "marker": 9)", "LineString", "[[0,7],[1,7]]") +
                       "," + feature(R"("name": "buoy")", "Point", "[3,3]") + "," +
                       feature(R"("name": 7)", "Point", "[4,3]") + "]}"));
  CHECK(file.graph.names.regions == Regions{{5, "Lake_One"}});
  CHECK(file.graph.names.facets == Markers{{8, "pier"}});
  std::vector<std::string> notes;
  for (const auto& note : file.notes) notes.push_back(note.text);
  CHECK(notes == std::vector<std::string>{
                     "the name of a line without a marker is not used",
                     "a name that its group, or another group, has already is not used",
                     "the name of a point is not used", "the property 'name' is not used",
                     "a name with blanks or quotes gets _ in their place"});
}

TEST_CASE("a repaired graph keeps its names") {
  CHECK(mesher::repair(two_squares()).file.graph.names == two_squares().names);
}
