// Meshes from scratch at every update.
#include "static_mesher.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <string>
#include <utility>

namespace tool {
namespace {

using mesher::Error;
using mesher::ErrorCode;
using mesher::FeatureId;
using mesher::Mesh;
using mesher::Point;

using Triangle = std::array<Point<2>, 3>;

std::string id_text(FeatureId id) { return std::to_string(static_cast<std::int64_t>(id)); }

// Both in order: vertices are, so triangles given by their points are as those given by indices.
std::vector<Triangle> triangles_of(const Mesh<2>& mesh) {
  std::vector<Triangle> triangles;
  triangles.reserve(mesh.simplices.size());
  for (const auto& [a, b, c] : mesh.simplices) {
    triangles.push_back({mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]});
  }
  return triangles;
}

template <class T>
std::vector<T> difference(const std::vector<T>& all, const std::vector<T>& without) {
  std::vector<T> rest;
  std::set_difference(all.begin(), all.end(), without.begin(), without.end(),
                      std::back_inserter(rest));
  return rest;
}

// Vertices of both that have another kind now.
std::vector<mesher::KindChange<2>> kinds_changed(const Mesh<2>& before, const Mesh<2>& after) {
  std::vector<mesher::KindChange<2>> changes;
  std::size_t i = 0;
  for (std::size_t k = 0; k < after.vertices.size(); ++k) {
    while (i < before.vertices.size() && before.vertices[i] < after.vertices[k]) ++i;
    if (i == before.vertices.size() || before.vertices[i] != after.vertices[k]) continue;
    if (before.kinds[i] == after.kinds[k]) continue;
    changes.push_back({after.vertices[k], before.kinds[i], after.kinds[k]});
  }
  return changes;
}

std::vector<mesher::LineEdge<2>> edges_of(const Mesh<2>& mesh) {
  std::vector<mesher::LineEdge<2>> edges;
  for (const auto& e : mesh.edges) {
    edges.push_back({mesh.vertices[e.low], mesh.vertices[e.high], e.line});
  }
  return edges;
}

mesher::Change<2> change_between(const Mesh<2>& before, const Mesh<2>& after) {
  const auto old_triangles = triangles_of(before), new_triangles = triangles_of(after);
  mesher::Change<2> change;
  change.vertices_added = difference(after.vertices, before.vertices);
  change.vertices_removed = difference(before.vertices, after.vertices);
  change.kinds_changed = kinds_changed(before, after);
  change.simplices_added = difference(new_triangles, old_triangles);
  change.simplices_removed = difference(old_triangles, new_triangles);
  const auto old_edges = edges_of(before), new_edges = edges_of(after);
  change.edges_added = difference(new_edges, old_edges);
  change.edges_removed = difference(old_edges, new_edges);
  return change;
}

mesher::DomainChange change_of_kept(const Mesh<2>& before, const Mesh<2>& after) {
  const auto old_triangles = triangles_of(before), new_triangles = triangles_of(after);
  return {
      difference(new_triangles, old_triangles), difference(old_triangles, new_triangles), {}, 0};
}

}  // namespace

void StaticMesher::require_known(FeatureId id) const {
  if (edited_.points.contains(id)) return;
  throw Error(ErrorCode::unknown_id, "there is no point " + id_text(id), {}, {id});
}

void StaticMesher::require_inside(FeatureId id, const Point<2>& p) const {
  const auto& box = options_.domain;
  if (p[0] >= box.lo[0] && p[0] <= box.hi[0] && p[1] >= box.lo[1] && p[1] <= box.hi[1]) return;
  throw Error(ErrorCode::outside_domain, "point " + id_text(id) + " is outside the domain", {},
              {id});
}

void StaticMesher::require_free(FeatureId id, const Point<2>& p) const {
  const auto other = edited_.ids.find(p);
  if (other == edited_.ids.end()) return;
  throw Error(ErrorCode::duplicate_point,
              "point " + id_text(id) + " would lie on point " + id_text(other->second), {},
              {id, other->second});
}

// --- Points ----------------------------------------------------------------------------------

void StaticMesher::put(FeatureId id, const Vertex& vertex) {
  edited_.points.emplace(id, vertex);
  edited_.ids.emplace(vertex.at, id);
}

void StaticMesher::insert(FeatureId id, const Point<2>& point, std::int64_t marker) {
  if (edited_.points.contains(id)) {
    throw Error(ErrorCode::repeated_id, "there is a point " + id_text(id) + " already", {}, {id});
  }
  require_inside(id, point);
  if (!current_.points.contains(id)) require_free(id, point);
  put(id, {point, marker});
}

