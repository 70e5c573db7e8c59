// Meshes of this library that are as they should be, though it takes a second look to see that: the
// check finds no fault with them, and still finds one if something is taken away.
#include <algorithm>
#include <catch2/catch.hpp>
#include <string>
#include <utility>
#include <vector>

#include "any_id.hpp"
#include "facade/graph_runs.hpp"
#include "mesher/check.hpp"
#include "mesher/extra/generate.hpp"
#include "mesher/meshing.hpp"

namespace {

using mesher::BoundaryRule;
using mesher::Extent;
using mesher::Graph;
using mesher::GraphFile;
using mesher::MeshData;
using mesher::Options;
using mesher::Point;

AnyId id(std::int64_t i) { return AnyId{i}; }

std::string fault_in(const std::vector<mesher::Finding>& findings) {
  for (const auto& f : findings) {
    if (!f.holds) return f.property + ": " + f.detail;
  }
  return "";
}

// --- In the plane

// The points are numbered from 1, the segments likewise, with their markers.
GraphFile<2> graph_of(const std::vector<Point<2>>& points,
                      const std::vector<std::array<std::int64_t, 3>>& segments) {
  GraphFile<2> file;
  for (const auto& p : points) {
    file.graph.points.push_back({id(static_cast<std::int64_t>(file.graph.points.size()) + 1), p});
  }
  for (const auto& [a, b, marker] : segments) {
    const auto next = static_cast<std::int64_t>(file.graph.segments.size()) + 1;
    file.graph.segments.push_back({id(next), id(a), id(b), marker});
  }
  file.points.resize(points.size());
  file.segments.resize(segments.size());
  return file;
}
GraphFile<2> square(std::int64_t marker = 0) {
  return graph_of({{0, 0}, {1, 0}, {1, 1}, {0, 1}},
                  {{1, 2, marker}, {2, 3, marker}, {3, 4, marker}, {4, 1, marker}});
}

MeshData<2> mesh_of(const GraphFile<2>& file, Extent extent) {
  Options<2> options;
  options.domain = mesher::snapped_domain<2>(places_of(file.graph));
  return domain_mesh(mesh_statically(file.graph, options), file.graph, extent).mesh;
}
std::string fault(const MeshData<2>& mesh, const GraphFile<2>& file) {
  mesher::CheckOptions<2> options;
  options.rho = 1.4142;
  options.graph = &file;
  options.features = &mesh.features;
  options.boundary = boundary_rule(mesh, &file);
  return fault_in(check_mesh(mesh, options));
}

// --- In space

struct Builder {
  GraphFile<3> file;
  std::int64_t point(const Point<3>& p) {
    const auto next = static_cast<std::int64_t>(file.graph.points.size()) + 1;
    file.graph.points.push_back({id(next), p});
    return next;
  }
  void polygon(const std::vector<std::vector<std::int64_t>>& loops,
               const std::vector<std::array<std::int64_t, 2>>& edges = {},
               std::int64_t marker = 0) {
    mesher::Polygon facet;
    facet.id = id(static_cast<std::int64_t>(file.graph.polygons.size()) + 1);
    for (const auto& loop : loops) {
      auto& corners = facet.loops.emplace_back();
      for (const auto i : loop) corners.push_back(id(i));
    }
    for (const auto& [a, b] : edges) facet.edges.push_back({id(a), id(b)});
    facet.marker = marker;
    file.graph.polygons.push_back(facet);
  }
  // The box on 4 corners of its floor, without the floor.
  void walls(const std::vector<std::int64_t>& floor, const std::vector<std::int64_t>& roof) {
    polygon({roof});
    for (std::size_t i = 0; i < 4; ++i) {
      const std::size_t k = (i + 1) % 4;
      polygon({{floor[i], floor[k], roof[k], roof[i]}});
    }
  }
  std::vector<std::int64_t> level(double x, double y, double side, double z) {
    return {point({x, y, z}), point({x + side, y, z}), point({x + side, y + side, z}),
            point({x, y + side, z})};
  }
};

// A floor around a box that stands on it.
GraphFile<3> floor_with_box(const Point<3>& at, std::int64_t marker = 0) {
  Builder b;
  const auto outline = b.level(at[0], at[1], 3, at[2]);
  const auto base = b.level(at[0] + 1, at[1] + 1, 1, at[2]);
  const auto roof = b.level(at[0] + 1, at[1] + 1, 1, at[2] + 1);
  b.polygon({outline},
            {{base[0], base[1]}, {base[1], base[2]}, {base[2], base[3]}, {base[3], base[0]}},
            marker);
  b.walls(base, roof);
  return b.file;
}
GraphFile<3> cube(const Point<3>& at, double side) {
  Builder b;
  const auto base = b.level(at[0], at[1], side, at[2]);
  b.polygon({base});
  b.walls(base, b.level(at[0], at[1], side, at[2] + side));
  return b.file;
}

MeshData<3> mesh_of(const GraphFile<3>& file, Extent extent) {
  Options<3> options;
  options.domain = mesher::snapped_domain<3>(places_of(file.graph));
  return domain_mesh(mesh_statically(file.graph, options), file.graph, extent).mesh;
}
std::string fault(const MeshData<3>& mesh, const GraphFile<3>& file) {
  mesher::CheckOptions<3> options;
  options.rho = 2;
  options.graph = &file;
  options.features = &mesh.features;
  options.boundary = boundary_rule(mesh, &file);
  return fault_in(check_mesh(mesh, options));
}

// Names of polygons are for formats that have them.
MeshData<3> without_names(MeshData<3> mesh) {
  for (auto& f : mesh.features.faces) f.polygon.reset();
  for (auto& e : mesh.features.edges) e.line.reset();
  return mesh;
}

}  // namespace

