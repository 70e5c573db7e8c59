// Regions of a triangulation that is changed: what changes of walls and seeds do, what they cost,
// and that what fails leaves all as it was.
#include "domain/regions.hpp"

#include <catch2/catch.hpp>
#include <ctime>
#include <memory>
#include <tuple>

#include "failing_new.hpp"
#include "mesh/canonical.hpp"
#include "walled_grid.hpp"

namespace {

using mesher::Extent;
using mesher::hole_id;
using mesher::region_id;
using mesher::RegionLabel;
using mesher::Seed;
using mesher::SeedId;
using mesher::Zone;
using mesher::detail::Regions;
using mesher::detail::RegionsChange;
using mesher::detail::RegionsDifference;
using support::Edge;
using support::hole;
using support::region;
using support::WalledGrid;

Regions regions_of(const WalledGrid& grid, const std::vector<Edge>& walls,
                   const std::vector<Seed<2>>& seeds = {}) {
  return {grid.triangles(), walls, seeds, [grid](std::uint32_t v) { return grid.place(v); }};
}

RegionsChange walls_out(std::vector<Edge> walls) {
  RegionsChange change;
  change.walls_out = std::move(walls);
  return change;
}
RegionsChange walls_in(std::vector<Edge> walls) {
  RegionsChange change;
  change.walls_in = std::move(walls);
  return change;
}
RegionsChange flip(const WalledGrid& grid, int x, int y) {
  RegionsChange change;
  for (const auto& t : grid.square(x, y)) change.triangles_out.push_back(t);
  for (const auto& t : grid.square(x, y, true)) change.triangles_in.push_back(t);
  return change;
}

std::size_t count(const RegionsDifference& d, const RegionLabel& before, const RegionLabel& after) {
  return static_cast<std::size_t>(
      std::count_if(d.relabelled.begin(), d.relabelled.end(),
                    [&](const auto& t) { return t.before == before && t.after == after; }));
}

constexpr RegionLabel kOutside{Zone::outside, {}}, kInside{Zone::inside, {}};
RegionLabel inside(std::int64_t id) { return {Zone::inside, region_id(id)}; }

}  // namespace

// --- What changes do -------------------------------------------------------------------------

TEST_CASE("the last wall of a ring encloses, and the first to go opens it") {
  const WalledGrid grid(10);
  auto ring = grid.rectangle(2, 2, 6, 6);
  const Edge last = ring[7];
  ring.erase(ring.begin() + 7);
  Regions regions = regions_of(grid, ring);
  CHECK_FALSE(regions.encloses());
  CHECK(regions.keeps(kOutside, Extent::enclosed));
  const RegionsDifference closed = regions.update(walls_in({last}));
  CHECK(closed.encloses);
  CHECK(count(closed, kOutside, kInside) == 32);
  CHECK(closed.relabelled.size() == 32);
  CHECK_FALSE(regions.keeps(kOutside, Extent::enclosed));
  CHECK(regions.keeps(kOutside, Extent::box));
  const RegionsDifference opened = regions.update(walls_out({last}));
  CHECK(count(opened, kInside, kOutside) == 32);
  CHECK(opened.relabelled.size() == 32);
  regions.check_invariants();
}

TEST_CASE("a wall between two regions that goes joins them: the least seed counts") {
  const WalledGrid grid(10);
  auto walls = grid.rectangle(1, 1, 9, 9);
  const auto middle = grid.line(4, 1, 4, 9);
  WalledGrid::append(walls, middle);
  Regions regions = regions_of(grid, walls, {region(5, 2, 2), region(3, 7, 7)});
  CHECK(regions.faults(Extent::enclosed).empty());
  const RegionsDifference joined = regions.update(walls_out({middle[2]}));
  CHECK(joined.relabelled.size() == 2 * 24);
  CHECK(count(joined, inside(5), inside(3)) == 48);
  REQUIRE(regions.faults(Extent::enclosed).size() == 1);
  CHECK(describe(regions.faults(Extent::enclosed)[0]) ==
        "the seed of region 5 at (2, 2) is in one region with region 3, which counts");
  const RegionsDifference parted = regions.update(walls_in({middle[2]}));
  CHECK(count(parted, inside(3), inside(5)) == 48);
  CHECK(regions.faults(Extent::enclosed).empty());
  regions.check_invariants();
}

