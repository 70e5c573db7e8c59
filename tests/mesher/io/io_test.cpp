// Readers and writers: what is accepted, what is refused and where, and that what is written reads
// back bit for bit.
#include <sys/stat.h>

#include <bit>
#include <catch2/catch.hpp>
#include <cstdint>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "feature_ids.hpp"
#include "io/point_file.hpp"
#include "mesher/extra/generate.hpp"
#include "mesher/read.hpp"
#include "mesher/write.hpp"
#include "scratch_file.hpp"

namespace {

using mesher::Mesh;
using mesher::Point;
using mesher::VertexKind;
using support::error_of;
using support::failure_of;
using support::ids;
using support::ScratchFolder;

mesher::PointFile<2> read(const std::string& name, const std::string& content) {
  const ScratchFolder folder;
  return mesher::read_points<2>(folder.write(name, content));
}

struct Refused {
  const char* name;
  const char* content;
  const char* failure;  // code@line:column
};

// A square around one input point, coordinates that need all their digits.
Mesh<2> sample_mesh() {
  Mesh<2> mesh;
  mesh.vertices = {
      {-0.1, -0.1}, {-0.1, 1e30}, {1.0 / 3, 0x1.fffffffffffffp-1}, {5e29, -0.1}, {5e29, 1e30}};
  mesh.kinds = {VertexKind::boundary, VertexKind::boundary, VertexKind::input, VertexKind::boundary,
                VertexKind::steiner};
  mesh.simplices = {{0, 2, 1}, {0, 3, 2}, {1, 2, 4}, {2, 3, 4}};
  return mesh;
}

}  // namespace

TEST_CASE("a .node file is read with comments, attributes, markers, any ids and CRLF") {
  const auto file = read("a.node",
                         "# header\r\n"
                         "3 2 1 1 # counts\r\n"
                         "\r\n"
                         "-7 0.5 +1e-3 99 1\r\n"
                         "  0\t1 2 x 0 # comment\r\n"
                         "9000000000 -.25 -0 1 0");
  CHECK(file.ids == ids({-7, 0, 9000000000}));
  CHECK(file.points == std::vector<Point<2>>{{0.5, 1e-3}, {1, 2}, {-0.25, 0}});
  CHECK(file.lines == std::vector<long>{4, 5, 6});
  CHECK_FALSE(std::signbit(file.points[2][1]));
  CHECK(file.location(1).line == 5);
}

TEST_CASE("a .node header may stop after the count, and the count may be 0") {
  CHECK(read("a.node", "1\n1 2 3\n").points == std::vector<Point<2>>{{2, 3}});
  CHECK(read("a.node", "0 2 0 0\n").points.empty());
}

TEST_CASE("a .node file in space is read where D is 3") {
  const ScratchFolder folder;
  const auto file = mesher::read_points<3>(folder.write("a.node", "1 3 0 0\n5 1 2 3\n"));
  CHECK(file.points == std::vector<Point<3>>{{1, 2, 3}});
}

TEST_CASE("an .xyz file is read as ids 1..n, with z = 0 or without z") {
  const auto file = read("a.xyz", "# c\n1 2\n\n  3 4 0\n");
  CHECK(file.ids == ids({1, 2}));
  CHECK(file.points == std::vector<Point<2>>{{1, 2}, {3, 4}});
  CHECK(file.lines == std::vector<long>{2, 4});
  CHECK(read("a.xyz", "").points.empty());
}

TEST_CASE("a .csv file is read by its columns' names or by position") {
  const std::vector<Point<2>> expected{{1, 2}, {3, -4}};
  CHECK(read("a.csv", "1,2\n3,-4\n").points == expected);
  CHECK(read("a.csv", "# c\r\nx,y\r\n1, 2\r\n 3,-4").points == expected);
  CHECK(read("a.csv", "Name;LAT;LON\nA;2;1\n\"B;C\";-4;3\n").points == expected);
  CHECK(read("a.CSV", "longitude\tlatitude\n1\t2\n3\t-4\n").points == expected);
  CHECK(read("a.csv", "\xEF\xBB\xBF\"x\",\"y\"\n\"1\",\"2\"\n3,-4\n").ids == ids({1, 2}));
  CHECK(read("a.csv", "x,y\n").points.empty());
}

