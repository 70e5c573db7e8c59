// The checker of meshes of tetrahedra speaks for each property that a mesh can break.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <set>
#include <utility>

#include "asked.hpp"
#include "facade/graph_runs.hpp"
#include "mesher/check.hpp"
#include "mesher/extra/generate.hpp"
#include "mesher/mesher.hpp"
#include "mesher/predicates.hpp"
#include "space_points.hpp"

namespace {

using mesher::Finding;
using mesher::GraphFile;
using mesher::Mesh;
using mesher::Point;
using mesher::PointId;
using mesher::VertexKind;
using Asked = support::Asked<3>;

// The cube of side 2 around its centre, vertex 8: each side has the diagonal that its greatest
// corner is not on, as ties are decided.
Mesh<3> cube() {
  Mesh<3> mesh;
  for (const double z : {0, 2}) {
    for (const double y : {0, 2}) {
      for (const double x : {0, 2}) mesh.vertices.push_back({x, y, z});
    }
  }
  mesh.vertices.push_back({1, 1, 1});
  mesh.kinds.assign(9, VertexKind::boundary);
  mesh.kinds[8] = VertexKind::input;
  mesh.simplices = {{8, 0, 2, 1}, {8, 1, 2, 3}, {8, 4, 5, 6}, {8, 5, 7, 6},
                    {8, 0, 1, 4}, {8, 1, 5, 4}, {8, 2, 6, 3}, {8, 3, 6, 7},
                    {8, 0, 4, 2}, {8, 2, 4, 6}, {8, 1, 3, 5}, {8, 3, 7, 5}};
  return mesh;
}

GraphFile<3> centre() {
  GraphFile<3> file;
  file.graph.points = {{PointId{7}, {1, 1, 1}}};
  file.points = {{2, 1}};
  return file;
}

std::vector<Finding> broken_ones(const Mesh<3>& mesh, const Asked& options = {}) {
  auto findings = mesher::check_mesh(mesh, options);
  findings.erase(std::remove_if(findings.begin(), findings.end(),
                                [](const Finding& finding) { return finding.holds; }),
                 findings.end());
  return findings;
}

// The first property that does not hold, or "".
std::string broken(const Mesh<3>& mesh, const Asked& options = {}) {
  const auto findings = broken_ones(mesh, options);
  return findings.empty() ? "" : findings.front().property;
}

// What is said of it.
std::string complaint(const Mesh<3>& mesh, const Asked& options = {}) {
  const auto findings = broken_ones(mesh, options);
  return findings.empty() ? "" : findings.front().detail;
}

Mesh<3> meshed(const std::vector<Point<3>>& points) {
  return mesher::mesh_statically<3>(points, {.domain = mesher::snapped_domain<3>(points)});
}

// Two tetrahedra on a triangle in place of the three around an edge, all five vertices inside.
bool flip(Mesh<3>& mesh, std::size_t from) {
  for (std::size_t i = from; i < mesh.simplices.size(); ++i) {
    for (std::size_t j = i + 1; j < mesh.simplices.size(); ++j) {
      const std::set<std::uint32_t> a(mesh.simplices[i].begin(), mesh.simplices[i].end());
      const std::set<std::uint32_t> b(mesh.simplices[j].begin(), mesh.simplices[j].end());
      std::vector<std::uint32_t> face, p, q;
      std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(face));
      if (face.size() != 3) continue;
      std::set_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(p));
      std::set_difference(b.begin(), b.end(), a.begin(), a.end(), std::back_inserter(q));
      // 2 to 3: the edge pq must cross the triangle.
      std::vector<Mesh<3>::Simplex> three;
      const auto at = [&](std::uint32_t v) { return mesh.vertices[v]; };
      const int side =
          mesher::predicates::orient3d(at(face[0]), at(face[1]), at(face[2]), at(p[0]));
      if (side < 0) std::swap(face[1], face[2]);
      for (std::size_t k = 0; k < 3; ++k) {
        three.push_back({face[k], face[(k + 1) % 3], q[0], p[0]});
      }
      const bool convex = std::all_of(three.begin(), three.end(), [&](const auto& s) {
        return mesher::predicates::orient3d(at(s[0]), at(s[1]), at(s[2]), at(s[3])) > 0;
      });
      if (!convex) continue;
      mesh.simplices.erase(mesh.simplices.begin() + static_cast<long>(j));
      mesh.simplices.erase(mesh.simplices.begin() + static_cast<long>(i));
      mesh.simplices.insert(mesh.simplices.end(), three.begin(), three.end());
      return true;
    }
  }
  return false;
}

}  // namespace