TEST_CASE("a seed that comes, moves or goes labels its region anew") {
  const WalledGrid grid(10);
  auto walls = grid.rectangle(1, 1, 5, 5);
  WalledGrid::append(walls, grid.rectangle(6, 6, 9, 9));
  Regions regions = regions_of(grid, walls);
  RegionsChange come;
  come.seeds_in = {hole(1, 2, 2)};
  const RegionLabel in_hole{Zone::hole, hole_id(1)};
  CHECK(count(regions.update(come), kInside, in_hole) == 32);
  RegionsChange move;
  move.seeds_out = {hole_id(1)};
  move.seeds_in = {hole(1, 7, 7)};
  const RegionsDifference moved = regions.update(move);
  CHECK(count(moved, in_hole, kInside) == 32);
  CHECK(count(moved, kInside, in_hole) == 18);
  CHECK(moved.relabelled.size() == 50);
  RegionsChange go;
  go.seeds_out = {hole_id(1)};
  CHECK(count(regions.update(go), in_hole, kInside) == 18);
  regions.check_invariants();
}

TEST_CASE("a seed on a vertex loses its region to a wall that comes there, and gets it back") {
  const WalledGrid grid(8);
  Regions regions = regions_of(grid, grid.rectangle(1, 1, 7, 7), {region(2, 4, 4)});
  // Each of the edges around the vertex is far from some triangle that holds the seed.
  for (const auto& wall : {grid.line(4, 4, 5, 4), grid.line(3, 4, 4, 4), grid.line(4, 4, 4, 5)}) {
    CHECK(count(regions.update(walls_in(wall)), inside(2), kInside) == 72);
    REQUIRE(regions.faults(Extent::enclosed).size() == 1);
    CHECK(regions.faults(Extent::enclosed)[0].kind == mesher::SeedFault<2>::Kind::on_segment);
    CHECK(count(regions.update(walls_out(wall)), kInside, inside(2)) == 72);
    regions.check_invariants();
  }
}

TEST_CASE("an edge that goes and comes as a wall in one change stays one") {
  const WalledGrid grid(6);
  const auto ring = grid.rectangle(1, 1, 4, 4);
  Regions regions = regions_of(grid, ring);
  RegionsChange change = flip(grid, 1, 1);
  change.walls_out = {ring[0]};
  change.walls_in = {{ring[0][1], ring[0][0]}};
  const RegionsDifference d = regions.update(change);
  CHECK(d.relabelled.empty());
  CHECK(d.visited == 0);
  CHECK(d.added.size() == 2);
  CHECK(d.added[0].label == kInside);
  CHECK(regions.label(grid.square(1, 1, true)[0]) == kInside);
  regions.check_invariants();
}

TEST_CASE("regions that only come to be where triangles are replaced are found") {
  const WalledGrid grid(6);
  const auto [a, b, c, d] =
      std::tuple(grid.vertex(2, 2), grid.vertex(3, 2), grid.vertex(3, 3), grid.vertex(2, 3));
  Regions regions = regions_of(grid, {});
  RegionsChange change = flip(grid, 2, 2);
  change.walls_in = {{a, b}, {b, d}, {d, a}};
  CHECK(regions.update(change).encloses);
  CHECK(regions.regions().size() == 2);
  RegionsChange back;
  std::swap(back.triangles_in, change.triangles_out);
  std::swap(back.triangles_out, change.triangles_in);
  back.walls_out = {{b, d}, {d, a}};
  CHECK_FALSE(regions.update(back).encloses);
  regions.check_invariants();
  CHECK(regions.label({a, b, c}) == kOutside);
}