TEST_CASE("bad points are refused with the code and the place of the mistake") {
  const Refused refused = GENERATE(values<Refused>({
      // header
      {"a.node", "", "truncated@0:0"},
      {"a.node", "# nothing\n", "truncated@0:0"},
      {"a.node", "x 2 0 0\n", "bad_number@1:1"},
      {"a.node", "-1 2 0 0\n", "bad_header@1:1"},
      {"a.node", "1 3 0 0\n1 0 0 0\n", "bad_dimension@1:3"},
      {"a.node", "1 2 -1 0\n", "bad_header@1:5"},
      {"a.node", "1 2 0 2\n", "bad_header@1:7"},
      {"a.node", "1 2 0 0 0\n", "bad_header@1:9"},
      {"a.node", "99999999999999999999 2\n", "bad_number@1:1"},
      // counts: nothing is set aside for a count that is not there
      {"a.node", "9000000000000000000 2 0 0\n1 0 0\n", "truncated@2:6"},
      {"a.node", "9000000000000000000 2 1000000 0\n", "truncated@1:32"},
      {"a.node", "2 2 0 0\n1 0 0\n", "truncated@2:6"},
      {"a.node", "1 2 0 0\n1 0 0\n2 1 1\n", "wrong_count@3:1"},
      {"a.node", "2 2 0 0\n1 0 0\n2 1", "truncated@3:4"},
      {"a.node", "2 2 0 0\n1 0\n2 1 1\n", "wrong_count@2:4"},
      {"a.node", "1 2 0 0\n1 0 0 7\n", "wrong_count@2:7"},
      // numbers
      {"a.node", "1 2 0 0\n1 0 0.5x\n", "bad_number@2:5"},
      {"a.node", "1 2 0 0\n1 1,5 0\n", "bad_number@2:3"},
      {"a.node", "1 2 0 0\n1.5 0 0\n", "bad_number@2:1"},
      {"a.node", "1 2 0 0\n1 +-1 0\n", "bad_number@2:3"},
      {"a.node", "1 2 0 0\n1 0x10 0\n", "bad_number@2:3"},
      {"a.node", "1 2 0 0\n1 nan 0\n", "not_finite@2:3"},
      {"a.node", "1 2 0 0\n1 0 -inf\n", "not_finite@2:5"},
      {"a.node", "1 2 0 0\n1 0 Infinity\n", "not_finite@2:5"},
      {"a.node", "1 2 0 0\n1 1e31 0\n", "magnitude@2:3"},
      {"a.node", "1 2 0 0\n1 0 7e-31\n", "magnitude@2:5"},
      {"a.node", "1 2 0 0\n1 1e999 0\n", "magnitude@2:3"},
      {"a.node", "1 2 0 0\n1 -1e-999 0\n", "magnitude@2:3"},
      // repetitions
      {"a.node", "3 2 0 0\n5 0 0\n6 1 1\n5 2 2\n", "repeated_id@4:1"},
      {"a.node", "3 2 0 0\n5 0 0\n6 1 1\n7 -0 0\n", "duplicate_point@4:1"},
      {"a.node", "4 2 0 0\n1 9 9\n2 0 0\n3 9 9\n4 0 0\n", "duplicate_point@4:1"},
      {"a.xyz", "1 2\n3 4\n1 2\n", "duplicate_point@3:1"},
      // .xyz
      {"a.xyz", "1 2\n3\n", "truncated@2:2"},
      {"a.xyz", "1\n3 4\n", "wrong_count@1:2"},
      {"a.xyz", "1 2 3\n", "bad_dimension@1:5"},
      {"a.xyz", "1 2 0 4\n", "wrong_count@1:7"},
      {"a.xyz", "H 1 2\n", "bad_number@1:1"},
      // .csv
      {"a.csv", "1,2,3\n", "bad_dimension@1:5"},
      {"a.csv", "a,b\n1,2\n", "bad_header@1:1"},
      {"a.csv", "x,y,X\n1,2,3\n", "bad_header@1:5"},
      {"a.csv", "x,y\n1,2\n3\n4,5\n", "wrong_count@3:2"},
      {"a.csv", "x,y\n1,2\n3,4,5\n", "wrong_count@3:5"},
      {"a.csv", "x,y\n1,2\n3", "truncated@3:2"},
      {"a.csv", "x,y\n1,\n", "bad_number@2:3"},
      {"a.csv", "x,y\n1,NaN\n", "not_finite@2:3"},
      {"a.csv", "nan,1\n", "not_finite@1:1"},
      // files
      {"a.poly", "1 2 0 0\n1 0 0\n", "unknown_format@0:0"},
      {"points", "1 2\n", "unknown_format@0:0"},
  }));
  INFO(refused.name << ": " << refused.content);
  CHECK(failure_of([&] { (void)read(refused.name, refused.content); }) == refused.failure);
}

