// The edges and polygons of the input, the queries of calls about them, and edits from outside.
//
//   crowded(s, piece)     whether a piece of an edge, or of a polygon, has to be split
//   (observation)
//   crowded(s, edge)      whether an edge of the mesh is not isolated (space/guard.hpp)
//   (observation)
//   hemmed_in(s, piece)   whether a piece of a polygon is better off without a vertex
//   (observation)
//
// A call that observes a cell reads the features near it (find_near) with no further observation:
// an added or removed feature finds the cells that it is near.
#pragma once

#include "index/vertex_index.hpp"
#include "program/surroundings.hpp"
#include "space/feature_search.hpp"
#include "space/guard.hpp"

namespace mesher::detail {

template <class S>
class InputFeatures;

template <>
class InputFeatures<sac::PlainScope> {
 public:
  InputFeatures(const MeshBox<3>& box, const VertexPool<3>& pool,
                Features<sac::PlainScope, 3>& points, sac::PlainScope& s)
      : store_(box, pool),
        edges_(box, store_, points, s),
        facets_(box, store_, points, s),
        hinges_(box, store_, points, s),
        guards_(box, store_, points, s) {}

  [[nodiscard]] const FeatureStore& store() const noexcept { return store_; }
  [[nodiscard]] FeatureStore& store() noexcept { return store_; }

  [[nodiscard]] bool crowded(sac::PlainScope& s, const EdgePiece& piece) {
    return edges_.crowded(s, piece);
  }
  [[nodiscard]] bool crowded(sac::PlainScope& s, const FacetPiece& piece) {
    return facets_.crowded(s, piece);
  }
  [[nodiscard]] bool crowded(sac::PlainScope& s, const ShortEdge& e) {
    return guards_.crowded(s, e);
  }
  [[nodiscard]] bool hemmed_in(sac::PlainScope& s, const FacetPiece& piece) {
    return hinges_.crowded(s, piece);
  }

  /// One user more of the edge between two different input points.
  const Edge& insert(VertexHandle a, VertexHandle b);
  /// Requires: it is not there, and has an area.
  const Polygon& insert(PolygonParts parts);

