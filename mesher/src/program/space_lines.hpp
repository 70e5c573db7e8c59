// The queries of ChooseSteiners about edges and polygons in space [Fig 6.2, 6.3; rules C].
//
// No edge or face of the mesh is remembered: an edge of the input is a union of the mesh's edges,
// and a polygon of its faces, once no vertex that is not on it has a cell that meets it. So
// Complete(v) queries the features of the input near v, a function of v's cell and these features:
// calls that have observed v's cell are notified when a feature within their search radius is added
// or removed (VertexIndex::feature_changed).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "program/staying.hpp"
#include "program/world.hpp"
#include "space/encroachment.hpp"
#include "space/guard.hpp"
#include "space/small_angles.hpp"
#include "space/yielding.hpp"

namespace mesher::detail {

/// One Complete(v, b) among edges and polygons: which poor simplices stay, and what yields.
template <class S>
class Staying<S, 3> final : public EdgeFilter<3> {
 public:
  Staying(World<S, 3>& world, VoronoiCell3& cell)
      : world_(world),
        cell_(cell),
        any_(world.has_features()),
        before_(world.plc.store().looked_at()),
        near_(world.plc.store(), cell.center().p, any_ ? world.vertices.beside(cell) : 0) {}
  Staying(const Staying&) = delete;
  Staying& operator=(const Staying&) = delete;
  /// Records the search radius with the cell's observation.
  ~Staying() override {
    if (any_) world_.vertices.note_asked(near_.asked());
  }

  [[nodiscard]] bool any() const noexcept { return any_; }
  /// This, for a rule; null where nothing can stay.
  [[nodiscard]] const EdgeFilter<3>* filter() const noexcept { return any_ ? this : nullptr; }
  /// The simplices at this edge stay.
  void leave(const VoronoiCell3& cell, int p, int q) { left_.push_back(ends(cell, p, q)); }
  [[nodiscard]] std::uint64_t looked_at() const noexcept {
    return world_.plc.store().looked_at() - before_;
  }

  [[nodiscard]] bool skips(const VoronoiCell3& cell, int p, int q) const override {
    if (std::find(left_.begin(), left_.end(), ends(cell, p, q)) != left_.end()) return true;
    return angles().keeps(standing(vertex(cell, p)), standing(vertex(cell, q)));
  }
  [[nodiscard]] bool skips_large(const VoronoiCell3&, int, int) const override { return false; }

  /// While the cell meets features that v is not on: vertices on these.
  void disencroach(S& s, int b) {
    if (!any_) return;
    for (const Edge* e : find_in<Edge>(cell_, near_.store())) clear(s, *e, b);
    for (const Polygon* f : find_in<Polygon>(cell_, near_.store())) clear(s, *f, b);
  }

  /// Whether x yields: a vertex is inserted instead, on a feature; or is refused.
  Outcome yields(S& s, const typename InsertionRule<3>::NewPoint& x, int b) {
    const auto y = yield(near_, x.p, std::sqrt(x.nearest2));
    if (world_.guarded && !x.large && is_refused(s, x, y)) return Outcome::refused;
    if (!y) return Outcome::stands;
    insert(s, helps(*y, x.corner) ? *y : instead_of(x.corner), b);
    return Outcome::yielded;
  }

 private:
  [[nodiscard]] Standing standing(const Vertex<3>& v) const { return {v, world_.vertices.role(v)}; }
  [[nodiscard]] SmallAngles angles() const { return SmallAngles(near_); }
  using Ends = std::array<VertexHandle, 2>;
  [[nodiscard]] Ends ends(const VoronoiCell3& cell, int p, int q) const {
    const auto [first, last] = std::minmax({vertex(cell, p).self, vertex(cell, q).self});
    return {first, last};
  }
  [[nodiscard]] const Vertex<3>& vertex(const VoronoiCell3& cell, int i) const {
    return i == kCentre ? cell.center() : world_.vertices.pool()[cell.handle(i)];
  }
  void insert(S& s, const Placed& y, int b) {
    world_.insert_beside(s, cell_.center(), cell_, y, b);
  }

  // Each new vertex takes some of what the cell has of e.
  void clear(S& s, const Edge& e, int b) {
    const Standing v = standing(cell_.center());
    if (is_on(v, e)) return;
    while (const auto part = part_in(cell_, e)) {
      auto y = angles().copy(v, e);
      if (!y || !cell_.cuts(y->p)) {
        const auto at = roundest(e, part->middle(0.5));
        if (!at) world_.fail_useless(v.v, v.v);
        y = placed_on(e, *at);
      }
      insert(s, *y, b);
    }
  }
  void clear(S& s, const Polygon& f, int b) {
    const Standing v = standing(cell_.center());
    if (is_on(v, f)) return;
    while (const auto x = place_in(cell_, f)) {
      auto y = angles().copy(v, f);
      if (!y || !cell_.cuts(y->p)) {
        y = yield_to_edges(near_, *x, std::sqrt(squared_distance(*x, v.v.p)));
      }
      insert(s, y ? *y : placed_on(f, *x), b);
    }
  }

  // By the guard (space/guard.hpp).
  [[nodiscard]] bool is_refused(S& s, const typename InsertionRule<3>::NewPoint& x,
                                const std::optional<Placed>& y) {
    const Point<3>& p = vertex(cell_, x.from).p;
    const Point<3>& q = vertex(cell_, x.to).p;
    const double length = std::sqrt(squared_distance(p, q));
    ShortEdge e = beside_new(near_, y, x.p, kNearNew * length);
    if (e.edge == nullptr && e.polygon == nullptr) return false;
    e.middle = scaled(0.5, plus(p, q));
    e.length = length;
    return !has_two_parts(e, near_.store()) && !world_.plc.crowded(s, e);
  }

  // Whether a vertex at y takes a corner of the cell.
  [[nodiscard]] bool helps(const Placed& y, const Point<3>& corner) {
    const double gap2 = squared_distance(corner, cell_.center().p);
    return squared_distance(y.p, corner) < gap2 * (1 - 0x1p-30) && cell_.cuts(y.p);
  }
  // The off-centre's ball is not all in the circumball: where the off-centre yields to a place
  // outside of that, the circumcentre does what it asks for.
  [[nodiscard]] Placed instead_of(const Point<3>& corner) {
    const auto y = yield(near_, corner, std::sqrt(squared_distance(corner, cell_.center().p)));
    return y && helps(*y, corner) ? *y : Placed{corner, {}};
  }

  World<S, 3>& world_;
  VoronoiCell3& cell_;
  const bool any_;
  const std::uint64_t before_;
  const FeaturesBeside near_;
  std::vector<Ends> left_;
};

}  // namespace mesher::detail
