// Limits of size in what lines enclose, and of regions, while lines and seeds are edited.
#include "sizes/region_limits.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "any_id.hpp"
#include "facade/box_mesher.hpp"
#include "facade/graph_runs.hpp"
#include "failing_update.hpp"
#include "geometry/box.hpp"
#include "mesher/extra/generate.hpp"
#include "mesher/mesher.hpp"
#include "mesher/sizes.hpp"
#include "program/world.hpp"
#include "rules/mesh_box.hpp"

namespace {

using mesher::Box;
using mesher::Extent;
using mesher::Mesh;
using mesher::Mesher;
using mesher::Options;
using mesher::Point;
using mesher::RegionAreas;
using RegionLimits = mesher::RegionLimits<2>;

AnyId id(std::int64_t i) { return AnyId{i}; }

Options<2> options(Extent extent = Extent::enclosed, RegionAreas areas = RegionAreas::ignored) {
  return {.domain = {{0, 0}, {16, 16}}, .extent = extent, .region_areas = areas};
}

// Two rooms with a wall between them, line 2, in a wide domain.
template <class Target>
void announce_rooms(Target& m) {
  const std::vector<Point<2>> points{{4, 4}, {8, 4}, {12, 4}, {12, 8}, {8, 8}, {4, 8}};
  for (std::size_t i = 0; i < points.size(); ++i) {
    m.insert(id(static_cast<std::int64_t>(i) + 1), points[i]);
  }
  m.insert_polyline(id(1), {id(1), id(2), id(3), id(4), id(5), id(6), id(1)});
  m.insert_segment(id(2), id(2), id(5));
}

Mesh<2> from_scratch(const Mesher<2>& m, RegionAreas areas = RegionAreas::limits) {
  Options<2> o = m.options();
  o.region_limits = mesher::region_limits(m.input(), o, o.extent, areas);
  return mesher::mesh_statically(m.input(), o);
}

long vertices_in(const Mesh<2>& mesh, const Box<2>& box) {
  return std::count_if(mesh.vertices.begin(), mesh.vertices.end(), [&](const Point<2>& p) {
    return p[0] > box.lo[0] && p[0] < box.hi[0] && p[1] > box.lo[1] && p[1] < box.hi[1];
  });
}
constexpr Box<2> kLeft{{4, 4}, {8, 8}}, kRight{{8, 4}, {12, 8}};

double largest_kept(const Mesher<2>& m) {
  const auto kept = m.domain_mesh().mesh;
  double most = 0;
  for (const auto& t : kept.simplices) {
    const auto &p = kept.vertices[t[0]], &q = kept.vertices[t[1]], &r = kept.vertices[t[2]];
    most = std::max(most, ((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])) / 2);
  }
  return most;
}

}  // namespace

TEST_CASE("A limit counts in what lines enclose, and fills nothing around it") {
  Mesher<2> m(options());
  m.limit({.max_measure = 0.05});
  announce_rooms(m);
  m.update();
  CHECK(m.box_mesh() == from_scratch(m, RegionAreas::ignored));
  CHECK(largest_kept(m) <= 0.05);
  CHECK(vertices_in(m.box_mesh(), kLeft) + vertices_in(m.box_mesh(), kRight) > 300);
  CHECK(m.box_mesh().vertices.size() < 1200);  // 16^2 / 0.05 / 2 would be 2560
  Mesher<2> all(options(Extent::box));
  all.limit({.max_measure = 0.05});
  announce_rooms(all);
  all.update();
  CHECK(all.box_mesh().vertices.size() > 2500);
}

