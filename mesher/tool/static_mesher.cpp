// Meshes from scratch at every update.
#include "static_mesher.hpp"

#include <utility>
#include <vector>

#include "mesh_difference.hpp"
#include "mesher/meshing.hpp"
#include "mesher/reports.hpp"

namespace tool {
namespace {

using mesher::Error;
using mesher::ErrorCode;
using mesher::Mesh;
using mesher::PointId;
using mesher::Polygon;
using mesher::PolygonId;

std::vector<mesher::LineEdge<2>> edges_of(const Mesh<2>& mesh) {
  std::vector<mesher::LineEdge<2>> edges;
  for (const auto& e : mesh.edges) {
    edges.push_back({mesh.vertices[e.low], mesh.vertices[e.high], e.feature});
  }
  return edges;
}

template <class Visit>
void for_each_point(const Polygon& polygon, Visit&& visit) {
  for (const auto& loop : polygon.loops) {
    for (const PointId id : loop) visit(id);
  }
  for (const auto& edge : polygon.edges) {
    for (const PointId id : edge) visit(id);
  }
  for (const PointId id : polygon.points) visit(id);
}

}  // namespace

template <int D>
StaticMesher<D>::StaticMesher(mesher::Options<D> options)
    : StaticSeeds<D>(options.domain), options_(std::move(options)) {
  options_.algorithm = mesher::Algorithm::gap_balls;
  edited_options_ = options_;
}

template <int D>
void StaticMesher<D>::insert(const mesher::Graph<D>& graph) {
  for (const auto& p : graph.points) this->insert(p.id, p.at, p.marker);
  for (const auto& s : graph.segments) this->insert_segment(s.id, s.from, s.to, s.marker);
  for (const auto& l : graph.polylines) this->insert_polyline(l.id, l.points, l.marker);
  if constexpr (D == 3) {
    for (const auto& f : graph.polygons) insert_polygon(f);
  }
  for (const auto& seed : graph.seeds) this->insert_seed(seed);
}

template <int D>
void StaticMesher<D>::insert_polygon(const Polygon& polygon) requires(D == 3) {
  if (edited_polygons_.emplace(polygon.id, polygon).second) return;
  throw Error(ErrorCode::repeated_id, text_of(polygon.id) + " is there already", {}, {polygon.id});
}

template <int D>
void StaticMesher<D>::remove_polygon(PolygonId id) requires(D == 3) {
  if (edited_polygons_.erase(id) > 0) return;
  throw Error(ErrorCode::unknown_id, text_of(id) + " is not there", {}, {id});
}

template <int D>
void StaticMesher<D>::require_no_corners_go() const {
  for (const auto& edited : edited_polygons_) {
    for_each_point(edited.second,
                   [&](PointId point) { this->require_stays(point, "on", edited.first); });
  }
}

template <int D>
mesher::Graph<D> StaticMesher<D>::input() const {
  mesher::Graph<D> graph;
  for (const auto& [id, vertex] : this->points()) {
    graph.points.push_back({id, vertex.at, vertex.marker});
  }
  for (const auto& [id, line] : this->lines()) {
    graph.polylines.push_back({id, line.points, line.marker});
  }
  if constexpr (D == 3) {
    for (const auto& [id, polygon] : edited_polygons_) graph.polygons.push_back(polygon);
  }
  this->add_seeds(graph);
  return graph;
}

template <int D>
void StaticMesher<D>::report(const Mesh<D>& after, const mesher::Graph<D>& input,
                             mesher::DomainUpdate<D>& update) const {
  static_cast<mesher::Change<D>&>(update) = change_between<D>(mesh_, after);
  if constexpr (D == 2) {
    const auto old_edges = edges_of(mesh_), new_edges = edges_of(after);
    update.edges_added = difference(new_edges, old_edges);
    update.edges_removed = difference(old_edges, new_edges);
    update.angles = mesher::angle_news(after, edited_options_, update.simplices_added);
  } else {
    update.guard = mesher::guard_news(after, input, options_.rho, update.simplices_added);
  }
}

template <int D>
mesher::DomainUpdate<D> StaticMesher<D>::update(const mesher::RunControl& control) {
  this->require_no_ends_go();
  require_no_corners_go();
  const mesher::Graph<D> input = this->input();
  mesher::RunReport report_of_run;
  Mesh<D> after = mesher::box_mesh(input, edited_options_, &report_of_run, control);
  auto domain = mesher::domain_mesh(after, input, options_.extent);
  mesher::DomainUpdate<D> update;
  report(after, input, update);
  update.domain = change_of_kept<D>(domain_.mesh, domain.mesh);
  this->keep_edits();
  current_polygons_ = edited_polygons_;
  options_ = edited_options_;
  mesh_ = std::move(after);
  domain_ = std::move(domain);
  stats_ = report_of_run.stats;
  return update;
}

template class StaticMesher<2>;
template class StaticMesher<3>;

}  // namespace tool