TEST_CASE("a polygon that declares edges may be in the mesh in part") {
  const GraphFile<3> file = floor_with_box({0, 0, 0});
  for (const Extent extent : {Extent::enclosed, Extent::box}) {
    const MeshData<3> mesh = mesh_of(file, extent);
    CHECK(fault(mesh, file) == "");
    CHECK(fault(without_names(mesh), file) == "");
  }
}

TEST_CASE("a part of a polygon is missed where tetrahedra are beside its edges") {
  const GraphFile<3> file = floor_with_box({0, 0, 0});
  MeshData<3> mesh = mesh_of(file, Extent::box);
  auto& faces = mesh.features.faces;
  // All of the floor but the part below the box: on no polygon any more.
  std::erase_if(faces, [&](const mesher::MeshFace& f) {
    if (f.polygon != id(1)) return false;
    Point<3> middle{};
    for (const auto v : f.corners) {
      for (int i = 0; i < 3; ++i) middle[i] += mesh.vertices[v][i] / 3;
    }
    return middle[0] < 1 || middle[0] > 2 || middle[1] < 1 || middle[1] > 2;
  });
  CHECK(fault(mesh, file).starts_with("polygons: polygon 1: the edge"));

  MeshData<3> enclosed = mesh_of(file, Extent::enclosed);
  std::erase_if(enclosed.features.faces,
                [](const mesher::MeshFace& f) { return f.polygon == id(1); });
  CHECK(fault(enclosed, file).starts_with("polygons: polygon 1: the edge"));
}

TEST_CASE("areas of faces are compared by what rounding does to them far from the origin") {
  // The third is no multiple of a power of two: vertices on edges are rounded.
  for (const double far : {0.0, 1e6, 1e6 + 1.0 / 3, -3e7}) {
    CAPTURE(far);
    const GraphFile<3> file = floor_with_box({far, far / 3, far / 7});
    CHECK(fault(mesh_of(file, Extent::enclosed), file) == "");
    const GraphFile<3> slanted = [&] {
      Builder b;
      const Point<3> o{far, far, far};
      const auto at = [&](double x, double y, double z) {
        return b.point({o[0] + x, o[1] + y, o[2] + z});
      };
      const auto p = at(0, 0, 0), q = at(0.7, 0.1, 0.2), r = at(0.2, 0.9, 0.1),
                 s = at(0.3, 0.2, 0.8);
      b.polygon({{p, q, r}});
      b.polygon({{p, q, s}});
      b.polygon({{q, r, s}});
      b.polygon({{r, p, s}});
      return b.file;
    }();
    CHECK(fault(mesh_of(slanted, Extent::enclosed), slanted) == "");
  }
}

TEST_CASE("a line that is left out gives its marker to a vertex of a line that is there") {
  GraphFile<2> file = square(3);
  file.graph.points.push_back({id(5), {-1, 0}});
  file.graph.segments.push_back({id(5), id(1), id(5), 2});
  file.points.resize(5);
  file.segments.resize(5);
  MeshData<2> mesh = mesh_of(file, Extent::enclosed);
  CHECK(fault(mesh, file) == "");
  const auto corner = std::find(mesh.vertices.begin(), mesh.vertices.end(), Point<2>{0, 0});
  auto& marker = mesh.features.markers[static_cast<std::size_t>(corner - mesh.vertices.begin())];
  for (const std::int64_t other : {2, 3}) {
    marker = other;
    CHECK(fault(mesh, file) == "");
  }
  marker = 4;
  CHECK(fault(mesh, file).starts_with("markers: vertex"));
}

