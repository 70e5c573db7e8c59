// By labels: an edge borders the rest if the rest is on one side of it.
#include "repair/rest_of.hpp"

#include <algorithm>
#include <map>

#include "sets/make_set.hpp"

namespace mesher::detail {

namespace {

// Closed walks along edges; nothing if a point has an odd number of them.
std::optional<std::vector<Loop>> walks(const std::vector<EdgeHandle>& edges,
                                       const FeatureStore& store) {
  std::map<VertexHandle, std::vector<VertexHandle>> ahead;
  for (const EdgeHandle h : edges) {
    const Edge& e = store.edges()[h];
    ahead[e.a].push_back(e.b);
    ahead[e.b].push_back(e.a);
  }
  for (const auto& [v, ends] : ahead) {
    if (ends.size() % 2 != 0) return std::nullopt;
  }
  std::vector<Loop> loops;
  for (auto& [start, ends] : ahead) {
    while (!ends.empty()) {
      Loop loop;
      VertexHandle v = start;
      do {
        loop.push_back(v);
        const VertexHandle w = ahead.at(v).back();
        ahead.at(v).pop_back();
        auto& back = ahead.at(w);
        back.erase(std::find(back.begin(), back.end(), v));
        v = w;
      } while (v != start);
      loops.push_back(std::move(loop));
    }
  }
  return loops;
}

// Which sides of an edge are on a polygon that has it: the left one of its direction, and the
// right.
struct Sides {
  bool left = false, right = false;
};
Sides sides_of(const Polygon& f, EdgeHandle h, const Point<3>& left) {
  const std::uint32_t corner = f.corner_at(h);
  if (corner == Polygon::kInner) return {true, true};
  const bool is_left = dot(inward(f, corner), left) > 0;
  return {is_left, !is_left};
}

}  // namespace

// An edge borders the rest if that is on one of its sides: there g is, and no other.
std::optional<std::vector<Loop>> rest_of(const Polygon& g,
                                         const std::vector<const Polygon*>& others,
                                         const FeatureStore& store) {
  std::vector<EdgeHandle> borders;
  for (const EdgeHandle h : g.all_edges) {
    const Edge& e = store.edges()[h];
    const Point<3> left = cross(g.plane.normal, minus(e.place_b, e.place_a));
    Sides rest = sides_of(g, h, left);
    for (const Polygon* f : others) {
      if (!f->has_edge(h)) continue;
      const Sides covered = sides_of(*f, h, left);
      rest = {rest.left && !covered.left, rest.right && !covered.right};
    }
    if (rest.left != rest.right) borders.push_back(h);
  }
  std::vector<EdgeHandle> edges = g.edges;
  make_set(edges);
  if (borders == edges) return std::nullopt;
  return walks(borders, store);
}

}  // namespace mesher::detail
