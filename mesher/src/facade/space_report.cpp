// What an update has changed of the parts of segments and polygons.
//
// Whether an edge of the mesh is a part of a segment, or a face one of a polygon, depends on its
// corners, on the tetrahedra at it, which are in the stars of all its corners, and on the feature.
// So what has come or gone has all its corners among the vertices with another star; or one of
// them has become another kind, and the rest are its neighbours; or it is of a feature that has
// come or gone, and the corners are those that the feature had, or have become its own; or a
// feature is called otherwise, and the corners are all of its vertices.
#include <algorithm>
#include <set>

#include "facade/space_state.hpp"
#include "program/triangulate.hpp"
#include "program/world_impl.hpp"
#include "sets/make_set.hpp"
#include "sets/report_difference.hpp"
#include "space/parts_in_mesh.hpp"
#include "space/placed.hpp"

namespace mesher::detail {

namespace {

using LineEdges = std::vector<mesher::LineEdge<3>>;
using PolygonFaces = std::vector<mesher::PolygonFace<3>>;

LineEdges placed(const std::vector<LineEdge>& edges, const VertexPool<3>& pool) {
  LineEdges all;
  for (const LineEdge& e : edges) {
    all.push_back(edge_between(pool[e.from].p, pool[e.to].p, e.name));
  }
  return all;
}

PolygonFaces placed(const std::vector<PolygonFace>& faces, const VertexPool<3>& pool) {
  PolygonFaces all;
  for (const PolygonFace& f : faces) {
    const auto& [a, b, c] = f.corners;
    all.push_back({{pool[a].p, pool[b].p, pool[c].p}, f.polygon});
    std::sort(all.back().corners.begin(), all.back().corners.end());
  }
  return all;
}

bool is_on_feature(VertexKind kind) {
  return kind == VertexKind::input || kind == VertexKind::segment;
}

}  // namespace

// --- Where to look ---------------------------------------------------------------------------

void SpaceState::list_neighbours(VertexHandle v, std::vector<VertexHandle>& all) const {
  vertices().for_each_simplex_at(
      pool()[v], [&](const Simplex& s) { all.insert(all.end(), s.begin() + 1, s.end()); });
}

void SpaceState::list_on(const Edge& e, std::vector<VertexHandle>& all) const {
  all.push_back(e.b);
  parts_.list_ends(e.self, e.a, all);
}

void SpaceState::list_on(const Polygon& f, std::vector<VertexHandle>& all) const {
  all.insert(all.end(), f.points.begin(), f.points.end());
  for (const EdgeHandle e : f.all_edges) list_on(store().edges()[e], all);
}

// `all` has the vertices on its edges. Each inside is next to one of these, or to another inside.
void SpaceState::list_inside(const Polygon& f, std::vector<VertexHandle>& all) const {
  std::set<VertexHandle> inside;
  std::vector<VertexHandle> near;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!pool()[all[i]].alive) continue;
    near.clear();
    list_neighbours(all[i], near);
    for (const VertexHandle v : near) {
      const bool is_inside = pool()[v].on_segment && polygon_of(vertices().roles()[v]) == f.self;
      if (is_inside && inside.insert(v).second) all.push_back(v);
    }
  }
}

// The corners of all parts that may have come or gone, ascending.
std::vector<VertexHandle> SpaceState::disturbed(const Log& log) const {
  std::vector<VertexHandle> all = log.touched;
  for (const auto* simplices : {&log.simplices_gone, &log.simplices_come}) {
    for (const Simplex& s : *simplices) all.insert(all.end(), s.begin(), s.end());
  }
  for (const VertexHandle h : log.touched) {
    const Vertex<3>& v = pool()[h];
    const bool stayed = v.alive && v.committed;
    if (stayed && (is_on_feature(v.kind()) || is_on_feature(v.committed_kind))) {
      list_neighbours(h, all);
    }
  }
  const auto& edges = store().edges();
  for (const EdgeHandle e : segment_names_.taken()) list_on(edges[e], all);
  for (const EdgeHandle e : segment_names_.added()) list_on(edges[e], all);
  const auto& polygons = store().polygons();
  for (const PolygonHandle h : polygon_names_.taken()) {
    const Polygon& f = polygons[h];
    std::vector<VertexHandle> on;
    list_on(f, on);
    if (f.alive) list_inside(f, on);  // it has another id now
    all.insert(all.end(), on.begin(), on.end());
  }
  for (const PolygonHandle f : polygon_names_.added()) list_on(polygons[f], all);
  make_set(all);
  return all;
}

// --- What is there ---------------------------------------------------------------------------

// All parts at these vertices, and some others.
OnFeatures SpaceState::parts_at(const std::vector<VertexHandle>& at) const {
  std::vector<Simplex> simplices;
  for (const VertexHandle h : at) {
    const Vertex<3>& v = pool()[h];
    if (!v.alive || !is_on_feature(v.kind())) continue;
    const auto is_first = [&](VertexHandle w) {  // of the corners at which its star is looked at
      return w > h || !is_on_feature(pool()[w].kind()) ||
             !std::binary_search(at.begin(), at.end(), w);
    };
    vertices().for_each_simplex_at(v, [&](const Simplex& s) {
      if (std::all_of(s.begin() + 1, s.end(), is_first)) simplices.push_back(s);
    });
  }
  return on_features(simplices);
}

// By places: a vertex may have gone, and another have come to its place.
void SpaceState::report_features(const Log& log, Change<3>& change) {
  if (store().live_edges() == 0 && parts_.empty()) return;
  const std::vector<VertexHandle> at = disturbed(log);
  part_news_ = parts_.news(at, parts_at(at));
  const KnownParts::News& news = part_news_;
  report_difference(placed(news.edges_in, pool()), placed(news.edges_out, pool()),
                    change.edges_added, change.edges_removed);
  report_difference(placed(news.faces_in, pool()), placed(news.faces_out, pool()),
                    change.faces_added, change.faces_removed);
}

void SpaceState::check_features() const {
  world_->plc.check_invariants();
  SAC_INVARIANT(polygon_names_.at() == detail::polygons_at(store()));
  SAC_INVARIANT(parts_ == KnownParts(on_features(simplices())));
}

}  // namespace mesher::detail