TEST_CASE("an error of a file says file, line, column, code, ids and values") {
  const ScratchFolder folder;
  const auto path = folder.write("a.node", "2 2 0 0\n5 0.5 1\n6 0.5 1\n");
  const auto error = error_of([&] { (void)mesher::read_points<2>(path); });
  CHECK(error.what() == path + ":3:1: error[duplicate_point]: point 6 lies on point 5 of line 2, " +
                            "both at (0.5, 1)");
}

TEST_CASE("a file that is not there, or is a folder, cannot be read") {
  const ScratchFolder folder;
  CHECK(failure_of([&] { (void)mesher::read_points<2>(folder.path("no.node")); }) ==
        "cannot_read@0:0");
  std::filesystem::create_directory(folder.path("d.node"));
  CHECK(failure_of([&] { (void)mesher::read_points<2>(folder.path("d.node")); }) ==
        "cannot_read@0:0");
}

TEST_CASE("every code has a word and an exit code") {
  for (int i = 0; i <= static_cast<int>(mesher::ErrorCode::cancelled); ++i) {
    const auto code = static_cast<mesher::ErrorCode>(i);
    CHECK(code_name(code) != "unknown");
    CHECK(exit_code(code) != mesher::ExitCode::bug);
    CHECK(exit_code(code) != mesher::ExitCode::ok);
  }
}

TEST_CASE("a mesh written as .node and .ele reads back equal, kinds included") {
  const ScratchFolder folder;
  mesher::write_mesh(sample_mesh(), folder.path("m.node"));
  CHECK(mesher::read_mesh(folder.path("m.node")) == sample_mesh());
  CHECK(mesher::read_mesh(folder.path("m.ele")) == sample_mesh());
  CHECK(folder.count() == 2);
}

TEST_CASE("a mesh written as .off reads back equal but for the kinds") {
  const ScratchFolder folder;
  mesher::write_mesh(sample_mesh(), folder.path("m.off"));
  Mesh<2> expected = sample_mesh();
  expected.kinds.assign(expected.vertices.size(), VertexKind::steiner);
  CHECK(mesher::read_mesh(folder.path("m.off")) == expected);
}

TEST_CASE("coordinates of every magnitude are written so that they read back bit for bit") {
  const ScratchFolder folder;
  mesher::SplitMix64 random(1);
  Mesh<2> mesh = sample_mesh();
  for (int i = 0; i < 20000; ++i) {
    const double x = std::bit_cast<double>(random.bits());
    mesh.vertices.push_back({std::isfinite(x) ? x : -0.0, std::ldexp(random.unit(), -1060)});
    mesh.kinds.push_back(VertexKind::steiner);
  }
  for (const std::string name : {"m.node", "m.off"}) {
    mesher::write_mesh(mesh, folder.path(name));
    const auto back = mesher::read_mesh(folder.path(name)).vertices;
    REQUIRE(back.size() == mesh.vertices.size());
    bool same = true;
    for (std::size_t i = 0; i < back.size(); ++i) {
      for (int k = 0; k < 2; ++k) {
        same = same && std::bit_cast<std::uint64_t>(back[i][k]) ==
                           std::bit_cast<std::uint64_t>(mesh.vertices[i][k]);
      }
    }
    CHECK(same);
  }
}

TEST_CASE("integers of every length are written with all their digits") {
  const ScratchFolder folder;
  std::vector<long long> all{0, INT64_MAX, INT64_MIN, UINT32_MAX, UINT32_MAX + 1LL};
  for (long long power = 1; power < 2'000'000'000'000'000'000; power *= 10) {
    for (const long long n : {power - 1, power, power + 1, power / 9 * 8 + power / 1000}) {
      all.push_back(n);
      all.push_back(-n);
    }
  }
  std::string expected;
  mesher::OutputFiles files;
  auto& file = files.open(folder.path("numbers"));
  for (int round = 0; round < 200; ++round) {  // beyond the buffer
    for (const long long n : all) {
      file << n << ' ';
      expected += std::to_string(n) + ' ';
    }
  }
  files.commit();
  CHECK(folder.read("numbers") == expected);
}

