// Counting the polygons at each edge.
#include "open_surface.hpp"

#include <algorithm>
#include <tuple>
#include <unordered_map>
#include <vector>

namespace tool {

namespace {

// Of a loop, or declared to lie in a polygon.
struct Use {
  mesher::PointId a, b;  // a < b
  mesher::PolygonId polygon;
};

std::vector<Use> uses_of(const mesher::Graph<3>& graph) {
  std::vector<Use> uses;
  const auto add = [&](mesher::PointId a, mesher::PointId b, mesher::PolygonId polygon) {
    uses.push_back({std::min(a, b), std::max(a, b), polygon});
  };
  for (const mesher::Polygon& f : graph.polygons) {
    for (const auto& loop : f.loops) {
      for (std::size_t i = 0; i < loop.size(); ++i) add(loop[i], loop[(i + 1) % loop.size()], f.id);
    }
    for (const auto& [a, b] : f.edges) add(a, b, f.id);
  }
  std::sort(uses.begin(), uses.end(), [](const Use& x, const Use& y) {
    return std::tie(x.a, x.b, x.polygon) < std::tie(y.a, y.b, y.polygon);
  });
  return uses;
}

}  // namespace

std::optional<OpenSurface> open_surface(const mesher::Graph<3>& graph, const mesher::Mesh<3>& mesh,
                                        bool keeps_all) {
  if (graph.polygons.empty()) return std::nullopt;
  std::unordered_map<mesher::PointId, mesher::Point<3>> places;
  places.reserve(graph.points.size());
  for (const auto& p : graph.points) places.emplace(p.id, p.at);
  const auto is_kept = [&](mesher::PointId id) {
    return std::binary_search(mesh.vertices.begin(), mesh.vertices.end(), places.at(id));
  };
  OpenSurface open;
  const std::vector<Use> uses = uses_of(graph);
  for (std::size_t i = 0, end = 0; i < uses.size(); i = end) {
    const Use& use = uses[i];
    while (end < uses.size() && uses[end].a == use.a && uses[end].b == use.b) ++end;
    if (end - i > 1 || (!keeps_all && is_kept(use.a) && is_kept(use.b))) continue;
    if (open.edges++ == 0) {
      open.from = places.at(use.a), open.to = places.at(use.b), open.polygon = use.polygon;
    }
  }
  return open.edges == 0 ? std::nullopt : std::optional(open);
}

}  // namespace tool
