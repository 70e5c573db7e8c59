// The guard: leaves tetrahedra poor where refinement might not terminate [rules C].
//
// A point that yields to a feature, or is near one, leads to edges that may be shorter than the
// edge that asked for it: a foot is as near as half of the gap ball's radius, which is less than
// the edge where rho < 2. Beside an isolated feature this need not terminate: no other feature
// there bounds the lengths from below. So an edge requests no such point if it is *isolated*:
// within kIsolated times its length every feature has a point in common with this one, and so have
// any two parts of it (corners, ends, edges) with each other.
//
// Termination: an edge e that requests a point is within kBesideEdge e of a feature, and not
// isolated; so two features without a common point are within (kBesideEdge + kIsolated) e of each
// other. These have a least distance, and all vertices that tetrahedra request are at least a
// constant times that apart. (This does not prove termination for the effects of features on each
// other at small angles.)
#pragma once

#include "mesher/reports.hpp"
#include "space/feature_search.hpp"
#include "space/placed.hpp"

namespace mesher::detail {

/// A new point is near features within this times the length of the edge that asks for it: what
/// those that it does not yield to make of it is then as far from all as that length again, even if
/// it yields to where they meet others.
inline constexpr double kNearNew = 2.25;

/// A short edge beside a feature: an edge, or else a polygon.
struct ShortEdge {
  const Edge* edge = nullptr;
  const Polygon* polygon = nullptr;
  Point<3> middle{};
  double length = 0;
  friend bool operator==(const ShortEdge&, const ShortEdge&) = default;
};

/// What there is for a short edge: features that the one beside it has nothing in common with.
class GuardBall : public PieceBall<ShortEdge> {
 public:
  explicit GuardBall(const ShortEdge& e)
      : PieceBall(e, e.middle, kIsolated * kIsolated * e.length * e.length) {}
  template <class F>
  [[nodiscard]] bool has(const F& f) const {
    const bool other =
        whole().edge != nullptr ? disjoint(*whole().edge, f) : disjoint(*whole().polygon, f);
    return other && meets(f);
  }
};

struct GuardPieces : SpacePieces<ShortEdge, GuardBall> {
  [[nodiscard]] static bool alive(const ShortEdge& e) {
    return e.edge != nullptr ? e.edge->alive : e.polygon->alive;
  }
};

/// The feature that a new point x is beside: what it yields to, else the first of those within
/// `reach` of it, edges before polygons; nothing if there is none.
[[nodiscard]] ShortEdge beside_new(const FeaturesBeside& near, const std::optional<Placed>& yields,
                                   const Point<3>& x, double reach);

/// Whether two parts of the feature that e is beside are near e, and have nothing in common.
[[nodiscard]] bool has_two_parts(const ShortEdge& e, const FeatureStore& store);

}  // namespace mesher::detail