TEST_CASE("a good mesh of tetrahedra has every property") {
  const GraphFile<3> input = centre();
  const Asked all{.graph = &input, .rho = 0.87, .ties = true};
  CHECK(complaint(cube(), all) == "");
  CHECK(mesher::check_mesh(cube(), all).size() == 11);
}

TEST_CASE("meshes of all families of points in space are what they should be, ties included") {
  for (const auto family : support::kSpaceFamilies) {
    const auto points = support::space_points(family, 120, 5);
    GraphFile<3> input;
    for (std::size_t i = 0; i < points.size(); ++i) {
      input.graph.points.push_back({PointId{static_cast<std::int64_t>(i + 1)}, points[i]});
      input.points.push_back({1, 1});
    }
    INFO(support::name(family));
    CHECK(complaint(meshed(points), {.graph = &input, .rho = 2.0, .ties = true}) == "");
  }
}

TEST_CASE("each way to break a mesh of tetrahedra is found as what it is, where it is") {
  Mesh<3> mesh = cube();
  SECTION("coordinates") {
    mesh.vertices[8][0] = 0x1p-161;
    CHECK(broken(mesh) == "coordinates");
  }
  SECTION("coordinates: more bits than can be judged") {
    mesh.vertices[7] = {0x1p100, 0x1p100, 0x1p100};
    mesh.vertices[8][0] = 0x1.8p-153;
    CHECK(broken(mesh) == "coordinates");
    mesh.vertices[8][0] = 0x1p-152;
    CHECK(broken(mesh) != "coordinates");
  }
  SECTION("vertices: two coincide") {
    mesh.vertices.push_back({1, 1, 1});
    CHECK(complaint(mesh) == "vertex 9 at (1, 1, 1) and vertex 10 at (1, 1, 1) coincide");
  }
  SECTION("vertices: one is unused") {
    mesh.vertices.push_back({1, 1, 0.5});
    CHECK(complaint(mesh) == "vertex 10 at (1, 1, 0.5) is in no tetrahedron");
  }
  SECTION("orientation: one is inside out") {
    std::swap(mesh.simplices[1][0], mesh.simplices[1][1]);
    CHECK(complaint(mesh) ==
          "tetrahedron 2 with the vertices 2, 9, 3, 4 is not positively oriented");
  }
  SECTION("orientation: one is flat") {
    mesh.vertices[8] = {1, 1, 0};
    CHECK(broken(mesh) == "orientation");
  }
  SECTION("orientation: a vertex is moved out of its star") {
    mesh.vertices[8] = {1, 1, 3};
    CHECK(broken(mesh) == "orientation");
  }
  SECTION("faces: one is there twice") {
    mesh.simplices.push_back(mesh.simplices[3]);
    CHECK(complaint(mesh) ==
          "the face of vertex 6 at (2, 0, 2), vertex 7 at (0, 2, 2) and vertex 8 at (2, 2, 2) has "
          "two tetrahedra on one side: tetrahedron 4 with the vertices 9, 6, 8, 7, and tetrahedron "
          "13 with the vertices 9, 6, 8, 7");
    mesh.simplices.push_back(mesh.simplices[3]);
    CHECK(complaint(mesh) ==
          "the face of vertex 6 at (2, 0, 2), vertex 7 at (0, 2, 2) and vertex 8 at (2, 2, 2) is "
          "of more than two tetrahedra");
  }
  SECTION("faces: two tetrahedra on one side") {
    mesh.vertices.push_back({1, 1, 0.5});
    mesh.simplices.push_back({9, 0, 2, 1});
    CHECK(complaint(mesh) ==
          "the face of vertex 1 at (0, 0, 0), vertex 2 at (2, 0, 0) and vertex 3 at (0, 2, 0) has "
          "two tetrahedra on one side: tetrahedron 1 with the vertices 9, 1, 3, 2, and tetrahedron "
          "13 with the vertices 10, 1, 3, 2");
  }
  SECTION("hull: one is missing") {
    mesh.simplices.pop_back();
    CHECK(broken(mesh) == "hull");
    CHECK(complaint(mesh, {.boundary = mesher::BoundaryRule::any}).find("beyond its plane") !=
          std::string::npos);
  }
  SECTION("hull: not a box") {
    mesh.vertices[7] = {2, 2, 2.5};
    CHECK(broken(mesh) == "hull");
  }
  SECTION("hull: nothing") { CHECK(broken({}) == "hull"); }
  SECTION("hull: a second cube beside the first") {
    const auto tetrahedra = mesh.simplices;
    for (const auto& p : cube().vertices) mesh.vertices.push_back({p[0] + 4, p[1], p[2]});
    for (auto t : tetrahedra) {
      for (auto& corner : t) corner += 9;
      mesh.simplices.push_back(t);
    }
    CHECK(broken(mesh) == "hull");
  }
  SECTION("kinds: a vertex inside is said to be of the boundary") {
    mesh.kinds[8] = VertexKind::boundary;
    CHECK(broken(mesh) == "kinds");
  }
}

