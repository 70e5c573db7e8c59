// Rules for features that meet at small angles [rules C]: copies instead of projections, and
// tetrahedra that are left poor.
//
// Let v be a vertex on f, too near g, where f and g share h, an edge or a point: projections
// between them would approach h for ever. Instead v is *copied*: turned about h on to g, which is
// not near f for that. And an edge from f to g that is shorter than both ends' distances from h is
// as short as the angle makes it: a tetrahedron that is poor by it stays.
#pragma once

#include <optional>

#include "space/feature_search.hpp"
#include "space/placed.hpp"

namespace mesher::detail {

/// A vertex, and what it stands for.
struct Standing {
  const Vertex<3>& v;
  Role role;
};

/// Whether it lies on a feature, by labels.
[[nodiscard]] bool is_on(const Standing& v, const Edge& e);
[[nodiscard]] bool is_on(const Standing& v, const Polygon& f);

class SmallAngles {
 public:
  explicit SmallAngles(const FeaturesBeside& near) : store_(near.store()), near_(near) {}

  /// The copy of v on g, if they share something at a small angle and there is a place for it.
  [[nodiscard]] std::optional<Placed> copy(const Standing& v, const Edge& g) const;
  [[nodiscard]] std::optional<Placed> copy(const Standing& v, const Polygon& g) const;
  /// Whether v is on a polygon that shares an edge with g, at 45 degrees at most, and would be on g
  /// if turned about it.
  [[nodiscard]] bool leans(const Standing& v, const Polygon& g) const;

  /// Whether a tetrahedron stays whose shortest edge is ab.
  [[nodiscard]] bool keeps(const Standing& a, const Standing& b) const;

 private:
  [[nodiscard]] bool on(const Standing& v, const Feature& f) const;
  [[nodiscard]] bool has(const Feature& f, VertexHandle point) const;
  [[nodiscard]] EdgeHandle edge_at(const Polygon& g, const Point<3>& x, double away) const;
  [[nodiscard]] bool share_shell(const Standing& a, const Standing& b) const;
  /// Calls visit(feature) for the edges and polygons that a vertex lies on, until one returns true;
  /// returns whether one has.
  template <class Visit>
  bool visit_features_of(const Standing& v, Visit&& visit) const;
  [[nodiscard]] Feature shared(const Feature& f, const Feature& g, const Point<3>& x) const;
  [[nodiscard]] Point<3> foot(const Feature& h, const Point<3>& x) const;
  /// A place at distance `away` from what two features share.
  struct Turned {
    Point<3> x;
    Feature about;
    double away;
  };
  [[nodiscard]] double shell(const Standing& v, VertexHandle point) const;
  [[nodiscard]] double distance(const Standing& v, const Feature& h) const;
  [[nodiscard]] double kept_shell(const Standing& v, const Feature& h) const;
  template <class Foot>
  [[nodiscard]] std::optional<Turned> turned(const Standing& v, const Feature& g,
                                             Foot&& foot_on_g) const;

  const FeatureStore& store_;
  const FeaturesBeside& near_;
};

}  // namespace mesher::detail
