// Random complexes full of faults: repaired, a mesher finds none; they are where they were.
#include <algorithm>
#include <catch2/catch.hpp>
#include <map>
#include <random>

#include "facade/graph_runs.hpp"
#include "mesher/mesher.hpp"
#include "mesher/repair.hpp"
#include "random_soup.hpp"
#include "repaired_complex.hpp"

namespace {

using mesher::Graph;
using mesher::Point;
using mesher::Repaired;
using support::area;
using support::domain_of;
using support::RandomSoup;
using support::SoupKind;
using Shape = mesher::detail::Polygon;

constexpr double kScales[] = {1, 1e-9, 1e9};

// Without the order of elements, and of corners around a loop.
Graph<3> sorted(Graph<3> g) {
  const auto by_id = [](const auto& a, const auto& b) { return a.id < b.id; };
  std::sort(g.points.begin(), g.points.end(), by_id);
  std::sort(g.segments.begin(), g.segments.end(), by_id);
  std::sort(g.polygons.begin(), g.polygons.end(),
            [](const auto& a, const auto& b) { return a.id < b.id; });
  for (auto& f : g.polygons) {
    mesher::detail::put_in_order(f.loops, [](mesher::PointId v) { return v; });
  }
  return g;
}

Graph<3> shuffled(Graph<3> g, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::shuffle(g.points.begin(), g.points.end(), random);
  std::shuffle(g.segments.begin(), g.segments.end(), random);
  std::shuffle(g.polygons.begin(), g.polygons.end(), random);
  for (auto& f : g.polygons) {
    auto& loop = f.loops[0];
    if (random() % 2 == 0) std::reverse(loop.begin(), loop.end());
    std::rotate(loop.begin(), loop.begin() + static_cast<std::ptrdiff_t>(random() % loop.size()),
                loop.end());
  }
  return g;
}

// The polygons by their places, and all points, kept where they were.
struct Covered {
  std::vector<Shape> shapes;
  std::vector<std::array<Point<3>, 2>> segments;
};
Covered covered(const Graph<3>& plc) {
  std::map<mesher::PointId, Point<3>> at;
  for (const auto& p : plc.points) REQUIRE(at.emplace(p.id, p.at).second);
  Covered all;
  for (const auto& f : plc.polygons) {
    support::Loops loops;
    for (const auto& loop : f.loops) {
      auto& places = loops.emplace_back();
      for (const auto v : loop) places.push_back(at.at(v));
    }
    all.shapes.push_back(support::polygon_of(loops));
  }
  for (const auto& s : plc.segments) all.segments.push_back({at.at(s.from), at.at(s.to)});
  return all;
}

double distance(const Point<3>& x, const Covered& all, bool of_polygons) {
  double least = std::numeric_limits<double>::infinity();
  if (of_polygons) {
    for (const Shape& f : all.shapes) {
      if (!f.loop_end.empty()) least = std::min(least, mesher::detail::distance2(x, f));
    }
  } else {
    for (const auto& s : all.segments) {
      least = std::min(least, mesher::detail::distance2(x, s[0], s[1]));
    }
  }
  return std::sqrt(least);
}

// Places of these are on those, but for `most`.
void require_covered(const Covered& these, const Covered& those, double most,
                     mesher::SplitMix64& random) {
  for (const Shape& f : these.shapes) {
    for (int k = 0; k < 12 && !f.loop_end.empty(); ++k) {
      Point<2> uv;
      for (int i = 0; i < 2; ++i) {
        uv[i] = f.bounds.lo[i] + random.unit() * (f.bounds.hi[i] - f.bounds.lo[i]);
      }
      if (!mesher::detail::contains(f, uv)) continue;
      REQUIRE(distance(f.plane.at(uv), those, true) <= most);
    }
    for (const Point<3>& p : f.places) REQUIRE(distance(p, those, true) <= most);
  }
  for (const auto& [a, b] : these.segments) {
    for (const double t : {0.0, 0.3, 0.6, 1.0}) {
      const Point<3> x =
          mesher::detail::plus(a, mesher::detail::scaled(t, mesher::detail::minus(b, a)));
      REQUIRE(distance(x, those, false) <= most);
    }
  }
}

void require_points_kept(const Graph<3>& before, const Repaired<3>& r) {
  std::map<mesher::PointId, mesher::GraphPoint<3>> at;
  for (const auto& p : before.points) at.emplace(p.id, p);
  std::int64_t last = 0;
  for (const auto& p : before.points) last = std::max(last, static_cast<std::int64_t>(p.id));
  for (const auto& p : r.file.graph.points) {
    const auto it = at.find(p.id);
    if (it == at.end()) {
      REQUIRE(static_cast<std::int64_t>(p.id) > last);
    } else {
      REQUIRE(it->second.at == p.at);
    }
  }
}

// Without the polygons of which nothing is left: with a large tolerance they may have been long.
Graph<3> without_dropped(Graph<3> plc, const Repaired<3>& r) {
  for (const auto& note : r.notes) {
    if (note.kind != mesher::RepairKind::dropped_polygon) continue;
    std::erase_if(plc.polygons, [&](const auto& f) { return f.id == note.polygons[0]; });
  }
  return plc;
}

// Whether it could be: what is nearly parallel may be too close. `share`: of the box's longest
// side, the tolerance.
bool try_soup(std::uint64_t seed, SoupKind kind, std::size_t parts, double scale,
              double share = 0) {
  const Graph<3> plc = RandomSoup(seed, kind, parts, scale).plc();
  CAPTURE(seed, int(kind), parts, scale, share);
  const auto domain = domain_of(plc);
  double side = 0;
  for (int i = 0; i < 3; ++i) side = std::max(side, domain.hi[i] - domain.lo[i]);
  const mesher::RepairOptions<3> options{.domain = domain, .tolerance = share * side};
  Repaired<3> r;
  try {
    r = repair(plc, options);  // asks a mesher's own tests
  } catch (const mesher::Error& error) {
    REQUIRE(error.code() == mesher::ErrorCode::too_close);
    return false;
  }
  require_points_kept(plc, r);
  const Repaired<3> again = repair(r.file, options);
  REQUIRE(again.file.graph == r.file.graph);
  REQUIRE(again.notes.empty());
  REQUIRE(sorted(repair(shuffled(plc, seed), options).file.graph) == sorted(r.file.graph));
  REQUIRE(r.deviation <= 16 * r.tolerance);
  if (kind == SoupKind::flat) {
    mesher::SplitMix64 random(seed);
    const Covered before = covered(share > 0 ? without_dropped(plc, r) : plc);
    const Covered after = covered(r.file.graph);
    const double most = 16 * r.tolerance;
    require_covered(before, after, most, random);
    require_covered(after, before, most, random);
  }
  return true;
}

}  // namespace