TEST_CASE("a mesh that covers its box twice, face to face, is found") {
  // The same vertices but for the centre, and two sets of tetrahedra whose outer faces differ:
  // both diagonals of each side are there, so no face is twice on one side.
  Mesh<3> mesh = cube();
  mesh.vertices.push_back({1, 1, 1.25});
  for (const auto& [a, b, c, d] : std::vector<std::array<std::uint32_t, 4>>{
           {0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}}) {
    // The side abcd, with the diagonal that cube() has not.
    const bool has_ac = std::any_of(
        mesh.simplices.begin(), mesh.simplices.begin() + 12, [&, x = a, y = c](const auto& s) {
          return std::count(s.begin(), s.end(), x) + std::count(s.begin(), s.end(), y) == 2;
        });
    using Halves = std::array<std::array<std::uint32_t, 3>, 2>;
    const Halves halves = has_ac ? Halves{{{a, b, d}, {b, c, d}}} : Halves{{{a, b, c}, {a, c, d}}};
    for (auto half : halves) {
      const auto at = [&](std::uint32_t v) { return mesh.vertices[v]; };
      if (mesher::predicates::orient3d(at(half[0]), at(half[1]), at(half[2]), at(9)) < 0) {
        std::swap(half[0], half[1]);
      }
      mesh.simplices.push_back({half[0], half[1], half[2], 9});
    }
  }
  mesh.kinds.clear();
  CHECK(broken(mesh) == "cover");
}

TEST_CASE("a face that is not Delaunay is found, and a tie that is decided otherwise if asked") {
  Mesh<3> mesh = cube();
  mesh.simplices[0] = {8, 0, 3, 1};  // the other diagonal of the bottom
  mesh.simplices[1] = {8, 0, 2, 3};
  CHECK(broken(mesh) == "");
  CHECK(broken(mesh, {.ties = true}) == "ties");
  int flips = 0;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const auto points = support::space_points(support::SpaceFamily::uniform, 20, seed);
    Mesh<3> flipped = meshed(points);
    mesher::SplitMix64 random(seed);
    if (!flip(flipped, random.below(flipped.simplices.size() / 2))) continue;
    ++flips;
    INFO("seed " << seed);
    CHECK(broken(flipped) == "delaunay");
  }
  CHECK(flips > 0);
}

