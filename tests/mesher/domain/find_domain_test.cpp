// Regions of a mesh at one time, and the part of it that is kept.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <map>
#include <queue>

#include "facade/box_mesher.hpp"
#include "feature_ids.hpp"
#include "mesher/check.hpp"
#include "mesher/domain.hpp"
#include "mesher/extra/generate.hpp"
#include "mesher/predicates.hpp"
#include "scratch_file.hpp"
#include "walled_grid.hpp"

namespace {

using mesher::Domain;
using mesher::Extent;
using mesher::LineId;
using mesher::Mesh;
using mesher::MeshData;
using mesher::MeshEdge;
using mesher::PointId;
using mesher::Region;
using mesher::Seed;
using mesher::SeedFault;
using mesher::SidedEdge;
using mesher::SplitMix64;
using mesher::Zone;
using support::hole;
using support::region;
using support::WalledGrid;

Domain<2> domain_of(const WalledGrid& grid, const std::vector<support::Edge>& walls,
                    const std::vector<Seed<2>>& seeds = {}, Extent extent = Extent::enclosed) {
  return find_domain(grid.mesh(), WalledGrid::as_walls(walls), seeds, extent);
}

std::size_t kept(const Domain<2>& domain) {
  std::size_t count = 0;
  for (std::uint32_t t = 0; t < domain.region_of.size(); ++t) count += domain.keeps(t);
  return count;
}

std::vector<std::string> words(const Domain<2>& domain) {
  std::vector<std::string> all;
  for (const SeedFault<2>& fault : domain.faults) all.push_back(describe(fault));
  return all;
}

using Words = std::vector<std::string>;

}  // namespace

TEST_CASE("a closed ring of walls encloses what is inside; loose walls change nothing") {
  const WalledGrid grid(8);
  auto walls = grid.rectangle(2, 2, 5, 4);
  const Domain<2> domain = domain_of(grid, walls);
  CHECK(domain.regions.size() == 2);
  CHECK(kept(domain) == 2 * 6);
  WalledGrid::append(walls, grid.line(3, 3, 4, 3));  // inside
  WalledGrid::append(walls, grid.line(5, 4, 7, 4));  // outside, from a corner of the ring
  CHECK(domain_of(grid, walls).region_of == domain.region_of);
}

TEST_CASE("an input that encloses nothing keeps all, and so does the box") {
  const WalledGrid grid(6);
  auto ring = grid.rectangle(2, 2, 4, 4);
  CHECK(kept(domain_of(grid, {})) == 72);
  CHECK(kept(domain_of(grid, ring, {}, Extent::box)) == 72);
  CHECK(kept(domain_of(grid, ring, {hole(1, 3, 3)}, Extent::box)) == 72);
  ring.pop_back();  // a gap
  CHECK(kept(domain_of(grid, ring)) == 72);
}

TEST_CASE("walls on the boundary of the triangulation enclose all of it") {
  const WalledGrid grid(3);
  const Domain<2> domain = domain_of(grid, grid.rectangle(0, 0, 3, 3));
  REQUIRE(domain.regions.size() == 1);
  CHECK(domain.regions[0].label.zone == Zone::inside);
}

TEST_CASE("a hole takes its region and nothing else; what is in a ring inside it stays") {
  const WalledGrid grid(12);
  auto walls = grid.rectangle(1, 1, 11, 11);
  WalledGrid::append(walls, grid.rectangle(3, 3, 9, 9));
  WalledGrid::append(walls, grid.rectangle(5, 5, 7, 7));
  const Domain<2> domain = domain_of(grid, walls, {hole(4, 3.5, 3.25)});
  CHECK(domain.faults.empty());
  CHECK(kept(domain) == 2 * (100 - 36) + 2 * 4);
  const Domain<2> all_gone =
      domain_of(grid, walls, {hole(1, 1.5, 1.25), hole(2, 3.5, 3.25), hole(3, 6, 6)});
  CHECK(all_gone.faults.empty());
  CHECK(kept(all_gone) == 0);
}

