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

void StaticSpaceMesher::insert_polygon(const mesher::Polygon& polygon) {
  if (edited_polygons_.emplace(polygon.id, polygon).second) return;
  throw Error(ErrorCode::repeated_id, "polygon " + id_text(polygon.id) + " is there already", {},
              {polygon.id});
}

void StaticSpaceMesher::remove_polygon(FeatureId id) {
  if (edited_polygons_.erase(id) > 0) return;
  throw Error(ErrorCode::unknown_id, "polygon " + id_text(id) + " is not there", {}, {id});
}

void StaticSpaceMesher::require_no_corners_go() const {
  for (const auto& edited : edited_polygons_) {
    for_each_point(edited.second,
                   [&](FeatureId point) { require_stays(point, "on polygon", edited.first); });
  }
}

// Points alone take any rule.
mesher::Mesh<3> StaticSpaceMesher::meshed(mesher::MeshStats& stats,
                                          const mesher::RunControl& control) const {
  std::vector<mesher::Point<3>> places;
  std::vector<FeatureId> ids;
  for (const auto& [id, vertex] : points()) {
    places.push_back(vertex.at);
    ids.push_back(id);
  }
  if (lines().empty() && edited_polygons_.empty()) {
    return mesher::mesh_statically<3>(places, options_, ids, &stats, control);
  }
  std::vector<mesher::Segment> segments;
  for (const auto& [id, line] : lines()) {
    for (std::size_t i = 1; i < line.points.size(); ++i) {
      segments.push_back({id, line.points[i - 1], line.points[i]});
    }
  }
  std::vector<mesher::Polygon> polygons;
  for (const auto& [id, polygon] : edited_polygons_) polygons.push_back(polygon);
  return mesher::mesh_statically(places, segments, polygons, options_, ids, &stats, control);
}

mesher::Change<3> StaticSpaceMesher::update(const mesher::RunControl& control) {
  require_no_ends_go();
  require_no_corners_go();
  mesher::MeshStats stats;
  auto after = meshed(stats, control);
  auto change = change_between<3>(mesh_, after);
  keep_edits();
  current_polygons_ = edited_polygons_;
  mesh_ = std::move(after);
  stats_ = stats;
  return change;
}

}  // namespace tool
