// Queries about the features of the input near a position: functions of the input alone.
#pragma once

#include <algorithm>
#include <array>
#include <new>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "cells/voronoi_cell3.hpp"
#include "geometry/box.hpp"
#include "index/features.hpp"
#include "plane/crowding.hpp"
#include "space/facet_piece.hpp"
#include "space/feature_store.hpp"

namespace mesher::detail {

/// Whether two features have nothing in common: no corner, no end, and none lies on the other.
[[nodiscard]] inline bool disjoint(const Edge& e, const Vertex<3>& v) { return !e.has_end(v.self); }
[[nodiscard]] inline bool disjoint(const Edge& e, const Edge& t) {
  return !e.has_end(t.a) && !e.has_end(t.b);
}
[[nodiscard]] inline bool disjoint(const Edge& e, const Polygon& f) {
  return !f.has(e.a) && !f.has(e.b);
}
[[nodiscard]] inline bool disjoint(const Polygon& f, const Vertex<3>& v) { return !f.has(v.self); }
[[nodiscard]] inline bool disjoint(const Polygon& f, const Edge& e) { return disjoint(e, f); }
[[nodiscard]] bool disjoint(const Polygon& f, const Polygon& g);

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

/// Whether a closed ball around a place has some of a feature.
template <class F>
[[nodiscard]] bool is_in_ball(const Point<3>& x, double radius2, const F& f) {
  return touches(distance2_to(x, f), radius2);
}
template <>
[[nodiscard]] inline bool is_in_ball(const Point<3>& x, double radius2, const Polygon& f) {
  return is_within(x, f, closed(radius2));
}

/// Where a feature lies.
[[nodiscard]] inline FeatureExtent<3> extent_of(const Vertex<3>& v) { return {v.p, v.p}; }
[[nodiscard]] inline FeatureExtent<3> extent_of(const Edge& e) { return {e.place_a, e.place_b}; }
[[nodiscard]] inline FeatureExtent<3> extent_of(const Polygon& f) {
  return {f.middle, f.middle, f.reach + f.thickness};
}

/// Canonical order: edges by the places of their ends, polygons by those of their corners.
[[nodiscard]] inline bool comes_before(const Edge& e, const Edge& t) {
  return std::tie(e.place_a, e.place_b) < std::tie(t.place_a, t.place_b);
}
[[nodiscard]] inline bool comes_before(const Polygon& f, const Polygon& g) {
  return order(f, g) < 0;
}

/// Takes what a search shows it, some repeatedly. Visitors must not throw: this one says so, and
/// the search ends.
template <class F>
class FoundFeatures {
 public:
  /// Whether the search ends.
  bool take(const F& f) noexcept {
    try {
      all_.push_back(&f);
    } catch (const std::bad_alloc&) {
      failed_ = true;
    }
    return failed_;
  }
  /// Throws: std::bad_alloc.
  [[nodiscard]] std::vector<const F*> all() && {
    if (failed_) throw std::bad_alloc();
    return std::move(all_);
  }

 private:
  std::vector<const F*> all_;
  bool failed_ = false;
};

/// Around what place, and how far, a ball reaches that has all of a feature.
[[nodiscard]] inline Point<3> middle_of(const Edge& e) {
  return scaled(0.5, plus(e.place_a, e.place_b));
}
[[nodiscard]] inline Point<3> middle_of(const Polygon& f) { return f.middle; }
[[nodiscard]] inline double reach_of(const Edge& e) { return 0.5 * e.length * (1 + 0x1p-20); }
[[nodiscard]] inline double reach_of(const Polygon& f) { return f.reach + 3 * f.thickness; }
/// Whether that ball is farther than r from x: then so is the feature, less twice its thickness.
template <class F>
[[nodiscard]] bool is_clear_of(const F& f, const Point<3>& x, double r) {
  const double most = (r + reach_of(f)) * (1 + 0x1p-20);
  return squared_distance(x, middle_of(f)) > most * most;
}

/// How far a feature may be off a line or a plane.
[[nodiscard]] inline double thickness_of(const Edge&) { return 0; }
[[nodiscard]] inline double thickness_of(const Polygon& f) { return f.thickness; }

/// The edges, or polygons, within `radius` of a place, in canonical order. Cost: O(log L/s), and
/// what is near.
template <class F>
[[nodiscard]] std::vector<const F*> find_near(const Point<3>& place, double radius,
                                              FeatureStore& store);

/// What is asked of features by who observes a cell. How far is noted: the farther, the more
/// features are there whose coming and going concerns it.
class FeaturesBeside {
 public:
  /// `place`: of the cell's vertex; `most`: it asks nothing beyond.
  FeaturesBeside(FeatureStore& store, const Point<3>& place, double most)
      : store_(store), place_(place), most_(most) {}

