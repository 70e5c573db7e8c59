// Meshes from scratch at every update.
#include "static_mesher.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "mesh_difference.hpp"

namespace tool {
namespace {

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

}  // namespace

mesher::Pslg StaticMesher::graph() const {
  mesher::Pslg graph;
  for (const auto& [id, vertex] : points()) {
    graph.points.push_back({id, vertex.at, vertex.marker});
  }
  for (const auto& [id, line] : lines()) {
    graph.polylines.push_back({id, line.points, line.marker});
  }
  add_seeds(graph);
  return graph;
}

mesher::DomainUpdate StaticMesher::update(const mesher::RunControl& control) {
  require_no_ends_go();
  const mesher::Pslg input = graph();
  mesher::Options<2> options = edited_options_;
  options.region_limits =
      needs_regions(options, extent_, areas_) ? region_limits(input, options, extent_, areas_) : nullptr;
  mesher::MeshStats stats;
  Mesh<2> after = mesher::mesh_statically(input, options, &stats, control);
  mesher::DomainMesh domain = mesher::domain_mesh(after, input, extent_);
  mesher::DomainUpdate update;
  static_cast<mesher::Change<2>&>(update) = change_of_lines_too(mesh_, after);
  update.angles = mesher::angle_news(after, options, update.simplices_added);
  update.domain = change_of_kept<2>(domain_.kept, domain.kept);
  keep_edits();
  options_ = edited_options_ = std::move(options);
  mesh_ = std::move(after);
  domain_ = std::move(domain);
  stats_ = stats;
  return update;
}

}  // namespace tool
