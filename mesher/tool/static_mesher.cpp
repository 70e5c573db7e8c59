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

// --- Seeds -----------------------------------------------------------------------------------

void StaticMesher::insert_seed(const mesher::Seed& seed) {
  if (edited_seeds_.emplace(seed.name, seed).second) return;
  throw Error(ErrorCode::repeated_id, "there is a " + text_of(seed.name) + " already", {},
              {seed.name.id});
}

void StaticMesher::remove_seed(const mesher::SeedName& name) {
  if (edited_seeds_.erase(name) > 0) return;
  throw Error(ErrorCode::unknown_id, "there is no " + text_of(name), {}, {name.id});
}

// --- Updates ---------------------------------------------------------------------------------

mesher::Pslg StaticMesher::graph() const {
  mesher::Pslg graph;
  for (const auto& [id, vertex] : points()) {
    graph.points.push_back({id, vertex.at, vertex.marker});
  }
  for (const auto& [id, line] : lines()) {
    graph.polylines.push_back({id, line.points, line.marker});
  }
  for (const auto& [name, seed] : edited_seeds_) mesher::add_seed(graph, seed);
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
  require_no_ends_go();
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
  current_seeds_ = edited_seeds_;
  options_ = edited_options_ = std::move(options);
  mesh_ = std::move(after);
  domain_ = std::move(domain);
  stats_ = stats;
  return update;
}

}  // namespace tool