  [[nodiscard]] FeatureStore& store() const noexcept { return store_; }
  [[nodiscard]] const Point<3>& place() const noexcept { return place_; }
  /// Within what distance of the cell's vertex features have been asked for. 0: they have not.
  [[nodiscard]] double asked() const noexcept { return asked_; }
  /// Notes that features within `radius` of the cell's vertex are asked for.
  void ask_within(double radius) const { ask(place_, radius); }
  /// The polygons within `radius` of x, and others, in canonical order.
  [[nodiscard]] const std::vector<const Polygon*>& polygons(const Point<3>& x, double radius) const;
  /// The edges within `radius` of x, in canonical order.
  [[nodiscard]] std::vector<const Edge*> edges(const Point<3>& x, double radius) const;
  /// The polygons that e lies on, in canonical order; x is a place of e.
  [[nodiscard]] std::span<const PolygonHandle> polygons_at(const Edge& e, const Point<3>& x) const {
    ask(x, 0);
    return store_.polygons_at(e);
  }
  /// The edge nearest to x, at most `most` away; of equally near ones the first. Null: none.
  /// Cost: O(log L/s), and what is as near.
  [[nodiscard]] const Edge* nearest_edge(const Point<3>& x, double most) const;
  /// The same of the polygons that have the foot of x.
  [[nodiscard]] const Polygon* nearest_under(const Point<3>& x, double most) const;

 private:
  void ask(const Point<3>& x, double radius) const;
  template <class F, class Measure, class Distance>
  [[nodiscard]] const F* nearest(const Point<3>& x, double most, double most_measure,
                                 Measure&& measure, Distance&& distance) const;

  FeatureStore& store_;
  Point<3> place_;
  double most_;
  mutable double asked_ = 0;
  mutable double known_ = -1;  // within this polygons_ are all
  mutable std::vector<const Polygon*> polygons_;
};

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

/// Whether a feature that does not lie on a polygon has something in common with it, and is at no
/// more than 64 degrees to its plane: then vertices of one may be turned on to the other
/// (space/small_angles.hpp).
[[nodiscard]] inline bool leans_on(const Vertex<3>&, const Polygon&) { return false; }
[[nodiscard]] inline bool leans_on(const Edge& e, const Polygon& f) {
  const double sine = dot(minus(e.place_b, e.place_a), f.plane.normal) / e.length;
  return std::abs(sine) <= 0.9 && !f.has_edge(e.self) && !disjoint(f, e);
}
[[nodiscard]] inline bool leans_on(const Polygon& g, const Polygon& f) {
  const double cosine = dot(g.plane.normal, f.plane.normal);
  return std::abs(cosine) >= 0.43 && &g != &f && !disjoint(f, g);
}

/// A closed ball around a piece of an edge or a polygon.
template <class Whole>
class PieceBall {
 public:
  PieceBall(const Whole& whole, const Point<3>& middle, double radius2)
      : whole_(whole), middle_(middle), radius2_(radius2) {}

