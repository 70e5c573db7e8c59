// Regions that follow edits in space: after every update labels, faults and what is kept are those
// of a run from scratch.
#include <catch2/catch.hpp>
#include <map>
#include <set>

#include "any_id.hpp"
#include "facade/graph_runs.hpp"
#include "failing_new.hpp"
#include "mesher/extra/generate.hpp"
#include "mesher/mesher.hpp"
#include "space_parcels.hpp"

namespace {

using mesher::Domain;
using mesher::Extent;
using mesher::Graph;
using mesher::Mesh;
using mesher::Options;
using mesher::Point;
using mesher::PolygonId;
using mesher::RegionLabel;
using mesher::SeedId;
using mesher::SeedKind;
using mesher::SplitMix64;
using mesher::Zone;
using Mesher = mesher::Mesher<3>;
using Update = mesher::DomainUpdate<3>;
using Corners = mesher::DomainChange<3>::Corners;

AnyId id(std::int64_t i) { return AnyId{i}; }

const Options<3> kOptions{.domain = {{0, 0, 0}, {2, 2, 2}}};

std::vector<Corners> corners_of(const Mesh<3>& mesh) {
  std::vector<Corners> all;
  for (const auto& s : mesh.simplices) {
    auto& corners = all.emplace_back();
    for (std::size_t i = 0; i < 4; ++i) corners[i] = mesh.vertices[s[i]];
  }
  return all;
}

// What a follower of the kept part knows by the changes alone.
struct Follower {
  std::set<Corners> kept;
  void follow(const Update& update) {
    for (const Corners& t : update.domain.kept_removed) REQUIRE(kept.erase(t) == 1);
    for (const Corners& t : update.domain.kept_added) REQUIRE(kept.insert(t).second);
  }
};

std::map<Corners, RegionLabel> labels_of(const Mesh<3>& mesh, const Domain<3>& domain) {
  std::map<Corners, RegionLabel> labels;
  const auto corners = corners_of(mesh);
  for (std::size_t t = 0; t < corners.size(); ++t) {
    labels[corners[t]] = domain.regions[domain.region_of[t]].label;
  }
  return labels;
}

Domain<3> domain_of(const Mesh<3>& mesh, const Graph<3>& plc, Extent extent) {
  std::vector<mesher::MeshFace> walls;
  for (const auto& f : mesh.faces) walls.push_back({f.corners, f.polygon, 0});
  return find_domain<3>(mesh, walls, plc.seeds, extent);
}

// All is that of a run from scratch, and the changes led there.
void require_fresh(const Mesher& m, const Follower& follower) {
  const Graph<3> plc = m.input();
  const Mesh<3> mesh = mesh_statically(plc, m.options());
  REQUIRE(m.box_mesh() == mesh);
  const Domain<3> domain = domain_of(mesh, plc, m.options().extent);
  std::set<Corners> kept;
  for (const auto& [corners, label] : labels_of(mesh, domain)) {
    REQUIRE(m.label(corners) == label);
    const bool is_kept = domain.keeps_all || label.zone == Zone::inside;
    REQUIRE(m.keeps(corners) == is_kept);
    if (is_kept) kept.insert(corners);
  }
  REQUIRE(follower.kept == kept);
  auto faults = domain.faults;
  for (auto& fault : faults) fault.wall = {};
  REQUIRE(m.faults() == faults);
}

// Seeds that come, go and move, most of them in the middles of tetrahedra, some on corners.
class Seeds {
 public:
  Seeds(Mesher& m, std::uint64_t seed) : m_(m), random_(seed) {}
  void edit() {
    const SeedId name{random_.below(2) == 0 ? SeedKind::hole : SeedKind::region,
                      1 + static_cast<std::int64_t>(random_.below(4))};
    const bool there = m_.contains(name);
    if (there) m_.remove_seed(name);
    if (there && random_.below(2) == 0) return;
    m_.insert_seed({name, place(), static_cast<double>(random_.below(5)), {}});
  }

