// Writing meshes of tetrahedra: the faces of their boundary, and what is refused.
// (What the files hold is compared by readers of others: tests/formats/compare_space.py.)
#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <iterator>
#include <map>
#include <random>
#include <set>

#include "facade/graph_runs.hpp"
#include "io/point_file.hpp"
#include "mesh/boundary_faces.hpp"
#include "mesher/mesher.hpp"
#include "mesher/predicates.hpp"
#include "mesher/read.hpp"
#include "mesher/write.hpp"
#include "scratch_file.hpp"
#include "space_points.hpp"

namespace {

using mesher::Mesh;
using mesher::Point;

Mesh<3> some_mesh() {
  const auto points = support::space_points(support::SpaceFamily::uniform, 20, 3);
  return mesher::mesh_statically<3>(points, {.domain = mesher::snapped_domain<3>(points)});
}

}  // namespace

TEST_CASE("the boundary's faces are those on the box's sides, seen from outside, in one surface") {
  const Mesh<3> mesh = some_mesh();
  const auto faces = mesher::boundary_faces(mesh);
  const auto input = std::find(mesh.kinds.begin(), mesh.kinds.end(), mesher::VertexKind::input);
  const Point<3>& middle = mesh.vertices[static_cast<std::size_t>(input - mesh.kinds.begin())];
  std::map<std::array<std::uint32_t, 2>, int> sides;
  for (const auto& f : faces) {
    CHECK(f[0] == *std::min_element(f.begin(), f.end()));
    // Counterclockwise seen from outside: clockwise seen from a vertex inside.
    CHECK(mesher::predicates::orient3d(mesh.vertices[f[0]], mesh.vertices[f[1]],
                                       mesh.vertices[f[2]], middle) < 0);
    for (std::size_t k = 0; k < 3; ++k) {
      CHECK(mesh.kinds[f[k]] == mesher::VertexKind::boundary);
      ++sides[{f[k], f[(k + 1) % 3]}];
    }
  }
  for (const auto& [side, count] : sides) CHECK((count == 1 && sides.count({side[1], side[0]})));
  CHECK(std::is_sorted(faces.begin(), faces.end()));
  const auto on_boundary =
      std::count(mesh.kinds.begin(), mesh.kinds.end(), mesher::VertexKind::boundary);
  CHECK(static_cast<long>(faces.size()) == 2 * on_boundary - 4);  // a sphere
  CHECK(mesher::boundary_faces({}).empty());
}

TEST_CASE("the boundary's faces are those of one tetrahedron, whatever the tetrahedra are") {
  // Around the first vertex are more faces than a table of bits has room for; some tetrahedra are
  // there twice, and corners come in any order that keeps the orientation.
  std::mt19937 random(7);
  for (const std::uint32_t around : {4u, 20u, 300u}) {
    Mesh<3> mesh;
    mesh.vertices.resize(around + 1);
    for (int k = 0; k < 500; ++k) {
      Mesh<3>::Simplex s;
      do {
        for (std::uint32_t& v : s) v = random() % (around + 1);
        s[0] = k % 3 == 0 ? 0 : s[0];
      } while (std::set(s.begin(), s.end()).size() < 4);
      mesh.simplices.push_back(s);
    }
    std::map<std::set<std::uint32_t>, int> count;
    std::vector<std::array<std::uint32_t, 3>> all, once;
    for (const auto& [a, b, c, d] : mesh.simplices) {
      using Face = std::array<std::uint32_t, 3>;
      for (Face f : {Face{b, c, d}, Face{a, d, c}, Face{a, b, d}, Face{a, c, b}}) {
        ++count[{f.begin(), f.end()}];
        std::rotate(f.begin(), std::min_element(f.begin(), f.end()), f.end());
        all.push_back(f);
      }
    }
    std::copy_if(all.begin(), all.end(), std::back_inserter(once), [&](const auto& f) {
      return count.at({f.begin(), f.end()}) == 1;
    });
    std::sort(once.begin(), once.end());
    INFO(around);
    CHECK(mesher::boundary_faces(mesh) == once);
    // In order, as those of the mesher are; a cycle of three corners keeps the orientation.
    for (auto& s : mesh.simplices) {
      const auto least = std::min_element(s.begin(), s.end()) - s.begin();
      if (least == 3) s = {s[3], s[1], s[0], s[2]};
      if (least < 3) std::rotate(s.begin(), s.begin() + least, s.begin() + 3);
    }
    std::sort(mesh.simplices.begin(), mesh.simplices.end());
    CHECK(mesher::boundary_faces(mesh) == once);
  }
}

TEST_CASE("a mesh of tetrahedra is refused for formats that do not take it, nothing is written") {
  const support::ScratchFolder folder;
  for (const char* name : {"mesh.ply", "mesh.poly", "mesh"}) {
    INFO(name);
    try {
      mesher::write_mesh(some_mesh(), folder.path(name));
      FAIL("written");
    } catch (const mesher::Error& e) {
      CHECK(e.code() == mesher::ErrorCode::unknown_format);
    }
    CHECK_FALSE(std::filesystem::exists(folder.path(name)));
  }
  std::filesystem::create_directories(folder.path("mesh.ele"));  // in the way of the second file
  CHECK_THROWS_AS(mesher::write_mesh(some_mesh(), folder.path("mesh.node")), mesher::Error);
  CHECK_FALSE(std::filesystem::exists(folder.path("mesh.node")));
}

TEST_CASE("surfaces have the vertices and faces of the boundary, in their order") {
  const Mesh<3> mesh = some_mesh();
  const auto faces = mesher::boundary_faces(mesh);
  std::vector<Point<3>> on_boundary;
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    if (mesh.kinds[i] == mesher::VertexKind::boundary) on_boundary.push_back(mesh.vertices[i]);
  }
  const support::ScratchFolder folder;
  for (const char* name : {"m.off", "m.obj"}) {
    INFO(name);
    mesher::write_mesh(mesh, folder.path(name));
    CHECK(mesher::read_points<3>(folder.path(name)).points == on_boundary);
  }
  mesher::write_mesh(mesh, folder.path("m.stl"));
  auto corners = mesher::read_points<3>(folder.path("m.stl")).points;
  std::sort(corners.begin(), corners.end());
  CHECK(corners == on_boundary);
  const auto count = [](const std::string& text, const std::string& word) {
    std::size_t found = 0;
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
      ++found;
    }
    return found;
  };
  CHECK(count(folder.read("m.off"), "\n3 ") == faces.size());
  CHECK(count(folder.read("m.obj"), "\nf ") == faces.size());
  CHECK(count(folder.read("m.stl"), "facet normal") == faces.size());
}