TEST_CASE("a region has the attribute and the limit of its seed, its triangles in one number") {
  const WalledGrid grid(8);
  auto walls = grid.rectangle(1, 1, 7, 7);
  WalledGrid::append(walls, grid.line(4, 1, 4, 7));
  Seed<2> right = region(9, 5.5, 5.25, -2.5);
  right.max_measure = 0.125;
  const Domain<2> domain = domain_of(grid, walls, {right});
  REQUIRE(domain.regions.size() == 3);
  CHECK(domain.faults.empty());
  const Region& left = domain.regions[1];  // outside has the smallest triangle, left comes next
  CHECK(left.label == mesher::RegionLabel{Zone::inside, {}});
  CHECK(left.triangles == 36);
  CHECK(domain.regions[2] ==
        Region{{Zone::inside, mesher::region_id(9)}, domain.regions[2].smallest, 36, -2.5, 0.125});
  for (std::uint32_t r = 0; r < 3; ++r) {
    const auto first = std::find(domain.region_of.begin(), domain.region_of.end(), r);
    CHECK(domain.regions[r].smallest == first - domain.region_of.begin());
  }
}

TEST_CASE("a seed on an edge or a vertex is in the region around it, and on a wall in none") {
  const WalledGrid grid(8);
  auto walls = grid.rectangle(2, 2, 6, 6);
  WalledGrid::append(walls, grid.line(4, 4, 5, 4));
  const auto label_at = [&](double x, double y) {
    const Domain<2> domain = domain_of(grid, walls, {region(1, x, y, 7)});
    return std::pair(domain.regions[1].attribute, words(domain));
  };
  CHECK(label_at(3.5, 3.5) == std::pair(7.0, Words{}));  // on a diagonal
  CHECK(label_at(3, 3.5) == std::pair(7.0, Words{}));    // on a side
  CHECK(label_at(3, 3) == std::pair(7.0, Words{}));      // on a vertex
  CHECK(label_at(4.5, 4) ==
        std::pair(0.0, Words{"the seed of region 1 at (4.5, 4) is on segment 1"}));
  CHECK(label_at(4, 4) == std::pair(0.0, Words{"the seed of region 1 at (4, 4) is on segment 1"}));
  CHECK(label_at(2, 2) == std::pair(0.0, Words{"the seed of region 1 at (2, 2) is on segment 1"}));
}

TEST_CASE("seeds that have no region of their own are named, and change nothing") {
  const WalledGrid grid(8);
  const auto walls = grid.rectangle(2, 2, 6, 6);
  const Domain<2> domain = domain_of(grid, walls,
                                     {hole(1, 0.5, 0.25), hole(2, 20, 20), region(3, 1, 1),
                                      region(8, 3, 3, 8), region(5, 4, 4, 5)});
  CHECK(words(domain) ==
        Words{"the seed of hole 1 at (0.5, 0.25) is outside of what the segments enclose",
              "the seed of hole 2 at (20, 20) is outside of what the segments enclose",
              "the seed of region 3 at (1, 1) is outside of what the segments enclose",
              "the seed of region 8 at (3, 3) is in one region with region 5, which counts"});
  CHECK(domain.regions[1].attribute == 5);
  CHECK(kept(domain) == 32);
  const Domain<2> holed = domain_of(grid, walls, {region(1, 3, 3), hole(7, 4, 4), hole(9, 5, 5)});
  CHECK(words(holed) ==
        Words{"the seed of hole 9 at (5, 5) is in one region with hole 7, which counts",
              "the seed of region 1 at (3, 3) is in one region with hole 7, which counts"});
  CHECK(kept(holed) == 0);
  const mesher::Error error = error_of(holed.faults[0]);
  CHECK(error.code() == mesher::ErrorCode::bad_seed);
  CHECK(support::ids_of(error) == support::ids({9, 7}));
}

TEST_CASE("where all is kept a region seed may be anywhere in it") {
  const WalledGrid grid(4);
  const Domain<2> domain = domain_of(grid, {}, {region(1, 1, 1, 3)});
  CHECK(domain.faults.empty());
  CHECK(domain.regions[0].attribute == 3);
}

TEST_CASE("a wall that is no edge of the mesh is refused") {
  const WalledGrid grid(4);
  CHECK_THROWS_AS(domain_of(grid, {{0, 12}}), mesher::Error);
  CHECK_THROWS_AS(domain_of(grid, {{24, 25}}), mesher::Error);
}

