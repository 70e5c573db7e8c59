// The mesh checker speaks for each property that a mesh can break; domains are snapped as promised.
#include "mesher/check.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "asked.hpp"
#include "facade/graph_runs.hpp"
#include "mesher/extra/generate.hpp"
#include "mesher/mesh.hpp"
#include "mesher/mesher.hpp"

namespace {

using mesher::Mesh;
using mesher::Point;
using mesher::VertexKind;

// The square (0,0) to (4,4) with one vertex inside; vertices 1 to 4 of the hull count from 0.
Mesh<2> square() {
  Mesh<2> mesh;
  mesh.vertices = {{0, 0}, {0, 4}, {1, 2}, {4, 0}, {4, 4}};
  mesh.kinds.assign(5, VertexKind::boundary);
  mesh.kinds[2] = VertexKind::input;
  mesh.simplices = {{0, 2, 1}, {0, 3, 2}, {1, 2, 4}, {2, 3, 4}};
  return mesh;
}

// The first property that does not hold, or "".
std::string broken(const Mesh<2>& mesh, const support::Asked<2>& options = {}) {
  for (const auto& finding : mesher::check_mesh(mesh, options)) {
    if (!finding.holds) return finding.property;
  }
  return "";
}

}  // namespace

TEST_CASE("a good mesh has every property") {
  CHECK(broken(square()) == "");
  CHECK(mesher::check_mesh(square(), {}).size() == 7);
}

TEST_CASE("each way to break a mesh is found as what it is") {
  Mesh<2> mesh = square();
  SECTION("coordinates") {
    mesh.vertices[2][0] = 0x1p-161;
    CHECK(broken(mesh) == "coordinates");
  }
  SECTION("coordinates: more bits than can be judged") {
    mesh.vertices[4] = {0x1p100, 0x1p100};
    mesh.vertices[2][0] = 0x1.8p-153;
    CHECK(broken(mesh) == "coordinates");
    mesh.vertices[2][0] = 0x1p-152;
    CHECK(broken(mesh) != "coordinates");
  }
  SECTION("vertices: two coincide") {
    mesh.vertices.push_back({1, 2});
    CHECK(broken(mesh) == "vertices");
  }
  SECTION("vertices: one is unused") {
    mesh.vertices.push_back({3, 3});
    CHECK(broken(mesh) == "vertices");
  }
  SECTION("orientation: clockwise") {
    std::swap(mesh.simplices[1][0], mesh.simplices[1][1]);
    CHECK(broken(mesh) == "orientation");
  }
  SECTION("orientation: flat") {
    mesh.vertices[2] = {0, 2};
    CHECK(broken(mesh) == "orientation");
  }
  SECTION("edges: two triangles on one side") {
    mesh.vertices.push_back({1, 3});
    mesh.simplices.push_back({0, 3, 5});
    CHECK(broken(mesh) == "edges");
  }
  SECTION("edges: three triangles") {
    mesh.simplices.push_back({0, 2, 1});
    mesh.simplices.push_back({0, 2, 1});
    CHECK(broken(mesh) == "edges");
  }
  SECTION("hull: a triangle is missing") {
    mesh.simplices.pop_back();
    CHECK(broken(mesh) == "hull");
  }
  SECTION("hull: not a box") {
    mesh.vertices[4] = {4, 5};
    CHECK(broken(mesh) == "hull");
  }
  SECTION("hull: nothing") { CHECK(broken({}) == "hull"); }
  SECTION("hull: a second square beside the first") {
    const auto triangles = mesh.simplices;
    for (const auto& p : square().vertices) mesh.vertices.push_back({p[0] + 8, p[1]});
    for (auto t : triangles) {
      for (auto& corner : t) corner += 5;
      mesh.simplices.push_back(t);
    }
    CHECK(broken(mesh) == "hull");
  }
}

TEST_CASE("an edge that is not Delaunay is found, cocircular points are not") {
  Mesh<2> mesh;
  mesh.kinds.assign(4, VertexKind::boundary);
  mesh.vertices = {{0, 0}, {0, 1}, {1, 0}, {1, 1}};
  mesh.simplices = {{0, 2, 1}, {1, 2, 3}};
  CHECK(broken(mesh) == "");
  mesh.kinds.assign(6, VertexKind::boundary);
  mesh.vertices = {{0, 0}, {0, 4}, {2, 0}, {2, 3.5}, {4, 0}, {4, 4}};
  mesh.simplices = {{0, 2, 3}, {0, 3, 1}, {1, 3, 5}, {2, 4, 3}, {3, 4, 5}};
  CHECK(broken(mesh) == "");
  mesh.simplices[0] = {0, 2, 1};
  mesh.simplices[1] = {1, 2, 3};
  CHECK(broken(mesh) == "delaunay");
}