TEST_CASE("What begins or ceases to be enclosed is filled or emptied") {
  Mesher<2> m(options());
  announce_rooms(m);
  m.update();
  m.limit({.max_measure = 0.1});
  m.update();
  CHECK(m.box_mesh() == from_scratch(m));
  const Mesh<2> closed = m.box_mesh();
  m.insert_hole(1, {6, 6});
  m.update();
  CHECK(vertices_in(m.box_mesh(), kLeft) < 30);
  CHECK(m.box_mesh() == from_scratch(m));
  m.remove_line(id(2));  // now the hole is all
  m.update();
  CHECK(vertices_in(m.box_mesh(), kRight) < 60);
  CHECK(m.box_mesh() == from_scratch(m));
  m.insert_segment(id(2), id(2), id(5));
  m.remove_hole(1);
  m.update();
  CHECK(m.box_mesh() == closed);
  m.remove_line(id(1));  // nothing is enclosed: all of the domain is wanted
  m.update();
  CHECK(m.box_mesh().vertices.size() > 1200);
  CHECK(m.box_mesh() == from_scratch(m));
  m.check_invariants();
}

TEST_CASE("The area of a region follows its walls and its seed") {
  Mesher<2> m(options(Extent::enclosed, RegionAreas::limits));
  announce_rooms(m);
  m.update();
  const Mesh<2> without = m.box_mesh();
  m.insert_region(1, {6, 6}, 1, 0.05);
  m.update();
  CHECK(m.box_mesh() == from_scratch(m));
  const long left = vertices_in(m.box_mesh(), kLeft);
  CHECK(left > 150);
  CHECK(vertices_in(m.box_mesh(), kRight) < 60);
  m.remove_line(id(2));
  m.update();
  CHECK(m.box_mesh() == from_scratch(m));
  CHECK(vertices_in(m.box_mesh(), kRight) > 150);
  m.remove_region(1);  // its area changes, and nothing else
  m.insert_region(1, {6, 6}, 1, 0.5);
  m.update();
  CHECK(m.box_mesh() == from_scratch(m));
  CHECK(vertices_in(m.box_mesh(), kLeft) < left / 2);
  m.insert_segment(id(2), id(2), id(5));
  m.remove_region(1);
  m.update();
  CHECK(m.box_mesh() == without);
  m.check_invariants();
}

TEST_CASE(
    "An update that is refused or stopped leaves the limits of regions, and can be repeated") {
  Mesher<2> m(options(Extent::enclosed, RegionAreas::limits));
  announce_rooms(m);
  m.insert_region(1, {6, 6}, 1, 0.05);
  m.update();
  const Mesh<2> before = m.box_mesh();
  m.remove_line(id(2));
  m.remove(id(1));
  CHECK_THROWS_AS(m.update(), mesher::Error);
  CHECK(m.box_mesh() == before);
  m.remove_line(id(2));
  mesher::RunControl control;
  std::uint64_t most = 0;
  control.progress = [&](const mesher::Progress& p) { return p.done < most; };
  for (int stopped = 0; stopped < 50; ++stopped) {
    try {
      m.update(control);
      break;
    } catch (const mesher::Error& error) {
      REQUIRE(error.code() == mesher::ErrorCode::cancelled);
      REQUIRE(m.box_mesh() == before);
      most += 200;
    }
  }
  CHECK(most > 200);
  CHECK(m.box_mesh() == from_scratch(m));
  m.check_invariants();
  m.insert_segment(id(2), id(2), id(5));
  m.limit({.max_measure = 1});
  m.discard_edits();
  m.update();
  CHECK(m.box_mesh() == from_scratch(m));
}