 private:
  Point<3> place() {
    const Mesh<3> mesh = m_.box_mesh();
    if (mesh.simplices.empty() || random_.below(6) == 0) {
      return {2 * random_.unit(), 3 * random_.unit(), random_.unit()};
    }
    const auto& s = mesh.simplices[random_.below(mesh.simplices.size())];
    Point<3> p = mesh.vertices[s[0]];
    const std::size_t of = 1 + random_.below(4);  // a corner, or in the middle of 2, 3, 4
    for (std::size_t i = 1; i < of; ++i) {
      for (std::size_t x = 0; x < 3; ++x) p[x] += mesh.vertices[s[i]][x];
    }
    for (double& x : p) x /= static_cast<double>(of);
    return p;
  }
  Mesher& m_;
  SplitMix64 random_;
};

// A box of 8 points from `first` on, as 6 polygons.
void insert_box(Mesher& m, std::int64_t first, double lo, double hi) {
  for (std::int64_t i = 0; i < 8; ++i) {
    const auto at = [&](std::int64_t bit) { return (i >> bit & 1) != 0 ? hi : lo; };
    m.insert(id(first + i), {at(0), at(1), at(2)});
  }
  constexpr std::int64_t kSides[6][4] = {{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                         {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}};
  for (std::int64_t f = 0; f < 6; ++f) {
    mesher::Polygon side{.id = id(first + f), .loops = {{}}, .marker = 10 + f};
    for (const auto i : kSides[f]) side.loops[0].push_back(id(first + i));
    m.insert_polygon(side);
  }
}

}  // namespace

TEST_CASE(
    "After random edits of polygons and seeds in space all regions are those of a fresh run") {
  const std::uint64_t seed = GENERATE(1, 2, 3, 4, 5, 6);
  const Extent extent = seed % 3 == 0 ? Extent::box : Extent::enclosed;
  CAPTURE(seed);
  Options<3> options = kOptions;
  options.extent = extent;
  Mesher m(options);
  support::SpaceParcels<Mesher> parcels(m, seed);
  Seeds seeds(m, seed);
  Follower follower;
  std::size_t enclosing = 0;
  for (int round = 0; round < 30; ++round) {
    CAPTURE(round);
    Update update;
    const auto change = [&] {
      for (auto n = parcels.below(3); n > 0; --n) seeds.edit();
      update = m.update();
    };
    const auto count = round == 0 ? parcels.below(2) * 6 : parcels.below(3);
    if (parcels.edit_and(count, change)) follower.follow(update);
    require_fresh(m, follower);
    enclosing += follower.kept.size() < m.box_mesh().simplices.size() ? 1 : 0;
    if (round % 6 == 0) m.check_invariants();
  }
  if (extent == Extent::enclosed) CHECK(enclosing > 5);
}

TEST_CASE("A shell in a box: a lid that goes joins regions, and one that comes parts them") {
  Mesher m(kOptions);
  Follower follower;
  insert_box(m, 1, 0.25, 1.75);
  insert_box(m, 11, 0.75, 1.25);
  m.insert_hole(1, {1, 1, 1});
  m.insert_region(2, {0.5, 0.5, 0.5}, 7);
  follower.follow(m.update());
  require_fresh(m, follower);
  CHECK(m.faults().empty());
  const std::size_t shell = follower.kept.size();
  m.remove_polygon(id(11));  // the inner box opens: hole and region share what is inside
  const Update opened = m.update();
  follower.follow(opened);
  require_fresh(m, follower);
  CHECK(follower.kept.empty());
  REQUIRE(m.faults().size() == 1);
  CHECK(m.faults()[0].seed == mesher::region_id(2));
  m.remove_hole(1);
  follower.follow(m.update());
  require_fresh(m, follower);
  CHECK(follower.kept.size() > shell);
  m.remove_polygon(id(1));  // and the outer one: nothing is enclosed, all is kept
  follower.follow(m.update());
  require_fresh(m, follower);
  CHECK(follower.kept.size() == m.box_mesh().simplices.size());
}

TEST_CASE("Markers of points, segments and polygons are in the domain's mesh, and stay in moves") {
  Mesher m(kOptions);
  insert_box(m, 1, 0.25, 1.75);
  m.insert(id(20), {1, 1, 1}, 5);
  m.insert_segment(id(9), id(1), id(2), 77);
  m.update();
  m.move(id(20), {1, 1.125, 1});
  m.update();
  const auto domain = m.domain_mesh();
  CHECK(domain.mesh.features.faces.size() > 11);
  for (const auto& f : domain.mesh.features.faces) {
    REQUIRE(f.polygon);
    CHECK(f.marker == 9 + static_cast<std::int64_t>(*f.polygon));
  }
  std::size_t on_segment = 0;
  for (const auto& e : domain.mesh.features.edges) on_segment += e.marker == 77 ? 1 : 0;
  CHECK(on_segment > 0);
  const auto& vertices = domain.mesh.vertices;
  const Point<3> place{1, 1.125, 1};
  const auto at = std::lower_bound(vertices.begin(), vertices.end(), place) - vertices.begin();
  CHECK(domain.mesh.features.markers[static_cast<std::size_t>(at)] == 5);
  const Graph<3> plc = m.input();
  CHECK(domain.mesh ==
        domain_mesh(mesh_statically(plc, m.options()), plc, m.options().extent).mesh);
  CHECK(m.contains(PolygonId{1}));
}

// The wall between the halves is far from the edits; neither half is looked at.
TEST_CASE("An edit inside a large region in space does not look at the region") {
  Mesher m(kOptions);
  insert_box(m, 1, 0.125, 1.875);
  SplitMix64 random(4);
  for (std::int64_t i = 100; i < 900; ++i) {
    const auto x = [&] { return 0.2 + 1.6 * random.unit(); };
    m.insert(id(i), {x(), x(), x()});
  }
  m.insert_region(1, {1, 1, 1}, 3);
  m.update();
  REQUIRE(m.box_mesh().simplices.size() > 5000);
  std::uint64_t visited = 0;
  for (std::int64_t i = 100; i < 120; ++i) {
    m.remove(id(i));
    visited += m.update().domain.visited;
  }
  CHECK(visited == 0);
  m.remove_region(1);
  CHECK(m.update().domain.relabelled.size() > 1000);
}

TEST_CASE("What fails leaves mesh, regions and seeds in space, and it works again") {
  Mesher m(kOptions);
  Follower follower;
  insert_box(m, 1, 0.25, 1.75);
  insert_box(m, 11, 0.75, 1.25);
  m.insert_region(2, {0.5, 0.5, 0.5}, 7);
  follower.follow(m.update());
  CHECK_THROWS_AS(m.insert_region(2, {1, 1, 1}, 7), mesher::Error);
  CHECK_THROWS_AS(m.remove_hole(9), mesher::Error);
  m.insert(id(50), {1, 1, 1.75});  // on a polygon
  m.insert_hole(1, {1, 1, 1});
  CHECK_THROWS_AS(m.update(), mesher::Error);
  CHECK_FALSE(m.contains(mesher::hole_id(1)));
  require_fresh(m, follower);
  bool burnt = true;
  int failures = 0;
  for (std::uint64_t count = 1; burnt; count += 1 + count / 8) {
    CAPTURE(count);
    Update update;
    const bool failed = support::fails(count, burnt, [&] {
      m.insert_hole(1, {1, 1, 1});
      m.remove_polygon(id(1));
      update = m.update();
    });
    if (failed) {
      ++failures;
      m.discard_edits();
      m.check_invariants();
      REQUIRE(m.faults().empty());
      continue;
    }
    follower.follow(update);
    if (!burnt) break;
    m.remove_hole(1);  // somebody could do without
    m.insert_polygon({id(1), {{id(1), id(2), id(4), id(3)}}, {}, {}, 10});
    follower.follow(m.update());
  }
  CHECK(failures > 30);
  require_fresh(m, follower);
}
