// Meshes of tetrahedra from scratch at every update.
#include "static_space_mesher.hpp"

#include <utility>

#include "mesh_difference.hpp"

namespace tool {
namespace {

using mesher::Error;
using mesher::ErrorCode;
using mesher::FeatureId;

template <class Visit>
void for_each_point(const mesher::Polygon& polygon, Visit&& visit) {
  for (const auto& loop : polygon.loops) {
    for (const FeatureId id : loop) visit(id);
  }
  for (const auto& edge : polygon.edges) {
    for (const FeatureId id : edge) visit(id);
  }
  for (const FeatureId id : polygon.points) visit(id);
}

}  // namespace

void StaticSpaceMesher::insert_polygon(const mesher::Polygon& polygon, std::int64_t marker) {
  if (edited_polygons_.emplace(polygon.id, mesher::Plc::Facet{polygon, marker}).second) return;
  throw Error(ErrorCode::repeated_id, "polygon " + id_text(polygon.id) + " is there already", {},
              {mesher::polygon_named(polygon.id)});
}

void StaticSpaceMesher::remove_polygon(FeatureId id) {
  if (edited_polygons_.erase(id) > 0) return;
  throw Error(ErrorCode::unknown_id, "polygon " + id_text(id) + " is not there", {},
              {mesher::polygon_named(id)});
}

void StaticSpaceMesher::require_no_corners_go() const {
  for (const auto& edited : edited_polygons_) {
    for_each_point(edited.second.polygon, [&](FeatureId point) {
      require_stays(point, "on", mesher::polygon_named(edited.first));
    });
  }
}

mesher::Plc StaticSpaceMesher::input() const {
  mesher::Plc plc;
  for (const auto& [id, vertex] : points()) plc.points.push_back({id, vertex.at, vertex.marker});
  for (const auto& [id, line] : lines()) {
    for (std::size_t i = 1; i < line.points.size(); ++i) {
      plc.segments.push_back({id, line.points[i - 1], line.points[i], line.marker});
    }
  }
  for (const auto& [id, facet] : edited_polygons_) plc.facets.push_back(facet);
  add_seeds(plc);
  return plc;
}

mesher::DomainUpdateOf<3> StaticSpaceMesher::update(const mesher::RunControl& control) {
  require_no_ends_go();
  require_no_corners_go();
  const mesher::Plc input = this->input();
  mesher::Options<3> options = edited_options_;
  options.region_limits = needs_regions(options, extent_, areas_)
                              ? region_limits(input, options, extent_, areas_)
                              : nullptr;
  mesher::MeshStats stats;
  auto after = mesher::mesh_statically(input, options, &stats, control);
  auto domain = mesher::domain_mesh(after, input, extent_);
  mesher::DomainUpdateOf<3> update;
  static_cast<mesher::Change<3>&>(update) = change_between<3>(mesh_, after);
  update.guard = mesher::guard_news(after, input, options_.rho, update.simplices_added);
  update.domain = change_of_kept<3>(domain_.kept, domain.kept);
  keep_edits();
  current_polygons_ = edited_polygons_;
  options_ = edited_options_ = std::move(options);
  mesh_ = std::move(after);
  domain_ = std::move(domain);
  stats_ = stats;
  return update;
}

}  // namespace tool