TEST_CASE("an empty mesh has no regions") {
  const Domain<2> domain = find_domain<2>({}, {}, {hole(1, 0, 0)}, Extent::enclosed);
  CHECK(domain.regions.empty());
  CHECK(words(domain) ==
        Words{"the seed of hole 1 at (0, 0) is outside of what the segments enclose"});
  CHECK(extract({}, domain).mesh.simplices.empty());
}

TEST_CASE("seeds that are none are refused by name") {
  const WalledGrid grid(4);
  const auto refused = [&](const std::vector<Seed<2>>& seeds) {
    const mesher::Error error = support::error_of([&] { domain_of(grid, {}, seeds); });
    CHECK(support::ids_of(error) == support::ids({6}));
    return error.code();
  };
  using mesher::ErrorCode;
  const double inf = std::numeric_limits<double>::infinity();
  CHECK(refused({hole(6, std::nan(""), 1)}) == ErrorCode::not_finite);
  CHECK(refused({hole(6, 1, inf)}) == ErrorCode::not_finite);
  CHECK(refused({hole(6, 1e300, 1)}) == ErrorCode::magnitude);
  CHECK(refused({region(6, 1, 1, inf)}) == ErrorCode::not_finite);
  CHECK(refused({region(6, 1, 1), hole(6, 2, 2), region(6, 3, 3)}) == ErrorCode::repeated_id);
  Seed<2> empty = region(6, 1, 1);
  empty.max_measure = 0;
  CHECK(refused({empty}) == ErrorCode::bad_number);
}

namespace {

// A grid with a wall between two squares here and there, and a flood over squares as its twin.
struct RandomRooms {
  explicit RandomRooms(std::uint64_t seed) {
    SplitMix64 random(seed);
    const auto wall = [&] { return random.below(100) < 40 + seed % 40; };
    for (int x = 0; x < grid.size(); ++x) {
      for (int y = 0; y < grid.size(); ++y) {
        if (wall()) walls.push_back(grid.line(x, y, x + 1, y)[0]);
        if (wall()) walls.push_back(grid.line(x, y, x, y + 1)[0]);
      }
    }
    std::sort(walls.begin(), walls.end());
    fill();
  }

  [[nodiscard]] bool has(const support::Edge& e) const {
    return std::binary_search(walls.begin(), walls.end(), e);
  }
  void fill() {
    for (int x = 0; x < grid.size(); ++x) {
      for (int y = 0; y < grid.size(); ++y) {
        if (!room.contains({x, y})) fill_from(x, y, rooms++);
      }
    }
  }
  void fill_from(int x0, int y0, int number) {
    std::queue<std::pair<int, int>> reached;
    const auto take = [&](int x, int y, const support::Edge& between) {
      if (has(between)) return;
      if (x < 0 || y < 0 || x == grid.size() || y == grid.size()) {
        open.insert(number);
      } else if (room.emplace(std::pair(x, y), number).second) {
        reached.emplace(x, y);
      }
    };
    room[{x0, y0}] = number;
    reached.emplace(x0, y0);
    for (; !reached.empty(); reached.pop()) {
      const auto [x, y] = reached.front();
      take(x - 1, y, grid.line(x, y, x, y + 1)[0]);
      take(x + 1, y, grid.line(x + 1, y, x + 1, y + 1)[0]);
      take(x, y - 1, grid.line(x, y, x + 1, y)[0]);
      take(x, y + 1, grid.line(x, y + 1, x + 1, y + 1)[0]);
    }
  }

  WalledGrid grid{12};
  std::vector<support::Edge> walls;
  std::map<std::pair<int, int>, int> room;
  std::set<int> open;
  int rooms = 0;
};

}  // namespace

