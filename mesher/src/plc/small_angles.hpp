// Where features meet at small angles [rules C]: copies instead of projections, and tetrahedra that
// stay poor.
//
// A vertex v on f, too near g, and f and g share h, an edge or a point: projections between them
// would approach h for ever. Instead v is *copied*: turned about h on to g, which is not near f for
// that. And an edge from f to g that is shorter than both ends' distances from h is as short as
// the angle makes it: a tetrahedron that is poor by it stays.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "plc/placed.hpp"
#include "plc/polygon_shape.hpp"

namespace mesher::detail {

/// `Plc`: InputFeatures, of which edge(h), polygon(h), polygons_at(e) and common(f, g, x) are used.
template <class Plc>
class SmallAngles {
 public:
  explicit SmallAngles(const Plc& plc) : plc_(plc) {}

  [[nodiscard]] bool is_on(const Vertex<3>& v, const Role& role, const Edge& e) const {
    return e.self == edge_of(role) || e.has_end(v.self);
  }
  [[nodiscard]] bool is_on(const Vertex<3>& v, const Role& role, const Polygon& f) const {
    const EdgeHandle e = edge_of(role);
    return f.self == polygon_of(role) || (e != 0 && f.has_edge(e)) || f.has(v.self);
  }

  /// The copy of v on the edge, or polygon, if there is a place for it there: nearer to v than v is
  /// to what they share.
  [[nodiscard]] std::optional<Placed> copy(const Vertex<3>& v, const Role& role,
                                           const Edge& g) const {
    const Point<3> along = minus(g.place_b, g.place_a);
    const auto fraction = [&](const Point<3>& x) {
      return dot(minus(x, g.place_a), along) / squared(along);
    };
    const auto x = turned(v, role, Feature(g), [&](const Point<3>& p) {
      return plus(g.place_a, scaled(fraction(p), along));
    });
    if (!x) return std::nullopt;
    const double at = fraction(*x);
    if (!(at > 0 && at < 1)) return std::nullopt;
    return placed_on(g, at);
  }
  [[nodiscard]] std::optional<Placed> copy(const Vertex<3>& v, const Role& role,
                                           const Polygon& g) const {
    const auto x = turned(v, role, Feature(g), [&](const Point<3>& p) { return g.plane.foot(p); });
    if (!x || !contains(g, *x)) return std::nullopt;
    for (const EdgeHandle h : g.all_edges) {  // it may be on one
      const Edge& e = plc_.edge(h);
      if (distance2(*x, e.place_a, e.place_b) > 0x1p-60 * e.length * e.length) continue;
      return placed_on(e, nearest_fraction(*x, e.place_a, e.place_b));
    }
    return placed_on(g, *x);
  }

  /// Whether a tetrahedron stays whose shortest edge is ab.
  [[nodiscard]] bool keeps(const Vertex<3>& a, const Role& on_a, const Vertex<3>& b,
                           const Role& on_b) const {
    if (on_a.on == 0 || on_b.on == 0) return false;
    const double length2 = squared_distance(a.p, b.p);
    for (const Feature f : features_of(on_a)) {
      if (is_on(b, on_b, f)) continue;
      for (const Feature g : features_of(on_b)) {
        if (is_on(a, on_a, g)) continue;
        const Feature h = plc_.common(f, g, a.p);
        if (!h) continue;
        if (length2 < std::min(squared_distance(a.p, foot(h, a.p)),
                               squared_distance(b.p, foot(h, b.p)))) {
          return true;
        }
      }
    }
    return false;
  }

 private:
  [[nodiscard]] bool is_on(const Vertex<3>& v, const Role& role, const Feature& f) const {
    return f.kind() == Feature::Kind::edge ? is_on(v, role, plc_.edge(f.handle()))
                                           : is_on(v, role, plc_.polygon(f.handle()));
  }
  // The edges and polygons that a vertex with this role lies on.
  [[nodiscard]] std::vector<Feature> features_of(const Role& role) const {
    std::vector<Feature> all;
    if (const PolygonHandle f = polygon_of(role)) all.emplace_back(plc_.polygon(f));
    if (const EdgeHandle e = edge_of(role)) {
      all.emplace_back(plc_.edge(e));
      for (const Polygon* f : plc_.polygons_at(plc_.edge(e))) all.emplace_back(*f);
    }
    return all;
  }
  [[nodiscard]] Point<3> foot(const Feature& h, const Point<3>& x) const {
    if (h.kind() == Feature::Kind::point) return plc_.place(h.handle());
    const Edge& e = plc_.edge(h.handle());
    return plus(e.place_a, scaled(nearest_fraction(x, e.place_a, e.place_b),
                                  minus(e.place_b, e.place_a)));
  }
  // At v's distance from what g shares with a feature of v, on the way to the foot of v on g.
  template <class Foot>
  [[nodiscard]] std::optional<Point<3>> turned(const Vertex<3>& v, const Role& role,
                                               const Feature& g, Foot&& foot_on_g) const {
    for (const Feature f : features_of(role)) {
      const Feature h = plc_.common(f, g, v.p);
      if (!h || h == f || h == g) continue;
      const Point<3> hinge = foot(h, v.p);
      const double d2 = squared_distance(v.p, hinge);
      const Point<3> to = minus(foot_on_g(v.p), hinge);
      if (d2 == 0 || squared(to) < d2 / 4) continue;  // at over 60 degrees
      const Point<3> x = plus(hinge, scaled(std::sqrt(d2 / squared(to)), to));
      if (squared_distance(x, v.p) < d2) return x;
    }
    return std::nullopt;
  }

  const Plc& plc_;
};

}  // namespace mesher::detail
