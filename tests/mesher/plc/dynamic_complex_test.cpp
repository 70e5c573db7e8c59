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

mesher::Options<3> cube_options() {
  mesher::Options<3> options;
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
  explicit Grid(std::uint64_t seed) : random_(seed), parts_(kAcross * kAcross * kAcross) {}

  /// Takes what is in a random cube, or puts something, or one for the other.
  void edit() {
    const std::size_t i = random_.below(parts_.size());
    auto& part = parts_[i];
    if (part) {
      space_.erase(part->second);
      part.reset();
      if (random_.below(2) == 0) return;
    }
    const Complex complex = random_.part({static_cast<double>(i % kAcross),
                                          static_cast<double>(i / kAcross % kAcross),
                                          static_cast<double>(i / kAcross / kAcross)});
    part = {complex, space_.insert(complex)};
  }
  std::uint64_t below(std::uint64_t n) { return random_.below(n); }
  TracedSpace& space() { return space_; }
  Complex all() const {
    Complex all;
    for (const auto& part : parts_) {
      if (part) append(all, part->first);
    }
    return all;
  }

 private:
  support::RandomComplex random_;
  TracedSpace space_{cube_options()};
  std::vector<std::optional<std::pair<Complex, TracedSpace::Part>>> parts_;
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
    space.insert(random.part({static_cast<double>(i % 8), static_cast<double>(i / 8 % 8),
                              static_cast<double>(i / 64)},
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
