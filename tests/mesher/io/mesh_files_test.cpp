// Meshes with features in every format: what is written reads back, what others write is read, and
// what is no mesh is refused with its place.
#include <algorithm>
#include <bit>
#include <catch2/catch.hpp>
#include <cstring>

#include "mesher/read.hpp"
#include "mesher/write.hpp"
#include "random_mesh.hpp"
#include "random_mistakes.hpp"
#include "scratch_file.hpp"

namespace {

using mesher::LineId;
using mesher::MeshData;
using mesher::VertexKind;
using support::failure_of;
using support::ScratchFolder;

// Equal to the last bit: == takes -0 for 0.
bool same_bits(const std::vector<mesher::Point<2>>& a, const std::vector<mesher::Point<2>>& b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]) == 0);
}

MeshData<2> back(const ScratchFolder& folder, const MeshData<2>& mesh, const std::string& name) {
  mesher::write_mesh(mesh, folder.path(name));
  return mesher::read_mesh(folder.path(name));
}

MeshData<2> read(const std::string& name, const std::string& content) {
  const ScratchFolder folder;
  return mesher::read_mesh(folder.write(name, content));
}

std::vector<mesher::MeshEdge> without_lines(std::vector<mesher::MeshEdge> edges) {
  for (auto& edge : edges) edge.line.reset();
  return edges;
}

struct Refused {
  const char* name;
  const char* content;
  const char* failure;  // code@line:column
};

std::string vtu(const std::string& points, const std::string& cells, const std::string& more = "") {
  return "<VTKFile type=\"UnstructuredGrid\">\n<UnstructuredGrid>\n"
         "<Piece NumberOfPoints=\"3\" NumberOfCells=\"1\">\n" +
         more + "<Points>\n" + points + "</Points>\n<Cells>\n" + cells +
         "</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
}

std::string array(const std::string& type, const std::string& name, const std::string& values) {
  return "<DataArray type=\"" + type + "\" Name=\"" + name + "\" NumberOfComponents=\"" +
         (name == "Points" ? "3" : "1") + "\" format=\"ascii\">\n" + values + "\n</DataArray>\n";
}

const std::string kPoints = array("Float64", "Points", "0 0 0 1 0 0 0 1 0");
const std::string kCells = array("Int32", "connectivity", "0 1 2") + array("Int8", "offsets", "3") +
                           array("UInt8", "types", "5");

}  // namespace

TEST_CASE("random meshes with features read back equal from .node, .vtu and .vtk") {
  const ScratchFolder folder;
  const std::uint64_t seed = GENERATE(1, 2, 3, 4);
  mesher::SplitMix64 random(seed);
  for (int round = 0; round < 15; ++round) {
    const MeshData<2> mesh =
        support::random_mesh(1 + static_cast<std::uint32_t>(random.below(6)), random);
    for (const std::string name : {"m.node", "m.vtu", "m.vtk"}) {
      INFO("seed " << seed << ", round " << round << ", " << name);
      const MeshData<2> copy = back(folder, mesh, name);
      REQUIRE(same_bits(copy.vertices, mesh.vertices));
      REQUIRE(copy == mesh);
      REQUIRE(copy.features == mesh.features);
      REQUIRE(copy.notes.empty());
    }
  }
}

TEST_CASE("random meshes read back from .msh and .mesh but for kinds, origins and lines") {
  const ScratchFolder folder;
  mesher::SplitMix64 random(5);
  for (int round = 0; round < 30; ++round) {
    MeshData<2> mesh = support::random_mesh(1 + static_cast<std::uint32_t>(random.below(6)), random,
                                            {.any_region = false, .any_marker = false});
    INFO("round " << round);
    for (const std::string name : {"m.msh", "m.mesh"}) {
      MeshData<2> copy = back(folder, mesh, name);
      REQUIRE(same_bits(copy.vertices, mesh.vertices));
      REQUIRE(copy.features.edges == without_lines(mesh.features.edges));
      REQUIRE(copy.features.markers ==
              (name == "m.mesh" ? mesh.features.markers : std::vector<std::int64_t>()));
      // .msh keeps the triangles of a region together
      std::vector<std::pair<mesher::Mesh<2>::Simplex, double>> expected, found;
      for (std::size_t i = 0; i < mesh.simplices.size(); ++i) {
        expected.emplace_back(mesh.simplices[i], mesh.features.regions[i]);
        found.emplace_back(copy.simplices.at(i), copy.features.regions.at(i));
      }
      std::sort(expected.begin(), expected.end());
      std::sort(found.begin(), found.end());
      REQUIRE(found == expected);
    }
  }
}

