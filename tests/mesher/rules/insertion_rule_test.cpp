// Where the two rules put new points, and how far from the vertex that asks.
#include "rules/insertion_rule.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <memory>

#include "facade/mesh_statically.hpp"
#include "mesher/check.hpp"
#include "mesher/extra/generate.hpp"
#include "program/world_impl.hpp"
#include "rules/mesh_box.hpp"

namespace {

const mesher::detail::Limits<2>& no_limits() {
  static const mesher::detail::Limits<2> none({}, {});
  return none;
}

using mesher::Options;
using mesher::Point;
using mesher::Rule;
using mesher::SplitMix64;
using mesher::detail::insertion_rule;
using EdgeFilter = mesher::detail::EdgeFilter<2>;
using InsertionRule = mesher::detail::InsertionRule<2>;
constexpr double kReads = mesher::detail::kReads<2>;
using mesher::detail::MeshBox;
using mesher::detail::VertexHandle;
using mesher::detail::VertexRef;
using mesher::detail::VoronoiCell;
using PlainWorld = mesher::detail::World<sac::PlainScope>;

Options<2> options(double rho, Rule rule) {
  return {.domain = {{0, 0}, {1, 1}}, .rho = rho, .rule = rule};
}

struct Search : mesher::detail::VertexSearch<2> {
  using VertexSearch::cut_around;
  using VertexSearch::VertexSearch;
};

double distance(const Point<2>& a, const Point<2>& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1]);
}

// The farthest that a vertex read, and inserted, was from the vertex completed; in clips.
struct Farthest {
  double read = 0;
  double inserted = 0;
  double input = 0;  // from a new vertex to the input points, in distances to its nearest neighbour
  int early = 0;     // vertices whose nearest neighbour is in a bucket that is over, or under way
};

// A rule that is watched.
class Watched final : public InsertionRule {
 public:
  Watched(const Options<2>& options, const MeshBox<2>& box, const std::vector<Point<2>>& input,
          Farthest& farthest)
      : InsertionRule(options, box, mesher::detail::promise<2>(options.rule, options.rho)),
        rule_(insertion_rule<2>(options, box, no_limits())),
        input_(input),
        farthest_(farthest),
        step_(box.side / box.boundary_steps) {}

  std::optional<NewPoint> next_point(const VoronoiCell& cell, int b,
                                     const EdgeFilter* filter) const override {
    const auto point = rule_->next_point(cell, b, filter);
    const double clip = buckets().clip_radius(b);
    farthest_.read = std::max(farthest_.read, 2 * std::sqrt(cell.reach2()) / clip);
    if (point.has_value()) {
      farthest_.inserted = std::max(farthest_.inserted, distance(point->p, cell.center().p) / clip);
      note_input(point->p, std::sqrt(point->nearest2));
      farthest_.early += buckets().bucket(point->nearest2 * (1 + 1e-9)) <= b;
    }
    return point;
  }
  std::optional<int> next_bucket(const VoronoiCell& cell, int b,
                                 const EdgeFilter* filter) const override {
    return rule_->next_bucket(cell, b, filter);
  }

 private:
  // Vertices with nearest neighbours more than a step away may come from the boundary grid.
  void note_input(const Point<2>& x, double nearest) const {
    if (nearest >= step_) return;
    double to_input = 16;
    for (const auto& p : input_) to_input = std::min(to_input, distance(p, x));
    farthest_.input = std::max(farthest_.input, to_input / nearest);
  }

  std::unique_ptr<const InsertionRule> rule_;
  const std::vector<Point<2>>& input_;
  Farthest& farthest_;
  double step_;
};

Farthest farthest(const std::vector<Point<2>>& points, const Options<2>& o) {
  const MeshBox<2> box = mesher::detail::mesh_box(o);
  sac::PlainScope scope;
  PlainWorld world(o, box, scope);
  Farthest found;
  world.rule = std::make_unique<const Watched>(o, box, points, found);
  auto& features = world.features.tree();
  for (const auto& p : points) features.insert_only(world.vertices.add_input(p, true));
  world.vertices.pool().for_each([&](mesher::detail::Vertex<2>& v) {
    if (!v.input) return;
    world.quadtree.post_from_outside<mesher::detail::locate>(
        mesher::detail::locate_key(box.fixed(v.p)), VertexRef<2>{&v});
  });
  scope.run<mesher::detail::refine<2>>();
  return found;
}

// Points of which some are ever nearer to others.
std::vector<Point<2>> spread_points(SplitMix64& random, int n) {
  std::vector<Point<2>> points{{0.5, 0.5}};
  for (int i = 1; i < n; ++i) {
    Point<2> p{random.unit(), random.unit()};
    if (random.below(3) != 0) {
      const auto near = points[random.below(points.size())];
      const double reach = std::pow(2.0, -20 * random.unit());
      for (std::size_t k = 0; k < 2; ++k) p[k] = near[k] + reach * (p[k] - 0.5);
    }
    if (p[0] >= 0 && p[0] <= 1 && p[1] >= 0 && p[1] <= 1) points.push_back(p);
  }
  return points;
}

}  // namespace

