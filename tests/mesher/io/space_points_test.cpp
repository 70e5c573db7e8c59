// Points in space: which files hold them, what is read of surfaces and grids, what is refused.
#include "space_points.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "bytes.hpp"
#include "facade/graph_runs.hpp"
#include "io/point_file.hpp"
#include "mesher/mesher.hpp"
#include "mesher/read.hpp"
#include "mesher/write.hpp"
#include "scratch_file.hpp"

namespace {

using mesher::Point;
using mesher::PointFile;
using mesher::PointId;
using support::Bytes;
using support::failure_of;
using support::ScratchFolder;

struct NamedFile {
  const char* name;
  std::string content;
};

PointFile<3> read(const NamedFile& file) {
  const ScratchFolder folder;
  return mesher::read_points<3>(folder.write(file.name, file.content));
}

int dimension(const NamedFile& file) {
  const ScratchFolder folder;
  return mesher::dimension_of(folder.write(file.name, file.content));
}

struct Refused {
  NamedFile file;
  const char* failure;  // code@line:column
};

void require_refused(const std::vector<Refused>& all) {
  for (const Refused& refused : all) {
    CAPTURE(refused.file.name, refused.file.content);
    CHECK(failure_of([&] { read(refused.file); }) == refused.failure);
  }
}

// The corners of a tetrahedron as faces 1 0 2 and 1 2 3.
const std::vector<Point<3>> kCorners{{0, 0, 0}, {1, 0, 0.5}, {0, -1, 0}, {0, 0, 2}};

std::string vtu(const std::string& places, int cells = 0) {
  std::string file =
      "<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid><Piece "
      "NumberOfPoints=\"4\" NumberOfCells=\"" +
      std::to_string(cells) + "\">\n<Points><DataArray type=\"Float64\" NumberOfComponents=\"3\">" +
      places + "</DataArray></Points><Cells>";
  const std::string values[][2] = {{"connectivity", "0 1 2 3"}, {"offsets", "4"}, {"types", "10"}};
  for (const auto& [name, value] : values) {
    file += "<DataArray type=\"Int64\" Name=\"" + name + "\">" + (cells > 0 ? value : "") +
            "</DataArray>";
  }
  return file + "</Cells></Piece></UnstructuredGrid></VTKFile>";
}

constexpr const char* kPlyHeader =
    "element vertex 4\nproperty uchar red\nproperty float x\nproperty list uchar short more\n"
    "property double z\nproperty float32 y\nelement face 2\nproperty list uint8 int32 corners\n"
    "end_header\n";

std::string text_ply() {
  return std::string("ply\nformat ascii 1.0\ncomment element vertex 9\nobj_info x\n") + kPlyHeader +
         "7 0 0 0 0\n7 1 2 5 6 0.5 0\n7 0 1 5 0 -1\n7 -0 0 2 0\n3 1 0 2 3 1 2 3\n";
}

std::string binary_ply(bool big_endian) {
  Bytes ply(big_endian);
  ply << "ply\nformat " << (big_endian ? "binary_big_endian" : "binary_little_endian") << " 1.0\n"
      << kPlyHeader;
  int more = 0;
  for (const Point<3>& p : kCorners) {
    ply.all<std::uint8_t>(7).all<float>(p[0]).all<std::uint8_t>(more % 3);
    for (int i = 0; i < more % 3; ++i) ply.all<std::int16_t>(-i);
    ++more;
    ply.all<double>(p[2]).all<float>(p[1]);
  }
  for (int face = 0; face < 2; ++face) ply.all<std::uint8_t>(3).all<std::int32_t>(1, 2, face);
  return ply.text();
}

std::string binary_stl(const std::string& header, std::uint32_t said) {
  Bytes stl(false);
  stl << (header + std::string(80 - header.size(), ' ')).c_str();
  stl.all<std::uint32_t>(said);
  for (const auto& [a, b, c] : {std::array{1, 0, 2}, std::array{1, 2, 3}}) {
    stl.all<float>(0, 0, 0);
    for (const int v : {a, b, c}) stl.all<float>(kCorners[v][0], kCorners[v][1], kCorners[v][2]);
    stl.all<std::uint16_t>(0);
  }
  return stl.text();
}

const std::string kTextStl =
    "solid a thing\n facet normal 0 0 1\n  outer loop\n   vertex 1 0 0.5\n   vertex 0 0 0\n"
    "   vertex 0 -1 -0\n  endloop\n endfacet\n facet normal 0 0 1\n outer loop\n vertex 1 0 .5\n"
    " vertex 0 -1 0\n vertex -0 0 2\n endloop\n endfacet\nendsolid a thing\n";

}  // namespace