TEST_CASE("regions and markers of any value read back from .msh by their names") {
  const ScratchFolder folder;
  mesher::SplitMix64 random(6);
  const MeshData<2> mesh = support::random_mesh(5, random);
  const MeshData<2> copy = back(folder, mesh, "m.msh");
  CHECK(copy.features.edges == without_lines(mesh.features.edges));
  auto expected = mesh.features.regions, found = copy.features.regions;
  std::sort(expected.begin(), expected.end());
  std::sort(found.begin(), found.end());
  CHECK(found == expected);
}

TEST_CASE("random meshes read back from .obj and .off: triangles, and lines of .obj") {
  const ScratchFolder folder;
  mesher::SplitMix64 random(7);
  const MeshData<2> mesh = support::random_mesh(6, random);
  MeshData<2> obj = back(folder, mesh, "m.obj");
  CHECK(same_bits(obj.vertices, mesh.vertices));
  CHECK(obj.simplices == mesh.simplices);
  REQUIRE(obj.features.edges.size() == mesh.features.edges.size());
  for (std::size_t i = 0; i < obj.features.edges.size(); ++i) {
    CHECK(obj.features.edges[i].low == mesh.features.edges[i].low);
    CHECK(obj.features.edges[i].high == mesh.features.edges[i].high);
  }
  MeshData<2> off = back(folder, mesh, "m.off");
  CHECK(same_bits(off.vertices, mesh.vertices));
  CHECK(off.simplices == mesh.simplices);
}

TEST_CASE("coordinates of every magnitude read back bit for bit from all formats") {
  const ScratchFolder folder;
  mesher::SplitMix64 random(8);
  MeshData<2> mesh = support::random_mesh(1, random);
  for (int i = 0; i < 5000; ++i) {
    const double x = std::bit_cast<double>(random.bits());
    mesh.vertices.push_back({std::isfinite(x) ? x : -0.0, std::ldexp(random.unit(), -1060)});
    mesh.kinds.push_back(VertexKind::steiner);
  }
  mesh.features.origins.clear();
  mesh.features.markers.clear();
  for (const std::string name : {"m.node", "m.vtu", "m.vtk", "m.msh", "m.mesh", "m.off", "m.obj"}) {
    INFO(name);
    CHECK(same_bits(back(folder, mesh, name).vertices, mesh.vertices));
  }
}

TEST_CASE("an empty mesh is written and read in every format") {
  const ScratchFolder folder;
  for (const std::string name : {"m.node", "m.vtu", "m.vtk", "m.msh", "m.mesh", "m.off", "m.obj"}) {
    INFO(name);
    const MeshData<2> copy = back(folder, MeshData<2>(), name);
    CHECK(copy == mesher::Mesh<2>());
    CHECK(copy.features.empty());
  }
}

TEST_CASE("a mesh with features is five files of Triangle's, a plain one two") {
  const ScratchFolder folder;
  mesher::SplitMix64 random(9);
  const MeshData<2> mesh = support::random_mesh(2, random);
  mesher::write_mesh(mesh, folder.path("m.node"));
  CHECK(folder.count() == 5);
  CHECK(folder.read("m.poly").substr(0, 8) == "0 2 0 1\n");
  const ScratchFolder plain;
  mesher::write_mesh(static_cast<const mesher::Mesh<2>&>(mesh), plain.path("m.node"));
  CHECK(plain.count() == 2);
}

