// Limits of size in space: nothing is larger, and under edits of complexes, of limits and of
// regions the mesh is that of a run from scratch.
#include "space_limits.hpp"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "facade/graph_runs.hpp"
#include "geometry/centroid.hpp"
#include "geometry/space_vectors.hpp"
#include "mesher/check.hpp"
#include "mesher/error.hpp"
#include "mesher/mesher.hpp"
#include "program/obstacles.hpp"
#include "program/world.hpp"
#include "rules/mesh_box.hpp"
#include "sizes/limits.hpp"
#include "space_parcels.hpp"

namespace {

using mesher::Extent;
using mesher::Graph;
using mesher::LineId;
using mesher::Mesh;
using mesher::Options;
using mesher::Point;
using mesher::PointId;
using mesher::PolygonId;
using mesher::RegionAreas;
using Mesher = mesher::Mesher<3>;

const Options<3> kOptions{.domain = {{0, 0, 0}, {2, 2, 2}}, .max_vertices = 200000};

// The tetrahedra of a mesh that are larger than they may be.
std::size_t count_large(const Mesh<3>& mesh, const Options<3>& options) {
  const mesher::detail::Limits<3> limits(options, mesher::detail::mesh_box<3>(options));
  std::size_t large = 0;
  for (const auto& s : mesh.simplices) {
    mesher::detail::CornersOf<3> p;
    for (std::size_t i = 0; i < 4; ++i) p[i] = mesh.vertices[s[i]];
    using mesher::detail::cross, mesher::detail::dot, mesher::detail::minus;
    const Point<3> n = cross(minus(p[1], p[0]), minus(p[2], p[0]));
    const double volume = dot(minus(p[3], p[0]), n) / 6;
    large += volume > limits.measure(mesher::detail::centroid(p)) ? 1 : 0;
  }
  return large;
}

Options<3> fresh_options(const Mesher& m, RegionAreas areas) {
  Options<3> options = m.options();
  options.region_limits = nullptr;
  const bool regions = m.options().region_limits != nullptr;
  if (regions) options.region_limits = region_limits(m.input(), options, options.extent, areas);
  return options;
}

// Edits of complexes and of limits, and of seeds if regions have limits of their own.
void follow(std::uint64_t seed, Extent extent, RegionAreas areas, int updates) {
  Options<3> with_extent = kOptions;
  with_extent.extent = extent;
  with_extent.region_areas = areas;
  Mesher m(with_extent);
  support::SpaceParcels<Mesher> parcels(m, seed);
  support::SpaceLimits limits(seed);
  mesher::SplitMix64 random(seed);
  std::int64_t last_seed = 0;
  bool refined = false;
  for (int update = 0; update < updates; ++update) {
    INFO("seed " << seed << ", update " << update);
    const bool done = parcels.edit_and(update == 0 ? 6 : 1 + parcels.below(3), [&] {
      if (update == 0 || random.below(2) == 0) limits.edit(m);
      if (areas == RegionAreas::limits && random.below(2) == 0) {
        const Point<3> at{2 * random.unit(), 2 * random.unit(), 2 * random.unit()};
        const double volume = random.below(2) == 0 ? 0.002 : 0.0004;
        m.insert_region(++last_seed, at, 1, volume);
      }
      m.update();
    });
    const Options<3> options = fresh_options(m, areas);
    const Mesh<3> mesh = m.box_mesh();
    if (!done && mesh.vertices.empty()) return;
    REQUIRE(mesh == mesh_statically(m.input(), options));
    REQUIRE(count_large(mesh, options) == 0);
    if (update % 3 == 2) m.check_invariants();
    if (!refined) {
      refined = mesh.vertices.size() > mesh_statically(m.input(), kOptions).vertices.size();
    }
  }
  CHECK(refined);
}

}  // namespace

TEST_CASE("With limits that are edited the mesh is that of a fresh run, and nothing is larger") {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    follow(seed, Extent::box, RegionAreas::ignored, 8);
  }
}

TEST_CASE("So it is where limits count in what polygons enclose, and regions have their own") {
  for (std::uint64_t seed = 11; seed <= 13; ++seed) {
    follow(seed, Extent::enclosed, RegionAreas::ignored, 6);
    follow(seed, Extent::enclosed, RegionAreas::limits, 6);
  }
}

