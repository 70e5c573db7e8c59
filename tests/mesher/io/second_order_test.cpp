// Meshes of second order: where midpoints are, what they have, and how files order them.
#include "mesher/second_order.hpp"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <iterator>
#include <set>
#include <sstream>

#include "mesher/extra/generate.hpp"
#include "mesher/meshing.hpp"
#include "mesher/read.hpp"
#include "mesher/write.hpp"
#include "random_mesh.hpp"
#include "scratch_file.hpp"

namespace {

using mesher::MeshData;
using mesher::SecondOrder;
using mesher::VertexKind;
using support::ScratchFolder;
using Pairs = std::vector<std::array<std::size_t, 2>>;

// A cube of polygons with markers 1 to 6, a line along one edge, and a region.
MeshData<3> cube() {
  mesher::Graph<3> graph;
  for (std::int64_t i = 0; i < 8; ++i) {
    const auto bit = [&](int k) { return static_cast<double>(i >> k & 1); };
    graph.points.push_back({mesher::PointId{i}, {bit(0), bit(1), bit(2)}});
  }
  const std::array<std::array<std::int64_t, 4>, 6> sides{
      {{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}}};
  std::int64_t id = 0;
  for (const auto& side : sides) {
    mesher::Polygon f{.id = mesher::PolygonId{++id}, .loops = {{}}};
    for (const std::int64_t p : side) f.loops[0].push_back(mesher::PointId{p});
    f.marker = id;
    graph.polygons.push_back(f);
  }
  graph.segments = {{mesher::LineId{5}, mesher::PointId{0}, mesher::PointId{1}, 9}};
  graph.seeds = {mesher::region_seed<3>(1, {.5, .5, .5}, 2)};
  return mesher::mesh(graph, {.max_measure = .05}).mesh;
}

template <int D>
mesher::Point<D> middle(const mesher::Point<D>& a, const mesher::Point<D>& b) {
  mesher::Point<D> m;
  for (int i = 0; i < D; ++i) m[i] = 0.5 * a[i] + 0.5 * b[i];
  return m;
}

// Whether nodes behind the corners of a row are the midpoints of these pairs.
template <int D, class Row>
void require_pairs(const std::vector<mesher::Point<D>>& places, const Row& row,
                   const Pairs& pairs) {
  const std::size_t corners = row.size() - pairs.size();
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const auto [a, b] = pairs[k];
    REQUIRE(places.at(row[corners + k]) == middle<D>(places.at(row[a]), places.at(row[b])));
  }
}

const Pairs kLine{{0, 1}}, kTriangle{{0, 1}, {1, 2}, {2, 0}};
const Pairs kTetrahedron{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};

// The rows of numbers behind a line that begins so, up to the next line of words.
std::vector<std::vector<std::uint32_t>> rows_behind(const std::string& text,
                                                    const std::string& line) {
  std::istringstream lines(text.substr(text.find("\n" + line) + 1));
  std::vector<std::vector<std::uint32_t>> rows;
  std::string row;
  std::getline(lines, row);
  while (std::getline(lines, row) && row[0] >= '0' && row[0] <= '9') {
    std::replace(row.begin(), row.end(), ',', ' ');
    std::istringstream numbers(row);
    rows.push_back({std::istream_iterator<std::uint32_t>(numbers), {}});
  }
  return rows;
}

}  // namespace

TEST_CASE("midpoints follow the vertices in the order of edges, once for each edge") {
  mesher::SplitMix64 random(3);
  const MeshData<2> mesh = support::random_mesh(4, random);
  const SecondOrder<2> second(mesh);
  CHECK(second.edges() == mesher::edges(mesh));
  CHECK(second.nodes() == mesh.vertices.size() + second.edges().size());
  const MeshData<2> all = with_midpoints(mesh, mesh.features, second);
  CHECK(all.vertices.size() == second.nodes());
  for (const auto& t : mesh.simplices)
    require_pairs<2>(all.vertices, second.nodes_of(t), kTriangle);
  for (const auto& e : mesh.features.edges) {
    require_pairs<2>(all.vertices, second.nodes_of(e), kLine);
    const std::uint32_t node = second.between(e.high, e.low);
    CHECK(all.features.markers[node] == e.marker);
    CHECK((all.kinds[node] == VertexKind::segment) == e.line.has_value());
    if (e.line) CHECK(all.features.origins[node] == mesher::Feature(*e.line));
  }
  const auto error = support::error_of([&] { (void)second.between(0, 7000000); });
  CHECK(error.code() == mesher::ErrorCode::bad_mesh);
  CHECK(SecondOrder<2>(mesher::Mesh<2>{}).nodes() == 0);
}

