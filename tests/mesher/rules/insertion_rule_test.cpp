// Buckets, colours, and where the two rules put new points.
#include "rules/insertion_rule.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "mesher/check.hpp"
#include "mesher/generate.hpp"
#include "program/world.hpp"

namespace {

using mesher::Options;
using mesher::Point;
using mesher::Rule;
using mesher::SplitMix64;
using mesher::detail::InsertionRule;
using mesher::detail::MeshBox;
using mesher::detail::VertexHandle;

Options<2> options(double rho, Rule rule) {
  return {.domain = {{0, 0}, {1, 1}}, .rho = rho, .rule = rule};
}

struct Search : mesher::detail::VertexSearch {
  using VertexSearch::cut_around;
  using VertexSearch::VertexSearch;
};

double distance(const Point<2>& a, const Point<2>& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1]);
}

}  // namespace

TEST_CASE("buckets grow with length, by one for a factor of rho; clips grow with them") {
  for (const double rho : {1.05, 1.4142, 2.0, 10.0}) {
    for (const Rule rule : {Rule::radius_edge, Rule::voronoi_aspect}) {
      const auto o = options(rho, rule);
      const MeshBox<2> box = mesher::detail::mesh_box(o);
      const InsertionRule r(o, box);
      int last = 0;
      double last_clip = 0;
      for (double x = box.side * 0x1p-53; x < 2 * rho * box.side; x *= 1.01) {
        const int b = r.bucket(x * x);
        CHECK((b == last || b == last + 1));
        if (b > 0) CHECK(std::abs(r.bucket(rho * rho * x * x * 1.000001) - b) <= 1);
        CHECK(r.clip_radius(b) >= last_clip);
        CHECK(r.clip_radius(b) <= 2 * box.side);
        CHECK((r.clip_radius(b) >= rho * x * (1 - 1e-9) || r.clip_radius(b) == 2 * box.side));
        last = b;
        last_clip = r.clip_radius(b);
      }
      CHECK(last == r.buckets() - 1);
      CHECK(r.clip_radius(last) == 2 * box.side);
      CHECK(r.clip_radius(last + 50) == 2 * box.side);  // [b + 1 behind the last bucket]
      CHECK(r.colour({0, 0}, last + 50) == 0);
    }
  }
}

TEST_CASE(
    "vertices of one colour in different squares are farther apart than three clips [Fig 4.9]") {
  const auto o = options(1.4142, Rule::radius_edge);
  const MeshBox<2> box = mesher::detail::mesh_box(o);
  const InsertionRule r(o, box);
  SplitMix64 random(3);
  INFO("seed 3");
  for (int i = 0; i < 200000; ++i) {
    const int b = r.bucket(std::pow(2.0, -20 * random.unit()));
    const double clip = r.clip_radius(b);
    const Point<2> p{random.unit(), random.unit()};
    const Point<2> q{p[0] + 6 * clip * (random.unit() - 0.5),
                     p[1] + 6 * clip * (random.unit() - 0.5)};
    const auto f = box.fixed(p);
    const auto g = box.fixed(q);
    if (r.colour(f, b) != r.colour(g, b) || distance(p, q) >= 3.3 * clip) continue;
    int level = 0;  // of the squares: as large as they can be
    while (level < 30 && box.cell_side(level + 1) >= 3.3 * clip) ++level;
    CHECK(MeshBox<2>::cell(f, level) == MeshBox<2>::cell(g, level));
  }
}

TEST_CASE("a new point's nearest vertex is rho lengths away, and what the rule says it is") {
  SplitMix64 random(17);
  INFO("seed 17");
  int found = 0;
  for (int i = 0; i < 3000; ++i) {
    const double rho = 1.05 + 1.5 * random.unit();
    const auto o = options(rho, random.below(2) == 0 ? Rule::radius_edge : Rule::voronoi_aspect);
    const MeshBox<2> box = mesher::detail::mesh_box(o);
    const InsertionRule rule(o, box);
    Search search(box);
    std::vector<mesher::detail::Vertex<2>*> all;
    const double scale = std::pow(2.0, -30 * random.unit());
    for (int k = 0; k < 12; ++k) {
      auto& v = search.pool().create(
          {0.5 + scale * random.unit(), 0.5 + scale * random.unit() * random.unit()});
      search.tree().insert(v);
      all.push_back(&v);
    }
    double nearest2 = 16;
    for (std::size_t k = 1; k < all.size(); ++k) {
      const double d = distance(all[0]->p, all[k]->p);
      nearest2 = std::min(nearest2, d * d);
    }
    const int b = rule.bucket(nearest2);
    const auto cell =
        search.cut_around(*all[0], rule.clip_radius(b), [](VertexHandle) { return true; });
    const auto point = rule.next_point(*cell, b);
    if (!point.has_value()) continue;
    ++found;
    double shortest = 16, to_nearest = 16;
    for (const auto* v : all) to_nearest = std::min(to_nearest, distance(v->p, point->p));
    for (const auto* u : all) {
      for (const auto* v : all) {
        if (u != v) shortest = std::min(shortest, distance(u->p, v->p));
      }
    }
    CHECK(to_nearest * to_nearest == Approx(point->nearest2).epsilon(1e-9));
    CHECK(to_nearest >= rho * (1 - 0x1p-15) * shortest);
    CHECK(point->farther);
  }
  CHECK(found > 1000);
}

TEST_CASE("a lone point, whose events run in the last buckets, is meshed for every rho") {
  SplitMix64 random(23);
  INFO("seed 23");
  std::vector<Point<2>> points{{0x1.bp-1, 0x1.18p-1}, {0, 0}, {1, 1}, {0.5, 0.5}, {0, 1}};
  for (int i = 0; i < 20; ++i) points.push_back({random.unit(), random.unit()});
  for (const double rho : {1.05, 1.1, 1.2, 1.4142, 2.0, 4.0, 100.0}) {
    for (const Rule rule : {Rule::radius_edge, Rule::voronoi_aspect}) {
      for (const auto& p : points) {
        INFO("rho " << rho << " point " << p[0] << ' ' << p[1]);
        const auto mesh = mesher::mesh_statically<2>({p}, options(rho, rule));
        for (const auto& finding : mesher::check_mesh(mesh, {.input = nullptr, .rho = rho})) {
          INFO(finding.property << ": " << finding.detail);
          CHECK(finding.holds);
        }
      }
    }
  }
}

TEST_CASE("vertices beside an axis of symmetry have no noise for coordinates") {
  const Options<2> o{.domain = {{-1, -1}, {1, 1}}, .rho = 1.1, .rule = Rule::voronoi_aspect};
  const auto mesh =
      mesher::mesh_statically<2>({{-0.3, 0.1}, {0.3, 0.1}, {-0.3, -0.1}, {0.3, -0.1}}, o);
  for (const auto& p : mesh.vertices) {
    for (const double x : p) CHECK((x == 0 || std::abs(x) >= 8 * 0x1p-60));
  }
}
