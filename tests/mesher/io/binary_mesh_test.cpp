// Binary .vtk and .msh: what they say is read, and what is cut off or damaged is an error.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <string>

#include "bytes.hpp"
#include "mesher/extra/generate.hpp"
#include "mesher/read.hpp"
#include "mesher/write.hpp"
#include "scratch_file.hpp"

namespace {

using mesher::ErrorCode;
using mesher::MeshData;
using support::Bytes;
using support::ScratchFolder;

// Two triangles, regions 1.5 and -2, and two edges on lines, markers 7 and 0.
std::string vtk_file() {
  Bytes b(true);
  b << "# vtk DataFile Version 3.0\ntitle\nBINARY\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 double\n";
  b.all<double>(0, 0, 2, 1 / 3.0, 0, 2, 0, -1e-300, 2, 1, 1, 2);
  b << "\nCELLS 4 14\n";
  b.all<std::int32_t>(3, 0, 1, 2, 3, 1, 3, 2, 2, 0, 1, 2, 1, 3);
  b << "\nCELL_TYPES 4\n";
  b.all<std::int32_t>(5, 5, 3, 3);
  b << "\nCELL_DATA 4\nSCALARS region float 1\nLOOKUP_TABLE default\n";
  b.all<float>(1.5, -2, 0, 0);
  b << "\nFIELD FieldData 1\nmarker 1 4 short\n";
  b.all<std::int16_t>(0, 0, 7, -1);
  return (b << "\nPOINT_DATA 4\nSCALARS kind unsigned_char\nLOOKUP_TABLE default\n")
             .all<std::uint8_t>(0, 1, 2, 3)
             .text() +
         "\n";
}

std::string new_vtk_file() {
  Bytes b(true);
  b << "# vtk DataFile Version 5.1\ntitle\nBINARY\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 double\n";
  b.all<double>(0, 0, 2, 1 / 3.0, 0, 2, 0, -1e-300, 2, 1, 1, 2);
  b << "\nMETADATA\nINFORMATION 0\n\nCELLS 5 10\nOFFSETS vtktypeint64\n";
  b.all<std::int64_t>(0, 3, 6, 8, 10);
  b << "\nCONNECTIVITY vtktypeint64\n";
  b.all<std::int64_t>(0, 1, 2, 1, 3, 2, 0, 1, 1, 3);
  b << "\nCELL_TYPES 4\n";
  b.all<std::int32_t>(5, 5, 3, 3);
  b << "\nCELL_DATA 4\nSCALARS region double 1\nLOOKUP_TABLE default\n";
  b.all<double>(1.5, -2, 0, 0);
  b << "\nSCALARS marker vtkIdType\nLOOKUP_TABLE default\n";
  return b.all<std::int32_t>(0, 0, 7, -1).text() + "\n";
}

std::string msh_file(bool big_endian) {
  Bytes b(big_endian);
  b << "$MeshFormat\n4.1 1 8\n" << std::int32_t{1} << "\n$EndMeshFormat\n";
  b << "$PhysicalNames\n4\n2 1 \"region 1.5\"\n2 2 \"region -2\"\n1 3 \"marker 7\"\n"
       "1 4 \"marker -1\"\n$EndPhysicalNames\n$Entities\n";
  b.all<std::int64_t>(1, 2, 2, 0);
  b << std::int32_t{9};
  b.all<double>(0, 0, 0) << std::int64_t{1} << std::int32_t{5};
  for (const int tag : {1, 2, 3, 4}) {  // curves 3, 4 in groups 3, 4; surfaces 1, 2 in 1, 2
    const int entity = tag <= 2 ? tag + 2 : tag - 2;
    b << std::int32_t{entity};
    b.all<double>(0, 0, 0, 1, 1, 0) << std::int64_t{1} << std::int32_t{entity};
    b << std::int64_t{2};
    b.all<std::int32_t>(9, -9);
  }
  b << "\n$EndEntities\n$Periodic\n" << std::int64_t{0} << "\n$EndPeriodic\n$Nodes\n";
  b.all<std::int64_t>(2, 4, 2, 9);
  b.all<std::int32_t>(0, 9, 0) << std::int64_t{1} << std::int64_t{9};
  b.all<double>(0, 0, 2);
  b.all<std::int32_t>(2, 1, 1) << std::int64_t{3};
  b.all<std::int64_t>(2, 3, 4);
  b.all<double>(1 / 3.0, 0, 2, 0.1, 0.2, 0, -1e-300, 2, 0.3, 0.4, 1, 1, 2, 0.5, 0.6);
  b << "\n$EndNodes\n$Elements\n";
  b.all<std::int64_t>(5, 5, 1, 5);
  b.all<std::int32_t>(0, 9, 15) << std::int64_t{1};
  b.all<std::int64_t>(1, 9);
  b.all<std::int32_t>(2, 1, 2) << std::int64_t{1};
  b.all<std::int64_t>(2, 9, 2, 3);
  b.all<std::int32_t>(2, 2, 2) << std::int64_t{1};
  b.all<std::int64_t>(3, 2, 4, 3);
  b.all<std::int32_t>(1, 3, 1) << std::int64_t{1};
  b.all<std::int64_t>(4, 9, 2);
  b.all<std::int32_t>(1, 4, 1) << std::int64_t{1};
  b.all<std::int64_t>(5, 2, 4);
  return b.text() + "\n$EndElements\n";
}

struct File {
  const char* name;
  std::string content;
};
std::vector<File> files() {
  return {{"old.vtk", vtk_file()},
          {"new.vtk", new_vtk_file()},
          {"little.msh", msh_file(false)},
          {"big.msh", msh_file(true)}};
}

MeshData<2> read(const ScratchFolder& folder, const std::string& name, const std::string& content) {
  return mesher::read_mesh(folder.write(name, content));
}

ErrorCode refusal(const std::string& name, const std::string& content) {
  const ScratchFolder folder;
  try {
    (void)read(folder, name, content);
  } catch (const mesher::Error& error) {
    CHECK(error.location().file.substr(0, 1) == "/");
    return error.code();
  }
  FAIL(name << " is read");
  return {};
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

}  // namespace

TEST_CASE("binary .vtk and .msh are read, numbers to the last bit") {
  const ScratchFolder folder;
  for (const File& file : files()) {
    INFO(file.name);
    const MeshData<2> mesh = read(folder, file.name, file.content);
    CHECK(mesh.vertices ==
          std::vector<mesher::Point<2>>{{0, 0}, {1 / 3.0, 0}, {0, -1e-300}, {1, 1}});
    CHECK(mesh.simplices == std::vector<mesher::Mesh<2>::Simplex>{{0, 1, 2}, {1, 3, 2}});
    CHECK(mesh.features.regions == std::vector<double>{1.5, -2});
    REQUIRE(mesh.features.edges.size() == 2);
    CHECK(mesh.features.edges[0].marker == 7);
    CHECK(mesh.features.edges[1].marker == -1);
    CHECK(mesh.features.edges[1].high == 3);
  }
  CHECK(read(folder, "old.vtk", vtk_file()).kinds.back() == mesher::VertexKind::segment);
}

TEST_CASE("a binary file that is cut off is refused, wherever it is") {
  const ScratchFolder folder;
  for (const File& file : files()) {
    // What follows the cells of a .vtk file may be missing as a whole.
    const bool is_vtk = std::string(file.name).ends_with(".vtk");
    const std::size_t most = is_vtk ? file.content.find("\nCELL_DATA") : file.content.size() - 1;
    for (std::size_t size = 0; size < most; ++size) {
      try {
        (void)read(folder, file.name, file.content.substr(0, size));
        FAIL(file.name << " cut at " << size << " is read");
      } catch (const mesher::Error& error) {
        const bool is_format = mesher::exit_code(error.code()) == mesher::ExitCode::format;
        if (!is_format) FAIL(file.name << " cut at " << size << ": " << error.what());
      }
    }
  }
}

TEST_CASE("a binary file with damaged bytes is read or refused, never anything else") {
  const ScratchFolder folder;
  mesher::SplitMix64 random(5);
  for (const File& file : files()) {
    std::size_t refused = 0;
    for (int round = 0; round < 300; ++round) {
      std::string bad = file.content;
      for (auto flips = 1 + random.below(3); flips > 0; --flips) {
        bad[random.below(bad.size())] ^= static_cast<char>(1 << random.below(8));
      }
      try {
        (void)read(folder, file.name, bad);
      } catch (const mesher::Error& error) {
        ++refused;
        const bool is_format = mesher::exit_code(error.code()) == mesher::ExitCode::format;
        if (!is_format) FAIL(file.name << " round " << round << ": " << error.what());
      }
    }
    CHECK(refused > 60);
  }
}

TEST_CASE("counts in a binary file are not believed: no memory is set aside for them") {
  const std::string vtk = vtk_file();
  CHECK(refusal("m.vtk", replaced(vtk, "POINTS 4", "POINTS 4000000000000000000")) ==
        ErrorCode::truncated);
  CHECK(refusal("m.vtk", replaced(vtk, "CELLS 4 14", "CELLS 4000000000 14000000000000")) ==
        ErrorCode::truncated);
  CHECK(refusal("m.vtk", replaced(vtk, "CELL_TYPES 4", "CELL_TYPES 999999999999")) ==
        ErrorCode::truncated);
  CHECK(refusal("m.vtk", replaced(vtk, "marker 1 4", "marker 4000000000000 4")) ==
        ErrorCode::truncated);
  const std::string msh = msh_file(false);
  const std::string nodes = (Bytes(false) << std::int64_t{1} << std::int64_t{9}).text();
  const std::string many = (Bytes(false) << std::int64_t{1} << 40 << std::int64_t{9}).text();
  CHECK(refusal("m.msh", replaced(msh, nodes, many)) != ErrorCode::cannot_read);
}

TEST_CASE("what binary files may hold and we do not read is said") {
  const std::string vtk = vtk_file();
  CHECK(refusal("m.vtk", replaced(vtk, "marker 1 4 short", "marker 1 4 bit")) ==
        ErrorCode::unsupported);
  CHECK(refusal("m.vtk", replaced(vtk, "POINTS 4 double\n", "POINTS 4 double 7\n")) ==
        ErrorCode::bad_syntax);
  const std::string msh = msh_file(false);
  CHECK(refusal("m.msh", replaced(msh, "4.1 1 8", "4.1 1 4")) == ErrorCode::unsupported);
  CHECK(refusal("m.msh", replaced(msh, std::string("\1\0\0\0", 4), "abcd")) ==
        ErrorCode::bad_header);
  const std::string infinite = (Bytes(true) << HUGE_VAL).text();
  const std::string third = (Bytes(true) << 1 / 3.0).text();
  CHECK(refusal("m.vtk", replaced(vtk, third, infinite)) == ErrorCode::not_finite);
  CHECK(refusal("m.msh", replaced(msh_file(true), third, infinite)) == ErrorCode::not_finite);
}