TEST_CASE("an input point that is no vertex, to the last bit, is found") {
  mesher::GraphFile<2> input;
  input.graph.points = {{mesher::PointId{7}, {1, 2}}};
  input.points = {{2, 1}};
  CHECK(broken(square(), {.graph = &input}) == "");
  input.graph.points[0].at[0] = std::nextafter(1, 2);
  CHECK(broken(square(), {.graph = &input}) == "input");
}

TEST_CASE("a triangle above rho is found, be its corners on the hull or not") {
  Mesh<2> mesh = square();
  CHECK(broken(mesh, {.rho = 1.2}) == "");
  CHECK(broken(mesh, {.rho = 1.02}) == "quality");
  mesh.vertices = {{0, 0}, {0, 1}, {64, 0}, {64, 1}};
  mesh.kinds.assign(4, VertexKind::boundary);
  mesh.simplices = {{0, 2, 1}, {1, 2, 3}};
  CHECK(broken(mesh, {.rho = 33}) == "");
  CHECK(broken(mesh, {.rho = 31}) == "quality");
}

TEST_CASE("the worst triangles are over all triangles") {
  const auto quality = mesher::quality(square());
  CHECK(quality.min_angle_deg == Approx(std::atan(0.5) * 180 / 3.14159265358979323846));
  CHECK(quality.max_radius_edge == Approx(2.5 / std::sqrt(5)));
  Mesh<2> outside = square();
  outside.kinds[2] = VertexKind::boundary;
  CHECK(mesher::quality(outside).min_angle_deg == quality.min_angle_deg);
  CHECK(std::isnan(mesher::quality(Mesh<2>{}).min_angle_deg));
  CHECK(mesher::radius_edge({0, 0}, {1, 0}, {0, 1}) == Approx(std::sqrt(0.5)));
}

TEST_CASE("the default domain contains the points on a power-of-two grid") {
  mesher::SplitMix64 random(5);
  for (int round = 0; round < 2000; ++round) {
    std::vector<Point<2>> points(1 + random.below(4));
    const int scale = static_cast<int>(random.below(180)) - 90;
    const double offset = std::ldexp(random.unit() - 0.5, static_cast<int>(random.below(180)) - 90);
    for (auto& p : points) {
      for (double& x : p) x = offset + std::ldexp(random.unit() - 0.5, scale);
    }
    const auto box = mesher::snapped_domain<2>(points);
    for (int i = 0; i < 2; ++i) {
      CHECK(box.lo[i] < box.hi[i]);
      for (const auto& p : points) CHECK((box.lo[i] <= p[i] && p[i] <= box.hi[i]));
    }
    CHECK(mesher::snapped_domain<2>(points) == box);
  }
}

TEST_CASE("the default domain has sides an eighth to a quarter of the longest apart") {
  using Points = std::vector<Point<2>>;
  CHECK(mesher::snapped_domain<2>(Points{}) == mesher::Box<2>{{0, 0}, {1, 1}});
  CHECK(mesher::snapped_domain<2>(Points{{0.1, 0.3}, {0.9, 0.4}}) ==
        mesher::Box<2>{{0, 0.25}, {1, 0.5}});
  CHECK(mesher::snapped_domain<2>(Points{{0, 0}}) == mesher::Box<2>{{-0.25, -0.25}, {0.25, 0.25}});
  CHECK(mesher::snapped_domain<2>(Points{{3, 5}}) == mesher::Box<2>{{2, 4}, {4, 6}});
  CHECK(mesher::snapped_domain<2>(Points{{0, 1}, {8, 1}}) == mesher::Box<2>{{0, 0}, {8, 2}});
  CHECK(mesher::snapped_domain<2>(Points{{-180, -90}, {179, 83}}) ==
        mesher::Box<2>{{-192, -128}, {192, 128}});
}

TEST_CASE("a mesh of points at the lower end of the range of coordinates passes every check") {
  std::uint64_t state = 7;
  const auto next = [&] { return state = state * 6364136223846793005u + 1442695040888963407u; };
  std::vector<mesher::Point<2>> points;
  for (int i = 0; i < 240; ++i) {
    mesher::Point<2> p;
    for (double& x : p) {
      const int exponent = -60 - static_cast<int>((next() >> 33) % 41);
      const double size = std::ldexp(1 + static_cast<double>(next() >> 12) * 0x1p-52, exponent);
      x = (next() >> 40) % 2 == 0 ? size : -size;
    }
    points.push_back(p);
  }
  const mesher::Options<2> options{.domain = mesher::snapped_domain<2>(points)};
  const auto mesh = mesher::mesh_statically<2>(points, options);
  for (const auto& finding : mesher::check_mesh(mesh, support::Asked<2>{.rho = options.rho})) {
    INFO(finding.property << ": " << finding.detail);
    CHECK(finding.holds);
  }
}