TEST_CASE("neighbours are across from the corners, and their file must agree") {
  const ScratchFolder folder;
  MeshData<2> mesh;
  mesh.vertices = {{0, 0}, {1, 0}, {0, 1}, {1, 1}};
  mesh.kinds.assign(4, VertexKind::steiner);
  mesh.simplices = {{0, 1, 2}, {1, 3, 2}};
  mesh.features.regions = {1, 2};
  CHECK(mesher::neighbours(mesh) ==
        std::vector<std::array<std::uint32_t, 3>>{{1, mesher::kNoTriangle, mesher::kNoTriangle},
                                                  {mesher::kNoTriangle, 0, mesher::kNoTriangle}});
  mesher::write_mesh(mesh, folder.path("m.node"));
  CHECK(folder.read("m.neigh") == "2 3\n1 2 -1 -1\n2 -1 1 -1\n");
  folder.write("m.neigh", "2 3\n1 2 -1 -1\n2 -1 -1 1\n");
  CHECK(failure_of([&] { (void)mesher::read_mesh(folder.path("m.node")); }) == "bad_mesh@3:6");
}

TEST_CASE("files of Triangle are read: 0-based, attributes, markers, segments, stale inputs") {
  const ScratchFolder folder;
  folder.write("m.node", "4 2 1 1\n0 0 0 2.5 1\n1 1 0 3.5 1\n2 0 1 4.5 1\n3 1 1 5.5 7\n");
  folder.write("m.ele", "2 3 2\n0 0 1 2 5 1\n1 1 3 2 6 1\n");
  folder.write("m.edge", "5 1\n0 0 1 1\n1 1 2 0\n2 2 0 1\n3 1 3 4\n4 3 2 1\n");
  folder.write("m.poly", "0 2 0 1\n2 1\n0 0 1 1\n1 2 1 0\n0\n");
  const MeshData<2> mesh = mesher::read_mesh(folder.path("m.ele"));
  CHECK(mesh.features.markers == std::vector<std::int64_t>{1, 1, 1, 7});
  CHECK(mesh.features.regions == std::vector<double>{5, 6});
  using Edges = std::vector<std::array<std::int64_t, 3>>;
  Edges edges;
  for (const auto& e : mesh.features.edges) edges.push_back({e.low, e.high, e.marker});
  CHECK(edges == Edges{{0, 1, 1}, {0, 2, 1}, {1, 2, 0}, {1, 3, 4}, {2, 3, 1}});
  CHECK(mesh.kinds == std::vector<VertexKind>(4, VertexKind::steiner));
  REQUIRE(mesh.notes.size() == 2);
  CHECK(mesh.notes[0].text == "attributes are not used");                // of vertices
  CHECK(mesh.notes[1].text == "attributes but the first are not used");  // of triangles
  folder.write("m.poly", "1 2 0 0\n0 0 0\n0 0\n0\n");
  CHECK(mesher::read_mesh(folder.path("m.ele")).features.edges.size() == 4);
}