TEST_CASE("a file is in space where its header, or a third coordinate that varies, says so") {
  const std::vector<std::pair<NamedFile, int>> all{
      {{"a.node", "1 3 0 0\n1 0 0 0\n"}, 3},
      {{"a.node", "1 2 0 0\n1 0 0\n"}, 2},
      {{"a.node", "1\n1 0 0\n"}, 2},
      {{"a.node", "# c\n\n0 3\n"}, 3},
      {{"a.node", ""}, 2},
      {{"a.xyz", "1 2\n3 4\n"}, 2},
      {{"a.xyz", "1 2 0\n3 4 -0.0\n"}, 2},
      {{"a.xyz", "1 2 0\n3 4 1e-30\n"}, 3},
      {{"a.xyz", "1 2 7\n3 4 7\n"}, 3},
      {{"a.xyz", "1 2 nan\n"}, 3},
      {{"a.csv", "1,2\n3,4\n"}, 2},
      {{"a.csv", "1,2,0\n3,4,0\n"}, 3},
      {{"a.csv", "y,x,Z\n1,2,0\n3,4,0\n"}, 2},
      {{"a.csv", "y,x,Z\n1,2,0\n3,4,1\n"}, 3},
      {{"a.csv", "y,x,Z\n1,2,0\n3,4,nan\n"}, 3},
      {{"a.csv", "lon,lat,z\n1,2,3\n"}, 2},
      {{"a.csv", "x;y;z\n1;2;3\n"}, 3},
      {{"a.csv", "x,y,height\n1,2,3\n"}, 2},
      {{"a.csv", ""}, 2},
      {{"a.obj", "v 0 0 5\nv 1 0 5\nl 1 2\n"}, 2},
      {{"a.obj", "v 0 0\nv 1 0 0\n"}, 2},
      {{"a.obj", "v 0 0 5\nvn 0 0 1\nv 1 0 6\n"}, 3},
      {{"a.vtu", vtu("0 0 1  1 0 1  0 1 1  1 1 1")}, 2},
      {{"a.vtu", vtu("0 0 1  1 0 1  0 1 1  1 1 2")}, 3},
      {{"a.OFF", "OFF\n0 0 0\n"}, 3},
      {{"a.ply", ""}, 3},
      {{"a.stl", ""}, 3},
      {{"a.vtk", ""}, 3},
      {{"a.poly", "0 3 0 0\n"}, 3},
      {{"a.poly", "0 2 0 0\n"}, 2},
      {{"a.smesh", ""}, 3},
      {{"a.geojson", ""}, 2},
      {{"a.dae", ""}, 2}};
  for (const auto& [file, expected] : all) {
    CAPTURE(file.name, file.content);
    CHECK(dimension(file) == expected);
  }
  CHECK(failure_of([] { (void)mesher::dimension_of("none.node"); }) == "cannot_read@0:0");
}

TEST_CASE("the vertices of surfaces and grids in space are read as points 1..n") {
  const std::vector<NamedFile> files{
      {"a.off", "OFF\n4 2 0\n0 0 0\n1 0 .5 255 0 0\n0 -1 0\n0 0 2\n3 1 0 2\n3 1 2 3 1 0 0\n"},
      {"a.off", "COFF 4 0 6\n0 0 0 9\n1 0 .5 9\n0 -1 0 9\n-0 0 2 9\n"},
      {"a.obj",
       "# c\nmtllib m\nv 0 0 0\nv 1 0 .5 1\nv 0 -1 0 1 0 0\nvn 0 0 1\nv -0 0 2\n"
       "f 1//1 2 3\np 1\nl 1 2\n"},
      {"a.ply", text_ply()},
      {"a.ply", binary_ply(false)},
      {"a.ply", binary_ply(true)},
      {"a.vtu", vtu("0 0 0  1 0 .5  0 -1 0  -0 0 2", 1)}};
  for (const NamedFile& file : files) {
    CAPTURE(file.name, file.content);
    const auto points = read(file);
    CHECK(points.points == kCorners);
    CHECK(points.ids == std::vector{PointId{1}, PointId{2}, PointId{3}, PointId{4}});
    CHECK_FALSE(std::signbit(points.points[3][0]));
  }
}