// --- What they cost --------------------------------------------------------------------------

namespace {

// A lake of 2 n^2 triangles and more, with a room of 18 in one corner or the other.
struct LakeWithRoom {
  LakeWithRoom(int n, bool first)
      : grid(n + 2), corner(first ? 1 : n - 2), lake(grid.rectangle(1, 1, n + 1, n + 1)) {
    WalledGrid::append(lake,
                       first ? grid.line(4, 1, 4, 4) : grid.line(corner, corner, corner, n + 1));
    WalledGrid::append(lake,
                       first ? grid.line(1, 4, 4, 4) : grid.line(corner, corner, n + 1, corner));
    door = first ? grid.line(4, 2, 4, 3) : grid.line(corner, corner, corner, corner + 1);
  }
  WalledGrid grid;
  int corner;
  std::vector<Edge> lake, door;
};

}  // namespace

TEST_CASE("a change inside a region looks at nothing else, however large the region is") {
  for (const int n : {10, 100}) {
    const WalledGrid grid(n);
    Regions regions = regions_of(grid, grid.rectangle(1, 1, n - 1, n - 1), {region(1, 5.5, 5.5)});
    for (int x = 0; x < n; ++x) {
      const RegionsDifference d = regions.update(flip(grid, x, 5));
      CHECK(d.visited == 0);
      CHECK(d.relabelled.empty());
    }
    CHECK(regions.update(walls_in(grid.line(3, 3, 4, 3))).visited <= 8);  // around its end
    CHECK(regions.update(walls_out(grid.line(3, 3, 4, 3))).visited == 0);
    regions.check_invariants();
  }
}

TEST_CASE("joining and parting cost the smaller region, whichever was there first") {
  for (const bool first : {true, false}) {
    for (const int n : {20, 120}) {
      const LakeWithRoom lake(n, first);
      Regions regions = regions_of(lake.grid, lake.lake, {region(4, 10.25, 10.5)});
      const RegionsDifference joined = regions.update(walls_out(lake.door));
      CHECK(count(joined, kInside, inside(4)) == 18);
      CHECK(joined.visited == 18);
      const RegionsDifference parted = regions.update(walls_in(lake.door));
      CHECK(count(parted, inside(4), kInside) == 18);
      CHECK(parted.visited <= 2 * 18 + 2);
      regions.check_invariants();
    }
  }
}

TEST_CASE("seeds that come to another region together cost no more than when they came first") {
  const WalledGrid grid(6);
  const auto rooms = grid.rectangle(1, 1, 5, 5);
  const auto door = grid.line(2, 1, 2, 5);
  std::vector<Seed<2>> seeds;
  for (int i = 0; i < 40000; ++i) seeds.push_back(region(i, 1.5 + 1e-6 * i, 1.75));
  std::vector<Edge> walls = rooms;
  WalledGrid::append(walls, door);
  const auto seconds = [](auto&& what) {
    const std::clock_t start = std::clock();
    what();
    return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  };
  std::unique_ptr<Regions> regions;
  const double first =
      seconds([&] { regions = std::make_unique<Regions>(regions_of(grid, walls, seeds)); });
  const double then = seconds([&] {
    for (int i = 0; i < 4; ++i) {
      regions->update(walls_out(door));
      regions->update(walls_in(door));
    }
  });
  INFO("first " << first << " s, then " << then << " s");
  CHECK(then < 10 * first + 0.2);
  regions->check_invariants();
}