TEST_CASE("binary data of .vtu are read: base64 and raw, inline and appended, either byte order") {
  // Values of the test mesh as meshio and VTK write them: a size, then the bytes.
  const auto encode = [](const std::string& bytes) {
    const char* const digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
      std::uint32_t bits = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        bits = bits << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0);
      }
      for (std::size_t k = 0; k < 4; ++k) {
        text += i + k > bytes.size() ? '=' : digits[bits >> (18 - 6 * k) & 63];
      }
    }
    return text;
  };
  const bool big_endian = GENERATE(false, true);
  const bool wide = GENERATE(false, true);
  const auto bytes_of = [&](auto value) {
    std::string bytes(reinterpret_cast<const char*>(&value), sizeof value);
    if (big_endian) std::reverse(bytes.begin(), bytes.end());
    return bytes;
  };
  const auto block = [&](auto... values) {
    std::string data;
    ((data += bytes_of(values)), ...);
    return std::pair(wide ? bytes_of(std::uint64_t{data.size()})
                          : bytes_of(static_cast<std::uint32_t>(data.size())),
                     data);
  };
  const auto points = block(0.0, 0.0, 0.0, 1.0 / 3, 0.0, 0.0, 0.0, -1e-300, 0.0);
  const auto corners = block(std::int32_t{0}, std::int32_t{1}, std::int32_t{2});
  const auto ends = block(std::uint16_t{3});
  const auto types = block(std::int8_t{5});
  const auto regions = block(1.5F);
  const std::string head = std::string(
                               "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" "
                               "byte_order=\"") +
                           (big_endian ? "BigEndian" : "LittleEndian") + "\" header_type=\"" +
                           (wide ? "UInt64" : "UInt32") + "\">\n<UnstructuredGrid>\n" +
                           "<Piece NumberOfPoints=\"3\" NumberOfCells=\"1\">\n";
  enum class Form { inline_together, inline_apart, appended_base64, appended_raw };
  for (const Form form :
       {Form::inline_together, Form::inline_apart, Form::appended_base64, Form::appended_raw}) {
    std::string appended;
    const auto data = [&](const char* type, const char* name, const auto& content) {
      const std::string array = std::string("<DataArray type=\"") + type + "\" Name=\"" + name +
                                "\" NumberOfComponents=\"" +
                                (std::string(name) == "Points" ? "3" : "1") + "\" format=\"";
      if (form == Form::inline_together) {
        return array + "binary\">\n  " + encode(content.first + content.second) +
               "\n</DataArray>\n";
      }
      if (form == Form::inline_apart) {
        return array + "binary\">" + encode(content.first) + encode(content.second) +
               "</DataArray>\n";
      }
      const std::string offset = std::to_string(appended.size());
      const std::string whole = content.first + content.second;
      appended += form == Form::appended_raw ? whole : encode(whole);
      return array + "appended\" offset=\"" + offset + "\"/>\n";
    };
    std::string text = head + "<CellData>" + data("Float32", "region", regions) + "</CellData>\n";
    text += "<Points>" + data("Float64", "Points", points) + "</Points>\n<Cells>\n";
    text += data("Int32", "connectivity", corners) + data("UInt16", "offsets", ends);
    text += data("Int8", "types", types) + "</Cells>\n</Piece>\n</UnstructuredGrid>\n";
    if (!appended.empty()) {
      text += std::string("<AppendedData encoding=\"") +
              (form == Form::appended_raw ? "raw" : "base64") + "\">\n _" + appended +
              "\n</AppendedData>\n";
    }
    INFO("form " << static_cast<int>(form) << "\n" << text);
    const MeshData<2> mesh = read("m.vtu", text + "</VTKFile>\n");
    CHECK(mesh.vertices == std::vector<mesher::Point<2>>{{0, 0}, {1.0 / 3, 0}, {0, -1e-300}});
    CHECK(mesh.simplices == std::vector<mesher::Mesh<2>::Simplex>{{0, 1, 2}});
    CHECK(mesh.features.regions == std::vector<double>{1.5});
  }
}

TEST_CASE("files of Gmsh are read: entities with groups, nodes in blocks, points as elements") {
  const MeshData<2> mesh = read("m.msh",
                                "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n"
                                "$PhysicalNames\n2\n1 3 \"the wall\"\n2 7 \"inner part\"\n"
                                "$EndPhysicalNames\n"
                                "$Entities\n1 1 1 0\n1 0 0 0 0\n"
                                "4 0 0 0 1 0 0 1 3 2 1 -1\n"
                                "6 0 0 0 1 1 0 1 7 1 4\n$EndEntities\n"
                                "$Nodes\n2 3 2 9\n0 1 0 1\n9\n0 0 0.5\n"
                                "2 6 1 2\n2\n4\n1 0 0.5 0.1 0.2\n0 1 0.5 0.3 0.4\n$EndNodes\n"
                                "$Elements\n3 3 1 3\n0 1 15 1\n1 9\n1 4 1 1\n2 9 2\n"
                                "2 6 2 1\n3 9 2 4\n$EndElements\n"
                                "$Periodic\n0\n$EndPeriodic\n");
  CHECK(mesh.vertices == std::vector<mesher::Point<2>>{{0, 0}, {1, 0}, {0, 1}});
  CHECK(mesh.simplices == std::vector<mesher::Mesh<2>::Simplex>{{0, 1, 2}});
  CHECK(mesh.features.regions == std::vector<double>{7});
  REQUIRE(mesh.features.edges.size() == 1);
  CHECK(mesh.features.edges[0].marker == 3);
  CHECK(mesh.features.names.facets == std::map<std::int64_t, std::string>{{3, "the_wall"}});
  CHECK(mesh.features.names.regions == std::map<double, std::string>{{7, "inner_part"}});
  CHECK(mesh.notes.size() == 3);
}