TEST_CASE("a new point's nearest vertex is rho lengths away, and what the rule says it is") {
  SplitMix64 random(17);
  INFO("seed 17");
  int found = 0;
  for (int i = 0; i < 3000; ++i) {
    const double rho = 1.05 + 1.5 * random.unit();
    const auto o = options(rho, random.below(2) == 0 ? Rule::radius_edge : Rule::voronoi_aspect);
    const MeshBox<2> box = mesher::detail::mesh_box(o);
    const auto rule = insertion_rule(o, box, no_limits());
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
    const int b = rule->buckets().bucket(nearest2);
    const auto cell = search.cut_around(*all[0], rule->buckets().clip_radius(b),
                                        [](VertexHandle) { return true; });
    const auto point = rule->next_point(*cell, b, nullptr);
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
        mesher::CheckOptions<2> asked;
        asked.rho = rho;
        for (const auto& finding : mesher::check_mesh(mesh, asked)) {
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

TEST_CASE("an off-centre may be nearly two circumradii of the clip away, and no farther") {
  for (const double rho : {1.05, 1.4142, 2.0}) {
    const auto o = options(rho, Rule::radius_edge);
    const MeshBox<2> box = mesher::detail::mesh_box(o);
    const auto rule = insertion_rule(o, box, no_limits());
    const int b = rule->buckets().bucket(0x1p-20);
    const double clip = rule->buckets().clip_radius(b);
    // An edge as short as you like, opposite of v on the circle around a corner of the octagon.
    const double corner = 0.3 + 3.14159265358979 / 8;
    const Point<2> out{std::cos(corner), std::sin(corner)};
    const Point<2> v{0.5, 0.5};
    Search search(box);
    const double far = 0.999 * kReads * clip;
    for (const double side : {0.0, -0.001 * clip, 0.001 * clip}) {
      const double along = side == 0 ? 0 : far;
      const Point<2> p{v[0] + along * out[0] - side * out[1],
                       v[1] + along * out[1] + side * out[0]};
      search.tree().insert(search.pool().create(p));
    }
    const auto cell = search.cut_around(search.pool()[1], clip, [](VertexHandle) { return true; });
    const auto point = rule->next_point(*cell, b, nullptr);
    REQUIRE(point.has_value());
    CHECK(distance(point->p, v) > 2.1 * clip);
    CHECK(distance(point->p, v) <= rule->promise().inserts * clip);
  }
}

TEST_CASE("Complete reads and inserts no farther away than promised, and stays near the input") {
  SplitMix64 random(29);
  INFO("seed 29");
  for (const Rule rule : {Rule::radius_edge, Rule::voronoi_aspect}) {
    double most = 0;
    for (const double rho : {1.05, 1.1, 1.2, 1.4142, 2.0, 4.0, 20.0}) {
      const auto o = options(rho, rule);
      const auto promise = mesher::detail::promise<2>(rule, rho);
      for (const int n : {1, 30, 150, 600}) {
        INFO("rule " << static_cast<int>(rule) << ", rho " << rho << ", n " << n);
        const Farthest f = farthest(spread_points(random, n), o);
        CHECK(f.read <= kReads * (1 + 1e-6));
        CHECK(f.inserted <= promise.inserts * (1 + 1e-6));
        CHECK(f.input <= promise.input * (1 + 1e-6));
        if (rule == Rule::radius_edge) CHECK(f.early == 0);
        most = std::max(most, f.inserted);
      }
    }
    CHECK(most >= (rule == Rule::radius_edge ? 1.2 : 1.08));
  }
}

TEST_CASE("an off-centre has the same bits whichever corner of its triangle asks for it") {
  SplitMix64 random(61);
  INFO("seed 61");
  const auto o = options(1.4142, Rule::radius_edge);
  const MeshBox<2> box = mesher::detail::mesh_box(o);
  const auto rule = insertion_rule(o, box, no_limits());
  const int b = rule->buckets().count() - 1;
  for (int i = 0; i < 2000; ++i) {
    // An edge p q of some length e, a neighbour r that makes a good triangle with it, and, on the
    // other side, a corner w far away.
    const double angle = 6.2831 * random.unit();
    const double e = 0.01 * (1 + random.unit());
    const Point<2> along{e * std::cos(angle), e * std::sin(angle)};
    const Point<2> across{-along[1], along[0]};
    const Point<2> p{random.unit(), random.unit()};
    const auto at = [&](double x, double y) {
      return Point<2>{p[0] + x * along[0] + y * across[0], p[1] + x * along[1] + y * across[1]};
    };
    Search search(box);
    std::vector<mesher::detail::Vertex<2>*> all;
    for (const auto& place : {p, at(1, 0), at(0.2 + 0.6 * random.unit(), 7), at(0.5, -1.1)}) {
      all.push_back(&search.pool().create(place));
      search.tree().insert(*all.back());
    }
    std::vector<Point<2>> asked;
    for (int corner = 0; corner < 3; ++corner) {
      const auto cell =
          search.cut_around(*all[static_cast<std::size_t>(corner)], rule->buckets().clip_radius(b),
                            [](VertexHandle) { return true; });
      const auto point = rule->next_point(*cell, b, nullptr);
      REQUIRE(point.has_value());
      asked.push_back(point->p);
    }
    CHECK(asked[0] == asked[1]);
    CHECK(asked[0] == asked[2]);
  }
}
