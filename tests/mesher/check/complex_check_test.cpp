// The check of meshes of complexes: good ones hold, and each fault that is put in is found and
// said.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <string>

#include "facade/graph_runs.hpp"
#include "mesh/boundary_faces.hpp"
#include "mesher/check.hpp"
#include "mesher/extra/generate.hpp"
#include "mesher/meshing.hpp"
#include "mesher/write.hpp"

namespace {

using mesher::BoundaryRule;
using mesher::Extent;
using mesher::Finding;
using mesher::Graph;
using mesher::GraphFile;
using mesher::LineId;
using mesher::MeshData;
using mesher::Options;
using mesher::PlcKind;
using mesher::PointId;

struct Case {
  GraphFile<3> complex;
  MeshData<3> mesh;

  explicit Case(const Graph<3>& plc, Extent extent = Extent::enclosed) {
    complex.graph = plc;
    const Options<3> options{.domain = mesher::snapped_domain<3>(places_of(plc)),
                             .max_vertices = 100000};
    mesh = domain_mesh(mesh_statically(plc, options), plc, extent).mesh;
  }
  std::vector<Finding> findings() const {
    mesher::CheckOptions<3> options;
    options.rho = 2;
    options.graph = &complex;
    options.features = &mesh.features;
    options.boundary = BoundaryRule::lines;
    return check_mesh(mesh, options);
  }
};

std::string first_fault(const std::vector<Finding>& findings) {
  for (const Finding& f : findings) {
    if (!f.holds) return f.property + ": " + f.detail;
  }
  return "";
}
std::vector<std::string> faulty(const std::vector<Finding>& findings) {
  std::vector<std::string> names;
  for (const Finding& f : findings) {
    if (!f.holds) names.push_back(f.property);
  }
  return names;
}

// Names of polygons and of lines are for formats that have them.
void forget_names(MeshData<3>& mesh) {
  for (auto& f : mesh.features.faces) f.polygon.reset();
  for (auto& e : mesh.features.edges) e.line.reset();
}

}  // namespace

TEST_CASE("meshes of all families hold, with what they enclose or all, named or not") {
  for (const std::string& name : mesher::plc_kind_names()) {
    const auto kind = mesher::plc_kind(name);
    REQUIRE(kind);
    if (*kind == PlcKind::bricks || *kind == PlcKind::cloud) continue;  // large
    const Graph<3> plc = mesher::generate_plc({*kind});
    for (const Extent extent : {Extent::enclosed, Extent::box}) {
      Case good(plc, extent);
      INFO(name);
      CHECK(first_fault(good.findings()) == "");
      forget_names(good.mesh);
      CHECK(first_fault(good.findings()) == "");
    }
  }
}

TEST_CASE("what is wrong with edges, faces and regions is said with ids and places") {
  Graph<3> plc = mesher::generate_plc({PlcKind::cube_square});
  plc.seeds.push_back(mesher::region_seed<3>(1, {0.1, 0.1, 0.1}, 3));
  const Case good(plc);
  REQUIRE(first_fault(good.findings()) == "");
  struct Fault {
    const char* property;
    const char* said;
    std::function<void(Case&)> put;
  };
  const Fault faults[] = {
      {"parts", "no tetrahedron has the edge from vertex 1 at ",
       [](Case& c) {
         auto& e = c.mesh.features.edges;
         const auto last = static_cast<std::uint32_t>(c.mesh.vertices.size() - 1);
         e.insert(e.begin(), {0, last, {}, 0});
       }},
      {"parts", "no tetrahedron has the face of vertex 1 at ",
       [](Case& c) {
         auto& f = c.mesh.features.faces;
         const auto last = static_cast<std::uint32_t>(c.mesh.vertices.size() - 1);
         f.insert(f.begin(), {{0, last - 1, last}, {}, 0});
       }},
      {"polygons", " of its faces",
       [](Case& c) {
         auto& f = c.mesh.features.faces;
         f.erase(f.begin() + static_cast<std::ptrdiff_t>(f.size() / 2));
       }},
      {"polygons", " off its plane",
       [](Case& c) {
         auto& f = c.mesh.features.faces;
         for (auto& face : f) {
           if (face.polygon != f[0].polygon) {
             face.polygon = f[0].polygon;
             break;
           }
         }
       }},
      {"regions", ", which is in no polygon",
       [](Case& c) { c.mesh.features.regions[c.mesh.simplices.size() / 2] = 4; }},
      {"regions", "the seed in it at ", [](Case& c) { c.complex.graph.seeds[0].attribute = 5; }},
      {"regions", " holds the seed of hole 6 at ",
       [](Case& c) {
         c.complex.graph.seeds.push_back(mesher::hole_seed<3>(6, {0.3, 0.3, 0.3}));
       }},
  };
  for (const Fault& fault : faults) {
    Case bad = good;
    fault.put(bad);
    const std::string said = first_fault(bad.findings());
    INFO(said);
    CHECK(said.starts_with(fault.property));
    CHECK(said.find(fault.said) != std::string::npos);
  }
}