TEST_CASE("legacy VTK of version 5 and scalars are read") {
  const MeshData<2> mesh = read("m.vtk",
                                "# vtk DataFile Version 5.1\nany title # here\nASCII\n"
                                "DATASET UNSTRUCTURED_GRID\nPOINTS 3 float\n0 0 1 1 0 1\n0 1 1\n"
                                "METADATA\nINFORMATION 0\n\n"
                                "CELLS 3 5\nOFFSETS vtktypeint64\n0 3 5\n"
                                "CONNECTIVITY vtktypeint64\n0 1 2 1 2\nCELL_TYPES 2\n5\n3\n"
                                "CELL_DATA 2\nSCALARS region int 1\nLOOKUP_TABLE default\n4 0\n");
  CHECK(mesh.simplices == std::vector<mesher::Mesh<2>::Simplex>{{0, 1, 2}});
  CHECK(mesh.features.regions == std::vector<double>{4});
  REQUIRE(mesh.features.edges.size() == 1);
  CHECK_FALSE(mesh.features.edges[0].line);
}

TEST_CASE("what is no mesh is refused with the code and the place of the mistake, in all formats") {
  const std::string no_number = vtu(array("Float64", "Points", "0 0 0 1 x 0 0 1 0"), kCells);
  const std::string no_vertex =
      vtu(kPoints, array("Int32", "connectivity", "0 1 3") + array("Int8", "offsets", "3") +
                       array("UInt8", "types", "5"));
  const std::string quad =
      vtu(kPoints, array("Int32", "connectivity", "0 1 2 0") + array("Int8", "offsets", "4") +
                       array("UInt8", "types", "9"));
  const std::string space = vtu(array("Float64", "Points", "0 0 0 1 0 0 0 1 1"), kCells);
  const std::string few = vtu(array("Float64", "Points", "0 0 0 1 0 0"), kCells);
  const std::string offsets =
      vtu(kPoints, array("Int32", "connectivity", "0 1 2") + array("Int8", "offsets", "4") +
                       array("UInt8", "types", "5"));
  const std::string kind =
      vtu(kPoints, kCells, "<PointData>\n" + array("Int8", "kind", "0 9 0") + "</PointData>\n");
  const std::string msh = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n";
  struct Case {
    std::string name, content, failure;
  };
  const std::vector<Case> cases{
      {"m.vtu", "", "truncated@1:1"},
      {"m.vtu", "<VTKFile", "truncated@1:9"},
      {"m.vtu", "<VTKFile type=\"PolyData\"></VTKFile>", "bad_header@1:2"},
      {"m.vtu", "<VTKFile type=\"UnstructuredGrid\"></VTKFile>", "bad_syntax@1:2"},
      {"m.vtu", "<VTKFile type=\"UnstructuredGrid\"></Other>", "bad_syntax@1:36"},
      {"m.vtu", "<VTKFile type=UnstructuredGrid></VTKFile>", "bad_syntax@1:15"},
      {"m.vtu", "<VTKFile type=\"UnstructuredGrid\" compressor=\"z\"></VTKFile>",
       "unsupported@1:2"},
      {"m.vtu", vtu(kPoints, kCells) + "x", "bad_syntax@23:1"},
      {"m.vtu", no_number, "bad_number@6:9"},
      {"m.vtu", no_vertex, "bad_mesh@10:2"},
      {"m.vtu", quad, "unsupported@16:2"},
      {"m.vtu", space, "bad_dimension@5:2"},
      {"m.vtu", few, "wrong_count@3:24"},
      {"m.vtu", offsets, "bad_mesh@13:2"},
      {"m.vtu", kind, "bad_mesh@5:2"},
      {"m.vtk", "", "bad_header@1:1"},
      {"m.vtk", "# vtk DataFile Version 3.0\nt\nBINARX\n", "bad_header@3:1"},
      {"m.vtk", "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\n", "unsupported@4:9"},
      {"m.vtk",
       "# vtk DataFile Version 3.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 2 "
       "double\n0 0 0 1 0\n",
       "truncated@7:1"},
      {"m.vtk",
       "# vtk DataFile Version 3.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 1 "
       "double\n0 0 0\nCELLS 1 4\n3 0 0 0\nCELL_TYPES 1\n5\n",
       "bad_mesh@7:1"},
      {"m.vtk",
       "# vtk DataFile Version 3.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 1 "
       "double\n0 0 0\nCELLS 1 3\n3 0 0 0\n",
       "wrong_count@7:1"},
      {"m.vtk", "# vtk DataFile Version 3.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\nVECTORS v\n",
       "unsupported@5:1"},
      {"m.msh", "", "truncated@1:1"},
      {"m.msh", "$MeshFormat\n3.0 0 8\n", "unsupported@2:1"},
      {"m.msh", "$MeshFormat\n4.1 2 8\n", "bad_header@2:5"},
      {"m.msh", msh + "$Nodes\n1 2 1 2\n2 1 0 2\n1\n1\n0 0 0\n1 0 0\n$EndNodes\n",
       "repeated_id@8:1"},
      {"m.msh", msh + "$Nodes\n1 3 1 2\n2 1 0 2\n1\n2\n0 0 0\n1 0 0\n$EndNodes\n",
       "wrong_count@12:1"},
      {"m.msh",
       msh + "$Nodes\n1 2 1 2\n2 1 0 2\n1\n2\n0 0 0\n1 0 9\n$EndNodes\n"
             "$Elements\n0 0 1 0\n$EndElements\n",
       "bad_dimension@10:5"},
      {"m.msh", msh + "$Elements\n1 1 1 1\n2 1 2 1\n1 1 2 3\n$EndElements\n", "bad_mesh@7:3"},
      {"m.msh", msh + "$Elements\n1 1 1 1\n2 1 3 1\n1 1 2 3 4\n$EndElements\n", "unsupported@6:5"},
      {"m.msh", msh + "nodes\n", "bad_syntax@4:1"},
      {"m.mesh", "", "bad_header@1:1"},
      {"m.mesh", "MeshVersionFormatted 2\nVertices\n1\n", "bad_header@2:1"},
      {"m.mesh", "MeshVersionFormatted 2\nDimension 4\n", "bad_dimension@2:11"},
      {"m.mesh", "MeshVersionFormatted 2\nDimension 2\nVertices 1\n0 0\n", "truncated@5:1"},
      {"m.mesh", "MeshVersionFormatted 2\nDimension 3\nVertices 2\n0 0 1 0\n0 1 2 0\n",
       "bad_dimension@5:5"},
      {"m.mesh", "MeshVersionFormatted 2\nDimension 2\nTriangles 1\n1 2 3 0\n", "bad_mesh@4:5"},
      {"m.mesh", "MeshVersionFormatted 2\nDimension 2\nTriangles 1\n1 2 2 0\n", "bad_mesh@3:1"},
      {"m.mesh", "MeshVersionFormatted 2\nDimension 2\nEdges 1\n0 1 0\n", "bad_mesh@4:1"},
      {"m.mesh", "MeshVersionFormatted 2\nDimension 2\nQuadrilaterals 0\n", "unsupported@3:1"},
      {"m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 2\n", "bad_mesh@4:1"},
      {"m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3 1\n", "bad_mesh@4:1"},
      {"m.obj", "v 0 0 0\nv 1 0 0\nl 1 2\nl 2 1\n", "bad_mesh@0:0"},
      {"m.obj", "v 0 0 0\nl 1 1\n", "bad_mesh@2:1"},
  };
  for (const Case& c : cases) {
    INFO(c.name << ":\n" << c.content);
    CHECK(failure_of([&] { (void)read(c.name, c.content); }) == c.failure);
  }
}

