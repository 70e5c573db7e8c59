// Turning vertices about what features share.
#include "space/small_angles.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "space/feature_search.hpp"

namespace mesher::detail {

namespace {

// A place is turned by up to the angle with this cosine, somewhat more than that beyond which its
// foot yields to what the features share: at an angle t the foot is sin(t) from the place and
// cos(t) from there, and yields if cos(t) <= kYields sin(t), from 63.44 degrees on.
constexpr double kTurned = 0.44;

// The cosine of the angle at which polygons lean on each other, and how far beside the hinge, in
// its lengths, a vertex may be.
constexpr double kLeans = 0.7071;
constexpr double kBesideHinge = 0x1p-30;

Point<3> place_on_line(const Edge& e, double fraction) {
  return plus(e.place_a, scaled(fraction, minus(e.place_b, e.place_a)));
}

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

template <class Visit>
bool SmallAngles::visit_features_of(const Standing& v, Visit&& visit) const {
  if (const PolygonHandle f = polygon_of(v.role)) return visit(Feature(store_.polygons()[f]));
  const EdgeHandle e = edge_of(v.role);
  if (e == 0) return false;
  if (visit(Feature(store_.edges()[e]))) return true;
  const auto polygons = near_.polygons_at(store_.edges()[e], v.v.p);
  return std::any_of(polygons.begin(), polygons.end(),
                     [&](PolygonHandle f) { return visit(Feature(store_.polygons()[f])); });
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

// The distance of v from a point of its features that is part of what v is: as an edge's end, or
// since v is a copy about the point. 0: there is none.
double SmallAngles::shell(const Standing& v, VertexHandle point) const {
  const Label& label = v.role.label;
  if (const EdgeHandle h = edge_of(v.role)) {
    const Edge& e = store_.edges()[h];
    return e.has_end(point) ? label.from(e.b == point, e.length) : 0;
  }
  const double away = std::sqrt(squared_distance(v.v.p, store_.points()[point].p));
  const double rounding = away * 0x1p-40 + resolution(v.v.p, 0);
  return std::abs(away - label.distance()) <= rounding ? label.distance() : 0;
}

// Of v from h; as labels say where they do, so that a copy of a copy is as far, bit for bit.
double SmallAngles::distance(const Standing& v, const Feature& h) const {
  const double known = h.kind() == Feature::Kind::point ? shell(v, h.handle()) : 0;
  return known != 0 ? known : std::sqrt(squared_distance(v.v.p, foot(h, v.v.p)));
}

// To be turned about h leaves v as far from a point as it is: from h itself, or from an end of h.
double SmallAngles::kept_shell(const Standing& v, const Feature& h) const {
  if (h.kind() == Feature::Kind::point) return distance(v, h);
  const Edge& e = store_.edges()[h.handle()];
  const double from_a = shell(v, e.a), from_b = shell(v, e.b);
  return from_a == 0 || (from_b != 0 && from_b < from_a) ? from_b : from_a;
}

// At v's distance from what g shares with a feature of v, on the way to the foot of v on g.
template <class Foot>
auto SmallAngles::turned(const Standing& v, const Feature& g, Foot&& foot_on_g) const
    -> std::optional<Turned> {
  std::optional<Turned> found;
  visit_features_of(v, [&](const Feature& f) {
    const Feature h = shared(f, g, v.v.p);
    if (!h || h == f || h == g) return false;
    const Point<3> hinge = foot(h, v.v.p);
    const double away = distance(v, h);
    const Point<3> to = minus(foot_on_g(v.v.p), hinge);
    const double cosine = std::sqrt(squared(to)) / away;
    if (away == 0 || cosine < kTurned) return false;
    found = Turned{plus(hinge, scaled(1 / cosine, to)), h, away};
    return true;
  });
  return found;
}

bool SmallAngles::leans(const Standing& v, const Polygon& g) const {
  const Point<3> foot_on_g = g.plane.foot(v.v.p);
  return visit_features_of(v, [&](const Feature& f) {
    const Feature h = shared(f, Feature(g), v.v.p);
    if (h.kind() != Feature::Kind::edge || h == f) return false;
    const double at = foot_fraction(store_.edges()[h.handle()], v.v.p);
    if (!(at > -kBesideHinge && at < 1 + kBesideHinge)) return false;
    const Point<3> hinge = foot(h, v.v.p);
    const Point<3> to = minus(foot_on_g, hinge), from = minus(v.v.p, hinge);
    const double to2 = squared(to), from2 = squared(from);
    return to2 > kLeans * kLeans * from2 && dot(to, from) > 0 &&
           contains(g, plus(hinge, scaled(std::sqrt(from2 / to2), to)));
  });
}

std::optional<Placed> SmallAngles::copy(const Standing& v, const Edge& g) const {
  const auto turned_to = turned(
      v, Feature(g), [&](const Point<3>& p) { return place_on_line(g, foot_fraction(g, p)); });
  if (!turned_to) return std::nullopt;
  const bool about_a = turned_to->about.handle() == g.a;
  const double from_a = about_a ? turned_to->away : g.length - turned_to->away;
  if (!(from_a > 0 && from_a < g.length)) return std::nullopt;
  const bool near = turned_to->away <= g.length / 2;
  return placed_on(g, near ? Label(turned_to->away, !about_a) : label_at(g, from_a));
}

// On an edge of g if it is there.
std::optional<Placed> SmallAngles::copy(const Standing& v, const Polygon& g) const {
  const auto turned_to = turned(v, Feature(g), [&](const Point<3>& p) { return g.plane.foot(p); });
  if (!turned_to || !contains(g, turned_to->x)) return std::nullopt;
  if (const EdgeHandle h = edge_at(g, turned_to->x, turned_to->away)) {
    const Edge& e = store_.edges()[h];
    const double at = foot_fraction(e, turned_to->x);
    if (at > 0 && at < 1) return placed_on(e, label_at(e, at * e.length));
    return std::nullopt;
  }
  return placed_on(g, turned_to->x, kept_shell(v, turned_to->about));
}

// Of the edges on g that x, turned about something this far away, is on the nearest, of equally
// near ones the first by its places; 0: none. x is in g's plane, which edges may be off.
EdgeHandle SmallAngles::edge_at(const Polygon& g, const Point<3>& x, double away) const {
  const double rounding = 0x1p-30 * away + g.thickness;
  const Edge* nearest = nullptr;
  const auto key = [&](const Edge& e) {
    return std::tuple(distance2_to(x, e), e.place_a, e.place_b);
  };
  visit_edges_near(g, x, rounding, [&](EdgeHandle h) {
    const Edge& e = store_.edges()[h];
    const bool is_on_it = distance2_to(x, e) <= rounding * rounding;
    if (is_on_it && (nearest == nullptr || key(e) < key(*nearest))) nearest = &e;
    return false;
  });
  return nearest == nullptr ? 0 : nearest->self;
}

// Whether b, a copy about a point, and a are on features at that point, as far from it.
bool SmallAngles::share_shell(const Standing& a, const Standing& b) const {
  const double distance = b.role.label.distance();
  if (polygon_of(b.role) == 0 || distance == 0) return false;
  const auto is_shared = [&](VertexHandle p) {
    const double away = shell(b, p);
    return away != 0 && shell(a, p) == away &&
           visit_features_of(a, [&](const Feature& f) { return has(f, p); });
  };
  return visit_points_at(store_.polygons()[polygon_of(b.role)], b.v.p, distance, is_shared);
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
  return visit_features_of(a, [&](const Feature& f) {
    return !on(b, f) &&
           visit_features_of(b, [&](const Feature& g) { return !on(a, g) && is_wide(f, g); });
  });
}

}  // namespace mesher::detail