// Corners of cells are in a polygon's plane but for more than the rounding of places.
TEST_CASE("vertices of polygons are in their planes, at decimal places too") {
  Graph<3> plc = mesher::generate_plc({PlcKind::pages});
  for (auto& p : plc.points) {
    for (double& x : p.at) x = std::round(x * 1e9) / 1e9;
  }
  CHECK(first_fault(Case(plc).findings()) == "");
}

// They are no corners, so that nothing but themselves says how far off they may be.
TEST_CASE("points that are declared in a polygon are in its plane, too, but for its flatness") {
  Graph<3> plc = mesher::generate_plc({PlcKind::cube});
  for (const double height : {0.0, 1e-9}) {
    INFO("off by " << height);
    Graph<3> bent = plc;
    const PointId id{100};
    bent.points.push_back({id, {0.4, 0.3, 1 + height}});
    const auto at = [&](PointId p) {
      return std::find_if(bent.points.begin(), bent.points.end(),
                          [&](const auto& q) { return q.id == p; })
          ->at;
    };
    for (auto& f : bent.polygons) {
      const bool is_top = std::all_of(f.loops[0].begin(), f.loops[0].end(),
                                      [&](PointId p) { return at(p)[2] == 1; });
      if (is_top) f.points.push_back(id);
    }
    CHECK(first_fault(Case(bent).findings()) == "");
  }
}

TEST_CASE("a seed on a polygon, on its edge or at its corner stands for neither side") {
  const Graph<3> plc = mesher::generate_plc({PlcKind::cube_square});
  for (const mesher::Point<3>& seed : {mesher::Point<3>{0.5, 0.5, 0.5},
                                       {0.5, 0.5, 1},
                                       {0.5, 1, 1},
                                       {1, 1, 1},
                                       {0.375, 0.25, 0.5}}) {
    Graph<3> seeded = plc;
    seeded.seeds.push_back(mesher::hole_seed<3>(1, seed));
    seeded.seeds.push_back(mesher::region_seed<3>(1, seed, 3));
    seeded.seeds.push_back(mesher::region_seed<3>(2, {0.1, 0.1, 0.1}, 4));
    Case made(seeded);
    INFO(seed[0] << ' ' << seed[1] << ' ' << seed[2]);
    CHECK(first_fault(made.findings()) == "");
  }
}

TEST_CASE("a mesh of the points alone has no segments and polygons") {
  Graph<3> plc = mesher::generate_plc({PlcKind::plates});
  Graph<3> points = plc;
  points.polygons.clear();
  Case bare(points);
  bare.complex.graph = plc;
  const auto names = faulty(bare.findings());
  CHECK(std::count(names.begin(), names.end(), "polygons") == 1);
  // A segment across the cube, past the corners of a square in its middle.
  plc = mesher::generate_plc({PlcKind::cube_square});
  plc.polygons.clear();
  Case loose(plc);
  plc.segments.push_back({LineId{5}, {}, {}, 0});
  for (const auto& p : plc.points) {
    if (p.at == mesher::Point<3>{0, 0, 0}) plc.segments[0].from = p.id;
    if (p.at == mesher::Point<3>{1, 1, 1}) plc.segments[0].to = p.id;
  }
  loose.complex.graph = plc;
  const std::string said = first_fault(loose.findings());
  CHECK(said.starts_with("segments: segment 5 from "));
  CHECK(said.find("no edge on it goes on from vertex ") != std::string::npos);
}