TEST_CASE("in space midpoints have the line or polygon that their edge is on") {
  const MeshData<3> mesh = cube();
  const SecondOrder<3> second(mesh);
  const MeshData<3> all = with_midpoints(mesh, mesh.features, second);
  for (const auto& t : mesh.simplices) {
    require_pairs<3>(all.vertices, second.nodes_of(t), kTetrahedron);
  }
  std::set<std::int64_t> polygons;
  for (const auto& f : mesh.features.faces) {
    const auto nodes = second.nodes_of(f);
    require_pairs<3>(all.vertices, nodes, kTriangle);
    for (std::size_t i = 3; i < 6; ++i) {
      CHECK(all.features.markers[nodes[i]] != 0);
      CHECK(all.kinds[nodes[i]] == VertexKind::segment);
      if (const auto id = all.features.origins[nodes[i]].polygon()) {
        polygons.insert(static_cast<std::int64_t>(*id));
      }
    }
  }
  CHECK(polygons == std::set<std::int64_t>{1, 2, 3, 4, 5, 6});
  std::size_t on_line = 0;
  for (std::size_t v = mesh.vertices.size(); v < all.vertices.size(); ++v) {
    if (!all.features.origins[v].line()) continue;
    ++on_line;
    CHECK(all.features.markers[v] == 9);
  }
  CHECK(on_line > 0);
}

TEST_CASE("files of second order read back as the mesh of their corners") {
  const ScratchFolder folder;
  mesher::SplitMix64 random(4);
  const MeshData<2> plane = support::random_mesh(5, random, {.any_region = false});
  const MeshData<3> space = cube();
  for (const std::string name : {"m.node", "m.vtu", "m.vtk", "m.msh", "old.msh"}) {
    INFO(name);
    const mesher::WriteOptions how{
        .order = 2, .msh = name[0] == 'o' ? mesher::MshVersion::v2_2 : mesher::MshVersion::v4_1};
    mesher::write_mesh(plane, folder.path(name), how);
    const MeshData<2> back = mesher::read_mesh<2>(folder.path(name));
    CHECK(back.vertices == plane.vertices);
    CHECK(back.features.edges.size() == plane.features.edges.size());
    REQUIRE(back.notes.size() == 1);
    CHECK(back.notes[0].text.find("of second order are not used") != std::string::npos);
    mesher::write_mesh(space, folder.path(name), how);
    const MeshData<3> solid = mesher::read_mesh<3>(folder.path(name));
    CHECK(solid.vertices == space.vertices);
    CHECK(solid.features.faces.size() == space.features.faces.size());
    CHECK(solid.features.edges.size() == space.features.edges.size());
    if (name.find(".msh") != std::string::npos) continue;  // which has regions together
    CHECK(back.simplices == plane.simplices);
    CHECK(back.features == plane.features);
    CHECK(solid.simplices == space.simplices);
    CHECK(solid.features == space.features);
    CHECK(solid.kinds == space.kinds);
  }
}

TEST_CASE("each format has its own order of midpoints") {
  const ScratchFolder folder;
  const MeshData<3> mesh = cube();
  const MeshData<3> all = with_midpoints(mesh, mesh.features, SecondOrder<3>(mesh));
  const auto check = [&](const std::string& name, const std::string& line, std::size_t skip,
                         std::size_t drop, const Pairs& pairs, std::size_t corners) {
    INFO(name << ", " << line);
    mesher::write_mesh(mesh, folder.path(name.substr(0, name.find(' '))), {.order = 2});
    const auto rows = rows_behind("\n" + folder.read(name.substr(name.find(' ') + 1)), line);
    REQUIRE(!rows.empty());
    for (const auto& row : rows) {
      std::vector<std::uint32_t> nodes(row.begin() + static_cast<std::ptrdiff_t>(skip),
                                       row.end() - static_cast<std::ptrdiff_t>(drop));
      for (std::uint32_t& v : nodes) --v;
      REQUIRE(nodes.size() == corners + pairs.size());
      require_pairs<3>(all.vertices, nodes, pairs);
    }
  };
  const Pairs opposite{{1, 2}, {2, 0}, {0, 1}};
  const Pairs of_gmsh{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {2, 3}, {1, 3}};
  const Pairs of_tetgen{{2, 3}, {0, 3}, {0, 1}, {1, 2}, {1, 3}, {0, 2}};
  check("m.inp m.inp", "*ELEMENT, TYPE=C3D10", 1, 0, kTetrahedron, 4);
  check("m.msh m.msh", "3 1 11 ", 1, 0, of_gmsh, 4);
  const auto rows = std::to_string(mesh.simplices.size());
  check("m.node m.ele", rows + " 10 1", 1, 1, of_tetgen, 4);
  check("m.node m.face", std::to_string(mesh.features.faces.size()) + " 1", 1, 2, opposite, 3);
}

TEST_CASE("formats without second order refuse it before anything is written") {
  const ScratchFolder folder;
  const MeshData<3> mesh = cube();
  for (const char* name : {"m.su2", "m.mesh", "m.off", "m.obj", "m.stl"}) {
    const auto error =
        support::error_of([&] { mesher::write_mesh(mesh, folder.path(name), {.order = 2}); });
    CHECK(error.code() == mesher::ErrorCode::bad_option);
  }
  const auto error =
      support::error_of([&] { mesher::write_mesh(mesh, folder.path("m.vtu"), {.order = 3}); });
  CHECK(error.message() == "order 3: must be 1 or 2");
  CHECK(folder.count() == 0);
  mesher::write_mesh(mesh, folder.path("a.svg"), {.order = 2});
  mesher::write_mesh(mesh, folder.path("b.svg"));
  CHECK(folder.read("a.svg") == folder.read("b.svg"));
}
