// Points, edges and polygons come and go in a tile's world.
#include "tiles/space_features.hpp"

#include "program/world_impl.hpp"
#include "space/placed.hpp"

namespace mesher::detail {

void SpaceFeatures::carry_out(const FeatureOrders& orders) {
  auto& plc = world_.plc;
  const auto& store = plc.store();
  for (const PolygonHandle f : orders.polygons_gone) {
    plc.erase(store.polygons()[own_polygons_.at(f)]);
  }
  for (const EdgeHandle e : orders.segments_gone) plc.erase(store.edges()[own_edges_.at(e)]);
  for (const Point<3>& p : orders.points_gone) take_point(p);
  for (const Point<3>& p : orders.points_come) put_point(p);
  for (const EdgeHandle e : orders.segments_come) put_segment(e);
  for (const PolygonHandle f : orders.polygons_come) put_polygon(f);
}

// A point stays an input point until the end of the update, so that its record does.
void SpaceFeatures::take_point(const Point<3>& p) {
  Vertex<3>& v = *world_.vertices.claim(p);
  gone_.push_back(v.self);
  engine_.begin_edit();
  world_.features.erase(v);
}

void SpaceFeatures::put_point(const Point<3>& p) {
  engine_.begin_edit();
  Vertex<3>& v = *world_.vertices.claim(p);
  engine_.on_rollback([&v, was = bool{v.input}] { v.input = was; });
  v.input = true;
  world_.features.insert(v);
}

void SpaceFeatures::put_segment(EdgeHandle name) {
  const Edge& e = whole_->edges()[name];
  world_.plc.insert(own_point(e.a), own_point(e.b));
  note_edge(name);
}

void SpaceFeatures::put_polygon(PolygonHandle name) {
  const Polygon& f = whole_->polygons()[name];
  PolygonParts parts;
  std::uint32_t at = 0;
  for (const std::uint32_t end : f.loop_end) {
    Loop& loop = parts.loops.emplace_back();
    for (; at < end; ++at) loop.push_back(own_point(f.corners[at]));
  }
  for (const EdgeHandle h : f.inner_edges) {
    const Edge& e = whole_->edges()[h];
    parts.edges.emplace_back(own_point(e.a), own_point(e.b));
  }
  for (const VertexHandle v : f.inner_points) parts.points.push_back(own_point(v));
  const Polygon& own = world_.plc.insert(std::move(parts));
  note(name, own.self, own_polygons_, polygon_names_);
  for (const EdgeHandle e : f.all_edges) note_edge(e);
}

// --- Handles ---------------------------------------------------------------------------------

VertexHandle SpaceFeatures::own_point(VertexHandle name) const {
  return world_.vertices.tree().find(whole_->points()[name].p)->self;
}

void SpaceFeatures::note(std::uint32_t name, std::uint32_t own, Handles& owns,
                         std::vector<std::uint32_t>& names) {
  if (own >= names.size()) names.resize(own + std::size_t{1});
  names[own] = name;
  owns[name] = own;
}

// Requires: it is there.
void SpaceFeatures::note_edge(EdgeHandle name) {
  const Edge& e = whole_->edges()[name];
  const Edge& own = *world_.plc.store().find_edge(own_point(e.a), own_point(e.b));
  note(name, own.self, own_edges_, edge_names_);
}

Role SpaceFeatures::own(Role role) const {
  if (const EdgeHandle e = edge_of(role); e != 0) role.on = own_edges_.at(e);
  if (const PolygonHandle f = polygon_of(role); f != 0) role.on = own_polygons_.at(f) | kOnPolygon;
  return role;
}

Role SpaceFeatures::named(Role role) const noexcept {
  if (const EdgeHandle e = edge_of(role); e != 0) role.on = edge_names_[e];
  if (const PolygonHandle f = polygon_of(role); f != 0) role.on = polygon_names_[f] | kOnPolygon;
  return role;
}

void SpaceFeatures::commit() noexcept {
  world_.plc.commit();
  for (const VertexHandle h : std::exchange(gone_, {})) {
    Vertex<3>& v = world_.vertices.pool()[h];
    if (v.feature) continue;  // it has come back
    v.input = false;
    world_.vertices.touch(v);
  }
  world_.vertices.commit();
}

}  // namespace mesher::detail