TEST_CASE("a bad .edge file beside a mesh is refused with the place of the mistake") {
  const Refused refused = GENERATE(values<Refused>({
      {"m.edge", "1 1\n1 1 4 1\n", "bad_mesh@2:5"},
      {"m.edge", "1 1\n1 1 1 1\n", "bad_mesh@2:3"},
      {"m.edge", "2 1\n1 1 2 1\n2 2 1 1\n", "bad_mesh@3:3"},
      {"m.edge", "2 1\n1 1 2 1\n", "truncated@2:8"},
      {"m.edge", "0 1\n1 1 2 1\n", "wrong_count@2:1"},
      {"m.edge", "1 1\n1 1 2 x\n", "bad_number@2:7"},
      {"m.poly", "0 2 0 1\n1 0\n1 1 4\n0\n", "bad_mesh@3:1"},
      {"m.neigh", "2 3\n", "wrong_count@1:1"},
      {"m.neigh", "1 3\n1 -1 -1 5\n", "bad_mesh@2:9"},
  }));
  INFO(refused.name << ": " << refused.content);
  const ScratchFolder folder;
  folder.write("m.node", "3 2 0 0\n1 0 0\n2 1 0\n3 0 1\n");
  folder.write("m.ele", "1 3 0\n1 1 2 3\n");
  folder.write(refused.name, refused.content);
  CHECK(failure_of([&] { (void)mesher::read_mesh(folder.path("m.node")); }) == refused.failure);
}

