// What the rules promise in space, by which buckets, squares and the boundary grid are sized.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <memory>
#include <optional>
#include <vector>

#include "facade/mesh_statically.hpp"
#include "mesher/extra/generate.hpp"
#include "mesher/predicates.hpp"
#include "program/world_impl.hpp"
#include "rules/mesh_box.hpp"
#include "sizes/lattice.hpp"
#include "space_points.hpp"

namespace {

using mesher::Options;
using mesher::Point;
using mesher::Rule;
using mesher::SplitMix64;
using mesher::detail::EdgeFilter;
using mesher::detail::InsertionRule;
using mesher::detail::Limits;
using mesher::detail::MeshBox;
using mesher::detail::VertexRef;
using mesher::detail::VoronoiCell3;
using World = mesher::detail::World<sac::PlainScope, 3>;
using Points = std::vector<Point<3>>;

double distance(const Point<3>& a, const Point<3>& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

// The farthest that a vertex read, and inserted, was from the vertex completed, in clips; and of a
// new vertex from the input points, in distances to its nearest neighbour.
struct Farthest {
  double read = 0, inserted = 0, input = 0;
  bool outside = false;  // of the box
  double nearest = 1;    // of a new vertex any vertex, in distances that the rule says it has
  int early = 0;         // vertices with an edge in a bucket that is over, or under way
  int on_lattice = 0, all = 0;
};

// A rule that is watched.
class Watched final : public InsertionRule<3> {
 public:
  Watched(const Options<3>& options, const MeshBox<3>& box, const Points& input, Farthest& farthest)
      : InsertionRule(options, box, mesher::detail::promise<3>(options.rule, options.rho)),
        limits_(options, box),
        rule_(mesher::detail::insertion_rule<3>(options, box, limits_)),
        box_(box),
        input_(input),
        farthest_(farthest) {}

  void watch(const World& world) { world_ = &world; }

  std::optional<NewPoint> next_point(const VoronoiCell3& cell, int b,
                                     const EdgeFilter<3>* filter) const override {
    auto point = rule_->next_point(cell, b, filter);
    const double clip = buckets().clip_radius(b);
    farthest_.read = std::max(farthest_.read, 2 * std::sqrt(cell.reach2()) / clip);
    if (!point) return point;
    ++farthest_.all;
    if (point->on_lattice) {
      ++farthest_.on_lattice;
      point->move();
      point->on_lattice.reset();
    }
    farthest_.outside |= !box_.contains(point->p);
    farthest_.inserted = std::max(farthest_.inserted, distance(point->p, cell.center().p) / clip);
    const double nearest = std::sqrt(point->nearest2);
    note_vertices(point->p, nearest, b);
    // What is farther apart than a step may come from the boundary grid.
    if (nearest >= box_.side / box_.boundary_steps) return point;
    double to_input = 4 * box_.side;
    for (const auto& p : input_) to_input = std::min(to_input, distance(p, point->p));
    farthest_.input = std::max(farthest_.input, to_input / nearest);
    return point;
  }
  std::optional<int> next_bucket(const VoronoiCell3& cell, int b,
                                 const EdgeFilter<3>* filter) const override {
    return rule_->next_bucket(cell, b, filter);
  }

 private:
  void note_vertices(const Point<3>& p, double nearest, int b) const {
    double to_vertex = 4 * box_.side;
    world_->vertices.pool().for_each([&](const mesher::detail::Vertex<3>& v) {
      if (v.alive) to_vertex = std::min(to_vertex, distance(v.p, p));
    });
    farthest_.nearest = std::min(farthest_.nearest, to_vertex / nearest);
    farthest_.early += buckets().bucket(to_vertex * to_vertex * (1 + 1e-9)) <= b;
  }

  Limits<3> limits_;
  std::unique_ptr<const InsertionRule<3>> rule_;
  MeshBox<3> box_;
  const Points& input_;
  Farthest& farthest_;
  const World* world_ = nullptr;
};

Farthest farthest(const Points& points, const Options<3>& o) {
  const MeshBox<3> box = mesher::detail::mesh_box(o);
  sac::PlainScope scope;
  World world(o, box, scope);
  Farthest found;
  auto watched = std::make_unique<Watched>(o, box, points, found);
  watched->watch(world);
  world.rule = std::move(watched);
  for (const auto& p : points) {
    world.features.tree().insert_only(world.vertices.add_input(p, true));
  }
  world.vertices.pool().for_each([&](mesher::detail::Vertex<3>& v) {
    if (!v.input) return;
    world.quadtree.post_from_outside<mesher::detail::locate>(
        mesher::detail::locate_key(box.fixed(v.p)), VertexRef<3>{&v});
  });
  scope.run<mesher::detail::refine<3>>();
  return found;
}

}  // namespace

TEST_CASE("in space Complete reads and inserts no farther away than promised, near the input") {
  int on_lattice = 0, all = 0;
  for (const Rule rule : {Rule::radius_edge, Rule::voronoi_aspect}) {
    for (const double rho : {1.7, 2.0, 4.0}) {
      const auto promise = mesher::detail::promise<3>(rule, rho);
      const Options<3> options{.domain = {{0, 0, 0}, {1, 1, 1}}, .rho = rho, .rule = rule};
      for (const auto family : support::kSpaceFamilies) {
        INFO(support::name(family) << ", rule " << static_cast<int>(rule) << ", rho " << rho);
        const Farthest f = farthest(support::space_points(family, 60, 7), options);
        CHECK(f.read <= mesher::detail::kReads<3> * (1 + 1e-6));
        CHECK(f.inserted <= promise.inserts * (1 + 1e-6));
        CHECK(f.input <= promise.input * (1 + 1e-6));
        CHECK_FALSE(f.outside);
        if (rule != Rule::radius_edge) continue;
        // An off-centre is as near as its height to what is on the other side of its edge.
        const double height = rho + std::sqrt(rho * rho - 0.25);
        CHECK(f.nearest >= height / std::hypot(height, 0.5) * (1 - 1e-4));
        CHECK(f.early == 0);
        on_lattice += f.on_lattice, all += f.all;
      }
    }
  }
  CHECK(on_lattice > all / 4);
  CHECK(on_lattice < all);
}

TEST_CASE("of a body-centred lattice the nearest point is found, a lower one if two are as near") {
  SplitMix64 random(41);
  INFO("seed 41");
  const MeshBox<3> box = mesher::detail::mesh_box(Options<3>{.domain = {{0, 0, 0}, {1, 1, 1}}});
  for (int i = 0; i < 300; ++i) {
    const double spacing = box.side * std::exp2(-1.0 - static_cast<double>(random.below(12)));
    Point<3> p;
    for (double& x : p) x = random.unit();
    const Point<3> found = box.nearest_in_lattice(p, spacing);
    std::array<std::int64_t, 3> half{};  // in halves of the spacing
    for (std::size_t k = 0; k < 3; ++k) {
      const double at = (found[k] - box.lo[k]) / (spacing / 2);
      half[k] = static_cast<std::int64_t>(at);
      CHECK(static_cast<double>(half[k]) == at);
    }
    CHECK((half[0] & 1) == (half[1] & 1));
    CHECK((half[0] & 1) == (half[2] & 1));
    // None of the fourteen around it is nearer.
    const mesher::detail::Lattice<3> lattice(spacing);
    for (const auto& node : lattice.around({half})) {
      Point<3> other = lattice.place(node);
      for (std::size_t k = 0; k < 3; ++k) other[k] += box.lo[k];
      CHECK(distance(p, found) <= distance(p, other) * (1 + 0x1p-18));
    }
    CHECK(box.nearest_in_lattice(found, spacing) == found);
    Point<3> between = found;
    between[0] += spacing / 2;
    CHECK(box.nearest_in_lattice(between, spacing) == found);
  }
}

TEST_CASE("no vertex is ever in a ball of the boundary grid, in space [L 4.4.1]") {
  for (const Rule rule : {Rule::radius_edge, Rule::voronoi_aspect}) {
    const Options<3> options{.domain = {{0, 0, 0}, {1, 1, 1}}, .rule = rule};
    const MeshBox<3> box = mesher::detail::mesh_box(options);
    for (const auto family : support::kSpaceFamilies) {
      INFO(support::name(family) << ", rule " << static_cast<int>(rule));
      const Points points = support::space_points(family, 60, 9);
      const auto mesh = mesher::mesh_statically<3>(points, options);
      for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
        if (mesh.kinds[i] == mesher::VertexKind::boundary) continue;
        for (int axis = 0; axis < 3; ++axis) {
          const double x = mesh.vertices[i][static_cast<std::size_t>(axis)];
          const double height =
              std::min(x - box.lo[static_cast<std::size_t>(axis)], box.hi(axis) - x);
          CHECK(height > std::sqrt(2.0) * box.longest_boundary_step() / 2);
        }
      }
    }
  }
}
