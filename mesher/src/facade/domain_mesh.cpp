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
template <int D, class Visit>
void for_each_input(const Mesh<D>& mesh, const std::vector<MarkedPoint<D>>& all, Visit&& visit) {
  std::vector<const MarkedPoint<D>*> points;
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

Markers line_markers(const Pslg& graph) {
  Markers markers;
  for (const auto& s : graph.segments) markers.emplace(s.id, s.marker);
  for (const auto& l : graph.polylines) markers.emplace(l.id, l.marker);
  return markers;
}

// There is one region, the box, and it is not enclosed.
template <int D>
DomainMeshOf<D> bare(Mesh<D> mesh) {
  DomainMeshOf<D> all;
  all.regions.push_back({{}, 0, mesh.simplices.size(), 0, {}});
  all.kept = MeshDataOf<D>(std::move(mesh));
  return all;
}

template <class Points>
bool has_no_markers(const Points& points) {
  return std::all_of(points.begin(), points.end(), [](const auto& p) { return p.marker == 0; });
}

template <class Points>
auto places(const Points& points) {
  std::vector<std::decay_t<decltype(points.front().at)>> all;
  all.reserve(points.size());
  for (const auto& p : points) all.push_back(p.at);
  return all;
}

template <class Points>
std::vector<FeatureId> ids_of(const Points& points) {
  std::vector<FeatureId> ids;
  ids.reserve(points.size());
  for (const auto& p : points) ids.push_back(p.id);
  return ids;
}

// Points with their names and markers.
template <int D>
void add_points(const std::vector<MarkedPoint<D>>& points, MeshDataOf<D>& data) {
  auto& features = data.features;
  for_each_input<D>(data, points, [&](std::uint32_t v, const MarkedPoint<D>& p) {
    features.origins[v] = p.id;
    features.markers[v] = p.marker;
  });
}

}  // namespace

bool is_bare(const Pslg& graph) {
  return graph.segments.empty() && graph.polylines.empty() && graph.holes.empty() &&
         graph.regions.empty() && has_no_markers(graph.points);
}
bool is_bare(const Plc& complex) {
  return complex.segments.empty() && complex.facets.empty() && complex.holes.empty() &&
         complex.regions.empty() && has_no_markers(complex.points);
}

std::vector<Point<2>> places_of(const Pslg& graph) { return places(graph.points); }
std::vector<Point<3>> places_of(const Plc& complex) { return places(complex.points); }

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
    graph.regions.push_back({seed.name.id, seed.at, seed.attribute, seed.max_measure});
  }
}

void add_seed(Plc& complex, const SeedOf<3>& seed) {
  if (seed.name.kind == SeedKind::hole) {
    complex.holes.push_back({seed.name.id, seed.at});
  } else {
    complex.regions.push_back({seed.name.id, seed.at, seed.attribute, seed.max_measure});
  }
}

Mesh<2> mesh_statically(const Pslg& graph, const Options<2>& options, MeshStats* stats,
                        const RunControl& control) {
  const std::vector<FeatureId> ids = ids_of(graph.points);
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
  add_points<2>(graph.points, data);
  return data;
}

DomainMesh domain_mesh(Mesh<2> mesh, const Pslg& graph, Extent extent) {
  if (is_bare(graph)) return bare(std::move(mesh));
  const MeshData whole = with_features(std::move(mesh), graph);
  Domain domain = find_domain(whole, whole.features.edges, seeds_of(graph), extent);
  return {extract(whole, domain).mesh, std::move(domain.regions), std::move(domain.faults),
          domain.keeps_all};
}

// --- In space --------------------------------------------------------------------------------