TEST_CASE("a file is read from a pipe, and its header after any comment") {
  const ScratchFolder folder;
  const std::string path = folder.path("pipe.node");
  REQUIRE(::mkfifo(path.c_str(), 0600) == 0);
  std::string content = "50000 2 0 0\n";
  for (int i = 0; i < 50000; ++i) content += std::to_string(i) + ' ' + std::to_string(i) + " 1\n";
  std::thread writer([&] { std::ofstream(path) << content; });
  const auto file = mesher::read_points<2>(path);
  writer.join();
  REQUIRE(file.points.size() == 50000);
  CHECK(file.points.back() == Point<2>{49999, 1});
  // Comments as long as what is read first, and the header cut there.
  for (std::size_t length = 4080; length < 4100; ++length) {
    const std::string comment = '#' + std::string(length - 2, 'x') + '\n';
    INFO(length);
    CHECK(mesher::dimension_of(folder.write("a.node", comment + "10 3 0 0\n1 0 0 0\n")) == 3);
    CHECK(mesher::dimension_of(folder.write("b.node", comment + "10 33 0 0\n")) == 2);
  }
}

TEST_CASE("the text of .vtu holds the points, the cells and the kinds") {
  const ScratchFolder folder;
  mesher::write_mesh(sample_mesh(), folder.path("m.vtu"));
  const std::string text = folder.read("m.vtu");
  CHECK(text.find("NumberOfPoints=\"5\" NumberOfCells=\"4\"") != std::string::npos);
  CHECK(text.find("\n0.3333333333333333 0.9999999999999999 0\n") != std::string::npos);
  CHECK(text.find("\n0 2 1\n0 3 2\n1 2 4\n2 3 4\n</DataArray>") != std::string::npos);
  CHECK(text.find("\n3\n6\n9\n12\n</DataArray>") != std::string::npos);
  CHECK(text.find("\n5\n5\n5\n5\n</DataArray>") != std::string::npos);
  CHECK(text.find(">\n1\n1\n2\n1\n0\n</DataArray>") != std::string::npos);
}

TEST_CASE("a picture shows each edge in view once and each input point") {
  Mesh<2> mesh = sample_mesh();
  mesh.vertices = {{0, 0}, {0, 4}, {1, 1}, {4, 0}, {4, 4}};
  const ScratchFolder folder;
  mesher::write_mesh(mesh, folder.path("m.svg"));  // one input point: all is in view
  const std::string text = folder.read("m.svg");
  CHECK(std::count(text.begin(), text.end(), 'L') == 8);
  CHECK(text.find("viewBox=\"0 0 1000 1000\"") != std::string::npos);
  CHECK(text.find("M300 700h0\n") != std::string::npos);
  CHECK(text.size() < 2000);
}

TEST_CASE("a picture has thinner lines and dots where the mesh is finer") {
  Mesh<2> mesh = sample_mesh();
  mesh.vertices = {{0, 0}, {0, 4}, {0.001, 0.001}, {4, 0}, {4, 4}};
  const ScratchFolder folder;
  mesher::write_mesh(mesh, folder.path("m.svg"));
  const std::string text = folder.read("m.svg");
  CHECK(text.find("stroke-width=\"1\" d=") != std::string::npos);           // the long edges
  CHECK(text.find("stroke-width=\"0.031\" d=") != std::string::npos);       // from vertex 0 to 2
  CHECK(text.find("round\" stroke-width=\"0.156\"") != std::string::npos);  // the dot at 2
}

TEST_CASE("a picture of a far window leaves out what it does not show") {
  const ScratchFolder folder;
  mesher::TextFile file(folder.path("m.svg"), "m.svg");
  mesher::write_svg(sample_mesh(), {{{-2, -2}, {-1, -1}}, {}}, file);
  file.close();
  const std::string text = folder.read("m.svg");
  CHECK(text.find('L') == std::string::npos);
}

TEST_CASE("bad meshes are refused with the code and the place of the mistake") {
  const std::string node = "3 2 0 0\n1 0 0\n2 1 0\n3 0 1\n";
  const Refused refused = GENERATE(values<Refused>({
      {"m.ele", "1 3 0\n1 1 2 3\n2 1 2 3\n", "wrong_count@3:1"},
      {"m.ele", "2 3 0\n1 1 2 3\n", "truncated@2:8"},
      {"m.ele", "2 3 0\n1 1 2\n2 1 2 3\n", "wrong_count@2:6"},
      {"m.ele", "1 3 0\n1 1 2\n", "truncated@2:6"},
      {"m.ele", "1 3 0\n1 1 2 4\n", "bad_mesh@2:7"},
      {"m.ele", "1 3 0\n1 1 2 -3\n", "bad_mesh@2:7"},
      {"m.ele", "1 3 0\n1 1 2 2\n", "bad_mesh@2:3"},
      {"m.ele", "1 4 0\n1 1 2 3 4\n", "bad_dimension@1:3"},
      {"m.ele", "-1 3 0\n", "bad_header@1:1"},
      {"m.ele", "", "truncated@0:0"},
      {"m.ele", "4000000000000000000 3 0\n1 1 2 3\n", "truncated@2:8"},
      {"m.off", "3 1 0\n", "bad_header@1:1"},
      {"m.off", "OFF\n1 0 0\n0 0 1\n", "bad_dimension@3:5"},
      {"m.off", "OFF\n1 0 0\n0 inf 0\n", "not_finite@3:3"},
      {"m.off", "OFF\n9000000000000000000 0 0\n0 0 0\n", "truncated@3:6"},
      {"m.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", "bad_mesh@6:7"},
      {"m.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n4 0 1 2 2\n", "bad_mesh@6:1"},
      {"m.off", "OFF\n0 0 0\n0 0 0\n", "wrong_count@3:1"},
      {"m.vtu", "", "truncated@1:1"},
      {"m.stl", "", "unknown_format@0:0"},
  }));
  INFO(refused.name << ": " << refused.content);
  const ScratchFolder folder;
  folder.write("m.node", node);
  const auto path = folder.write(refused.name, refused.content);
  CHECK(failure_of([&] { (void)mesher::read_mesh(path); }) == refused.failure);
}