TEST_CASE(
    "a vertex of a mesh that is moved a little is found, and so is each tetrahedron missing") {
  const auto points = support::space_points(support::SpaceFamily::uniform, 30, 3);
  const Mesh<3> good = meshed(points);
  mesher::SplitMix64 random(4);
  for (int round = 0; round < 20; ++round) {
    Mesh<3> mesh = good;
    const auto v = random.below(mesh.vertices.size());
    const bool on_hull = mesh.kinds[v] == VertexKind::boundary;
    for (double& x : mesh.vertices[v]) x += 0.7 * (random.unit() - 0.5);
    INFO("vertex " << v << (on_hull ? " of the hull" : ""));
    CHECK(broken(mesh) != "");
    mesh = good;
    mesh.simplices.erase(mesh.simplices.begin() +
                         static_cast<long>(random.below(mesh.simplices.size())));
    CHECK((broken(mesh) == "hull" || broken(mesh) == "vertices"));
  }
}

TEST_CASE("a body that is no box passes if it is convex and may be any") {
  Mesh<3> mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.simplices = {{0, 2, 1, 3}};
  CHECK(broken(mesh) == "orientation");
  mesh.simplices = {{0, 1, 2, 3}};
  CHECK(broken(mesh) == "hull");
  CHECK(complaint(mesh, {.boundary = mesher::BoundaryRule::any}) == "");
}

TEST_CASE("an input point that is no vertex of the mesh in space, to the last bit, is found") {
  GraphFile<3> input = centre();
  CHECK(broken(cube(), {.graph = &input}) == "");
  input.graph.points[0].at[2] = std::nextafter(1, 2);
  CHECK(complaint(cube(), {.graph = &input}) ==
        "input point 7 at (1, 1, 1.0000000000000002) (line 2) is no vertex");
}

TEST_CASE("kinds and origins that are not those of the input are found") {
  const GraphFile<3> input = centre();
  Mesh<3> mesh = cube();
  mesh.kinds[8] = VertexKind::steiner;
  CHECK(complaint(mesh, {.graph = &input}) ==
        "vertex 9 at (1, 1, 1) is an input point, but not said to be");
  mesh.kinds[8] = mesh.kinds[3] = VertexKind::input;
  CHECK(complaint(mesh, {.graph = &input}) ==
        "vertex 4 at (2, 2, 0) is said to be an input point, but is none");
  mesh = cube();
  mesher::MeshFeatures features;
  features.origins.assign(9, mesher::Feature());
  features.origins[8] = PointId{7};
  CHECK(broken(mesh, {.graph = &input, .features = &features}) == "");
  features.origins[8] = PointId{8};
  CHECK(complaint(mesh, {.graph = &input, .features = &features}) ==
        "vertex 9 at (1, 1, 1) is said to be input point 8, but is input point 7");
  mesh.kinds.assign(9, VertexKind::steiner);  // of a file that tells no kinds
  CHECK(broken(mesh, {.graph = &input}) == "");
}

TEST_CASE("a tetrahedron above rho is found, at the box as elsewhere") {
  // Each has the sphere of three corners of a side and the centre: radius 3/2, shortest edge
  // sqrt(3).
  CHECK(broken(cube(), {.rho = 0.8660254037844387}) == "");
  CHECK(complaint(cube(), {.rho = 0.8660254}).find("radius-edge 0.866025403784438") !=
        std::string::npos);
  const auto points = support::space_points(support::SpaceFamily::uniform, 60, 9);
  CHECK(broken(meshed(points), {.rho = 2.0}) == "");
  CHECK(broken(meshed(points), {.rho = 1.1}) == "quality");
}