TEST_CASE("seeds that go together cost no more than when they came, and come back if taken back") {
  const WalledGrid grid(6);
  std::vector<Seed<2>> seeds;  // in one triangle
  RegionsChange all_out;
  for (int i = 0; i < 40000; ++i) {
    seeds.push_back(region(i, 1.5 + 1e-6 * i, 1.75));
    all_out.seeds_out.push_back(seeds.back().id);
  }
  const auto seconds = [](auto&& what) {
    const std::clock_t start = std::clock();
    what();
    return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  };
  std::unique_ptr<Regions> regions;
  const double first = seconds([&] {
    regions = std::make_unique<Regions>(regions_of(grid, grid.rectangle(1, 1, 5, 5), seeds));
  });
  const auto before = regions->faults(Extent::enclosed);
  const double then = seconds([&] { regions->update(all_out); });
  INFO("first " << first << " s, then " << then << " s");
  CHECK(then < 10 * first + 0.2);
  CHECK(regions->faults(Extent::enclosed).empty());
  regions->roll_back();
  regions->check_invariants();
  CHECK(regions->faults(Extent::enclosed) == before);
}

TEST_CASE("a wall that moves through a lake costs what it sweeps, not the lake") {
  const int n = 60;
  const WalledGrid grid(n);
  auto walls = grid.rectangle(1, 1, n - 1, n - 1);
  WalledGrid::append(walls, grid.line(2, 1, 2, n - 1));
  Regions regions = regions_of(grid, walls, {region(1, 1.5, 1.5), region(2, n - 1.5, n - 1.5)});
  const std::size_t swept = 2 * (n - 2);
  for (int x = 2; x < n - 3; ++x) {
    RegionsChange move = walls_out(grid.line(x, 1, x, n - 1));
    move.walls_in = grid.line(x + 1, 1, x + 1, n - 1);
    const RegionsDifference d = regions.update(move);
    CHECK(d.relabelled.size() == swept);
    CHECK(count(d, inside(2), inside(1)) == swept);
    CHECK(d.visited <= 4 * swept);
  }
  regions.check_invariants();
}

TEST_CASE("a wall around which there is a way parts nothing, and costs at most its region") {
  const WalledGrid grid(20);
  auto walls = grid.rectangle(1, 1, 19, 19);
  WalledGrid::append(walls, grid.rectangle(8, 8, 12, 12));  // an island
  Regions regions = regions_of(grid, walls);
  const RegionsDifference d = regions.update(walls_in(grid.line(1, 10, 8, 10)));
  CHECK(d.relabelled.empty());
  CHECK(d.visited <= 2 * (18 * 18 - 16));
  CHECK(regions.regions().size() == 3);
  regions.check_invariants();
}

TEST_CASE("what a large update keeps to be taken back is given back by the next one") {
  const WalledGrid grid(60);
  const auto ring = grid.rectangle(1, 1, 59, 59);
  RegionsChange all_flipped;
  for (int x = 0; x < 60; ++x) {
    for (int y = 0; y < 60; ++y) {
      const RegionsChange one = flip(grid, x, y);
      for (const auto& t : one.triangles_out) all_flipped.triangles_out.push_back(t);
      for (const auto& t : one.triangles_in) all_flipped.triangles_in.push_back(t);
    }
  }
  Regions regions = regions_of(grid, ring);
  regions.update(walls_out({ring[0]}));
  regions.update(walls_in({ring[0]}));
  const std::size_t before = regions.bytes();
  regions.update(all_flipped);
  CHECK(regions.bytes() > 2 * before);
  regions.update({});
  CHECK(regions.bytes() <= before + before / 10);
  regions.check_invariants();
}

// --- What fails ------------------------------------------------------------------------------

namespace {

// All that can be seen.
using View = std::tuple<std::map<support::Corners, std::pair<Zone, std::optional<SeedId>>>,
                        std::vector<std::string>, std::size_t>;

View view(const Regions& regions) {
  View seen;
  regions.for_each([&](const support::Corners& corners, const RegionLabel& label) {
    std::get<0>(seen)[mesher::detail::smallest_first(corners)] = {label.zone, label.seed};
  });
  for (const auto& fault : regions.faults(Extent::enclosed)) {
    std::get<1>(seen).push_back(describe(fault));
  }
  std::get<2>(seen) = regions.regions().size();
  return seen;
}

struct Everything {
  WalledGrid grid{12};
  std::vector<Edge> walls = grid.rectangle(1, 1, 11, 11);
  RegionsChange change;