TEST_CASE("a picture shows regions in their colours and edges on lines above the others") {
  const ScratchFolder folder;
  MeshData<2> mesh;
  mesh.vertices = {{0, 0}, {1, 0}, {0, 1}, {1, 1}};
  mesh.kinds.assign(4, VertexKind::steiner);
  mesh.simplices = {{0, 1, 2}, {1, 3, 2}};
  mesh.features.regions = {1, 2};
  mesh.features.edges = {{1, 2, LineId{4}, 0}};
  mesher::write_mesh(mesh, folder.path("m.svg"));
  const std::string text = folder.read("m.svg");
  const auto at = [&](const std::string& part) { return text.find(part); };
  CHECK(at("fill=\"#dbe9f6\"") < at("fill=\"#fde3cf\""));
  CHECK(at("fill=\"#fde3cf\"") < at("stroke=\"#3b5b7c\""));
  CHECK(at("stroke=\"#3b5b7c\"") < at("stroke=\"#14283c\""));
  CHECK(std::count(text.begin(), text.end(), 'L') == 2 * 2 + 5 + 1);
}

TEST_CASE("files with random mistakes are read or refused with a place, never anything else") {
  const ScratchFolder folder;
  const std::uint64_t seed = GENERATE(1, 2, 3);
  mesher::SplitMix64 random(seed);
  const MeshData<2> mesh = support::random_mesh(2, random);
  const std::string shape =
      "{\"type\": \"Polygon\", \"coordinates\": "
      "[[[0,0],[9,0],[9,9],[0,0]],[[2,1],[4,1],[4,2],[2,1]]]}";
  folder.write("shape.geojson", shape);
  folder.write("shape.poly",
               "3 2 1 1\n1 0 0 1 1\n2 1 0 2 2\n3 0 1 3 3\n2 1\n1 1 2 4\n2 2 3 5\n1\n"
               "1 4 4\n1\n1 3 3 1 0.5\n");
  std::vector<std::string> names{"shape.geojson", "shape.poly"};
  for (const char* extension : {".node", ".vtu", ".vtk", ".msh", ".mesh", ".off", ".obj"}) {
    mesher::write_mesh(mesh, folder.path(std::string("mesh") + extension));
    names.push_back(std::string("mesh") + extension);
  }
  for (const char* beside : {"mesh.ele", "mesh.edge", "mesh.poly", "mesh.neigh"}) {
    names.push_back(beside);
  }
  for (const std::string& name : names) {
    INFO("seed " << seed);
    support::refused_with_mistakes(folder, name, random, [&] {
      if (name.substr(0, 5) == "shape") {
        (void)mesher::read<2>(folder.path(name));
      } else {
        const bool is_part = name == "mesh.edge" || name == "mesh.poly" || name == "mesh.neigh";
        (void)mesher::read_mesh(folder.path(is_part ? "mesh.node" : name));
      }
    });
  }
}