TEST_CASE("of a segment with an end outside of what is meshed the part inside must be there") {
  using mesher::Point;
  Graph<3> plc = mesher::generate_plc({PlcKind::cube});
  const auto add = [&](std::int64_t id, const Point<3>& at) {
    plc.points.push_back({PointId{id}, at, 0});
  };
  add(90, {0.5, 0.5, 0.5});
  add(91, {1, 0.5, 0.5});
  for (auto& f : plc.polygons) {
    const auto is_at_side = [&](PointId id) {
      return std::any_of(plc.points.begin(), plc.points.end(),
                         [&](const auto& p) { return p.id == id && p.at[0] == 1; });
    };
    const auto& loop = f.loops[0];
    if (!std::all_of(loop.begin(), loop.end(), is_at_side)) continue;
    f.points.push_back(PointId{91});
  }
  plc.segments.push_back({LineId{7}, PointId{90}, PointId{91}, 0});
  Case strut(plc);
  REQUIRE(first_fault(strut.findings()) == "");
  strut.complex.graph.points.push_back({PointId{92}, {}, 0});
  strut.complex.graph.segments[0].to = PointId{92};
  const auto said = [&](const Point<3>& end) {
    strut.complex.graph.points.back().at = end;
    for (const Finding& f : strut.findings()) {
      if (f.property == "segments") return f.detail;
    }
    return std::string();
  };
  for (int i = 0; i < 2; ++i) {
    CHECK(said({1.25, 0.5, 0.5}).ends_with(" edges, 1 in part"));
    CHECK(said({9, 0.5, 0.5}).ends_with(" edges, 1 in part"));
    CHECK(said({1.25, 0.5, 0.7}).ends_with("its end at (1.25, 0.5, 0.7) is no vertex"));
    CHECK(said({9, 0.5, 0.7}).ends_with("its end at (9, 0.5, 0.7) is no vertex"));
    std::swap(strut.complex.graph.segments[0].from, strut.complex.graph.segments[0].to);
  }
}

TEST_CASE("small angles excuse what they forbid, and nothing else") {
  const Graph<3> plc = mesher::generate_plc({PlcKind::wedge, 2});
  Case sharp(plc);
  REQUIRE(first_fault(sharp.findings()) == "");
  REQUIRE(count_above(sharp.mesh, 2) > 0);
  mesher::CheckOptions<3> options;  // the same mesh without its complex: nothing is excused
  options.rho = 2;
  options.features = &sharp.mesh.features;
  options.boundary = BoundaryRule::lines;
  CHECK(faulty(check_mesh(sharp.mesh, options)) == std::vector<std::string>{"quality"});
}

TEST_CASE("tetrahedra that overlap beyond the box are found") {
  Case twice(mesher::generate_plc({PlcKind::dumbbell}));
  REQUIRE(first_fault(twice.findings()) == "");
  // A copy of one tetrahedron with corners of its own, moved a little: a part that overlaps.
  auto s = twice.mesh.simplices[twice.mesh.simplices.size() / 2];
  for (auto& v : s) {
    auto p = twice.mesh.vertices[v];
    p[0] += 0x1p-20;
    v = static_cast<std::uint32_t>(twice.mesh.vertices.size());
    twice.mesh.vertices.push_back(p);
    twice.mesh.kinds.push_back(mesher::VertexKind::steiner);
  }
  twice.mesh.simplices.push_back(s);
  twice.mesh.features = {};
  mesher::CheckOptions<3> options;
  options.boundary = BoundaryRule::lines;
  mesher::MeshFeatures features;
  for (const auto& face : mesher::boundary_faces(twice.mesh))
    features.faces.push_back({face, {}, 1});
  std::sort(features.faces.begin(), features.faces.end(),
            [](const auto& a, const auto& b) { return a.key() < b.key(); });
  options.features = &features;
  const std::string said = first_fault(check_mesh(twice.mesh, options));
  CHECK(said.starts_with("cover: "));
}
