// Tests of pairs.
#include "space/validity.hpp"

#include <algorithm>
#include <tuple>

#include "sets/common_items.hpp"

namespace mesher::detail {

namespace {

using Kind = SpaceConflict::Kind;

double resolution_of(const Edge& e) {
  return resolution(scaled(0.5, plus(e.place_a, e.place_b)), e.length / 2);
}

double height_of(const Polygon& f, const Point<3>& x) { return std::abs(f.plane.height(x)); }
bool is_on(const Polygon& f, const Point<3>& x) {
  return height_of(f, x) <= f.thickness && contains(f, x);
}

Point<3> middle_of(VertexHandle v, VertexHandle w, const FeatureStore& store) {
  return scaled(0.5, plus(store.points()[v].p, store.points()[w].p));
}

// Points that both have, in the order along the line that they are on; nothing if they are one
// place or none.
std::vector<VertexHandle> common_points(const Polygon& f, const Polygon& g,
                                        const FeatureStore& store) {
  std::vector<VertexHandle> all;
  visit_common(f.points, g.points, [&](VertexHandle v) { return all.push_back(v), false; });
  const auto place = [&](VertexHandle v) { return store.points()[v].p; };
  const auto farther = [&](const Point<3>& from) {
    return [&, from](VertexHandle v, VertexHandle w) {
      return squared_distance(place(v), from) < squared_distance(place(w), from);
    };
  };
  if (all.size() < 2) return {};
  const VertexHandle first = *std::min_element(all.begin(), all.end(),
                                               [&](auto v, auto w) { return place(v) < place(w); });
  const Point<3> end = place(*std::max_element(all.begin(), all.end(), farther(place(first))));
  std::sort(all.begin(), all.end(), farther(end));
  return all;
}

// `points`: those that both have.
std::vector<std::array<VertexHandle, 2>> uncut(const Polygon& f, const Polygon& g,
                                               const std::vector<VertexHandle>& points,
                                               const FeatureStore& store) {
  std::vector<std::array<VertexHandle, 2>> all;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Edge* e = store.find_edge(points[i - 1], points[i]);
    if (e != nullptr && f.has_edge(e->self) && g.has_edge(e->self)) continue;
    const Point<3> middle = middle_of(points[i - 1], points[i], store);
    if (contains(f, middle) && contains(g, middle)) all.push_back({points[i - 1], points[i]});
  }
  return all;
}

bool lies_in_plane(const Polygon& f, const Polygon& g) {
  return std::all_of(f.places.begin(), f.places.end(), [&](const Point<3>& p) {
    return height_of(g, p) <= f.thickness + g.thickness;
  });
}

// Which side of its edge a polygon is on: one, or both for an edge that lies inside.
struct Side {
  bool both = false;
  Point<3> inward{};
};
Side side_of(const Polygon& f, EdgeHandle e) {
  const std::uint32_t corner = f.corner_at(e);
  if (corner == Polygon::kInner) return {true, {}};
  return {false, inward(f, corner)};
}

}  // namespace

// The one with fewer corners is looked at first.
bool lie_in_one_plane(const Polygon& f, const Polygon& g) {
  const bool fewer = f.places.size() <= g.places.size();
  return fewer ? lies_in_plane(f, g) || lies_in_plane(g, f)
               : lies_in_plane(g, f) || lies_in_plane(f, g);
}

std::optional<SpaceConflict> overlap(const Polygon& f, const Polygon& g,
                                     const FeatureStore& store) {
  std::optional<SpaceConflict> first;
  visit_common(f.all_edges, g.all_edges, [&](EdgeHandle e) {
    const Side of_f = side_of(f, e), of_g = side_of(g, e);
    if (!of_f.both && !of_g.both && dot(of_f.inward, of_g.inward) < 0) return false;
    first = SpaceConflict{Kind::overlapping_polygons, Feature(f), Feature(g),
                          middle_of(store.edges()[e])};
    return true;
  });
  return first;
}

std::vector<std::array<VertexHandle, 2>> uncut(const Polygon& f, const Polygon& g,
                                               const FeatureStore& store) {
  return uncut(f, g, common_points(f, g, store), store);
}

std::optional<SpaceConflict> conflict_with(const Vertex<3>& v, const Edge& e) {
  const double most = resolution_of(e);
  if (e.has_end(v.self) || distance2_to(v.p, e) > most * most) return std::nullopt;
  return SpaceConflict{Kind::point_on_edge, Feature(v), Feature(e), v.p};
}

std::optional<SpaceConflict> conflict_with(const Vertex<3>& v, const Polygon& f) {
  if (f.has(v.self) || !is_on(f, v.p)) return std::nullopt;
  return SpaceConflict{Kind::point_on_polygon, Feature(v), Feature(f), v.p};
}

std::optional<SpaceConflict> conflict_with(const Edge& e, const Edge& t) {
  if (!disjoint(e, t)) return std::nullopt;
  const double most = std::max(resolution_of(e), resolution_of(t));
  if (distance2(e.place_a, e.place_b, t.place_a, t.place_b) > most * most) return std::nullopt;
  return SpaceConflict{Kind::crossing_edges, Feature(e), Feature(t),
                       nearest_place(e.place_a, e.place_b, t.place_a, t.place_b)};
}

std::optional<SpaceConflict> conflict_with(const Edge& e, const Polygon& f) {
  if (f.has_edge(e.self) || f.has(e.a) != f.has(e.b)) return std::nullopt;
  if (f.has(e.a)) {
    if (!contains(f, middle_of(e))) return std::nullopt;
    return SpaceConflict{Kind::edge_on_polygon, Feature(e), Feature(f), middle_of(e)};
  }
  if (is_on(f, e.place_a) || is_on(f, e.place_b)) return std::nullopt;  // its end is a conflict
  const auto at = crossing(e.place_a, e.place_b, f);
  if (!at) return std::nullopt;
  return SpaceConflict{Kind::edge_through_polygon, Feature(e), Feature(f), *at};
}

std::optional<SpaceConflict> conflict_with(const Polygon& f, const Polygon& g,
                                           const FeatureStore& store) {
  if (f.self == g.self) return std::nullopt;
  const std::vector<VertexHandle> points = common_points(f, g, store);
  if (points.empty()) return std::nullopt;
  if (lie_in_one_plane(f, g)) return overlap(f, g, store);
  const auto gaps = uncut(f, g, points, store);
  if (gaps.empty()) return std::nullopt;
  return SpaceConflict{Kind::crossing_polygons, Feature(f), Feature(g),
                       middle_of(gaps[0][0], gaps[0][1], store)};
}

void keep_first(std::optional<SpaceConflict>& first, const std::optional<SpaceConflict>& conflict) {
  const auto key = [](const SpaceConflict& c) { return std::tuple(c.kind, c.at); };
  if (!conflict) return;
  if (!first || key(*conflict) < key(*first)) first = conflict;
}

std::optional<SpaceConflict> conflict_of(const Vertex<3>& v, FeatureStore& store) {
  std::optional<SpaceConflict> first;
  const FeatureExtent<3> where = validity::widened(extent_of(v));
  store.visit_near(where.p, where.q, where.slack, [&](const auto& f) {
    keep_first(first, conflict_with(v, f));
    return false;
  });
  return first;
}

}  // namespace mesher::detail
