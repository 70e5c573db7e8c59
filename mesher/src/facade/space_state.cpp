// Edits of polygons: between points that are there, that go, or that come.
#include "facade/space_state.hpp"

#include <algorithm>

#include "geometry/input_point.hpp"
#include "program/space_input.hpp"
#include "program/world_impl.hpp"
#include "space/parts_in_mesh.hpp"

namespace mesher::detail {

// --- Single polygons -------------------------------------------------------------------------

// Requires: none has come yet.
std::vector<PolygonHandle> SpaceState::polygons_at(VertexHandle point) const {
  std::vector<PolygonHandle> all;
  polygon_names_.at().visit_with_point(point, [&](PolygonHandle h) {
    if (store().polygons()[h].alive) all.push_back(h);
  });
  return all;
}

void SpaceState::take_polygon(PolygonHandle f) {
  polygon_names_.take(f);
  world_->erase_polygon(store().polygons()[f]);
}

void SpaceState::add_polygon(const mesher::Polygon& polygon) {
  PolygonParts parts = parts_of(polygon, [&](PointId id) { return point_with(id); });
  const Polygon& record = detail::add_polygon(*world_, polygon.id, std::move(parts), *this);
  polygon_names_.add(record, polygon.id);
}

// --- All of an update ------------------------------------------------------------------------

void SpaceState::take_edited(const Edits<3>& edits) {
  LineState::take_edited(edits);
  edits.polygons.for_each_edit(
      [&](PolygonId id, const mesher::Polygon* was, const mesher::Polygon* is) {
        if (was != nullptr) take_polygon(polygon_names_.record(id));
        if (is != nullptr) noted_polygons_.push_back(is);
      });
}

void SpaceState::take_at(VertexHandle v, const Edits<3>& edits) {
  LineState::take_at(v, edits);
  for (const PolygonHandle f : polygons_at(v)) {
    noted_polygons_.push_back(&edits.polygons.committed().at(polygon_names_.was(f)));
    take_polygon(f);
  }
}

void SpaceState::require_unused(PointId id, VertexHandle v) const {
  LineState::require_unused(id, v);
  std::optional<PolygonId> user;
  for (const PolygonHandle f : polygons_at(v)) {
    const PolygonId polygon = polygon_names_.was(f);
    if (!user || polygon < *user) user = polygon;
  }
  if (user) fail_in_use(id, "on", *user, places_of(place(id)));
}

void SpaceState::add_noted() {
  LineState::add_noted();
  for (const mesher::Polygon* polygon : noted_polygons_) add_polygon(*polygon);
}

void SpaceState::require_fit() {
  detail::require_fit(*world_, segment_names_.added(), polygon_names_.added(), *this, ask_);
  for (const VertexHandle h : arrivals()) {
    ask_();
    if (const auto conflict = conflict_of(pool()[h], store())) fail(*conflict, *this, store());
  }
}

// --- Names -----------------------------------------------------------------------------------

void SpaceState::prepare_names() {
  LineState::prepare_names();
  polygon_names_.prepare();
}

void SpaceState::commit_names() noexcept {
  LineState::commit_names();
  polygon_names_.commit(store().polygons());
  parts_.apply(part_news_);
}

void SpaceState::discard_news() noexcept {
  LineState::discard_news();
  polygon_names_.discard();
  noted_polygons_.clear();
  part_news_ = KnownParts::News();
}

OnFeatures SpaceState::on_features(const std::vector<Simplex>& simplices) const {
  if (store().live_edges() == 0) return {};
  return detail::on_features(simplices,
                             {pool(), vertices().roles(), store(), *this, polygon_names_.all_at()});
}

}  // namespace mesher::detail