 private:
  FeatureStore store_;
  Crowding<sac::PlainScope, EdgePieces> edges_;
  Crowding<sac::PlainScope, FacetPieces> facets_;
  Crowding<sac::PlainScope, HingePieces> hinges_;
  Crowding<sac::PlainScope, GuardPieces> guards_;
};

template <>
class InputFeatures<sac::Scope> final : public PointListener<3>,
                                        private FeatureEvents,
                                        private ChangedFeatures {
 public:
  InputFeatures(const MeshBox<3>& box, const VertexPool<3>& pool, Features<sac::Scope, 3>& points,
                sac::Engine& engine)
      : engine_(engine),
        store_(box, pool),
        edges_(box, store_, points, engine),
        facets_(box, store_, points, engine),
        hinges_(box, store_, points, engine),
        guards_(box, store_, points, engine) {
    points.set_listener(this);
    store_.set_listener(this);
  }

  [[nodiscard]] const FeatureStore& store() const noexcept { return store_; }
  [[nodiscard]] FeatureStore& store() noexcept { return store_; }

  /// Who looks at these is told which features come and go beside them.
  void set_listeners(VertexIndex<sac::Scope, 3>& cells,
                     Surroundings<sac::Scope, 3>& surroundings) noexcept {
    cells_ = &cells;
    cells.set_changed_features(this);
    surroundings_ = &surroundings;
  }

  [[nodiscard]] bool crowded(sac::Scope& s, const EdgePiece& piece) {
    return edges_.crowded(s, piece);
  }
  [[nodiscard]] bool crowded(sac::Scope& s, const FacetPiece& piece) {
    return facets_.crowded(s, piece);
  }
  [[nodiscard]] bool crowded(sac::Scope& s, const ShortEdge& e) { return guards_.crowded(s, e); }
  [[nodiscard]] bool hemmed_in(sac::Scope& s, const FacetPiece& piece) {
    return hinges_.crowded(s, piece);
  }

  /// Called by who edits the limits of size in `where`: who asks whether a piece is crowded asks
  /// about the limits in the box around its ball, too.
  void limits_changed(const Box<3>& where) noexcept {
    edges_.limits_changed(where);
    facets_.limits_changed(where);
  }

  /// The guard's question, from outside (space/guard.hpp).
  [[nodiscard]] bool is_isolated(const ShortEdge& e) {
    return !has_two_parts(e, store_) && !guards_.witness(e);
  }

  /// Outside edits, with their inverses noted for a roll-back: one user more, or less, of the edge
  /// between two different input points; a polygon that is not there (and has an area), or is.
  /// Throws: std::bad_alloc.
  const Edge& insert(VertexHandle a, VertexHandle b);
  void erase(const Edge& e);
  const Polygon& insert(PolygonParts parts);
  void erase(const Polygon& f);

  void point_came(const Vertex<3>& v) noexcept override;
  void point_went(const Vertex<3>& v) noexcept override;
  void level_changed(Vertex<3>& v) noexcept override {
    if (cells_ != nullptr) cells_->touch(v);
  }

  /// Ends an update: frees the records of features that have gone.
  void commit() noexcept { store_.commit(); }

  [[nodiscard]] std::size_t bytes() const noexcept {
    return store_.bytes() + edges_.bytes() + facets_.bytes() + hinges_.bytes() + guards_.bytes();
  }
  /// Requires: between updates. Throws InvariantError.
  void check_invariants() const {
    store_.check_invariants();
    edges_.check_invariants();
    facets_.check_invariants();
    hinges_.check_invariants();
    guards_.check_invariants();
  }

 private:
  // A side comes and goes with a polygon, which is told of.
  void came(const Edge& e) noexcept override {
    tell_pieces_came(e);
    if (!e.bounds) tell_others(e);
  }
  void went(const Edge& e) noexcept override {
    tell_pieces_went(e);
    if (!e.bounds) tell_others(e);
  }
  void came(const Polygon& f) noexcept override { tell_pieces_came(f), tell_others(f); }
  void went(const Polygon& f) noexcept override { tell_pieces_went(f), tell_others(f); }

  template <class F>
  void tell_pieces_came(const F& f) noexcept {
    edges_.came(f);
    facets_.came(f);
    hinges_.came(f);
    guards_.came(f);
  }
  template <class F>
  void tell_pieces_went(const F& f) noexcept {
    edges_.went(f);
    facets_.went(f);
    hinges_.went(f);
    guards_.went(f);
  }

  // How far a feature is from x, at least. What find_near finds, it finds with a slack; and where a
  // foot leaves a polygon, its distance may jump by as much as corners on both sides are off the
  // plane.
  template <class F>
  [[nodiscard]] static double distance(const Point<3>& x, const F& f) {
    return std::sqrt(distance2_to(x, f)) * (1 - 0x1p-29) - 2 * thickness_of(f);
  }
  [[nodiscard]] bool any_meets(const PlaceBall& whole, std::span<const PlaceBall> parts) override {
    const auto is_outside = [&](const Point<3>& x, double r) {
      const auto meets = [&](const PlaceBall& ball) {
        const double most = ball.radius + r;
        return squared_distance(ball.middle, x) <= most * most;
      };
      return !meets(whole) || std::none_of(parts.begin(), parts.end(), meets);
    };
    return store_.visit_changed_in(is_outside, [&](const auto& f) {
      const auto meets = [&](const PlaceBall& ball) {
        return !is_clear_of(f, ball.middle, ball.radius) && distance(ball.middle, f) <= ball.radius;
      };
      return meets(whole) && std::any_of(parts.begin(), parts.end(), meets);
    });
  }

  template <class F>
  void tell_others(const F& f) noexcept {
    if (cells_ == nullptr) return;
    surroundings_->changed(extent_of(f));
    const auto away = [&](const Point<3>& x) { return distance(x, f); };
    const auto beyond = [&](const Point<3>& x, double r) {
      return is_clear_of(f, x, r) || (r < reach_of(f) && away(x) > r);
    };
    cells_->feature_changed(beyond, away);
  }

  sac::Engine& engine_;
  VertexIndex<sac::Scope, 3>* cells_ = nullptr;
  Surroundings<sac::Scope, 3>* surroundings_ = nullptr;
  FeatureStore store_;
  Crowding<sac::Scope, EdgePieces> edges_;
  Crowding<sac::Scope, FacetPieces> facets_;
  Crowding<sac::Scope, HingePieces> hinges_;
  Crowding<sac::Scope, GuardPieces> guards_;
};

}  // namespace mesher::detail
