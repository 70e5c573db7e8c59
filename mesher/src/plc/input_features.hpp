// The input's edges and polygons, and what calls ask about them; outside edits.
//
//   near(s, place, R)       the features within R of a place, in canonical order   (observation)
//   crowded(s, piece)       whether a piece of an edge has to be split             (observation)
//   spacing(s, x, f, cap)   how far x, on f, is from what f has nothing in common
//                           with, at most cap                                      (observation)
#pragma once

#include "index/vertex_index.hpp"
#include "plc/feature_search.hpp"
#include "plc/nearby.hpp"

namespace mesher::detail {

template <class S>
class InputFeatures;

template <>
class InputFeatures<sac::PlainScope> {
 public:
  InputFeatures(const MeshBox<3>& box, const VertexPool<3>& pool,
                Features<sac::PlainScope, 3>& points, sac::PlainScope& s)
      : store_(box, pool), points_(points), crowding_(box, store_, points, s) {}

  [[nodiscard]] const FeatureStore& store() const noexcept { return store_; }
  [[nodiscard]] FeatureStore& store() noexcept { return store_; }

  /// Valid until the next call.
  const FeaturesNear& near(sac::PlainScope&, const Point<3>& place, double radius) {
    find_near(place, radius, store_, found_);
    return found_;
  }
  [[nodiscard]] bool crowded(sac::PlainScope& s, const EdgePiece& piece) {
    return crowding_.crowded(s, piece);
  }
  [[nodiscard]] Feature witness(const EdgePiece& piece) { return crowding_.witness(piece); }
  [[nodiscard]] double spacing(sac::PlainScope&, const Point<3>& x, const Polygon& f, double cap) {
    return find_spacing(x, f, cap, store_, points_);
  }

  /// One user more of the edge between two different input points.
  const Edge& insert(VertexHandle a, VertexHandle b);
  /// Requires: it is not there, and has an area.
  const Polygon& insert(PolygonParts parts);

 private:
  FeatureStore store_;
  Features<sac::PlainScope, 3>& points_;
  Crowding<sac::PlainScope, SpacePieces> crowding_;
  FeaturesNear found_;
};

template <>
class InputFeatures<sac::Scope> final : public PointListener<3>, private FeatureEvents {
 public:
  InputFeatures(const MeshBox<3>& box, const VertexPool<3>& pool, Features<sac::Scope, 3>& points,
                sac::Engine& engine)
      : engine_(engine),
        store_(box, pool),
        crowding_(box, store_, points, engine),
        nearby_(box, store_, points, engine) {
    points.set_listener(this);
    store_.set_listener(this);
  }

  [[nodiscard]] const FeatureStore& store() const noexcept { return store_; }
  [[nodiscard]] FeatureStore& store() noexcept { return store_; }

  /// Who looks at cells asks what is beside them without a word to this.
  void set_cells(VertexIndex<sac::Scope, 3>& cells) noexcept { cells_ = &cells; }

  /// Valid until the next call.
  const FeaturesNear& near(sac::Scope& s, const Point<3>& place, double radius) {
    return nearby_.near(s, place, radius);
  }
  [[nodiscard]] bool crowded(sac::Scope& s, const EdgePiece& piece) {
    return crowding_.crowded(s, piece);
  }
  [[nodiscard]] Feature witness(const EdgePiece& piece) { return crowding_.witness(piece); }
  [[nodiscard]] double spacing(sac::Scope& s, const Point<3>& x, const Polygon& f, double cap) {
    return nearby_.spacing(s, x, f, cap);
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

  /// Ends an update: frees the records of features that have gone.
  void commit() noexcept { store_.commit(); }

  [[nodiscard]] std::size_t bytes() const noexcept {
    return store_.bytes() + crowding_.bytes() + nearby_.bytes();
  }
  /// Requires: between updates. Throws InvariantError.
  void check_invariants() const {
    store_.check_invariants();
    crowding_.check_invariants();
    nearby_.check_invariants();
  }

 private:
  void came(const Edge& e) noexcept override { tell_came(e), tell_cells(e); }
  void went(const Edge& e) noexcept override { tell_went(e), tell_cells(e); }
  void came(const Polygon& f) noexcept override { tell_came(f), tell_cells(f); }
  void went(const Polygon& f) noexcept override { tell_went(f), tell_cells(f); }
  template <class F>
  void tell_came(const F& f) noexcept {
    crowding_.came(f);
    nearby_.came(f);
  }
  template <class F>
  void tell_went(const F& f) noexcept {
    crowding_.went(f);
    nearby_.went(f);
  }

  template <class F>
  void tell_cells(const F& f) noexcept {
    if (cells_ == nullptr) return;
    cells_->feature_changed([&](const Point<3>& x) { return std::sqrt(distance2_to(x, f)); });
  }

  sac::Engine& engine_;
  VertexIndex<sac::Scope, 3>* cells_ = nullptr;
  FeatureStore store_;
  Crowding<sac::Scope, SpacePieces> crowding_;
  NearObservations nearby_;
};

}  // namespace mesher::detail