TEST_CASE("corners of an .stl file in one place are one point, text or binary") {
  const std::vector<Point<3>> by_corner{kCorners[1], kCorners[0], kCorners[2], kCorners[3]};
  CHECK(read({"a.stl", kTextStl}).points == by_corner);
  CHECK(read({"a.stl", kTextStl}).lines == std::vector<long>{4, 5, 6, 13});
  CHECK(read({"a.STL", binary_stl("", 2)}).points == by_corner);
  // Some programs begin binary files as if they were text.
  CHECK(read({"a.stl", binary_stl("solid", 2)}).points == by_corner);
  CHECK(read({"a.stl", "solid\nendsolid\nsolid b\nendsolid b\n"}).points.empty());
}

TEST_CASE("what of a surface is not used is noted, with its place") {
  const auto notes_of = [](const NamedFile& file) {
    std::string all;
    for (const auto& note : read(file).notes) {
      all += std::to_string(note.location.line) + ": " + note.text + "\n";
    }
    return all;
  };
  CHECK(notes_of({"a.off", "NOFF\n1 2 0\n0 0 0 1\n3 0 0 0\n3 0 0 0\n"}) ==
        "3: a colour or normal is not used\n4: a face is not used (2 times)\n");
  CHECK(notes_of({"a.obj", "v 0 0 1\np 1\nf 1 1 1\nusemtl m\nf 1 1 1\n"}) ==
        "3: the statement 'f' is not used (2 times)\n4: the statement 'usemtl' is not used\n");
  CHECK(notes_of({"a.ply", text_ply()}) ==
        "5: properties of vertices other than x, y and z are not used\n"
        "11: the element 'face' is not used\n");
  CHECK(notes_of({"a.vtu", vtu("0 0 0 1 0 1 0 1 0 0 0 2", 1)}) ==
        "2: cells other than vertices are not used\n");
  CHECK(notes_of({"a.stl", kTextStl}).empty());
}

TEST_CASE("bad files of surfaces are refused with the code and the place of the mistake") {
  require_refused({
      {{"a.off", ""}, "truncated@0:0"},
      {{"a.off", "4OFF\n"}, "bad_header@1:1"},
      {{"a.off", "OFF\n-1 0 0\n"}, "bad_header@2:1"},
      {{"a.off", "OFF\n2 0 0\n0 0 0\n"}, "truncated@3:6"},
      {{"a.off", "OFF\n2 0 0\n0 0 0\n1 1"}, "truncated@4:4"},
      {{"a.off", "OFF\n2 0 0\n0 0\n1 1 1\n"}, "wrong_count@3:4"},
      {{"a.off", "OFF\n1 0 0\n0 nan 0\n"}, "not_finite@3:3"},
      {{"a.off", "OFF\n1 0 0\n0 1e40 0\n"}, "magnitude@3:3"},
      {{"a.off", "OFF\n1 0 0\n0 0 0\n1 1 1\n"}, "wrong_count@4:1"},
      {{"a.off", "OFF\n1 2 0\n0 0 0\n3 0 0 0\n"}, "truncated@4:8"},
      {{"a.off", "OFF\n1 1 0\n0 0 0\n3 0 0\n"}, "wrong_count@4:6"},
      {{"a.off", "OFF\n1000000000000000000 0 0\n0 0 0\n"}, "truncated@3:6"},
      {{"a.off", "OFF\n2 0 0\n0 0 1\n0 0 1\n"}, "duplicate_point@4:1"},
      {{"a.obj", "v 0 0 1\nv 0 0\n"}, "wrong_count@2:6"},
      {{"a.obj", "v 0 0 1\nv 0 0 1 1 1\n"}, "wrong_count@2:12"},
      {{"a.obj", "v 0 0 x\n"}, "bad_number@1:7"},
      {{"a.obj", "v 0 0 1\nvertex 1 1 1\n"}, "bad_syntax@2:1"},
      {{"a.obj", "v 0 0 1\nv 1 1 1\nv 0 0 1\n"}, "duplicate_point@3:1"},
      {{"a.vtu", vtu("0 0 0 1 0 1 0 1 0 0 0 1e40")}, "magnitude@2:10"},
      {{"a.vtu", vtu("0 0 0 1 0 1 0 1 0")}, "wrong_count@1:75"},
      {{"a.vtu", vtu("0 0 0 1 0 1 0 1 0 0 0 0")}, "duplicate_point@2:1"},
      {{"a.vtk", ""}, "bad_header@1:1"},
      {{"a.tri", ""}, "unknown_format@0:0"},
  });
}