void StaticMesher::remove(FeatureId id) {
  require_known(id);
  const auto row = edited_.points.find(id);
  const auto [first, last] = edited_.ids.equal_range(row->second.at);
  edited_.ids.erase(std::find_if(first, last, [&](const auto& e) { return e.second == id; }));
  edited_.points.erase(row);
}

void StaticMesher::move(FeatureId id, const Point<2>& point) {
  require_known(id);
  require_inside(id, point);
  const std::int64_t marker = edited_.points.at(id).marker;
  remove(id);
  put(id, {point, marker});
}

// --- Lines and seeds -------------------------------------------------------------------------

void StaticMesher::insert_polyline(FeatureId id, const std::vector<FeatureId>& points,
                                   std::int64_t marker) {
  if (edited_.lines.contains(id)) {
    throw Error(ErrorCode::repeated_id, "there is a line " + id_text(id) + " already", {}, {id});
  }
  const auto same = std::adjacent_find(points.begin(), points.end());
  if (same != points.end()) {
    throw Error(ErrorCode::zero_length,
                "segment " + id_text(id) + " goes from point " + id_text(*same) + " to itself", {},
                {id, *same});
  }
  edited_.lines.emplace(id, Line{points, marker});
}

void StaticMesher::remove_segment(FeatureId id) {
  if (edited_.lines.erase(id) > 0) return;
  throw Error(ErrorCode::unknown_id, "there is no line " + id_text(id), {}, {id});
}

void StaticMesher::insert_seed(const mesher::Seed& seed) {
  if (edited_.seeds.emplace(seed.name, seed).second) return;
  throw Error(ErrorCode::repeated_id, "there is a " + text_of(seed.name) + " already", {},
              {seed.name.id});
}

void StaticMesher::remove_seed(const mesher::SeedName& name) {
  if (edited_.seeds.erase(name) > 0) return;
  throw Error(ErrorCode::unknown_id, "there is no " + text_of(name), {}, {name.id});
}

// Ends of lines that were there before.
void StaticMesher::require_unused() const {
  for (const auto& [id, line] : edited_.lines) {
    for (const FeatureId end : line.points) {
      if (edited_.points.contains(end) || !current_.points.contains(end)) continue;
      throw Error(ErrorCode::point_in_use,
                  "point " + id_text(end) + " cannot go: it is an end of segment " + id_text(id),
                  {}, {end, id});
    }
  }
}

// --- Updates ---------------------------------------------------------------------------------

mesher::Pslg StaticMesher::graph() const {
  mesher::Pslg graph;
  for (const auto& [id, vertex] : edited_.points) {
    graph.points.push_back({id, vertex.at, vertex.marker});
  }
  for (const auto& [id, line] : edited_.lines) {
    graph.polylines.push_back({id, line.points, line.marker});
  }
  for (const auto& [name, seed] : edited_.seeds) mesher::add_seed(graph, seed);
  return graph;
}

// Whether it matters to limits of size what lines enclose.
bool StaticMesher::needs_regions() const {
  if (areas_ == mesher::RegionAreas::limits) return true;
  const auto& o = edited_options_;
  const bool limited = o.max_area != 0 || o.sizes != nullptr || !o.box_limits.empty();
  return extent_ == mesher::Extent::enclosed && limited;
}

mesher::DomainUpdate StaticMesher::update(const mesher::RunControl& control) {
  require_unused();
  const mesher::Pslg input = graph();
  mesher::Options<2> options = edited_options_;
  options.region_limits =
      needs_regions() ? region_limits(input, options, extent_, areas_) : nullptr;
  mesher::MeshStats stats;
  Mesh<2> after = mesher::mesh_statically(input, options, &stats, control);
  mesher::DomainMesh domain = mesher::domain_mesh(after, input, extent_);
  mesher::DomainUpdate update;
  static_cast<mesher::Change<2>&>(update) = change_between(mesh_, after);
  update.angles = mesher::angle_news(after, options, update.simplices_added);
  update.domain = change_of_kept(domain_.kept, domain.kept);
  current_ = edited_;
  options_ = edited_options_ = std::move(options);
  mesh_ = std::move(after);
  domain_ = std::move(domain);
  stats_ = stats;
  return update;
}

}  // namespace tool