  Everything() {
    WalledGrid::append(walls, grid.line(5, 1, 5, 11));
    WalledGrid::append(walls, grid.rectangle(7, 7, 9, 9));
    change = flip(grid, 2, 2);
    const auto more = flip(grid, 7, 7);
    change.triangles_out.insert(change.triangles_out.end(), more.triangles_out.begin(),
                                more.triangles_out.end());
    change.triangles_in.insert(change.triangles_in.end(), more.triangles_in.begin(),
                               more.triangles_in.end());
    change.walls_out = grid.line(5, 1, 5, 11);
    change.walls_in = grid.line(6, 1, 6, 11);
    WalledGrid::append(change.walls_in, grid.rectangle(2, 2, 4, 4));
    change.seeds_out = {hole_id(1), region_id(2)};
    change.seeds_in = {hole(1, 8, 8), region(7, 3, 3), region(8, 2, 10)};
  }
  [[nodiscard]] Regions regions() const {
    return regions_of(grid, walls,
                      {hole(1, 2.25, 2.5), region(2, 7.25, 7.5), region(3, 7.5, 7.25)});
  }
};

}  // namespace

TEST_CASE("an update of regions that finds no memory, at any allocation, changes nothing") {
  const Everything all;
  Regions done = all.regions();
  done.update(all.change);
  const View after = view(done);
  for (std::uint64_t k = 1;; ++k) {
    INFO("allocation " << k);
    Regions regions = all.regions();
    const View before = view(regions);
    bool failed = false;
    support::allocation_fuse.left = k;
    try {
      regions.update(all.change);
    } catch (const std::bad_alloc&) {
      failed = true;
    }
    support::allocation_fuse.left = 0;
    if (failed) {
      REQUIRE(view(regions) == before);
      regions.check_invariants();
      regions.update(all.change);
    }
    REQUIRE(view(regions) == after);
    regions.check_invariants();
    if (!failed) {
      CHECK(k > 50);
      break;
    }
  }
}

TEST_CASE("an update of regions can be taken back") {
  const Everything all;
  Regions regions = all.regions();
  const View before = view(regions);
  regions.update(all.change);
  CHECK(view(regions) != before);
  regions.roll_back();
  CHECK(view(regions) == before);
  regions.check_invariants();
  regions.roll_back();
  CHECK(view(regions) == before);
  regions.update(all.change);
  regions.check_invariants();
}

TEST_CASE("a change that does not fit is refused, and changes nothing") {
  const Everything all;
  Regions regions = all.regions();
  const View before = view(regions);
  const auto refused = [&](auto spoil) {
    RegionsChange change = all.change;
    spoil(change);
    CHECK_THROWS(regions.update(change));
    CHECK(view(regions) == before);
    regions.check_invariants();
  };
  const WalledGrid& grid = all.grid;
  refused([&](auto& c) { c.walls_in.push_back({0, 5}); });        // no edge
  refused([&](auto& c) { c.walls_in.push_back(all.walls[0]); });  // a wall already
  refused([&](auto& c) { c.walls_out.push_back({0, 1}); });       // no wall
  refused([&](auto& c) { c.triangles_out.pop_back(); });          // one too many comes
  refused([&](auto& c) { c.triangles_in.pop_back(); });           // a gap
  refused([&](auto& c) { c.triangles_out.push_back(grid.square(2, 2, true)[0]); });
  refused([&](auto& c) { c.seeds_out.push_back(hole_id(2)); });
  refused([&](auto& c) { c.seeds_in.push_back(hole(1, 3, 3)); });
  refused([&](auto& c) { c.seeds_in.push_back(hole(4, 1e300, 3)); });
}
