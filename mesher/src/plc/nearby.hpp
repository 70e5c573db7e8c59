// Observations of what is near: of the features within a radius, and of how far a place on a
// polygon is from the features that the polygon has nothing in common with.
//
//   near(s, place, R)       (observation)   invalidated when an edge or a polygon within R comes or
//                                           goes
//   spacing(s, x, f, cap)   (observation)   invalidated when the answer changes
//
// Features come and go from outside, before all calls.
#pragma once

#include "plc/feature_search.hpp"

namespace mesher::detail {

class NearObservations final : public sac::Structure {
 public:
  NearObservations(const MeshBox<3>& box, FeatureStore& store, Features<sac::Scope, 3>& points,
                   sac::Engine& engine)
      : engine_(engine),
        store_(store),
        points_(points),
        tree_(box),
        id_(engine.add_structure(*this)) {}

  /// Valid until the next call. Cost: O(log L/s), and what is near.
  const FeaturesNear& near(sac::Scope& s, const Point<3>& place, double radius);
  /// At most cap. Requires: x is on f, and f is live. Cost: as find_spacing.
  double spacing(sac::Scope& s, const Point<3>& x, const Polygon& f, double cap);

  /// Outside edits: what has come is there already, what has gone is no longer. `f`: a vertex (an
  /// input point), an edge or a polygon. Cost: O(log L/s), and that of a look for each place whose
  /// nearest has gone.
  template <class F>
  void came(const F& f) noexcept {
    visit_observers(f, [&](NearEdge& edge) {
      if (edge.polygon == 0) return invalidate_if_near(edge, f);
      if (disjoint(polygon(edge), f)) turn(edge, std::min(edge.now, distance(edge, f)));
    });
  }
  template <class F>
  void went(const F& f) noexcept {
    visit_observers(f, [&](NearEdge& edge) {
      if (edge.polygon == 0) return invalidate_if_near(edge, f);
      if (disjoint(polygon(edge), f) && distance(edge, f) <= edge.now) turn(edge, spacing(edge));
    });
  }

  void retract(sac::Call& call, sac::Edge& edge) noexcept override;
  [[nodiscard]] bool unchanged(sac::Call& call, sac::Edge& edge) override;
  void label(const sac::Call& call, const sac::Edge& edge, sac::LabelSink& sink) const override;
  void print(const sac::Call& call, const sac::Edge& edge, std::ostream& out) const override;

  [[nodiscard]] std::size_t bytes() const noexcept { return tree_.bytes(); }
  /// Throws InvariantError; among others if a spacing is not what a look at the input finds.
  /// Cost: O(observations) looks.
  void check_invariants() const override;

 private:
  static constexpr std::uint8_t kNear = 0;
  static constexpr std::uint8_t kSpacing = 1;
  // Of a polygon: a spacing, `reach` its cap. Of none (0): what is within `reach`.
  struct NearEdge : sac::Edge {
    sac::Handle call;
    PolygonHandle polygon;
    Point<3> place;
    double reach;
    double seen, now;  // the spacing that the call had; of now
    bool listed;       // in tree_
  };
  [[nodiscard]] NearEdge& at(sac::Handle h) const noexcept {
    return *engine_.arena().at<NearEdge>(h);
  }
  [[nodiscard]] const Polygon& polygon(const NearEdge& edge) const noexcept {
    return store_.polygons()[edge.polygon];
  }
  template <class F>
  [[nodiscard]] static double distance(const NearEdge& edge, const F& f) {
    return std::sqrt(distance2_to(edge.place, f));
  }
  [[nodiscard]] double spacing(const NearEdge& edge) const {
    return find_spacing(edge.place, polygon(edge), edge.reach, store_, points_);
  }
  [[nodiscard]] NearEdge* recall(sac::Scope& s, std::uint8_t kind, PolygonHandle polygon,
                                 const Point<3>& place, double reach);
  NearEdge& observe(sac::Scope& s, std::uint8_t kind, PolygonHandle polygon, const Point<3>& place,
                    double reach);
  template <class Look>
  void weighed(sac::Scope& s, Look&& look);
  void turn(NearEdge& edge, double spacing) noexcept;
  void invalidate_if_near(NearEdge&, const Vertex<3>&) noexcept {}  // points are no answer
  template <class F>
  void invalidate_if_near(NearEdge& edge, const F& f) noexcept {
    if (touches(distance2_to(edge.place, f), edge.reach * edge.reach)) {
      engine_.invalidate(engine_.call(edge.call));
    }
  }
  template <class F, class Visit>
  void visit_observers(const F& f, Visit&& visit) noexcept {
    if (tree_.size() == 0) return;
    const FeatureExtent<3> where = extent_of(f);
    tree_.visit_near(where.p, where.q, where.slack, [&](sac::Handle h) { visit(at(h)); });
  }

  sac::Engine& engine_;
  FeatureStore& store_;
  Features<sac::Scope, 3>& points_;
  ReachTree<sac::Handle, 3> tree_;  // of the observations, by what they may see
  FeaturesNear found_;
  std::uint8_t id_;
};

}  // namespace mesher::detail
