// The queries of ChooseSteiners about edges and polygons in space [Fig 6.2, 6.3; rules C, F].
//
// No edge or face of the mesh is remembered: an edge of the input is a union of the mesh's edges,
// and a polygon of its faces, once none crosses the star of a vertex (space/star_crossings.hpp). So
// Complete(v) queries the features of the input near v, a function of v's star and these features:
// calls that have observed v's cell are notified when a feature is added or removed that meets v's
// star, or is within their search radius (VertexIndex::feature_changed).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "program/staying.hpp"
#include "program/world.hpp"
#include "space/guard.hpp"
#include "space/small_angles.hpp"
#include "space/star_crossings.hpp"
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
        near_(world.plc.store(), cell.center().p, any_ ? world.vertices.beside(cell) : 0),
        known_(world.vertices.was_clear() ? Known::was_clear : Known::observed) {
    if (!any_) world_.vertices.note_clear(true);
  }
  Staying(const Staying&) = delete;
  Staying& operator=(const Staying&) = delete;
  /// Records the search radius beyond the star with the cell's observation. Where there are no
  /// features that is what it would be: of one that inserts nothing there is none; else it is not
  /// known, and the first feature concerns whoever it might.
  ~Staying() override { world_.vertices.note_asked(any_ ? near_.asked() : would_ask()); }

  [[nodiscard]] bool any() const noexcept { return any_; }
  /// Where there are no features: a new point stands.
  void note_new() noexcept { inserts_ = true; }
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

  /// While features cross the star: vertices on them. Returns whether there were any.
  bool disencroach(S& s, int b) {
    bool inserts = false;
    const auto role_of = [&](const Vertex<3>& v) { return world_.vertices.role(v); };
    while (any_) {
      const Known known = std::exchange(known_, Known::nothing);
      const auto y = StarCrossings(world_.star_room, cell_, world_.vertices.pool(), near_, role_of)
                         .place(known);
      if (known != Known::nothing) world_.vertices.note_clear(!y);
      if (!y) break;
      insert(s, *y, b);
      inserts = true;
    }
    return inserts;
  }

  /// Whether x yields: a vertex is inserted instead, on a feature; or is refused.
  Outcome yields(S& s, const typename InsertionRule<3>::NewPoint& x, int b) {
    const auto y = yield(near_, x.p, std::sqrt(x.nearest2));
    if (world_.guarded && !x.large && is_refused(s, x, y)) return Outcome::refused;
    if (!y) return Outcome::stands;
    insert(s, helps(*y, x.corner) ? *y : instead_of(x.corner), b);
    return Outcome::yielded;
  }

  /// Whether x, which stands, may be moved to the lattice: it yields to no feature there either,
  /// and none is so near that the guard has a say.
  [[nodiscard]] bool has_room(const typename InsertionRule<3>::NewPoint& x) const {
    const double length2 = squared_distance(vertex(cell_, x.from).p, vertex(cell_, x.to).p);
    const double reach =
        std::max(kYields * std::sqrt(x.on_lattice->reach2), kNearNew * std::sqrt(length2));
    return near_.nearest_edge(x.on_lattice->p, reach) == nullptr &&
           near_.nearest_under(x.on_lattice->p, reach) == nullptr;
  }

 private:
  using Known = StarCrossings::Known;

  [[nodiscard]] double would_ask() const {
    return inserts_ ? std::numeric_limits<double>::infinity() : 0;
  }
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
  Known known_;  // of the star
  bool inserts_ = false;
};

}  // namespace mesher::detail