namespace {

std::int64_t marker_of(const Markers& markers, FeatureId id) {
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

std::vector<Segment> segments_of(const Plc& complex) {
  std::vector<Segment> all;
  for (const auto& s : complex.segments) all.push_back({s.id, s.from, s.to});
  return all;
}

std::vector<Polygon> polygons_of(const Plc& complex) {
  std::vector<Polygon> all;
  for (const auto& f : complex.facets) all.push_back(f.polygon);
  return all;
}

std::vector<SeedOf<3>> seeds_of(const Plc& complex) {
  std::vector<SeedOf<3>> seeds;
  for (const auto& h : complex.holes) seeds.push_back({{SeedKind::hole, h.id}, h.seed, 0, {}});
  for (const auto& r : complex.regions) {
    seeds.push_back({{SeedKind::region, r.id}, r.seed, r.attribute, r.max_volume});
  }
  return seeds;
}

Mesh<3> mesh_statically(const Plc& complex, const Options<3>& options, MeshStats* stats,
                        const RunControl& control) {
  const std::vector<FeatureId> ids = ids_of(complex.points);
  const auto segments = segments_of(complex);
  const auto polygons = polygons_of(complex);
  if (segments.empty() && polygons.empty()) {
    return mesh_statically<3>(places_of(complex), options, ids, stats, control);
  }
  return mesh_statically(places_of(complex), segments, polygons, options, ids, stats, control);
}

namespace {

template <int D>
RefinedExtentOf<D> refined(const GraphOf<D>& graph, Extent extent) {
  RefinedExtentOf<D> refined{.only_enclosed = extent == Extent::enclosed};
  for (const auto& hole : graph.holes) refined.holes.push_back(hole.seed);
  return refined;
}

}  // namespace

Mesh<2> refine(const Pslg& graph, const Options<2>& options, Extent extent,
               const RefineSettings& settings, RefineStats* stats, const RunControl& control) {
  return refine(places_of(graph), segments_of(graph), options, refined<2>(graph, extent), settings,
                ids_of(graph.points), stats, control);
}

Mesh<2> svr(const Pslg& graph, const Options<2>& options, Extent extent,
            const SvrSettings& settings, SvrStats* stats, const RunControl& control) {
  return svr(places_of(graph), segments_of(graph), options, refined<2>(graph, extent), settings,
             ids_of(graph.points), stats, control);
}

Mesh<3> refine(const Plc& complex, const Options<3>& options, Extent extent,
               const RefineSettings& settings, RefineStats* stats, const RunControl& control) {
  return refine(places_of(complex), segments_of(complex), polygons_of(complex), options,
                refined<3>(complex, extent), settings, ids_of(complex.points), stats, control);
}

Mesh<3> svr(const Plc& complex, const Options<3>& options, Extent extent,
            const SvrSettings& settings, SvrStats* stats, const RunControl& control) {
  return svr(places_of(complex), segments_of(complex), polygons_of(complex), options,
             refined<3>(complex, extent), settings, ids_of(complex.points), stats, control);
}

MeshDataOf<3> with_features(Mesh<3> mesh, const Plc& complex) {
  MeshDataOf<3> data(std::move(mesh));
  auto& features = data.features;
  features.origins.resize(data.vertices.size());
  features.markers.resize(data.vertices.size());
  Markers of_segments, of_polygons;
  for (const auto& s : complex.segments) of_segments.emplace(s.id, s.marker);
  for (const auto& f : complex.facets) of_polygons.emplace(f.polygon.id, f.marker);
  const auto name = [&](std::uint32_t v, FeatureId id) {
    if (data.kinds[v] == VertexKind::segment) features.origins[v] = id;
  };
  for (const auto& f : data.faces) {
    features.faces.push_back({f.corners, f.polygon, marker_of(of_polygons, f.polygon)});
    for (const std::uint32_t v : f.corners) name(v, f.polygon);
  }
  for (const auto& e : data.edges) {
    const auto line = e.of_polygon ? std::optional<FeatureId>() : e.line;
    const std::int64_t marker = e.of_polygon ? 0 : marker_of(of_segments, e.line);
    features.edges.push_back({e.low, e.high, line, marker});
    name(e.low, e.line);
    name(e.high, e.line);
  }
  mark_edges(features);
  add_points<3>(complex.points, data);
  return data;
}

DomainMeshOf<3> domain_mesh(Mesh<3> mesh, const Plc& complex, Extent extent) {
  if (is_bare(complex)) return bare(std::move(mesh));
  const MeshDataOf<3> whole = with_features(std::move(mesh), complex);
  DomainOf<3> domain = find_domain(whole, whole.features.faces, seeds_of(complex), extent);
  return {extract(whole, domain).mesh, std::move(domain.regions), std::move(domain.faults),
          domain.keeps_all};
}

}  // namespace mesher