TEST_CASE("outputs appear on commit and not before, and a dropped output leaves nothing") {
  const ScratchFolder folder;
  folder.write("old.txt", "old");
  {
    mesher::OutputFiles files;
    files.open(folder.path("new.txt")) << "new " << 1 << ' ' << 0.5;
    files.open(folder.path("old.txt")) << "newer";
    CHECK_FALSE(std::filesystem::exists(folder.path("new.txt")));
    CHECK(folder.read("old.txt") == "old");
    files.commit();
    CHECK(folder.read("new.txt") == "new 1 0.5");
    CHECK(folder.read("old.txt") == "newer");
  }
  {
    mesher::OutputFiles files;
    files.open(folder.path("dropped.txt")) << std::string(1 << 20, 'x');
  }
  CHECK(folder.count() == 2);
}

TEST_CASE("an output that cannot be renamed leaves all targets as they were, and nothing else") {
  const ScratchFolder folder;
  folder.write("old.txt", "old");
  folder.write("other.txt", "other");
  {
    mesher::OutputFiles files;
    files.open(folder.path("old.txt")) << "newer";
    files.open(folder.path("new.txt")) << "new";
    files.open(folder.path("other.txt")) << "newer";
    files.open(folder.path("folder")) << "x";
    std::filesystem::create_directory(folder.path("folder"));  // after it was found to be free
    folder.write("folder/within.txt", "within");
    CHECK(failure_of([&] { files.commit(); }) == "cannot_write@0:0");
    CHECK(folder.read("old.txt") == "old");
    CHECK(folder.read("other.txt") == "other");
    CHECK(folder.read("folder/within.txt") == "within");
  }
  CHECK(folder.count() == 3);
}

TEST_CASE("outputs that cannot work are refused before anything is written") {
  const ScratchFolder folder;
  folder.write("in.txt", "input");
  std::filesystem::create_directory(folder.path("folder"));
  mesher::OutputFiles files;
  files.protect(folder.path("in.txt"));
  files.open(folder.path("out.txt"));
  const auto open = [&](const std::string& name) {
    return failure_of([&] { files.open(folder.path(name)); });
  };
  CHECK(open("nowhere/out.txt") == "cannot_write@0:0");
  CHECK(open("folder") == "cannot_write@0:0");
  CHECK(open("folder/../out.txt") == "bad_option@0:0");
  CHECK(open("in.txt") == "bad_option@0:0");
  CHECK(failure_of([&] { (void)mesher::open_mesh<2>(files, folder.path("m.stl")); }) ==
        "unknown_format@0:0");
  CHECK(files.targets().size() == 1);
}

TEST_CASE("an output that is a link goes where the link points") {
  const ScratchFolder folder;
  folder.write("there.txt", "old");
  std::filesystem::create_symlink("there.txt", folder.path("link.txt"));
  mesher::OutputFiles files;
  files.open(folder.path("link.txt")) << "new";
  files.commit();
  CHECK(folder.read("there.txt") == "new");
  CHECK(std::filesystem::is_symlink(folder.path("link.txt")));
}

TEST_CASE("a full disk is an error of the write or of the close") {
  mesher::TextFile small("/dev/full", "out.txt");
  small << "x";
  CHECK(failure_of([&] { small.close(); }) == "cannot_write@0:0");
  mesher::TextFile large("/dev/full", "out.txt");
  CHECK(failure_of([&] { large << std::string(1 << 20, 'x'); }) == "cannot_write@0:0");
}
