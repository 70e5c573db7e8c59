// Turning vertices about what features share.
#include "plc/small_angles.hpp"

#include <algorithm>
#include <cmath>

#include "plc/feature_search.hpp"

namespace mesher::detail {

namespace {

// Where the foot of x on the line of e is, as a fraction.
double foot_fraction(const Edge& e, const Point<3>& x) {
  const Point<3> along = minus(e.place_b, e.place_a);
  return dot(minus(x, e.place_a), along) / squared(along);
}
Point<3> place_on_line(const Edge& e, double fraction) {
  return plus(e.place_a, scaled(fraction, minus(e.place_b, e.place_a)));
}

// Whether two distances are one but for rounding.
bool is_about(double x, double y) { return std::abs(x - y) <= y * 0x1p-40; }

}  // namespace

bool is_on(const Standing& v, const Edge& e) {
  return e.self == edge_of(v.role) || e.has_end(v.v.self);
}

bool is_on(const Standing& v, const Polygon& f) {
  const EdgeHandle e = edge_of(v.role);
  return f.self == polygon_of(v.role) || (e != 0 && f.has_edge(e)) || f.has(v.v.self);
}

bool SmallAngles::on(const Standing& v, const Feature& f) const {
  return f.kind() == Feature::Kind::edge ? is_on(v, store_.edges()[f.handle()])
                                         : is_on(v, store_.polygons()[f.handle()]);
}

bool SmallAngles::has(const Feature& f, VertexHandle point) const {
  return f.kind() == Feature::Kind::edge ? store_.edges()[f.handle()].has_end(point)
                                         : store_.polygons()[f.handle()].has(point);
}

// The edges and polygons that a vertex with this role lies on.
std::vector<Feature> SmallAngles::features_of(const Role& role) const {
  std::vector<Feature> all;
  if (const PolygonHandle f = polygon_of(role)) all.emplace_back(store_.polygons()[f]);
  if (const EdgeHandle e = edge_of(role)) {
    all.emplace_back(store_.edges()[e]);
    for (const Polygon* f : near_.polygons) {
      if (f->has_edge(e)) all.emplace_back(*f);
    }
  }
  return all;
}

Feature SmallAngles::shared(const Feature& f, const Feature& g, const Point<3>& x) const {
  const auto with = [&](const auto& first) {
    return g.kind() == Feature::Kind::edge
               ? common(first, store_.edges()[g.handle()], x, store_)
               : common(first, store_.polygons()[g.handle()], x, store_);
  };
  return f.kind() == Feature::Kind::edge ? with(store_.edges()[f.handle()])
                                         : with(store_.polygons()[f.handle()]);
}

Point<3> SmallAngles::foot(const Feature& h, const Point<3>& x) const {
  if (h.kind() == Feature::Kind::point) return store_.points()[h.handle()].p;
  const Edge& e = store_.edges()[h.handle()];
  return place_on_line(e, std::clamp(foot_fraction(e, x), 0.0, 1.0));
}

// Of v from h; as labels say where they do, so that a copy of a copy is as far, bit for bit.
double SmallAngles::distance(const Standing& v, const Feature& h) const {
  if (h.kind() == Feature::Kind::point && edge_of(v.role) != 0) {
    const Edge& e = store_.edges()[edge_of(v.role)];
    if (e.has_end(h.handle())) return v.role.label.from(e.b == h.handle(), e.length);
  }
  const double away = std::sqrt(squared_distance(v.v.p, foot(h, v.v.p)));
  const double copied_at = polygon_of(v.role) != 0 ? v.role.label.distance() : 0;
  return is_about(away, copied_at) ? copied_at : away;
}

// At v's distance from what g shares with a feature of v, on the way to the foot of v on g, unless
// that is at over 60 degrees.
template <class Foot>
auto SmallAngles::turned(const Standing& v, const Feature& g, Foot&& foot_on_g) const
    -> std::optional<Turned> {
  for (const Feature& f : features_of(v.role)) {
    const Feature h = shared(f, g, v.v.p);
    if (!h || h == f || h == g) continue;
    const Point<3> hinge = foot(h, v.v.p);
    const double away = distance(v, h);
    const Point<3> to = minus(foot_on_g(v.v.p), hinge);
    if (away == 0 || squared(to) < away * away / 4) continue;
    const Point<3> x = plus(hinge, scaled(away / std::sqrt(squared(to)), to));
    if (squared_distance(x, v.v.p) < away * away) return Turned{x, h, away};
  }
  return std::nullopt;
}

std::optional<Placed> SmallAngles::copy(const Standing& v, const Edge& g) const {
  const auto turned_to = turned(v, Feature(g), [&](const Point<3>& p) {
    return place_on_line(g, foot_fraction(g, p));
  });
  if (!turned_to) return std::nullopt;
  const bool about_a = turned_to->about.handle() == g.a;
  const double from_a = about_a ? turned_to->away : g.length - turned_to->away;
  if (!(from_a > 0 && from_a < g.length)) return std::nullopt;
  const bool near = turned_to->away <= g.length / 2;
  return placed_on(g, near ? Label(turned_to->away, !about_a) : label_at(g, from_a));
}

// On an edge of g if it is there.
std::optional<Placed> SmallAngles::copy(const Standing& v, const Polygon& g) const {
  const auto turned_to =
      turned(v, Feature(g), [&](const Point<3>& p) { return g.plane.foot(p); });
  if (!turned_to || !contains(g, turned_to->x)) return std::nullopt;
  for (const EdgeHandle h : g.all_edges) {
    const Edge& e = store_.edges()[h];
    if (distance2_to(turned_to->x, e) > 0x1p-60 * e.length * e.length) continue;
    const double at = foot_fraction(e, turned_to->x);
    if (at > 0 && at < 1) return placed_on(e, label_at(e, at * e.length));
    return std::nullopt;
  }
  return placed_on(g, turned_to->x, turned_to->away);
}

// Whether b, a copy about a point, and a are on features at that point, as far from it.
bool SmallAngles::share_shell(const Standing& a, const Standing& b) const {
  const double away = b.role.label.distance();
  if (polygon_of(b.role) == 0 || away == 0) return false;
  for (const VertexHandle p : store_.polygons()[polygon_of(b.role)].points) {
    const Feature about(store_.points()[p]);
    if (!is_about(std::sqrt(squared_distance(b.v.p, store_.points()[p].p)), away)) continue;
    for (const Feature& f : features_of(a.role)) {
      if (has(f, p) && distance(a, about) == away) return true;
    }
  }
  return false;
}

bool SmallAngles::keeps(const Standing& a, const Standing& b) const {
  if (a.role.on == 0 || b.role.on == 0) return false;
  if (share_shell(a, b) || share_shell(b, a)) return true;
  const double length2 = squared_distance(a.v.p, b.v.p);
  const auto is_wide = [&](const Feature& f, const Feature& g) {
    const Feature h = shared(f, g, a.v.p);
    return h && length2 < std::min(squared_distance(a.v.p, foot(h, a.v.p)),
                                   squared_distance(b.v.p, foot(h, b.v.p)));
  };
  const std::vector<Feature> of_b = features_of(b.role);
  for (const Feature& f : features_of(a.role)) {
    if (on(b, f)) continue;
    for (const Feature& g : of_b) {
      if (!on(a, g) && is_wide(f, g)) return true;
    }
  }
  return false;
}

}  // namespace mesher::detail
