// Where simplices, or edges, of a cell are equal: which of them a rule goes by is a function of the
// cell, however it came about.
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <memory>
#include <optional>
#include <tuple>

#include "cell_scene.hpp"
#include "mesher/extra/generate.hpp"
#include "rules/insertion_rule.hpp"
#include "rules/mesh_box.hpp"

namespace {

using mesher::Options;
using mesher::Point;
using mesher::Rule;
using mesher::SplitMix64;
using mesher::detail::CellOf;
using mesher::detail::EdgeFilter;
using mesher::detail::insertion_rule;
using mesher::detail::InsertionRule;
using mesher::detail::LimitsOf;

// v and some of the points of a small grid around it, or of a body-centred one.
template <int D>
CellScene<D> grid(SplitMix64& random, double radius) {
  CellScene<D> scene;
  scene.radius = radius;
  const double unit = radius / 16;
  const bool is_centred = random.below(2) == 0;
  scene.add(Point<D>{});
  for (std::size_t n = 4 + random.below(12); n > 0; --n) {
    const double half = is_centred && random.below(2) == 0 ? 0.5 : 0;
    Point<D> p;
    for (double& x : p) x = unit * (static_cast<double>(random.below(5)) - 2 + half);
    scene.add(p);
  }
  return scene;
}

template <int D>
auto said(Rule rule, const CellOf<D>& cell, const typename InsertionRule<D>::NewPoint& x) {
  const auto name = [&](int i) {
    if (rule != Rule::radius_edge) return 0u;  // it names no edge
    return i == EdgeFilter<D>::kCentre ? cell.center().self : cell.handle(i);
  };
  const auto lattice =
      x.on_lattice
          ? std::optional(std::tuple(x.on_lattice->p, x.on_lattice->clear2, x.on_lattice->reach2))
          : std::nullopt;
  return std::tuple(x.p, x.nearest2, x.farther, name(x.from), name(x.to), x.large, x.corner,
                    lattice);
}

template <int D>
void require_functions_of_cells(std::uint64_t seed, int scenes) {
  SplitMix64 random(seed);
  INFO("seed " << seed);
  Options<D> o;
  for (int i = 0; i < D; ++i) o.domain.lo[i] = -1, o.domain.hi[i] = 1;
  int asked = 0, on_lattice = 0;
  for (int k = 0; k < scenes; ++k) {
    o.rule = k % 4 == 0 ? Rule::voronoi_aspect : Rule::radius_edge;
    o.rho = 1.1 + random.unit();
    o.max_measure = 0;
    if (k % 4 == 1) o.max_measure = std::ldexp(1.0, -D * static_cast<int>(random.below(12)));
    const auto box = mesher::detail::mesh_box(o);
    const LimitsOf<D> limits(o, box);
    const auto rule = insertion_rule<D>(o, box, limits);
    const int b = rule->buckets().count() / 2 - static_cast<int>(random.below(8));
    auto scene = grid<D>(random, rule->buckets().clip_radius(b));
    CellOf<D> cell;
    scene.cut_by_all(cell);
    const auto first = rule->next_point(cell, b, nullptr);
    const auto later = rule->next_bucket(cell, b, nullptr);
    if (first) ++asked, on_lattice += first->on_lattice.has_value();
    for (int again = 0; again < 4; ++again) {
      scene.shuffle(random);
      CellOf<D> other;
      scene.cut_by_all(other);
      const auto point = rule->next_point(other, b, nullptr);
      INFO("scene " << k);
      REQUIRE(point.has_value() == first.has_value());
      if (point) REQUIRE(said<D>(o.rule, other, *point) == said<D>(o.rule, cell, *first));
      REQUIRE(rule->next_bucket(other, b, nullptr) == later);
    }
  }
  CHECK(asked > scenes / 2);
  if (D == 3) CHECK(on_lattice > scenes / 20);
}

}  // namespace

TEST_CASE("what a rule asks for is a function of the cell, in the plane") {
  require_functions_of_cells<2>(71, 6000);
}

TEST_CASE("what a rule asks for is a function of the cell, in space") {
  require_functions_of_cells<3>(72, 6000);
}
