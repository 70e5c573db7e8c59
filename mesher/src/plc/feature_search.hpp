// What is asked of the input's features, found beside a place: functions of the input alone.
#pragma once

#include "geometry/box.hpp"
#include "index/features.hpp"
#include "plc/feature_store.hpp"
#include "segments/crowding.hpp"

namespace mesher::detail {

/// Whether an edge and a feature have nothing in common: no corner, no end, and none lies on the
/// other.
[[nodiscard]] inline bool disjoint(const Edge& e, const Vertex<3>& v) { return !e.has_end(v.self); }
[[nodiscard]] inline bool disjoint(const Edge& e, const Edge& t) {
  return !e.has_end(t.a) && !e.has_end(t.b);
}
[[nodiscard]] inline bool disjoint(const Edge& e, const Polygon& f) {
  return !f.has(e.a) && !f.has(e.b);
}

/// Squared distance of a place from a feature.
[[nodiscard]] inline double distance2_to(const Point<3>& x, const Vertex<3>& v) {
  return squared_distance(x, v.p);
}
[[nodiscard]] inline double distance2_to(const Point<3>& x, const Edge& e) {
  return distance2(x, e.place_a, e.place_b);
}
[[nodiscard]] inline double distance2_to(const Point<3>& x, const Polygon& f) {
  return distance2(x, f);
}

/// Where a feature lies.
[[nodiscard]] inline FeatureExtent<3> extent_of(const Vertex<3>& v) { return {v.p, v.p}; }
[[nodiscard]] inline FeatureExtent<3> extent_of(const Edge& e) { return {e.place_a, e.place_b}; }
[[nodiscard]] inline FeatureExtent<3> extent_of(const Polygon& f) {
  return {f.middle, f.middle, f.reach + f.thickness};
}

/// How far a feature may be off a line or a plane.
[[nodiscard]] inline double thickness_of(const Edge&) { return 0; }
[[nodiscard]] inline double thickness_of(const Polygon& f) { return f.thickness; }

/// The edges and polygons within `radius` of a place, in canonical order.
/// Cost: O(log L/s), and what is near.
void find_near(const Point<3>& place, double radius, FeatureStore& store, FeaturesNear& found);

/// The features that two features share: the edge or else the point nearest to x, of equally near
/// ones the first by its places; none.
[[nodiscard]] Feature common(const Edge& e, const Edge& t, const Point<3>& x,
                             const FeatureStore& store);
[[nodiscard]] Feature common(const Edge& e, const Polygon& f, const Point<3>& x,
                             const FeatureStore& store);
[[nodiscard]] Feature common(const Polygon& f, const Edge& e, const Point<3>& x,
                             const FeatureStore& store);
[[nodiscard]] Feature common(const Polygon& f, const Polygon& g, const Point<3>& x,
                             const FeatureStore& store);

/// The closed ball that has a piece of an edge as its diameter, and what crowds the piece there:
/// features that the edge has nothing in common with [rules C, Split].
class CrowdedBall {
 public:
  explicit CrowdedBall(const EdgePiece& piece) : edge_(*piece.edge) {
    const Point<3> lo = place_at(edge_, piece.lo), hi = place_at(edge_, piece.hi);
    for (int i = 0; i < 3; ++i) middle_[i] = (lo[i] + hi[i]) / 2;
    radius2_ = squared_distance(lo, hi) / 4;
  }
  [[nodiscard]] const Point<3>& middle() const noexcept { return middle_; }
  /// The ball lies within this around the middle, with its slack.
  [[nodiscard]] double reach() const noexcept { return std::sqrt(radius2_) * (1 + 0x1p-29); }
  [[nodiscard]] Box<3> box() const noexcept { return around(middle_, reach()); }

  /// `f`: a vertex, an edge, or a polygon.
  template <class F>
  [[nodiscard]] bool has(const F& f) const {
    return disjoint(edge_, f) && touches(distance2_to(middle_, f), radius2_);
  }

 private:
  const Edge& edge_;
  Point<3> middle_{};
  double radius2_;
};

/// Some feature in the ball, or nothing.
template <class S>
[[nodiscard]] Feature find_witness(const CrowdedBall& ball, FeatureStore& store,
                                   const Features<S, 3>& points) {
  Feature witness;
  const auto take = [&](const auto& f) {
    if (!ball.has(f)) return false;
    witness = Feature(f);
    return true;
  };
  if (!store.visit_near(ball.middle(), ball.middle(), ball.reach(), take)) {
    points.visit_points_in(ball.box(), take);
  }
  return witness;
}

/// Pieces of edges in space.
struct SpacePieces {
  static constexpr int kDimension = 3;
  using Piece = EdgePiece;
  using Zone = CrowdedBall;
  using Witness = Feature;
  using Store = FeatureStore;
  [[nodiscard]] static bool alive(const EdgePiece& piece) { return piece.edge->alive; }
};

}  // namespace mesher::detail