TEST_CASE("the worst tetrahedra are over all tetrahedra, and slivers are counted") {
  constexpr double kDegrees = 180 / 3.14159265358979323846;
  Mesh<3> mesh = cube();
  const auto quality = mesher::quality(mesh);
  CHECK(quality.min_dihedral_deg == Approx(45));
  CHECK(quality.max_dihedral_deg == Approx(120));
  CHECK(quality.max_radius_edge == Approx(std::sqrt(0.75)));
  CHECK(quality.slivers == 0);
  // Four corners near a square: two angles of its diagonals' faces are tiny, four nearly flat.
  mesh.vertices = {{0, 0, 0}, {1, 0, 0.01}, {1, 1, 0}, {0, 1, 0.01}};
  mesh.simplices = {{0, 1, 2, 3}};
  const auto sliver = mesher::quality(mesh);
  CHECK(sliver.slivers == 1);
  CHECK(sliver.min_dihedral_deg == Approx(std::atan(0.02) * kDegrees).epsilon(0.01));
  CHECK(sliver.max_dihedral_deg > 177);
  CHECK(std::isnan(mesher::quality(Mesh<3>{}).max_radius_edge));
}

TEST_CASE("the worst of many tetrahedra are those of each alone, at every scale") {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> place(-1, 1);
  for (const double scale : {0x1p-99, 1e-12, 1.0, 1e9, 0x1p99}) {
    for (const double height : {1.0, 1e-3, 1e-9, 1e-14}) {  // of the fourth corner over the others
      Mesh<3> mesh;
      for (int k = 0; k < 200; ++k) {
        std::array<Point<3>, 4> p;
        for (auto& corner : p) corner = {place(random), place(random), place(random)};
        for (std::size_t i = 0; i < 3; ++i) {
          const double centroid = (p[0][i] + p[1][i] + p[2][i]) / 3;
          p[3][i] = centroid + height * (p[3][i] - centroid);
          if (k % 7 == 0) p[1][i] = p[0][i] + 1e-4 * (p[1][i] - p[0][i]);  // a short edge
        }
        for (auto& corner : p) {
          for (double& x : corner) x *= scale;
        }
        if (mesher::predicates::orient3d(p[0], p[1], p[2], p[3]) < 0) std::swap(p[2], p[3]);
        if (mesher::predicates::orient3d(p[0], p[1], p[2], p[3]) == 0) continue;
        const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
        mesh.vertices.insert(mesh.vertices.end(), p.begin(), p.end());
        mesh.simplices.push_back({first, first + 1, first + 2, first + 3});
      }
      mesher::SpaceQuality worst = mesher::quality(mesh);
      std::vector<double> ratios;
      for (const auto& s : mesh.simplices) {
        Mesh<3> one;
        one.vertices = mesh.vertices;
        one.simplices = {s};
        const auto of_this = mesher::quality(one);
        CHECK(of_this.min_dihedral_deg >= worst.min_dihedral_deg);
        CHECK(of_this.max_dihedral_deg <= worst.max_dihedral_deg);
        CHECK(of_this.max_radius_edge <= worst.max_radius_edge);
        ratios.push_back(of_this.max_radius_edge);
        worst.slivers -= of_this.slivers;
      }
      INFO(scale << ' ' << height);
      CHECK(worst.slivers == 0);
      CHECK(std::count(ratios.begin(), ratios.end(), worst.max_radius_edge) > 0);
      std::sort(ratios.begin(), ratios.end());
      if (height < 1e-3) continue;  // flat ones have no ratio but for rounding
      for (const double rho : {ratios[ratios.size() / 4], ratios[ratios.size() / 2], 2.0}) {
        const auto above =
            ratios.end() - std::upper_bound(ratios.begin(), ratios.end(), rho * 1.01);
        const auto near = std::upper_bound(ratios.begin(), ratios.end(), rho * 1.01) -
                          std::lower_bound(ratios.begin(), ratios.end(), rho);
        const auto count = static_cast<std::ptrdiff_t>(mesher::count_above(mesh, rho));
        CHECK((count >= above && count <= above + near));
      }
    }
  }
}