TEST_CASE("bad .ply files are refused with the code and the place of the mistake") {
  const std::string head =
      "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\n"
      "property float y\nproperty float z\nend_header\n";
  require_refused({
      {{"a.ply", ""}, "truncated@0:0"},
      {{"a.ply", "plx\n"}, "bad_header@1:1"},
      {{"a.ply", "ply\nformat ascii 1.0\n"}, "truncated@2:17"},
      {{"a.ply", "ply\nend_header\n"}, "bad_header@2:1"},
      {{"a.ply", "ply\nformat text 1.0\nend_header\n"}, "unsupported@2:8"},
      {{"a.ply", "ply\nformat ascii 2.0\nend_header\n"}, "unsupported@2:14"},
      {{"a.ply", "ply\nformat ascii 1.0\nend_header\n"}, "bad_header@0:0"},
      {{"a.ply", "ply\nformat ascii 1.0\nproperty float x\n"}, "bad_header@3:1"},
      {{"a.ply", "ply\nformat ascii 1.0\nelement vertex -1\n"}, "bad_header@3:16"},
      {{"a.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty real x\n"}, "unsupported@4:10"},
      {{"a.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty list float int x\n"},
       "bad_header@4:15"},
      {{"a.ply", "ply\nformat ascii 1.0\nthing\n"}, "bad_syntax@3:1"},
      {{"a.ply", "ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nend_header\n"},
       "bad_header@3:1"},
      {{"a.ply", head + "0 0 0\n"}, "truncated@9:1"},
      {{"a.ply", head + "0 0 0\n1 1"}, "truncated@9:4"},
      {{"a.ply", head + "0 0 0\n1 nan 1\n"}, "not_finite@9:3"},
      {{"a.ply", head + "0 0 0\n1 1e37 1\n"}, "magnitude@9:1"},
      {{"a.ply", head + "0 0 0\n1 z 1\n"}, "bad_number@9:3"},
      {{"a.ply", head + "0 0 0\n1 1 1\n2\n"}, "wrong_count@10:1"},
      {{"a.ply", head + "0 0 1\n0 0 1\n"}, "duplicate_point@9:1"},
      // Values that the header does not tell of are the next row's, until that does not fit.
      {{"a.ply", head + "0 0 0 8\n1 1 1\n"}, "wrong_count@8:7"},
      {{"a.ply", head + "0 0 0 8\n1 z 1\n"}, "wrong_count@8:7"},
      {{"a.ply", head + "0 0 0 1 1\n"}, "wrong_count@8:7"},
  });
  // Lines and columns say nothing of binary data.
  for (const bool big_endian : {false, true}) {
    const std::string whole = binary_ply(big_endian);
    const std::size_t header = whole.find("end_header\n") + 11;
    for (std::size_t size = header; size < whole.size(); ++size) {
      CHECK(failure_of([&] { read({"a.ply", whole.substr(0, size)}); }) == "truncated@0:0");
    }
    CHECK(failure_of([&] { read({"a.ply", whole + 'x'}); }) == "wrong_count@0:0");
    CHECK(read({"a.ply", whole + "\r\n"}).points == kCorners);
  }
  Bytes bad(false);
  bad << "ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty float x\n"
         "property float y\nproperty float z\nend_header\n";
  Bytes huge = bad;
  bad.all<float>(0, 0, NAN);
  huge.all<float>(0, 0, 1e38F);
  CHECK(failure_of([&] { read({"a.ply", bad.text()}); }) == "not_finite@0:0");
  CHECK(failure_of([&] { read({"a.ply", huge.text()}); }) == "magnitude@0:0");
}