TEST_CASE("Triangles come and go, and what is said of places and boxes is that of all triangles") {
  mesher::SplitMix64 random(5);
  const auto box = mesher::detail::MeshBox<2>{{0, 0}, 16};
  auto tree = RegionLimits(box);
  std::vector<std::pair<RegionLimits::Corners, RegionLimits::Limit>> all;
  for (int step = 0; step < 400; ++step) {
    const RegionLimits before = tree;
    if (random.below(3) == 0 && !all.empty()) {
      const auto i = static_cast<std::ptrdiff_t>(random.below(all.size()));
      tree.erase(all[static_cast<std::size_t>(i)].first);
      all.erase(all.begin() + i);
    } else {
      const Point<2> p{15 * random.unit(), 15 * random.unit()};
      const double e = std::exp2(-10 * random.unit());
      const RegionLimits::Corners t{p, {p[0] + e, p[1]}, {p[0] + e * random.unit(), p[1] + e}};
      RegionLimits::Limit limit{random.below(3) != 0, RegionLimits::kNone, {}};
      if (random.below(2) == 0) limit.measure = random.unit();
      tree.insert(t, limit);
      all.push_back({t, limit});
    }
    const Point<2> lo{16 * random.unit(), 16 * random.unit()};
    const double side = std::exp2(5 - 10 * random.unit());
    const Box<2> some{lo, {lo[0] + side, lo[1] + side}};
    RegionLimits::Range range;
    RegionLimits::Limit at;
    for (const auto& [t, limit] : all) {
      const mesher::detail::Tile<2> facet(t);
      if (limit.counts && facet.contains(lo)) {
        at.counts = true, at.measure = std::min(at.measure, limit.measure);
      }
      if (!facet.touches(some)) continue;
      range.all = range.all && limit.counts;
      if (!limit.counts) continue;
      range.some = true;
      range.least = std::min(range.least, limit.measure);
      range.most = std::max(range.most, limit.measure);
    }
    REQUIRE(tree.at(lo) == at);
    REQUIRE(tree.range(some) == range);
    std::size_t count = 0;
    before.for_each([&](const auto&, const auto&) { ++count; });
    std::size_t now = 0;
    tree.for_each([&](const auto&, const auto&) { ++now; });
    REQUIRE(now == all.size());
    REQUIRE((count + 1 == now || count == now + 1));
  }
}

namespace {

// A wall goes, and rooms of which one has an area become one.
struct Rooms {
  Mesher<2> m{options(Extent::enclosed, RegionAreas::limits)};
  Mesh<2> before;

  Rooms() {
    announce_rooms(m);
    m.insert_region(1, {6, 6}, 1, 2);
    m.update();
    before = m.box_mesh();
  }
  void announce() { m.remove_line(id(2)); }
};

// The first limits, so that it begins to matter what is enclosed.
struct Begun : Rooms {
  Begun() : Rooms() {
    m = Mesher<2>(options());
    announce_rooms(m);
    m.update();
    before = m.box_mesh();
  }
  void announce() { m.limit({.max_measure = 2}); }
};

}  // namespace

TEST_CASE("an update of regions' limits in which any one allocation fails leaves all") {
  support::check_failing_updates<Rooms>();
}

TEST_CASE("the same where limits come to an enclosed domain") {
  support::check_failing_updates<Begun>();
}

TEST_CASE("The second mesh, which tells what lines enclose, counts in the memory that is told") {
  mesher::BoxMesher<2> alone(options());
  announce_rooms(alone);
  alone.update();
  Options<2> limited = options();
  limited.max_measure = 4;
  Mesher<2> m(limited);
  announce_rooms(m);
  m.update();
  mesher::BoxMesher<2> in_rooms(m.options());  // with the limits in their regions
  announce_rooms(in_rooms);
  in_rooms.update();
  const auto both = m.stats(), first = in_rooms.stats(), second = alone.stats();
  CHECK(both.vertices == first.vertices);
  CHECK(both.calls == first.calls + second.calls);
  CHECK(both.edges == first.edges + second.edges);
  CHECK(both.trace_bytes > first.trace_bytes + second.trace_bytes);  // and the limits' own
  RegionLimits limits(mesher::detail::mesh_box(options()));
  CHECK(limits.bytes() == 0);
  limits.insert({Point<2>{1, 1}, {2, 1}, {1, 2}}, {});
  CHECK(limits.bytes() > sizeof(RegionLimits::Corners));
}