TEST_CASE("so does a polygon, or a segment, in space") {
  GraphFile<3> file = cube({0, 0, 0}, 1);
  Builder b{file};
  for (auto& f : b.file.graph.polygons) f.marker = 7;
  const auto far = b.point({-1, 0, 0}), up = b.point({-1, 0, 1});
  b.polygon({{1, far, up}}, {}, 3);
  const auto left = b.point({-1, 1, 0.5});
  b.file.graph.segments.push_back({id(1), id(4), id(left), 2});
  file = b.file;
  file.points.resize(file.graph.points.size());
  file.polygons.resize(file.graph.polygons.size());
  file.segments.resize(1);
  MeshData<3> mesh = mesh_of(file, Extent::enclosed);
  CHECK(fault(mesh, file) == "");
  const auto marker_at = [&](const Point<3>& p) -> std::int64_t& {
    const auto v = std::find(mesh.vertices.begin(), mesh.vertices.end(), p);
    return mesh.features.markers[static_cast<std::size_t>(v - mesh.vertices.begin())];
  };
  for (const std::int64_t other : {3, 7}) {
    marker_at({0, 0, 0}) = other;
    CHECK(fault(mesh, file) == "");
  }
  marker_at({0, 0, 0}) = 2;
  CHECK(fault(mesh, file).starts_with("markers: vertex"));
}

TEST_CASE("a region beside a hole stands for nothing where all of the box is meshed") {
  GraphFile<2> file =
      graph_of({{0, 0}, {1, 0}, {1, 1}, {0, 1}, {2, 0}, {2, 1}},
               {{1, 2, 0}, {2, 3, 0}, {3, 4, 0}, {4, 1, 0}, {2, 5, 0}, {5, 6, 0}, {6, 3, 0}});
  file.graph.seeds = {mesher::hole_seed<2>(1, {0.5, 0.5}),
                      mesher::region_seed<2>(1, {0.25, 0.5}, 7),
                      mesher::region_seed<2>(2, {1.5, 0.5}, 8)};
  MeshData<2> mesh = mesh_of(file, Extent::box);
  CHECK(fault(mesh, file) == "");
  REQUIRE(std::count(mesh.features.regions.begin(), mesh.features.regions.end(), 8) > 0);
  for (double& region : mesh.features.regions) region = region == 8 ? 9 : region;
  CHECK(fault(mesh, file).starts_with("regions: triangle"));

  GraphFile<3> solid = cube({0, 0, 0}, 1);
  solid.graph.seeds = {mesher::hole_seed<3>(1, {0.5, 0.5, 0.5}),
                       mesher::region_seed<3>(1, {0.25, 0.5, 0.5}, 7)};
  CHECK(fault(mesh_of(solid, Extent::box), solid) == "");
}

TEST_CASE("a mesh that fills a box which no lines bound is held to fill it") {
  GraphFile<2> file = square();
  CHECK(boundary_rule(mesh_of(file, Extent::enclosed), &file) == BoundaryRule::lines);
  CHECK(boundary_rule(mesh_of(file, Extent::box), &file) == BoundaryRule::box);
  CHECK(boundary_rule(MeshData<2>(), &file) == BoundaryRule::lines);
  file.graph.seeds = {mesher::hole_seed<2>(1, {0.5, 0.5})};
  CHECK(fault(mesh_of(file, Extent::box), file) == "");
  // What lines enclose is not taken for a box, so that a hole is looked for in it.
  GraphFile<2> solid = square();
  const MeshData<2> filled = mesh_of(solid, Extent::enclosed);
  CHECK(fault(filled, file).starts_with("regions: triangle"));

  GraphFile<3> cubic = cube({0, 0, 0}, 1);
  CHECK(boundary_rule(mesh_of(cubic, Extent::enclosed), &cubic) == BoundaryRule::lines);
  CHECK(boundary_rule(mesh_of(cubic, Extent::box), &cubic) == BoundaryRule::box);
  cubic.graph.seeds = {mesher::hole_seed<3>(1, {0.5, 0.5, 0.5})};
  CHECK(fault(mesh_of(cubic, Extent::box), cubic) == "");
}

TEST_CASE("a mesh without simplices is good where all that is enclosed may be in holes") {
  GraphFile<2> file = square();
  file.graph.seeds = {mesher::hole_seed<2>(1, {0.5, 0.5})};
  const MeshData<2> mesh = mesh_of(file, Extent::enclosed);
  REQUIRE(mesh.simplices.empty());
  CHECK(fault(mesh, file) == "");
  CHECK(fault(mesh, square()) == "overlap: no triangles");

  GraphFile<3> solid = cube({0, 0, 0}, 1);
  solid.graph.seeds = {mesher::hole_seed<3>(1, {0.5, 0.5, 0.5})};
  const MeshData<3> none = mesh_of(solid, Extent::enclosed);
  REQUIRE(none.simplices.empty());
  CHECK(fault(none, solid) == "");
  CHECK(fault(none, cube({0, 0, 0}, 1)) == "hull: no tetrahedra");
}
