// Joins a graph and its mesh: which vertex and edge is whose, and the part that is wanted.
#include <algorithm>
#include <limits>
#include <unordered_map>
#include <utility>
#include <vector>

#include "facade/graph_runs.hpp"
#include "graph/distinct_ids.hpp"
#include "sac/check.hpp"

namespace mesher {
namespace {

template <class Id>
using Markers = std::unordered_map<Id, std::int64_t>;

// Calls visit(vertex, point) for each point, which is a vertex: both go by place.
template <int D, class Visit>
void for_each_input(const Mesh<D>& mesh, const std::vector<GraphPoint<D>>& all, Visit&& visit) {
  std::vector<const GraphPoint<D>*> points;
  points.reserve(all.size());
  for (const auto& p : all) points.push_back(&p);
  std::sort(points.begin(), points.end(), [](auto* a, auto* b) { return a->at < b->at; });
  std::uint32_t v = 0;
  for (const auto* p : points) {
    while (v < mesh.vertices.size() && mesh.vertices[v] < p->at) ++v;
    SAC_EXPECTS(v < mesh.vertices.size() && mesh.vertices[v] == p->at);
    visit(v, *p);
  }
}

template <int D>
Markers<LineId> line_markers(const Graph<D>& graph) {
  Markers<LineId> markers;
  for (const auto& s : graph.segments) markers.emplace(s.id, s.marker);
  for (const auto& l : graph.polylines) markers.emplace(l.id, l.marker);
  return markers;
}

// There is one region, the box, and it is not enclosed.
template <int D>
DomainMesh<D> bare(Mesh<D> mesh, const Graph<D>& graph) {
  DomainMesh<D> all;
  all.regions.push_back({{}, 0, mesh.simplices.size(), 0, {}});
  all.mesh = MeshData<D>(std::move(mesh));
  all.mesh.features.names = graph.names;
  return all;
}

// Points with their names and markers.
template <int D>
void add_points(const std::vector<GraphPoint<D>>& points, MeshData<D>& data) {
  auto& features = data.features;
  for_each_input<D>(data, points, [&](std::uint32_t v, const GraphPoint<D>& p) {
    features.origins[v] = p.id;
    features.markers[v] = p.marker;
  });
}

}  // namespace

namespace {

template <int D>
RefinedExtent<D> refined(const Graph<D>& graph, Extent extent, RegionAreas areas) {
  RefinedExtent<D> refined{.only_enclosed = extent == Extent::enclosed};
  for (const auto& hole : graph.holes()) refined.holes.push_back(hole.at);
  if (areas == RegionAreas::ignored) return refined;
  std::vector<Seed<D>> regions = graph.regions();
  std::sort(regions.begin(), regions.end(),
            [](const auto& r, const auto& s) { return r.id < s.id; });
  for (const Seed<D>& region : regions) {
    constexpr double kNone = std::numeric_limits<double>::infinity();
    refined.regions.push_back({region.at, region.max_measure.value_or(kNone)});
  }
  return refined;
}

// run(places, features..., ids): with the segments of a graph, and in space its polygons.
template <int D, class Run>
Mesh<D> with_parts(const Graph<D>& graph, Run&& run) {
  if constexpr (D == 2) {
    return run(places_of(graph), segments_of(graph));
  } else {
    return run(places_of(graph), segments_of(graph), graph.polygons);
  }
}

}  // namespace

template <int D>
Mesh<D> mesh_statically(const Graph<D>& graph, const Options<D>& options, MeshStats* stats,
                        const RunControl& control) {
  const std::vector<PointId> ids = detail::ids_of(graph.points);
  if (!has_features(graph))
    return mesh_statically<D>(places_of(graph), options, ids, stats, control);
  return with_parts(graph, [&](const auto&... parts) {
    return mesh_statically(parts..., options, ids, stats, control);
  });
}

template <int D>
Mesh<D> refine(const Graph<D>& graph, const Options<D>& options, Extent extent,
               const RefineSettings& settings, RefineStats* stats, const RunControl& control) {
  const std::vector<PointId> ids = detail::ids_of(graph.points);
  if (!has_features(graph)) {
    return refine<D>(places_of(graph), options, settings, ids, stats, control);
  }
  return with_parts(graph, [&](const auto&... parts) {
    return refine(parts..., options, refined(graph, extent, options.region_areas), settings, ids,
                  stats, control);
  });
}

template <int D>
Mesh<D> svr(const Graph<D>& graph, const Options<D>& options, Extent extent,
            const SvrSettings& settings, SvrStats* stats, const RunControl& control) {
  const std::vector<PointId> ids = detail::ids_of(graph.points);
  if (!has_features(graph)) {
    return svr<D>(places_of(graph), options, settings, ids, stats, control);
  }
  return with_parts(graph, [&](const auto&... parts) {
    return svr(parts..., options, refined(graph, extent, options.region_areas), settings, ids,
               stats, control);
  });
}

MeshData<2> with_features(Mesh<2> mesh, const Graph<2>& graph) {
  MeshData<2> data(std::move(mesh));
  auto& features = data.features;
  features.origins.resize(data.vertices.size());
  features.markers.resize(data.vertices.size());
  const Markers<LineId> markers = line_markers(graph);
  for (const auto& e : data.edges) {
    const LineId line{e.feature.number};
    features.edges.push_back({e.low, e.high, line, markers.at(line)});
    for (const std::uint32_t v : {e.low, e.high}) {
      if (data.kinds[v] == VertexKind::segment) features.origins[v] = line;
    }
  }
  add_points<2>(graph.points, data);
  return data;
}

// --- In space --------------------------------------------------------------------------------

#ifndef MESHER_PLANE_ONLY
namespace {

template <class Id>
std::int64_t marker_of(const Markers<Id>& markers, Id id) {
  const auto it = markers.find(id);
  return it == markers.end() ? 0 : it->second;
}

// Edges without a marker get the least of the faces beside them.
void mark_edges(MeshFeatures& features) {
  std::vector<std::int64_t> least(features.edges.size(), 0);
  const auto look_at = [&](std::uint32_t a, std::uint32_t b, std::int64_t marker) {
    const std::pair<std::uint32_t, std::uint32_t> ends = std::minmax(a, b);
    const auto e = std::lower_bound(
        features.edges.begin(), features.edges.end(), ends,
        [](const MeshEdge& x, const auto& key) { return std::pair(x.low, x.high) < key; });
    if (e == features.edges.end() || std::pair(e->low, e->high) != ends || marker == 0) return;
    std::int64_t& known = least[static_cast<std::size_t>(e - features.edges.begin())];
    known = known == 0 ? marker : std::min(known, marker);
  };
  for (const MeshFace& f : features.faces) {
    const auto [a, b, c] = f.corners;
    look_at(a, b, f.marker);
    look_at(b, c, f.marker);
    look_at(c, a, f.marker);
  }
  for (std::size_t i = 0; i < least.size(); ++i) {
    if (features.edges[i].marker == 0) features.edges[i].marker = least[i];
  }
}

}  // namespace

MeshData<3> with_features(Mesh<3> mesh, const Graph<3>& complex) {
  MeshData<3> data(std::move(mesh));
  auto& features = data.features;
  features.origins.resize(data.vertices.size());
  features.markers.resize(data.vertices.size());
  const Markers<LineId> of_lines = line_markers(complex);
  Markers<PolygonId> of_polygons;
  for (const auto& f : complex.polygons) of_polygons.emplace(f.id, f.marker);
  const auto name = [&](std::uint32_t v, const Feature& id) {
    if (data.kinds[v] == VertexKind::segment) features.origins[v] = id;
  };
  for (const auto& f : data.faces) {
    features.faces.push_back({f.corners, f.polygon, marker_of(of_polygons, f.polygon)});
    for (const std::uint32_t v : f.corners) name(v, f.polygon);
  }
  for (const auto& e : data.edges) {
    const std::optional<LineId> line = e.feature.line();
    const std::int64_t marker = line ? marker_of(of_lines, *line) : 0;
    features.edges.push_back({e.low, e.high, line, marker});
    name(e.low, e.feature);
    name(e.high, e.feature);
  }
  mark_edges(features);
  add_points<3>(complex.points, data);
  return data;
}
#endif

template <int D>
DomainMesh<D> domain_mesh(Mesh<D> mesh, const Graph<D>& graph, Extent extent) {
  if (is_bare(graph)) return bare(std::move(mesh), graph);
  const MeshData<D> whole = with_features(std::move(mesh), graph);
  Domain<D> domain = [&] {
    if constexpr (D == 2) {
      return find_domain(whole, whole.features.edges, graph.seeds, extent);
    } else {
      return find_domain(whole, whole.features.faces, graph.seeds, extent);
    }
  }();
  DomainMesh<D> made{extract(whole, domain).mesh, std::move(domain.regions),
                     std::move(domain.faults), domain.keeps_all};
  made.mesh.features.names = graph.names;
  return made;
}

#define MESHER_INSTANTIATE(D)                                                                     \
  template Mesh<D> mesh_statically(const Graph<D>&, const Options<D>&, MeshStats*,                \
                                   const RunControl&);                                            \
  template Mesh<D> refine(const Graph<D>&, const Options<D>&, Extent, const RefineSettings&,      \
                          RefineStats*, const RunControl&);                                       \
  template Mesh<D> svr(const Graph<D>&, const Options<D>&, Extent, const SvrSettings&, SvrStats*, \
                       const RunControl&);                                                        \
  template DomainMesh<D> domain_mesh(Mesh<D>, const Graph<D>&, Extent)

MESHER_INSTANTIATE(2);
#ifndef MESHER_PLANE_ONLY
MESHER_INSTANTIATE(3);
#endif
#undef MESHER_INSTANTIATE

}  // namespace mesher
