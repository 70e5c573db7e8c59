// What polygons enclose: regions, holes, seeds, and what is kept of a mesh of tetrahedra.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>

#include "facade/graph_runs.hpp"
#include "geometry/space_vectors.hpp"
#include "mesh/boundary_faces.hpp"
#include "mesher/check.hpp"
#include "mesher/extra/generate.hpp"
#include "mesher/meshing.hpp"
#include "mesher/write.hpp"
#include "plc_families.hpp"

namespace {

using mesher::DomainMesh;
using mesher::Extent;
using mesher::Graph;
using mesher::LineId;
using mesher::Mesh;
using mesher::Options;
using mesher::PlcKind;
using mesher::Point;
using mesher::PointId;
using mesher::PolygonId;
using mesher::SeedFault;

Options<3> options_for(const Graph<3>& plc) {
  return {.domain = mesher::snapped_domain<3>(places_of(plc))};
}
DomainMesh<3> domain_of(const Graph<3>& plc, Extent extent = Extent::enclosed) {
  return domain_mesh(mesh_statically(plc, options_for(plc)), plc, extent);
}

double volume(const Mesh<3>& mesh) {
  using namespace mesher::detail;
  double six = 0;
  for (const auto& [a, b, c, d] : mesh.simplices) {
    const auto& v = mesh.vertices;
    six += std::abs(dot(minus(v[b], v[a]), cross(minus(v[c], v[a]), minus(v[d], v[a]))));
  }
  return six / 6;
}

}  // namespace

TEST_CASE("what polygons enclose is kept, however it is turned; the box if that is wanted") {
  struct Case {
    PlcKind kind;
    double volume;
  };
  for (const auto& [kind, expected] :
       {Case{PlcKind::cube, 1}, {PlcKind::nested, 1}, {PlcKind::plates, 1}, {PlcKind::island, 1}}) {
    const Graph<3> plc = mesher::generate_plc({kind});
    CHECK(volume(domain_of(plc).mesh) == Approx(expected).epsilon(1e-12));
    const auto all = domain_of(plc, Extent::box);
    CHECK(all.keeps_all);
    CHECK(all.mesh.simplices == mesh_statically(plc, options_for(plc)).simplices);
  }
  // Two open squares enclose nothing: all is kept.
  Graph<3> open = mesher::generate_plc({PlcKind::cube});
  open.polygons.pop_back();
  CHECK(domain_of(open).keeps_all);
}

TEST_CASE("holes and attributes are those of the seeds in them") {
  Graph<3> plc = mesher::generate_plc({PlcKind::nested, 0.25});
  plc.seeds.push_back(mesher::region_seed<3>(1, {0.1, 0.1, 0.1}, 2.5));
  plc.seeds.push_back(mesher::region_seed<3>(2, {0.5, 0.5, 0.5}, -1));
  const auto both = domain_of(plc);
  CHECK(both.faults.empty());
  REQUIRE(both.mesh.features.regions.size() == both.mesh.simplices.size());
  double inner = 0;
  for (std::size_t t = 0; t < both.mesh.simplices.size(); ++t) {
    const double region = both.mesh.features.regions[t];
    CHECK((region == 2.5 || region == -1));
    Mesh<3> one = both.mesh;
    one.simplices = {both.mesh.simplices[t]};
    if (region == -1) inner += volume(one);
  }
  CHECK(inner == Approx(0.125).epsilon(1e-12));

  plc.seeds.pop_back();
  plc.seeds.push_back(mesher::hole_seed<3>(9, {0.5, 0.5, 0.5}));
  const auto hollow = domain_of(plc);
  CHECK(volume(hollow.mesh) == Approx(0.875).epsilon(1e-12));
  // Its boundary is both cubes' sides, seen from outside counterclockwise.
  const auto& f = hollow.mesh.features;
  std::vector<std::array<std::uint32_t, 3>> boundary;
  for (const auto& face : f.faces) boundary.push_back(face.corners);
  std::sort(boundary.begin(), boundary.end());
  CHECK(boundary == mesher::boundary_faces(hollow.mesh));
  for (const auto& face : f.faces) {
    CHECK(face.polygon.has_value());
    CHECK(face.marker == mesher::kBoundaryMarker);
  }
}