TEST_CASE("bad .stl files are refused with the code and the place of the mistake") {
  const std::string binary = binary_stl("", 2);
  require_refused({
      {{"a.stl", ""}, "truncated@0:0"},
      {{"a.stl", binary.substr(0, 83)}, "truncated@0:0"},
      {{"a.stl", binary.substr(0, binary.size() - 1)}, "truncated@0:0"},
      {{"a.stl", binary + "x"}, "wrong_count@0:0"},
      {{"a.stl", binary_stl("", 4000000000)}, "truncated@0:0"},
      {{"a.stl", "solid\n"}, "truncated@1:6"},
      {{"a.stl", "solid\nfacet normal 0 0 1\n vertex 0 0 0\n"}, "bad_syntax@3:2"},
      {{"a.stl", "solid\nfacet\nouter loop\nvertex 0 0\n"}, "wrong_count@4:11"},
      {{"a.stl", "solid\nfacet\nouter loop\nvertex 0 0 0 0\n"}, "wrong_count@4:14"},
      {{"a.stl", "solid\nfacet\nouter loop\nvertex 0 0 inf\n"}, "not_finite@4:12"},
      {{"a.stl", "solid\nfacet\nouter loop\nvertex 0 0 1e40\n"}, "magnitude@4:12"},
      {{"a.stl", "solid\nendsolid\nfacet\n"}, "bad_syntax@3:1"},
  });
  for (std::size_t size = 5; size + 1 < kTextStl.rfind("endsolid"); ++size) {
    CAPTURE(size);
    CHECK_THROWS_AS(read({"a.stl", kTextStl.substr(0, size)}), mesher::Error);
  }
  std::string bad = binary;
  const float nan = NAN;
  std::memcpy(&bad[96], &nan, sizeof nan);
  CHECK(failure_of([&] { read({"a.stl", bad}); }) == "not_finite@0:0");
}

TEST_CASE("the points of a mesh that was written in space are read back bit for bit") {
  const auto input = support::space_points(support::SpaceFamily::spread, 30, 3);
  const auto mesh = mesher::mesh_statically<3>(input, {.domain = mesher::snapped_domain<3>(input)});
  const ScratchFolder folder;
  for (const char* name : {"m.node", "m.vtu", "m.vtk"}) {
    CAPTURE(name);
    mesher::write_mesh(mesh, folder.path(name));
    CHECK(mesher::dimension_of(folder.path(name)) == 3);
    CHECK(mesher::read_points<3>(folder.path(name)).points == mesh.vertices);
  }
}

TEST_CASE("coordinates of surfaces that are noise are taken as 0, with a note") {
  const std::vector<NamedFile> files{
      {"a.off", "OFF\n3 1 0\n0 1e-40 0\n1 0 -1e-33\n0 1 7e-31\n3 0 1 2\n"},
      {"a.obj", "v 0 1e-40 0\nv 1 0 -1e-33\nv 0 1 7e-31\nf 1 2 3\n"},
      {"a.ply",
       "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double y\n"
       "property double z\nend_header\n0 1e-40 0\n1 0 -1e-33\n0 1 7e-31\n"},
      {"a.stl",
       "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 1e-40 0\nvertex 1 0 -1e-33\n"
       "vertex 0 1 7e-31\nendloop\nendfacet\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n"
       "vertex 0 1 0\nvertex 1 0 0\nendloop\nendfacet\nendsolid\n"}};
  for (const NamedFile& file : files) {
    CAPTURE(file.name);
    const PointFile<3> rows = read(file);
    CHECK(rows.points == std::vector<Point<3>>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    const auto is_it = [](const mesher::Note& note) {
      return note.text == "a coordinate below 2^-100 is taken as 0";
    };
    CHECK(std::count_if(rows.notes.begin(), rows.notes.end(), is_it) == 1);
  }
  CHECK(failure_of([&] { read({"a.node", "1 3 0 0\n1 0 0 1e-40\n"}); }) == "magnitude@2:7");
}

TEST_CASE("lines of .obj files go on after a backslash") {
  const ScratchFolder folder;
  const auto read_graph = [&](const std::string& content) {
    return mesher::read<3>(folder.write("a.obj", content)).graph;
  };
  const std::string vertices = "v 0 0 0\nv 1 \\\n 0 0\nv 1 1 0\nv 0 1 0\n";
  const auto graph = read_graph(vertices + "f 1 2\\\n3 4\nf 1 2 \\\r\n\\\n3\n");
  REQUIRE(graph.points.size() == 4);
  CHECK(graph.points[1].at == Point<3>{1, 0, 0});
  REQUIRE(graph.polygons.size() == 2);
  CHECK(graph.polygons[0].loops[0].size() == 4);
  CHECK(graph.polygons[1].loops[0].size() == 3);
  const auto failure = [&](const std::string& faces) {
    return failure_of([&] { static_cast<void>(read_graph(vertices + faces)); });
  };
  CHECK(failure("f 1 2 \\\n 3 x\n") == "bad_number@7:4");
  CHECK(failure("f 1 \\\n 9 2\n") == "bad_mesh@7:2");
}