TEST_CASE("random complexes are repaired: sound, once and for all, whatever the order") {
  const std::uint64_t seed = GENERATE(range(1, 61));
  for (const SoupKind kind :
       {SoupKind::general, SoupKind::lattice, SoupKind::layers, SoupKind::flat}) {
    REQUIRE(try_soup(seed, kind, 3 + seed % 12, kScales[seed % 3]));
  }
}

TEST_CASE("so are those in which much is nearly in one place, but for a few that are refused") {
  int refused = 0;
  for (std::uint64_t seed = 1; seed <= 120; ++seed) {
    refused += !try_soup(seed, SoupKind::near, 3 + seed % 8, kScales[seed % 3]);
  }
  REQUIRE(refused <= 2);
}

TEST_CASE("with a larger tolerance as well") {
  int refused = 0;
  for (const double share : {0x1p-20, 0x1p-12, 0x1p-8, 0x1p-6}) {
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
      for (const SoupKind kind : {SoupKind::general, SoupKind::lattice, SoupKind::layers,
                                  SoupKind::flat, SoupKind::near}) {
        refused += !try_soup(seed, kind, 3 + seed % 12, kScales[seed % 3], share);
      }
    }
  }
  REQUIRE(refused <= 6);
}

TEST_CASE("triangles are not as thin as the tolerance where others will do") {
  for (const std::uint64_t seed : {92, 106, 354}) {
    REQUIRE(try_soup(seed, SoupKind::near, 3 + seed % 8, kScales[seed % 3]));
  }
}

TEST_CASE("polygons of nearly one plane are joined in an order of their own") {
  for (const std::uint64_t seed : {1134, 1221}) {
    REQUIRE(try_soup(seed, SoupKind::near, 3 + seed % 8, kScales[seed % 3]));
  }
}

TEST_CASE("large ones are repaired in the same way") {
  for (const SoupKind kind : {SoupKind::general, SoupKind::lattice, SoupKind::layers}) {
    REQUIRE(try_soup(5, kind, 150, 1));
  }
}

TEST_CASE("where polygons cross and do not overlap, no area goes and none comes") {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Graph<3> plc = RandomSoup(seed, SoupKind::flat, 20, 1).plc();
    REQUIRE(area(repair(plc).file.graph) == Approx(area(plc)).epsilon(1e-9));
  }
}

TEST_CASE("repaired complexes of the lattice are meshed") {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const Graph<3> plc = repair(RandomSoup(2 * seed + 1, SoupKind::lattice, 4, 1).plc()).file.graph;
    CAPTURE(seed);
    std::vector<Point<3>> points;
    std::vector<mesher::PointId> ids;
    for (const auto& p : plc.points) points.push_back(p.at), ids.push_back(p.id);
    std::vector<mesher::Segment> segments;
    for (const auto& s : plc.segments) segments.push_back({s.id, s.from, s.to});
    const auto mesh = mesh_statically(points, segments, plc.polygons,
                                      {.domain = domain_of(plc), .max_vertices = 100000}, ids);
    REQUIRE(mesh.vertices.size() >= points.size());
  }
}
