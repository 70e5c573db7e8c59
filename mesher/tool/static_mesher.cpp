// Meshes from scratch at every update.
#include "static_mesher.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "mesh_difference.hpp"

namespace tool {
namespace {

using mesher::Error;
using mesher::ErrorCode;
using mesher::FeatureId;
using mesher::Mesh;

std::vector<mesher::LineEdge<2>> edges_of(const Mesh<2>& mesh) {
  std::vector<mesher::LineEdge<2>> edges;
  for (const auto& e : mesh.edges) {
    edges.push_back({mesh.vertices[e.low], mesh.vertices[e.high], e.line});
  }
  return edges;
}

mesher::Change<2> change_of_lines_too(const Mesh<2>& before, const Mesh<2>& after) {
  mesher::Change<2> change = change_between<2>(before, after);
  const auto old_edges = edges_of(before), new_edges = edges_of(after);
  change.edges_added = difference(new_edges, old_edges);
  change.edges_removed = difference(old_edges, new_edges);
  return change;
}

mesher::DomainChange change_of_kept(const Mesh<2>& before, const Mesh<2>& after) {
  const auto old_triangles = simplices_of(before), new_triangles = simplices_of(after);
  return {
      difference(new_triangles, old_triangles), difference(old_triangles, new_triangles), {}, 0};
}

}  // namespace

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
      if (is_there(end) || !was_there(end)) continue;
      throw Error(ErrorCode::point_in_use,
                  "point " + id_text(end) + " cannot go: it is an end of segment " + id_text(id),
                  {}, {end, id});
    }
  }
}

// --- Updates ---------------------------------------------------------------------------------

mesher::Pslg StaticMesher::graph() const {
  mesher::Pslg graph;
  for (const auto& [id, vertex] : points()) {
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
  static_cast<mesher::Change<2>&>(update) = change_of_lines_too(mesh_, after);
  update.angles = mesher::angle_news(after, options, update.simplices_added);
  update.domain = change_of_kept(domain_.kept, domain.kept);
  keep_edits();
  current_ = edited_;
  options_ = edited_options_ = std::move(options);
  mesh_ = std::move(after);
  domain_ = std::move(domain);
  stats_ = stats;
  return update;
}

}  // namespace tool
