// Complexes that come and go: after every update the mesh is that of a run from scratch, bit for
// bit, and nobody ran twice.
#include <catch2/catch.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "random_complex.hpp"
#include "traced_space.hpp"

namespace {

using support::Complex;
using support::PlcRun;
using support::TracedSpace;

constexpr std::size_t kAcross = 3;

mesher::Options<3> cube_options(double rho = 2) {
  mesher::Options<3> options;
  options.rho = rho;
  options.domain = {{0, 0, 0}, {kAcross, kAcross, kAcross}};
  options.max_vertices = 200000;
  return options;
}

void append(Complex& all, const Complex& part) {
  const std::size_t first = all.points.size();
  all.points.insert(all.points.end(), part.points.begin(), part.points.end());
  for (const auto& s : part.segments) all.segments.push_back({s[0] + first, s[1] + first});
  for (Complex::Face f : part.faces) {
    for (auto& loop : f.loops) {
      for (std::size_t& i : loop) i += first;
    }
    for (std::size_t& i : f.on) i += first;
    all.faces.push_back(std::move(f));
  }
}

// A grid of cubes, with a part or nothing in each.
class Grid {
 public:
  explicit Grid(std::uint64_t seed, double rho = 2)
      : random_(seed), space_(cube_options(rho)), parts_(kAcross * kAcross * kAcross) {}

  /// Takes what is in a random cube, or puts something, or one for the other; or takes or puts back
  /// the segments and polygons alone.
  void edit() {
    const std::size_t i = random_.below(parts_.size());
    auto& cube = parts_[i];
    if (cube && random_.below(2) == 0) return turn(*cube);
    if (cube) {
      space_.erase(cube->part);
      cube.reset();
      if (random_.below(2) == 0) return;
    }
    const Complex complex =
        random_.part({static_cast<double>(i % kAcross), static_cast<double>(i / kAcross % kAcross),
                      static_cast<double>(i / kAcross / kAcross)});
    cube = {complex, space_.insert(complex), false};
  }
  std::uint64_t below(std::uint64_t n) { return random_.below(n); }
  TracedSpace& space() { return space_; }
  Complex all() const {
    Complex all;
    for (const auto& cube : parts_) {
      if (cube) append(all, cube->bare ? bare(cube->complex) : cube->complex);
    }
    return all;
  }

 private:
  struct Cube {
    Complex complex;
    TracedSpace::Part part;
    bool bare;  // only points are there
  };

  static Complex bare(const Complex& complex) {
    Complex points;
    points.points = complex.points;
    return points;
  }
  void turn(Cube& cube) {
    if (cube.bare) {
      space_.insert_features(cube.complex, cube.part);
    } else {
      space_.erase_features(cube.part);
    }
    cube.bare = !cube.bare;
  }

  support::RandomComplex random_;
  TracedSpace space_;
  std::vector<std::optional<Cube>> parts_;
};

}  // namespace

TEST_CASE("after each edit of points, segments and polygons the mesh is a fresh run's") {
  for (const std::uint64_t seed : {1, 2, 3, 4}) {
    Grid grid(seed);
    for (int update = 0; update < 8; ++update) {
      INFO("seed " << seed << ", update " << update);
      for (std::uint64_t n = update == 0 ? 12 : 1 + grid.below(3); n > 0; --n) grid.edit();
      grid.space().update();
      PlcRun fresh(grid.all(), cube_options());
      REQUIRE(grid.space().result() == fresh.result());
      if (update % 4 == 3) grid.space().check_invariants();
    }
    const sac::AuditReport& report = grid.space().engine().audit();
    CHECK(report.first_duplicate == "");
    CHECK(report.first_reordered == "");
  }
}

TEST_CASE("so it is below rho = 2, where the guard looks farther than cells [rules C]") {
  for (const double rho : {1.3, 1.42}) {
    for (const std::uint64_t seed : {1, 2}) {
      Grid grid(seed, rho);
      for (int update = 0; update < 8; ++update) {
        INFO("rho " << rho << ", seed " << seed << ", update " << update);
        for (std::uint64_t n = update == 0 ? 4 : 1 + grid.below(2); n > 0; --n) grid.edit();
        grid.space().update();
        PlcRun fresh(grid.all(), cube_options(rho));
        REQUIRE(grid.space().result() == fresh.result());
        if (update % 4 == 3) grid.space().check_invariants();
      }
      CHECK(grid.space().engine().audit().first_duplicate == "");
    }
  }
}

