// Which feature a new point is beside, and its parts.
#include "space/guard.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace mesher::detail {

namespace {

bool disjoint(const std::vector<const Edge*>& edges, const std::vector<VertexHandle>& points) {
  if (points.size() > 1) return true;
  for (const Edge* e : edges) {
    if (!points.empty() && !e->has_end(points[0])) return true;
    for (const Edge* t : edges) {
      if (t != e && disjoint(*e, *t)) return true;
    }
  }
  return false;
}

}  // namespace

ShortEdge beside_new(const FeaturesBeside& near, const std::optional<Placed>& yields,
                     const Point<3>& x, double reach) {
  ShortEdge found;
  if (yields) {
    const FeatureStore& store = near.store();
    if (const EdgeHandle e = edge_of(yields->role)) found.edge = &store.edges()[e];
    if (const PolygonHandle f = polygon_of(yields->role)) found.polygon = &store.polygons()[f];
    return found;
  }
  const auto edges = near.edges(x, reach);
  if (!edges.empty()) return found.edge = edges.front(), found;
  for (const Polygon* f : near.polygons(x, reach)) {
    if (is_in_ball(x, reach * reach, *f)) return found.polygon = f, found;
  }
  return found;
}

bool has_two_parts(const ShortEdge& e, const FeatureStore& store) {
  const double reach2 = kIsolated * kIsolated * e.length * e.length;
  std::vector<const Edge*> edges;
  std::vector<VertexHandle> points;
  const auto look_at = [&](VertexHandle v) {
    if (!is_in_ball(e.middle, reach2, store.points()[v])) return;
    if (std::find(points.begin(), points.end(), v) == points.end()) points.push_back(v);
  };
  const auto add = [&](const Edge& part) {
    edges.push_back(&part);
    look_at(part.a), look_at(part.b);
    return points.size() > 1;
  };
  if (e.edge != nullptr) {
    add(*e.edge);
  } else {
    visit_edges_near(*e.polygon, e.middle, std::sqrt(reach2) * (1 + 0x1p-29), [&](EdgeHandle h) {
      const Edge& part = store.edges()[h];
      return is_in_ball(e.middle, reach2, part) && add(part);
    });
    for (const VertexHandle v : e.polygon->inner_points) look_at(v);
  }
  return disjoint(edges, points);
}

}  // namespace mesher::detail
