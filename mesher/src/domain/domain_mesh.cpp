// Joins a graph and its mesh: which vertex and edge is whose, and the part that is wanted.
#include "mesher/domain_mesh.hpp"

#include <algorithm>
#include <unordered_map>
#include <utility>

#include "sac/check.hpp"

namespace mesher {
namespace {

using Markers = std::unordered_map<FeatureId, std::int64_t>;

// Calls visit(vertex, point) for each point, which is a vertex: both go by place.
template <class Visit>
void for_each_input(const Mesh<2>& mesh, const Pslg& graph, Visit&& visit) {
  std::vector<const Pslg::Vertex*> points;
  points.reserve(graph.points.size());
  for (const auto& p : graph.points) points.push_back(&p);
  std::sort(points.begin(), points.end(), [](auto* a, auto* b) { return a->at < b->at; });
  std::uint32_t v = 0;
  for (const auto* p : points) {
    while (v < mesh.vertices.size() && mesh.vertices[v] < p->at) ++v;
    SAC_EXPECTS(v < mesh.vertices.size() && mesh.vertices[v] == p->at);
    visit(v, *p);
  }
}

Markers line_markers(const Pslg& graph) {
  Markers markers;
  for (const auto& s : graph.segments) markers.emplace(s.id, s.marker);
  for (const auto& l : graph.polylines) markers.emplace(l.id, l.marker);
  return markers;
}

// There is one region, the box, and it is not enclosed.
DomainMesh bare(Mesh<2> mesh) {
  DomainMesh all;
  all.regions.push_back({{}, 0, mesh.simplices.size(), 0, {}});
  all.kept = MeshData(std::move(mesh));
  return all;
}

}  // namespace

bool is_bare(const Pslg& graph) {
  return graph.segments.empty() && graph.polylines.empty() && graph.holes.empty() &&
         graph.regions.empty() &&
         std::all_of(graph.points.begin(), graph.points.end(),
                     [](const auto& p) { return p.marker == 0; });
}

std::vector<Point<2>> places_of(const Pslg& graph) {
  std::vector<Point<2>> places;
  places.reserve(graph.points.size());
  for (const auto& p : graph.points) places.push_back(p.at);
  return places;
}

std::vector<Segment> segments_of(const Pslg& graph) {
  std::vector<Segment> all;
  for (const auto& s : graph.segments) all.push_back({s.id, s.from, s.to});
  for (const auto& l : graph.polylines) {
    for (std::size_t i = 1; i < l.points.size(); ++i) {
      all.push_back({l.id, l.points[i - 1], l.points[i]});
    }
  }
  return all;
}

std::vector<Seed> seeds_of(const Pslg& graph) {
  std::vector<Seed> seeds;
  for (const auto& h : graph.holes) seeds.push_back({{SeedKind::hole, h.id}, h.seed, 0, {}});
  for (const auto& r : graph.regions) {
    seeds.push_back({{SeedKind::region, r.id}, r.seed, r.attribute, r.max_area});
  }
  return seeds;
}

void add_seed(Pslg& graph, const Seed& seed) {
  if (seed.name.kind == SeedKind::hole) {
    graph.holes.push_back({seed.name.id, seed.at});
  } else {
    graph.regions.push_back({seed.name.id, seed.at, seed.attribute, seed.max_area});
  }
}

Mesh<2> mesh_statically(const Pslg& graph, const Options<2>& options, MeshStats* stats,
                        const RunControl& control) {
  std::vector<FeatureId> ids;
  ids.reserve(graph.points.size());
  for (const auto& p : graph.points) ids.push_back(p.id);
  const std::vector<Segment> segments = segments_of(graph);
  if (segments.empty()) return mesh_statically<2>(places_of(graph), options, ids, stats, control);
  return mesh_statically(places_of(graph), segments, options, ids, stats, control);
}

MeshData with_features(Mesh<2> mesh, const Pslg& graph) {
  MeshData data(std::move(mesh));
  auto& features = data.features;
  features.origins.resize(data.vertices.size());
  features.markers.resize(data.vertices.size());
  const Markers markers = line_markers(graph);
  for (const auto& e : data.edges) {
    features.edges.push_back({e.low, e.high, e.line, markers.at(e.line)});
    for (const std::uint32_t v : {e.low, e.high}) {
      if (data.kinds[v] == VertexKind::segment) features.origins[v] = e.line;
    }
  }
  for_each_input(data, graph, [&](std::uint32_t v, const Pslg::Vertex& p) {
    features.origins[v] = p.id;
    features.markers[v] = p.marker;
  });
  return data;
}

DomainMesh domain_mesh(Mesh<2> mesh, const Pslg& graph, Extent extent) {
  if (is_bare(graph)) return bare(std::move(mesh));
  const MeshData whole = with_features(std::move(mesh), graph);
  Domain domain = find_domain(whole, whole.features.edges, seeds_of(graph), extent);
  return {extract(whole, domain).mesh, std::move(domain.regions), std::move(domain.faults),
          domain.keeps_all};
}

}  // namespace mesher