TEST_CASE("seeds that stand for nothing are faults that say why") {
  Graph<3> plc = mesher::generate_plc({PlcKind::nested, 0.25});
  plc.seeds.push_back(
      mesher::hole_seed<3>(1, {7.0 / 8, 9.0 / 8, 0.5}));           // in no tetrahedron, or outside
  plc.seeds.push_back(mesher::hole_seed<3>(2, {0.25, 0.5, 0.5}));  // on the inner cube
  plc.seeds.push_back(mesher::region_seed<3>(3, {0.1, 0.1, 0.1}, 1));
  plc.seeds.push_back(mesher::region_seed<3>(4, {0.9, 0.9, 0.9}, 2));
  const auto mesh = domain_of(plc);
  REQUIRE(mesh.faults.size() == 3);
  using Kind = SeedFault<3>::Kind;
  CHECK(mesh.faults[0].kind == Kind::outside);
  CHECK(mesh.faults[1].kind == Kind::on_segment);
  CHECK(mesh.faults[1].wall.polygon().has_value());
  CHECK(describe(mesh.faults[1]).find("is on polygon ") != std::string::npos);
  CHECK(mesh.faults[2].kind == Kind::shared);
  CHECK(mesh.faults[2].seed == mesher::region_id(4));
  CHECK(volume(mesh.mesh) == Approx(1).epsilon(1e-12));
}

TEST_CASE("the region of a tetrahedron is that of its middle") {
  for (const double gap : {0.1, 0.25}) {
    const Graph<3> plc = mesher::generate_plc({PlcKind::nested, gap});
    Graph<3> seeded = plc;
    seeded.seeds.push_back(mesher::region_seed<3>(1, {gap / 2, 0.5, 0.5}, 1));
    seeded.seeds.push_back(mesher::region_seed<3>(2, {0.5, 0.5, 0.5}, 2));
    const auto mesh = domain_of(seeded, Extent::box).mesh;
    std::size_t counts[3] = {};
    for (std::size_t t = 0; t < mesh.simplices.size(); ++t) {
      const auto& [a, b, c, d] = mesh.simplices[t];
      const auto& v = mesh.vertices;
      Point<3> centre{};
      for (std::size_t i = 0; i < 3; ++i) centre[i] = (v[a][i] + v[b][i] + v[c][i] + v[d][i]) / 4;
      double depth = INFINITY;  // in the outer cube
      for (const double x : centre) depth = std::min({depth, x, 1 - x});
      if (std::abs(depth) < 1e-12 || std::abs(depth - gap) < 1e-12) continue;
      const std::size_t region = depth < 0 ? 0 : depth < gap ? 1 : 2;
      ++counts[region];
      REQUIRE(mesh.features.regions[t] == static_cast<double>(region));
    }
    for (const std::size_t count : counts) CHECK(count > 0);
  }
}

TEST_CASE("vertices, edges and faces have markers of their own, else of what they lie on") {
  Graph<3> plc = mesher::generate_plc({PlcKind::cube_square});
  plc.points[0].marker = 70;
  for (std::size_t i = 0; i < plc.polygons.size(); ++i) {
    plc.polygons[i].marker = static_cast<std::int64_t>(i) + 10;
  }
  plc.polygons.back().marker = 0;  // the square, if it is the last
  const auto& loop = plc.polygons[0].loops[0];
  plc.segments.push_back({LineId{5}, loop[0], loop[1], -3});
  const auto mesh = domain_of(plc).mesh;
  std::map<PolygonId, std::int64_t> markers;
  for (const auto& f : plc.polygons) markers[f.id] = f.marker;
  std::map<std::uint32_t, std::int64_t> of_segment;
  for (const auto& e : mesh.features.edges) {
    if (!e.line) continue;
    CHECK(e.line == LineId{5});
    CHECK(e.marker == -3);
    of_segment[e.low] = of_segment[e.high] = -3;
  }
  CHECK(!of_segment.empty());
  for (const auto& f : mesh.features.faces) {
    REQUIRE(f.polygon.has_value());
    const bool boundary = f.polygon != plc.polygons.back().id;
    CHECK(f.marker == markers.at(*f.polygon));
    for (const std::uint32_t v : f.corners) {
      if (boundary) CHECK(mesh.features.markers[v] != 0);
    }
  }
  for (const auto& [v, marker] : of_segment) {
    const std::int64_t own = mesh.vertices[v] == plc.points[0].at ? 70 : marker;
    CHECK(mesh.features.markers[v] == own);
  }
}

TEST_CASE("points alone have no features, and all is kept") {
  Graph<3> plc;
  for (int i = 0; i < 8; ++i) {
    plc.points.push_back({PointId{i}, {i * 0.125, (i * 3 % 8) * 0.125, (i * 5 % 8) * 0.125}, 0});
  }
  const auto mesh = domain_of(plc);
  CHECK(mesh.keeps_all);
  CHECK(mesh.mesh.features.empty());
  plc.points[3].marker = 4;
  const auto marked = domain_of(plc).mesh;
  CHECK(std::count(marked.features.markers.begin(), marked.features.markers.end(), 4) == 1);
}