TEST_CASE("Long sequences with limits in space follow runs from scratch", "[.soak]") {
  for (std::uint64_t seed = 100; seed < 130; ++seed) {
    follow(seed, Extent::box, RegionAreas::limits, 40);
    follow(seed, Extent::enclosed, RegionAreas::limits, 40);
  }
}

TEST_CASE("A point amid a lattice in space changes few vertices, however fine the lattice is") {
  for (const double volume : {1e-3, 1e-4}) {
    Options<3> options = kOptions;
    options.max_measure = volume;
    options.extent = Extent::box;
    Mesher m(options);
    m.update();
    const std::size_t all = m.box_mesh().vertices.size();
    CHECK(all > 1 / volume);  // 8 / (6 volume) and the box
    m.insert(PointId{1}, {1.01, 0.93, 1.07});
    const auto change = m.update();
    CHECK(change.vertices_added.size() + change.vertices_removed.size() < 40);
    CHECK(m.box_mesh() ==
          mesh_statically(m.input(), options));  // also where it takes a place's room
  }
}

// In a sheet there is no centroid and no place of a lattice: nothing else splits.
TEST_CASE(
    "Edges and polygons are as fine as the lattice where they meet a limit, if it is a sheet") {
  const double spacing = 0.2;
  Mesher m(Options<3>{.domain = {{0, 0, 0}, {4, 4, 4}}, .extent = Extent::box});
  m.insert(PointId{1}, {0.5, 1.9, 3.1});
  m.insert(PointId{2}, {3.5, 2.2, 2.9});
  m.insert_segment(LineId{1}, PointId{1}, PointId{2});
  m.insert(PointId{3}, {0.5, 0.5, 1});
  m.insert(PointId{4}, {3.5, 0.5, 1});
  m.insert(PointId{5}, {3.5, 3.5, 1});
  m.insert(PointId{6}, {0.5, 3.5, 1});
  m.insert_polygon(
      {.id = PolygonId{1}, .loops = {{PointId{3}, PointId{4}, PointId{5}, PointId{6}}}});
  m.limit({{2.03, 0, 0}, {2.03, 4, 4}}, {.max_measure = spacing * spacing * spacing / 12});
  m.update();
  const Mesh<3> mesh = m.box_mesh();
  // The longest of those that meet the sheet.
  const auto longest = [&](const auto& parts) {
    double longest2 = 0;
    for (const auto& part : parts) {
      bool left = false, right = false;
      for (const auto v : part) (mesh.vertices[v][0] <= 2.03 ? left : right) = true;
      for (const auto v : part) {
        for (const auto w : part) {
          if (!left || !right) continue;
          const double length2 =
              mesher::detail::squared_distance(mesh.vertices[v], mesh.vertices[w]);
          longest2 = std::max(longest2, length2);
        }
      }
    }
    return std::sqrt(longest2);
  };
  std::vector<std::array<std::uint32_t, 2>> edges;
  for (const auto& e : mesh.edges) edges.push_back({e.low, e.high});
  std::vector<std::array<std::uint32_t, 3>> faces;
  for (const auto& f : mesh.faces) faces.push_back(f.corners);
  CHECK(longest(edges) > 0);
  CHECK(longest(edges) <= mesher::detail::kLongestEdge * spacing);
  CHECK(longest(faces) <= 3 * spacing);  // of pieces up to 1.1 wide, with one vertex in each
}

TEST_CASE("Limits in space that make no sense are refused, and change nothing") {
  Options<3> options = kOptions;
  options.extent = Extent::box;
  Mesher m(options);
  m.limit({.max_measure = 0.01});
  m.update();
  const Mesh<3> before = m.box_mesh();
  const auto refused = [&](const mesher::Box<3>& box, double volume) {
    try {
      m.limit(box, {.max_measure = volume});
    } catch (const mesher::Error& error) {
      return error.code() == mesher::ErrorCode::bad_option;
    }
    return false;
  };
  CHECK(refused(kOptions.domain, -1));
  CHECK(refused(kOptions.domain, std::nan("")));
  CHECK(refused(kOptions.domain, 1e-60));
  CHECK(refused({{1, 1, 1}, {0, 2, 2}}, 1));
  m.update();
  CHECK(m.box_mesh() == before);
  CHECK(m.options().max_measure == 0.01);
}
