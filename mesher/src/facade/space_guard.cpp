// Where the guard gave in, of the tetrahedra that an update has brought: the same questions as of a
// whole mesh (mesher/guard.hpp), asked of the program's indices.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <type_traits>
#include <vector>

#include "check/poor_beside.hpp"
#include "check/space_quality.hpp"
#include "facade/space_state.hpp"
#include "program/world_impl.hpp"
#include "space/small_angles.hpp"

namespace mesher::detail {

namespace {

using Beside = IsolatedEdges::Beside;
using World3 = World<sac::Scope, 3>;

// An edge of the mesh, and the features that it may be beside.
class EdgeBeside {
 public:
  EdgeBeside(World3& world, const Point<3>& p, const Point<3>& q)
      : world_(world),
        p_(*world.vertices.tree().find(p)),
        q_(*world.vertices.tree().find(q)),
        middle_(scaled(0.5, plus(p, q))),
        length_(std::sqrt(squared_distance(p, q))),
        reach_(kBesideEdge * length_),
        near_(world.plc.store(), middle_, reach_),
        polygons_(find_near<Polygon>(middle_, reach_, near_.store())) {}

  /// Whether small angles excuse it.
  [[nodiscard]] bool is_kept() const {
    const auto standing = [&](const Vertex<3>& v) { return Standing{v, world_.vertices.role(v)}; };
    return SmallAngles(near_).keeps(standing(p_), standing(q_));
  }
  /// `name(f)`: of an edge or polygon. The one beside which it is isolated, as IsolatedEdges has
  /// it.
  template <class Name>
  [[nodiscard]] std::optional<Beside> isolated(Name&& name) const {
    NearestBeside beside;
    const auto look = [&](const auto& f, bool is_polygon, const ShortEdge& e) {
      if (!world_.plc.is_isolated(e)) return;
      beside.show(std::sqrt(distance2_to(middle_, f)), is_polygon, name(f, polygons_));
    };
    for (const Edge* e : find_near<Edge>(middle_, reach_, near_.store())) {
      look(*e, false, {e, nullptr, middle_, length_});
    }
    for (const Polygon* f : polygons_) look(*f, true, {nullptr, f, middle_, length_});
    return beside.found(length_);
  }

 private:
  World3& world_;
  const Vertex<3>& p_;
  const Vertex<3>& q_;
  Point<3> middle_;
  double length_, reach_;
  FeaturesBeside near_;
  std::vector<const Polygon*> polygons_;
};

}  // namespace

Beside SpaceState::name_of(const Edge& e, const std::vector<const Polygon*>& near) const {
  if (const auto id = segment(e.self)) return *id;
  Beside least;
  for (const Polygon* f : near) {
    if (!f->has_edge(e.self)) continue;
    const Beside id = polygon(f->self);
    if (least == Beside() || id < least) least = id;
  }
  return least;
}

void SpaceState::find_angles(const std::vector<Simplex>& come, Change<3>& change) const {
  if (!world_->guarded || !world_->has_features()) return;
  const auto name = [&](const auto& f, const std::vector<const Polygon*>& near) {
    if constexpr (std::is_same_v<std::decay_t<decltype(f)>, Edge>) {
      return name_of(f, near);
    } else {
      return Beside(polygon(f.self));
    }
  };
  GuardCounts counts;
  for (const Simplex& s : come) {
    const std::array<Point<3>, 4> places = corners(s);  // ratios are rounded in this order
    const RadiusEdge ratio = radius_edge(places[0], places[1], places[2], places[3]);
    if (!is_above(ratio, rho_)) continue;
    const auto edges = GuardCounts::shortest_edges(places);
    const bool kept = std::any_of(edges.begin(), edges.end(), [&](const auto& e) {
      return EdgeBeside(*world_, e[0], e[1]).is_kept();
    });
    if (kept) continue;
    counts.look(edges, ratio.ratio, [&](const auto& p, const auto& q) {
      return EdgeBeside(*world_, p, q).isolated(name);
    });
  }
  change.guard = counts.report();
}

}  // namespace mesher::detail