TEST_CASE("regions are those of a flood over squares, for random walls between them") {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    INFO("seed " << seed);
    const RandomRooms rooms(seed);
    const Mesh<2> mesh = rooms.grid.mesh();
    const Domain<2> domain =
        find_domain(mesh, WalledGrid::as_walls(rooms.walls), {}, Extent::enclosed);
    CHECK(domain.regions.size() == static_cast<std::size_t>(rooms.rooms));
    CHECK(domain.keeps_all == (rooms.open.size() == static_cast<std::size_t>(rooms.rooms)));
    std::map<int, std::uint32_t> names;
    for (std::uint32_t t = 0; t < mesh.simplices.size(); ++t) {
      double x = 0, y = 0;
      for (const auto v : mesh.simplices[t]) {
        x += mesh.vertices[v][0] / 3;
        y += mesh.vertices[v][1] / 3;
      }
      const int room = rooms.room.at({static_cast<int>(x), static_cast<int>(y)});
      REQUIRE(names.emplace(room, domain.region_of[t]).first->second == domain.region_of[t]);
      REQUIRE((domain.regions[domain.region_of[t]].label.zone == Zone::outside) ==
              rooms.open.contains(room));
    }
  }
}

// --- Extraction ------------------------------------------------------------------------------

namespace {

// The mesh of random points, with the border of a disc's triangles as walls.
MeshData<2> disc_in_box() {
  mesher::BoxMesher<2> m(mesher::Options<2>{.domain = {{0, 0}, {1, 1}}});
  const auto points = mesher::generate_points<2>(mesher::PointKind::uniform, 120, 3);
  for (std::size_t i = 0; i < points.size(); ++i) {
    m.insert(PointId{static_cast<std::int64_t>(i)}, points[i]);
  }
  m.update();
  MeshData<2> whole(m.mesh());
  const auto inside = [&](std::uint32_t t) {
    double x = 0, y = 0;
    for (const auto v : whole.simplices[t]) {
      x += whole.vertices[v][0] / 3 - 1.0 / 6;
      y += whole.vertices[v][1] / 3 - 1.0 / 6;
    }
    return x * x + y * y < 0.16 && x * x + y * y > 0.01;
  };
  const auto next = neighbours(whole);
  for (std::uint32_t t = 0; t < next.size(); ++t) {
    for (int i = 0; i < 3; ++i) {
      if (!inside(t) || (next[t][i] != mesher::kNoTriangle && inside(next[t][i]))) continue;
      const auto [low, high] =
          std::minmax(whole.simplices[t][(i + 1) % 3], whole.simplices[t][(i + 2) % 3]);
      whole.features.edges.push_back({low, high, LineId{77}, low % 2 == 0 ? 5 : 0});
    }
  }
  std::sort(whole.features.edges.begin(), whole.features.edges.end(),
            [](const auto& a, const auto& b) {
              return std::pair(a.low, a.high) < std::pair(b.low, b.high);
            });
  return whole;
}

double twice_area(const Mesh<2>& mesh) {
  double sum = 0;
  for (const auto& t : mesh.simplices) {
    const auto &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
    sum += (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  }
  return sum;
}

}  // namespace

TEST_CASE("what is kept is a canonical mesh with the edges, markers and neighbours that it needs") {
  const MeshData<2> whole = disc_in_box();
  const auto seeds = std::vector{hole(1, 0.5, 0.5), region(2, 0.5, 0.8, 4.5)};
  const Domain<2> domain = find_domain(whole, whole.features.edges, seeds, Extent::enclosed);
  REQUIRE(domain.faults.empty());
  const mesher::Extract<2> part = extract(whole, domain);
  const MeshData<2>& mesh = part.mesh;

  CHECK(std::is_sorted(mesh.vertices.begin(), mesh.vertices.end()));
  CHECK(std::is_sorted(mesh.simplices.begin(), mesh.simplices.end()));
  std::set<std::uint32_t> used;
  for (const auto& t : mesh.simplices) {
    CHECK(t[0] == *std::min_element(t.begin(), t.end()));
    used.insert(t.begin(), t.end());
  }
  CHECK(used.size() == mesh.vertices.size());
  std::size_t wanted = 0;
  for (std::uint32_t t = 0; t < whole.simplices.size(); ++t) wanted += domain.keeps(t);
  CHECK(mesh.simplices.size() == wanted);
  CHECK(part.triangles.size() == wanted);
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    CHECK(mesh.vertices[v] == whole.vertices[part.vertices[v]]);
    CHECK(mesh.kinds[v] == whole.kinds[part.vertices[v]]);
  }
  CHECK(part.neighbours == neighbours(mesh));
  CHECK(mesh.features.regions == std::vector<double>(wanted, 4.5));

