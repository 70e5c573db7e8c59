// Flat tetrahedra are taken out, and all else of the mesh still holds.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "facade/graph_runs.hpp"
#include "mesher/check.hpp"
#include "mesher/delaunay.hpp"
#include "mesher/extra/generate.hpp"
#include "mesher/improve.hpp"
#include "mesher/meshing.hpp"

namespace {

using mesher::Finding;
using mesher::Graph;
using mesher::Mesh;
using mesher::Options;
using mesher::PlcKind;
using mesher::Point;

// No plane of it is across an axis.
Point<3> turned(const Point<3>& p) {
  const auto turn = [](double& a, double& b, double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    a = std::exchange(b, s * a + c * b) * -s + c * a;
  };
  Point<3> q = p;
  turn(q[0], q[1], 0.3);
  turn(q[0], q[2], 0.5);
  turn(q[1], q[2], 0.7);
  return q;
}

Graph<3> turned(Graph<3> plc) {
  for (auto& point : plc.points) point.at = turned(point.at);
  for (auto& seed : plc.seeds) seed.at = turned(seed.at);
  return plc;
}

Mesh<3> mesh_of(const Graph<3>& plc) {
  return mesh_statically(plc, {.domain = mesher::snapped_domain<3>(places_of(plc))});
}

std::string first_fault(const std::vector<Finding>& findings) {
  for (const Finding& f : findings) {
    if (!f.holds) return f.property + ": " + f.detail;
  }
  return "";
}

// Tetrahedra, features, regions, and that they are Delaunay but for rounding.
std::string fault(const Mesh<3>& mesh, const Graph<3>& plc) {
  mesher::GraphFile<3> complex;
  complex.graph = plc;
  const auto kept = domain_mesh(mesh, plc, mesher::Extent::box).mesh;
  mesher::CheckOptions<3> options;
  options.rho = 2;
  options.graph = &complex;
  options.features = &kept.features;
  options.boundary = mesher::BoundaryRule::box;
  options.near_delaunay = true;
  return first_fault(check_mesh(kept, options));
}

double least_dihedral(const Mesh<3>& mesh) { return quality(mesh).min_dihedral_deg; }

// A regular polygon, turned, with a vertex on each side of its plane: what is between these is a
// stack of flat tetrahedra and two fans.
Mesh<3> drum(std::size_t corners) {
  std::vector<Point<3>> points{turned({0.125, 0, 1.75}), turned({0, 0.0625, -1.5})};
  for (std::size_t i = 0; i < corners; ++i) {
    const double at = 2 * 3.141592653589793 * static_cast<double>(i) / static_cast<double>(corners);
    points.push_back(turned({std::cos(at), std::sin(at), 0}));
  }
  std::sort(points.begin(), points.end());
  Mesh<3> mesh;
  mesh.vertices = points;
  mesh.kinds.assign(points.size(), mesher::VertexKind::input);
  mesh.simplices = mesher::delaunay<3>(points).simplices;
  return mesh;
}

}  // namespace

TEST_CASE("families, plain and turned, lose their flat tetrahedra, and hold") {
  std::size_t removed = 0, left = 0;
  for (const std::string& name : mesher::plc_kind_names()) {
    const auto kind = *mesher::plc_kind(name);
    if (kind == PlcKind::bricks || kind == PlcKind::cloud || kind == PlcKind::faults) continue;
    for (const bool turn : {false, true}) {
      const Graph<3> plain = mesher::generate_plc({kind}), plc = turn ? turned(plain) : plain;
      const Mesh<3> before = mesh_of(plc);
      const mesher::Unflattened after = mesher::without_flat_tetrahedra(before);
      INFO(name << (turn ? " turned" : ""));
      // Six pages, and a round bore, have clusters of vertices on one sphere; features that meet at
      // small angles have copies at one distance from their corner.
      CHECK(after.left <= (kind == PlcKind::pages ? 10 : kind == PlcKind::pump ? 3 : 1));
      CHECK(after.mesh.vertices == before.vertices);
      CHECK(after.mesh.edges == before.edges);
      CHECK(after.mesh.faces.size() == before.faces.size());
      CHECK((after.removed == 0) == (after.mesh == before));
      CHECK((after.left > 0 || least_dihedral(after.mesh) > 1e-6));
      CHECK(fault(after.mesh, plc) == "");
      const auto again = mesher::without_flat_tetrahedra(after.mesh);
      CHECK(again.mesh == after.mesh);
      removed += after.removed;
      left += after.left;
    }
  }
  CHECK(removed > 10 * left);
}

TEST_CASE("stacks of flat tetrahedra go one by one") {
  for (const std::size_t corners : {4, 5, 6, 8, 12, 20}) {
    const Mesh<3> before = drum(corners);
    const mesher::Unflattened after = mesher::without_flat_tetrahedra(before);
    INFO(corners << " corners");
    CHECK(after.left == 0);
    CHECK(after.mesh.simplices.size() == 2 * (corners - 2));
    mesher::CheckOptions<3> options;
    options.boundary = mesher::BoundaryRule::any;
    options.near_delaunay = true;
    CHECK(first_fault(check_mesh(after.mesh, options)) == "");
  }
}

TEST_CASE("a flat tetrahedron whose edges are all needed stays") {
  Mesh<3> mesh = drum(5);
  REQUIRE(mesher::without_flat_tetrahedra(mesh).removed > 0);
  for (std::uint32_t a = 0; a < mesh.vertices.size(); ++a) {
    for (std::uint32_t b = a + 1; b < mesh.vertices.size(); ++b) {
      mesh.edges.push_back({a, b, mesher::LineId{1}});
    }
  }
  const mesher::Unflattened after = mesher::without_flat_tetrahedra(mesh);
  CHECK(after.removed == 0);
  CHECK(after.left > 0);
  CHECK(after.mesh == mesh);
}
