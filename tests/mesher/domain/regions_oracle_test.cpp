// After random edits of a mesh, its walls and seeds, the regions and the difference are those found
// from scratch.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "edit_sequence.hpp"
#include "facade/box_mesher.hpp"
#include "mesher/extra/generate.hpp"
#include "walled_mesh.hpp"

namespace {

using mesher::BoxMesher;
using mesher::Options;
using mesher::Point;
using mesher::Seed;
using mesher::SplitMix64;
using support::Places2;
using support::Places3;
using support::WalledMesh;

// Random edits of points, walls and seeds, several of which may be one change.
class RandomEdits {
 public:
  RandomEdits(support::Family family, std::uint64_t seed)
      : random_(seed), options_{.domain = support::domain(family)}, mesher_(options_) {
    points_ = random_sequence(family, options_, 12, 200, seed);
    step_points();
    follow();
  }

  void step() {
    walls_ = mesh_.walls();
    seeds_ = mesh_.seeds();
    bool points = false;
    for (std::uint64_t n = 1 + random_.below(3); n > 0; --n) {
      switch (random_.below(9)) {
        case 0:
        case 1:
        case 2:
          points = true;
          break;
        case 3:
        case 4:
          enclose_disc();
          break;
        case 5:
          open_disc();
          break;
        case 6:
          toggle_edges();
          break;
        case 7:
          edit_seeds();
          break;
        default:
          if (random_.below(6) == 0)
            walls_.clear();
          else
            edit_seeds();
      }
    }
    if (points) step_points();
    follow();
  }

 private:
  void follow() { mesh_.follow(mesher_.mesh(), walls_, seeds_); }

  // A step that the mesher refuses is left out.
  void step_points() {
    if (next_ == points_.steps.size()) return;
    support::PointSet twin = twin_;
    for (const auto& edit : points_.steps[next_++]) perform(edit, mesher_, twin);
    try {
      mesher_.update();
      twin_ = std::move(twin);
    } catch (const mesher::Error& error) {
      if (error.code() != mesher::ErrorCode::too_close) throw;
    }
  }

  Point<2> anywhere() {
    Point<2> p;
    for (int i = 0; i < 2; ++i) {
      const double side = options_.domain.hi[i] - options_.domain.lo[i];
      p[i] = options_.domain.lo[i] + random_.unit() * side;
    }
    return p;
  }
  // Triangles with their middles in some disc.
  std::set<Places3> disc() {
    const Point<2> centre = anywhere();
    const double side = options_.domain.hi[0] - options_.domain.lo[0];
    const double radius = side * std::ldexp(1.0, -static_cast<int>(random_.below(5)));
    std::set<Places3> inside;
    for (const auto& t : mesh_.triangles()) {
      const double x = (t[0][0] + t[1][0] + t[2][0]) / 3 - centre[0];
      const double y = (t[0][1] + t[1][1] + t[2][1]) / 3 - centre[1];
      if (x * x + y * y < radius * radius) inside.insert(t);
    }
    return inside;
  }
  void enclose_disc() {
    std::map<Places2, int> sides;
    for (const auto& t : disc()) {
      for (const auto& e : WalledMesh::edges_of({t})) ++sides[e];
    }
    for (const auto& [edge, count] : sides) {
      if (count == 1) walls_.insert(edge);
    }
  }
  void open_disc() {
    for (const auto& e : WalledMesh::edges_of(disc())) {
      if (random_.below(3) > 0) walls_.erase(e);
    }
  }
  void toggle_edges() {
    const auto edges = WalledMesh::edges_of(mesh_.triangles());
    for (std::uint64_t n = 1 + random_.below(6); n > 0; --n) {
      const auto& edge = *std::next(edges.begin(), static_cast<long>(random_.below(edges.size())));
      if (walls_.erase(edge) == 0) walls_.insert(edge);
    }
  }
  // Somewhere, on a vertex, or in the middle of an edge as well as doubles allow.
  Point<2> seed_place() {
    const auto& triangles = mesh_.triangles();
    const auto& t =
        *std::next(triangles.begin(), static_cast<long>(random_.below(triangles.size())));
    switch (random_.below(4)) {
      case 0:
        return t[0];
      case 1:
        return {(t[0][0] + t[1][0]) / 2, (t[0][1] + t[1][1]) / 2};
      case 2:
        return random_.below(8) == 0 ? Point<2>{1e6, -1e6} : anywhere();
      default:
        return {(t[0][0] + t[1][0] + t[2][0]) / 3, (t[0][1] + t[1][1] + t[2][1]) / 3};
    }
  }
  void edit_seeds() {
    const mesher::SeedId name{
        random_.below(3) == 0 ? mesher::SeedKind::hole : mesher::SeedKind::region,
        static_cast<std::int64_t>(random_.below(8))};
    if (seeds_.erase(name) > 0 && random_.below(2) == 0) return;
    seeds_[name] = Seed<2>{name, seed_place(), random_.unit(), random_.unit()};
  }

  SplitMix64 random_;
  Options<2> options_;
  BoxMesher<2> mesher_;
  support::Sequence points_;
  support::PointSet twin_;
  std::size_t next_ = 0;
  WalledMesh mesh_;
  WalledMesh::Walls walls_;
  WalledMesh::Seeds seeds_;
};

void run(support::Family family, std::uint64_t seed, int steps) {
  INFO("family " << support::name(family) << ", seed " << seed);
  RandomEdits edits(family, seed);
  for (int step = 0; step < steps; ++step) {
    INFO("step " << step);
    edits.step();
  }
}

}  // namespace

TEST_CASE("after random edits of points, walls and seeds the regions are those from scratch") {
  for (const auto family : {support::Family::uniform, support::Family::lattice,
                            support::Family::clustered, support::Family::borders}) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) run(family, seed, 60);
  }
}

TEST_CASE("soak: regions follow long sequences of all families", "[.soak][soak]") {
  for (std::uint64_t seed = 100; seed < 130; ++seed) {
    for (const auto family : support::kFamilies) run(family, seed, 200);
  }
}