  // Its boundary is the walls, each with a marker.
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;
  for (const auto& t : mesh.simplices) {
    for (int i = 0; i < 3; ++i) ++sides[std::minmax(t[i], t[(i + 1) % 3])];
  }
  std::size_t boundary = 0;
  for (const auto& [ends, count] : sides) boundary += count == 1;
  CHECK(mesh.features.edges.size() == boundary);
  CHECK(boundary == whole.features.edges.size());
  for (const MeshEdge& e : mesh.features.edges) {
    CHECK(sides.at({e.low, e.high}) == 1);
    CHECK(e.line == LineId{77});
    CHECK(e.marker == (part.vertices[e.low] % 2 == 0 ? 5 : mesher::kBoundaryMarker));
  }
  std::vector<std::int64_t> least(whole.vertices.size(), 1000);
  for (const MeshEdge& e : whole.features.edges) {
    for (const auto v : {e.low, e.high}) {
      if (e.marker != 0) least[v] = std::min(least[v], e.marker);
      if (e.marker == 0 && least[v] == 1000) least[v] = 999;  // on the boundary, at least
    }
  }
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const std::int64_t l = least[part.vertices[v]];
    CHECK(mesh.features.markers[v] == (l == 1000 ? 0 : l == 999 ? mesher::kBoundaryMarker : l));
  }
}

TEST_CASE("all that is kept of a box is the box, with its boundary marked") {
  const MeshData<2> whole = disc_in_box();
  const Domain<2> domain = find_domain(whole, whole.features.edges, {}, Extent::box);
  const MeshData<2> all = extract(whole, domain).mesh;
  CHECK(static_cast<const Mesh<2>&>(all) == static_cast<const Mesh<2>&>(whole));
  std::size_t marked = 0;
  for (const MeshEdge& e : all.features.edges)
    marked += !e.line && e.marker == mesher::kBoundaryMarker;
  std::size_t hull = 0;
  for (const auto& three : domain.neighbours)
    hull += std::count(three.begin(), three.end(), mesher::kNoTriangle);
  CHECK(marked == hull);
  CHECK(all.features.edges.size() == hull + whole.features.edges.size());
}

TEST_CASE("an edge's sides are the regions left and right of it") {
  const MeshData<2> whole = disc_in_box();
  for (const Extent extent : {Extent::enclosed, Extent::box}) {
    const Domain<2> domain = find_domain(whole, whole.features.edges, {}, extent);
    const auto edges = sided_edges(whole, whole.features.edges, domain);
    CHECK(edges.size() >= whole.features.edges.size());
    std::map<std::pair<std::uint32_t, std::uint32_t>, SidedEdge> by_ends;
    for (const SidedEdge& e : edges) by_ends[{e.low, e.high}] = e;
    for (std::uint32_t t = 0; t < whole.simplices.size(); ++t) {
      const std::uint32_t side = domain.keeps(t) ? domain.region_of[t] : mesher::kNoRegion;
      for (int i = 0; i < 3; ++i) {
        const std::uint32_t from = whole.simplices[t][i], to = whole.simplices[t][(i + 1) % 3];
        const auto it = by_ends.find(std::minmax(from, to));
        if (it == by_ends.end()) continue;
        CHECK((from < to ? it->second.left : it->second.right) == side);
      }
    }
  }
  // Around: the sum over the boundary of the kept part, each edge with the inside on its left.
  const Domain<2> domain = find_domain(whole, whole.features.edges, {}, Extent::enclosed);
  double around = 0;
  for (const SidedEdge& e : sided_edges(whole, whole.features.edges, domain)) {
    if ((e.left == mesher::kNoRegion) == (e.right == mesher::kNoRegion)) continue;
    const auto &a = whole.vertices[e.low], &b = whole.vertices[e.high];
    around += (e.left != mesher::kNoRegion ? 1 : -1) * (a[0] * b[1] - a[1] * b[0]);
  }
  CHECK(around == Approx(twice_area(extract(whole, domain).mesh)));
}