  [[nodiscard]] const Point<3>& middle() const noexcept { return middle_; }
  /// The ball lies within this around the middle, with its slack.
  [[nodiscard]] double reach() const noexcept { return std::sqrt(radius2_) * (1 + 0x1p-29); }
  [[nodiscard]] Box<3> box() const noexcept { return around(middle_, reach()); }

 protected:
  [[nodiscard]] const Whole& whole() const noexcept { return whole_; }
  template <class F>
  [[nodiscard]] bool meets(const F& f) const {
    return is_in_ball(middle_, radius2_, f);
  }

 private:
  const Whole& whole_;
  Point<3> middle_;
  double radius2_;
};

/// The ball that has a piece of an edge as its diameter, somewhat larger. What crowds the piece
/// there: features that the edge has nothing in common with [rules C, Split].
class EdgeBall : public PieceBall<Edge> {
 public:
  /// Of the piece's length. Half of it misses what is beside an end of the piece, however near: two
  /// edges that cross at a small gap, at a place where both are split, would have long pieces
  /// there. With 1/512 more these are at most 23 gaps long, and double from there on.
  static constexpr double kRadius = 0.5 + 0x1p-9;

  explicit EdgeBall(const EdgePiece& piece)
      : EdgeBall(*piece.edge, place_at(*piece.edge, piece.lo), place_at(*piece.edge, piece.hi)) {}

  /// `f`: a vertex, an edge, or a polygon.
  template <class F>
  [[nodiscard]] bool has(const F& f) const {
    return disjoint(whole(), f) && meets(f);
  }

 private:
  EdgeBall(const Edge& e, const Point<3>& lo, const Point<3>& hi)
      : PieceBall(e, scaled(0.5, plus(lo, hi)), squared_distance(lo, hi) * (kRadius * kRadius)) {}
};

/// A ball around the middle of a piece of a polygon; `radius`: of the longer side.
[[nodiscard]] inline PieceBall<Polygon> ball_around(const FacetPiece& piece, double radius) {
  const Polygon& f = *piece.polygon;
  const double r = radius * piece.longer_side();
  return {f, f.plane.at(piece.middle()), r * r};
}

/// What crowds a piece of a polygon: features that the polygon has nothing in common with [rules C,
/// Disencroach]. Where they stay out, the lattice leaves no place as far from its vertices as from
/// them, but for the borders.
class FacetBall : public PieceBall<Polygon> {
 public:
  explicit FacetBall(const FacetPiece& piece) : PieceBall(ball_around(piece, 0.55)) {}
  template <class F>
  [[nodiscard]] bool has(const F& f) const {
    return disjoint(whole(), f) && meets(f);
  }
};

/// What hems in a piece of a polygon: features that lean on the polygon so near that they would get
/// copies of the piece's vertex.
class HingeBall : public PieceBall<Polygon> {
 public:
  explicit HingeBall(const FacetPiece& piece) : PieceBall(ball_around(piece, 0.75)) {}
  template <class F>
  [[nodiscard]] bool has(const F& f) const {
    return leans_on(f, whole()) && meets(f);
  }
};

/// Some feature in a ball, or nothing.
template <class Ball, class S>
[[nodiscard]] Feature find_witness(const Ball& ball, FeatureStore& store,
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

/// What Crowding<S, Kind> (plane/crowding.hpp) is about in space.
template <class PieceOf, class Ball>
struct SpacePieces {
  static constexpr int kDimension = 3;
  using Piece = PieceOf;
  using Zone = Ball;
  using Witness = Feature;
  using Store = FeatureStore;
  [[nodiscard]] static bool alive(const EdgePiece& piece) { return piece.edge->alive; }
  [[nodiscard]] static bool alive(const FacetPiece& piece) { return piece.polygon->alive; }
};
using EdgePieces = SpacePieces<EdgePiece, EdgeBall>;
using FacetPieces = SpacePieces<FacetPiece, FacetBall>;
using HingePieces = SpacePieces<FacetPiece, HingeBall>;

}  // namespace mesher::detail
