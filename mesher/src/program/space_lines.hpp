// What ChooseSteiners asks of edges and polygons in space [Fig 6.2, 6.3; rules C].
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "plc/encroachment.hpp"
#include "plc/small_angles.hpp"
#include "plc/yielding.hpp"
#include "program/staying.hpp"
#include "program/world.hpp"

namespace mesher::detail {

/// What poor simplices stay in space, and which features are near.
template <class S>
class Staying<S, 3> final : public EdgeFilter<3> {
 public:
  explicit Staying(const World<S, 3>& world) : world_(world) {}

  /// This, for a rule; null where nothing can stay.
  [[nodiscard]] const EdgeFilter<3>* filter() const noexcept {
    return world_.plc.any() ? this : nullptr;
  }
  void leave(const VoronoiCell3&, int, int) {}
  [[nodiscard]] std::uint64_t looked_at() const noexcept { return 0; }

  [[nodiscard]] bool skips(const VoronoiCell3& cell, int p, int q) const override {
    const Vertex<3>&a = vertex(cell, p), &b = vertex(cell, q);
    return SmallAngles(world_.plc).keeps(a, world_.vertices.role(a), b, world_.vertices.role(b));
  }
  [[nodiscard]] bool skips_large(const VoronoiCell3&, int, int) const override { return false; }

 private:
  [[nodiscard]] const Vertex<3>& vertex(const VoronoiCell3& cell, int i) const {
    return i == kCentre ? cell.center() : world_.vertices.pool()[cell.handle(i)];
  }

  const World<S, 3>& world_;
};

/// One Complete(v, b) among edges and polygons.
template <class S>
class Yielding {
 public:
  Yielding(S& s, World<S, 3>& w, const Vertex<3>& v, CellOf<3>& cell, int b)
      : s_(s), w_(w), v_(v), role_(w.vertices.role(v)), cell_(cell), b_(b) {}

  /// While the cell meets features that v is not on: vertices on these.
  void disencroach() {
    const FeaturesNear near = w_.plc.near(s_, v_, v_.p, (1 + kYields) * std::sqrt(cell_.reach2()));
    for (const Edge* e : near.edges) clear(*e);
    for (const Polygon* f : near.polygons) clear(near, *f);
  }

  /// Whether x yields: a vertex is inserted instead, on a feature.
  bool yields(const typename InsertionRule<3>::NewPoint& x) {
    const FeaturesNear near = w_.plc.near(s_, v_, v_.p, kNear * std::sqrt(cell_.reach2()));
    const double gap2 = squared_distance(x.corner, v_.p);
    const auto helps = [&](const Placed& y) {
      return squared_distance(y.p, x.corner) < gap2 * (1 - 0x1p-30) && cell_.cuts(y.p);
    };
    const auto y = yield(near, x.p, std::sqrt(x.nearest2));
    if (!y) return false;
    if (helps(*y)) return insert(*y), true;
    ++g_fallback;
    const auto z = yield(near, x.corner, std::sqrt(gap2));
    insert(z && helps(*z) ? *z : Placed{x.corner, {}});
    return true;
  }
  static inline long g_copies = 0, g_fallback = 0, g_enc_e = 0, g_enc_f = 0, g_yields = 0;

 private:
  // A feature that x yields to is within this times the cell's reach of v.
  static constexpr double kNear = 2.75;

  void insert(const Placed& y) { w_.insert_beside(s_, v_, cell_, y, b_); }

  void clear(const Edge& e) {
    const SmallAngles angles(w_.plc);
    if (angles.is_on(v_, role_, e)) return;
    while (const auto part = part_in(cell_, e)) {
      ++g_enc_e;
      const auto copy = angles.copy(v_, role_, e);
      if (copy && cell_.cuts(copy->p)) { ++g_copies; insert(*copy); continue; }
      const auto at = coarsest_dyadic(part->middle_half());
      if (!at) w_.fail_useless(v_, v_);
      insert(placed_on(e, *at));
    }
  }
  void clear(const FeaturesNear& near, const Polygon& f) {
    const SmallAngles angles(w_.plc);
    if (angles.is_on(v_, role_, f)) return;
    while (const auto place = place_in(cell_, f)) {
      ++g_enc_f;
      const auto copy = angles.copy(v_, role_, f);
      if (copy && cell_.cuts(copy->p)) { ++g_copies; insert(*copy); continue; }
      const auto on_edge = yield_to_edges(near, *place, std::sqrt(squared_distance(*place, v_.p)));
      insert(on_edge ? *on_edge : placed_on(f, *place));
    }
  }

  S& s_;
  World<S, 3>& w_;
  const Vertex<3>& v_;
  const Role role_;
  CellOf<3>& cell_;
  const int b_;
};

}  // namespace mesher::detail