// A tetrahedron of which 555 edges are isolated, and short segments 5 to 15 lengths from these: the
// calls that look at the edges' cells do not look so far.
TEST_CASE("what comes far from a isolated edge, where no cell looks, ends its loneliness") {
  mesher::Options<3> options;
  options.rho = 1.42;
  options.domain = {{0, 0, 0}, {1, 1, 1}};
  const Complex alone = support::RandomComplex(1506).part({0, 0, 0}, 6);
  TracedSpace space(options, false);
  space.insert(alone);
  space.update();
  const auto before = space.result();
  for (const mesher::Point<3>& p : {mesher::Point<3>{0.5602, 0.6658, 0.5968},
                                    {0.7808, 0.4947, 0.6489},
                                    {0.6976, 0.773, 0.6237},
                                    {0.847, 0.5338, 0.6177}}) {
    INFO(p[0] << ' ' << p[1] << ' ' << p[2]);
    Complex near;
    near.segment(p, {p[0] + 1e-5, p[1] + 2e-5, p[2] + 1e-5});
    Complex all = alone;
    append(all, near);
    const auto part = space.insert(near);
    space.update();
    REQUIRE(space.result() == PlcRun(all, options).result());
    space.erase(part);
    space.update();
    REQUIRE(space.result() == before);
  }
}

// Most features bring vertices where they are crowded, which tells those around them. A polygon
// above whose middle there is a point, far from its edges, does not.
TEST_CASE("features between points that stay reach the vertices whose cells they meet") {
  for (int kind = 2; kind < support::RandomComplex::kKinds; ++kind) {
    INFO("kind " << kind);
    support::RandomComplex random(static_cast<std::uint64_t>(kind));
    const Complex complex = random.part({1, 1, 1}, kind);
    Complex points;
    points.points = complex.points;
    TracedSpace space(cube_options());
    auto part = space.insert(points);
    space.update();
    const auto bare = space.result();
    space.insert_features(complex, part);
    space.update();
    REQUIRE(space.result() == PlcRun(complex, cube_options()).result());
    space.erase_features(part);
    space.update();
    REQUIRE(space.result() == bare);
  }
}

TEST_CASE("all that comes and goes again leaves the mesh as it was") {
  Grid grid(11);
  for (int n = 0; n < 8; ++n) grid.edit();
  grid.space().update();
  const auto before = grid.space().result();
  const std::size_t records = grid.space().world().vertices.pool().size();
  support::RandomComplex random(5);
  for (int kind = 0; kind < support::RandomComplex::kKinds; ++kind) {
    INFO("kind " << kind);
    Complex part = random.part({0, 0, 0}, kind);
    for (auto& p : part.points) {
      for (double& x : p) x = (x + 0.01) * kAcross * 0x1p-6;  // in a corner, beside all others
    }
    const auto there = grid.space().insert(part);
    grid.space().update();
    grid.space().erase(there);
    grid.space().update();
    REQUIRE(grid.space().result() == before);
    REQUIRE(grid.space().world().vertices.pool().size() == records);
  }
}

TEST_CASE("who is far from a feature that comes or goes does not run again") {
  mesher::Options<3> options;
  options.domain = {{0, 0, 0}, {8, 8, 8}};
  TracedSpace space(options, false);
  support::RandomComplex random(3);
  for (std::size_t i = 0; i < 512; ++i) {
    space.insert(random.part(
        {static_cast<double>(i % 8), static_cast<double>(i / 8 % 8), static_cast<double>(i / 64)},
        1));
  }
  space.update();
  Complex small;
  small.face({{4, 4, 4}, {4.02, 4, 4}, {4, 4.02, 4.01}});
  const std::size_t vertices = space.world().vertices.pool().size();
  const auto part = space.insert(small);
  const auto came = space.update();
  CHECK(came.executed < vertices / 3);
  space.erase(part);
  CHECK(space.update().executed < vertices / 3);
}

TEST_CASE("an update that fails in the middle leaves the last state, in space with polygons") {
  mesher::Options<3> options = cube_options();
  options.max_vertices = 700;
  TracedSpace space(options);
  support::RandomComplex random(9);
  space.insert(random.part({0, 0, 0}, 4));
  space.update();
  const auto before = space.result();
  support::RandomComplex other(1);
  for (std::size_t i = 1; i < 9; ++i) {
    space.insert(other.part({static_cast<double>(i % 3), static_cast<double>(i / 3), 1}, 6));
  }
  CHECK_THROWS(space.update());
  CHECK(space.result() == before);
  space.check_invariants();
}
