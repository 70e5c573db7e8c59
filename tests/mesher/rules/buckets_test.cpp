// Buckets, clips and colours.
#include "rules/buckets.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "mesher/extra/generate.hpp"
#include "program/world.hpp"
#include "rules/insertion_rule.hpp"
#include "rules/mesh_box.hpp"

namespace {

using mesher::Options;
using mesher::Point;
using mesher::Rule;
using mesher::SplitMix64;
using mesher::detail::Buckets;
using mesher::detail::kLevels;
constexpr double kReads = mesher::detail::kReads<2>;
using mesher::detail::mesh_box;
using mesher::detail::MeshBox;
constexpr auto promise = mesher::detail::promise<2>;

constexpr Rule kRules[] = {Rule::radius_edge, Rule::voronoi_aspect};
constexpr double kBounds[] = {1.05, 1.4142, 2.0, 10.0};

Options<2> options(double rho, Rule rule) {
  return {.domain = {{0, 0}, {1, 1}}, .rho = rho, .rule = rule};
}

}  // namespace

TEST_CASE("buckets grow with length, by one for a factor of rho; clips grow with them") {
  for (const double rho : kBounds) {
    for (const Rule rule : kRules) {
      const MeshBox<2> box = mesh_box(options(rho, rule));
      const Buckets<2> buckets(rho, promise(rule, rho), box);
      int last = 0;
      double last_clip = 0;
      for (double x = box.side * 0x1p-53; x < 2 * rho * box.side; x *= 1.01) {
        const int b = buckets.bucket(x * x);
        CHECK((b == last || b == last + 1));
        if (b > 0) CHECK(std::abs(buckets.bucket(rho * rho * x * x * 1.000001) - b) <= 1);
        CHECK(buckets.clip_radius(b) >= last_clip);
        CHECK(buckets.clip_radius(b) <= 2 * box.side);
        CHECK((buckets.clip_radius(b) >= rho * x * (1 - 1e-9) ||
               buckets.clip_radius(b) == 2 * box.side));
        last = b;
        last_clip = buckets.clip_radius(b);
      }
      CHECK(last == buckets.count() - 1);
      CHECK(buckets.clip_radius(last) == 2 * box.side);
      CHECK(buckets.clip_radius(last + 50) == 2 * box.side);  // [b + 1 behind the last bucket]
      CHECK(buckets.colour({0, 0}, last + 50) == 0);
    }
  }
}

TEST_CASE(
    "squares are as large as independence asks for, at every scale, and no larger [Fig 4.9]") {
  for (const double rho : kBounds) {
    for (const Rule rule : kRules) {
      const MeshBox<2> box = mesh_box(options(rho, rule));
      const auto p = promise(rule, rho);
      const Buckets<2> buckets(rho, p, box);
      const double unit = box.cell_side(kLevels);
      for (int b = 0; b < buckets.count(); ++b) {
        const double apart = (kReads + p.inserts) * buckets.clip_radius(b);
        INFO("rho " << rho << ", bucket " << b);
        CHECK((buckets.independent(b) >= apart || buckets.colour({~0u, ~0u}, b) == 0));
        CHECK(buckets.independent(b) <= apart + 2 * unit);
      }
    }
  }
}

TEST_CASE("vertices of one colour in different squares are independent, at every scale [Fig 4.9]") {
  const MeshBox<2> box = mesh_box(options(1.4142, Rule::radius_edge));
  const auto p = promise(Rule::radius_edge, 1.4142);
  const Buckets<2> buckets(1.4142, p, box);
  SplitMix64 random(3);
  INFO("seed 3");
  int other_squares = 0;
  for (int i = 0; i < 200000; ++i) {
    const int b = buckets.bucket(std::pow(2.0, -88 * random.unit()));
    const double apart = (kReads + p.inserts) * buckets.clip_radius(b);
    const Point<2> u{0.3 + 0.01 * random.unit(), 0.3 + 0.01 * random.unit()};
    const Point<2> v{u[0] + 6 * apart * (random.unit() - 0.5),
                     u[1] + 6 * apart * (random.unit() - 0.5)};
    const auto f = box.fixed(u);
    const auto g = box.fixed(v);
    if (!box.contains(v) || buckets.colour(f, b) != buckets.colour(g, b)) continue;
    // In one square, or a whole square apart along some axis.
    const double distance = std::max(std::abs(u[0] - v[0]), std::abs(u[1] - v[1]));
    const double side = buckets.independent(b) + 2 * box.cell_side(kLevels);
    CHECK((distance <= side || distance >= apart));
    other_squares += distance >= apart;
  }
  CHECK(other_squares > 10000);
}
