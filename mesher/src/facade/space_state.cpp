// Edits of segments and polygons: between points that are there, that go, or that come.
#include "facade/space_state.hpp"

#include <algorithm>
#include <string>

#include "program/space_input.hpp"
#include "program/world_impl.hpp"
#include "space/parts_in_mesh.hpp"
#include "text/id_text.hpp"

namespace mesher::detail {

namespace {

template <class Visit>
void for_each_part(const LinePoints& points, Visit&& visit) {
  for (std::size_t i = 1; i < points.size(); ++i) visit(points[i - 1], points[i]);
}

template <class Id, class Value>
const Value* find_in(const std::unordered_map<Id, Value>& all, Id id) {
  const auto it = all.find(id);
  return it == all.end() ? nullptr : &it->second;
}

// So that merging `more` cannot fail.
template <class Map>
void reserve_for(Map& map, const Map& more) {
  const std::size_t most = map.size() + more.size();
  // One without any needs more, though its load would do.
  if (static_cast<float>(most) >= map.max_load_factor() * static_cast<float>(map.bucket_count())) {
    map.reserve(2 * most + 16);  // never less than there is: that would move all
  }
}

[[noreturn]] void fail_in_use(PointId point, const std::string& what, const mesher::Feature& user) {
  throw Error(ErrorCode::point_in_use,
              "point " + id_text(point) + " cannot go: it is " + what + " " + text_of(user), {},
              {mesher::Feature(point), user});
}

}  // namespace

// --- What is there ---------------------------------------------------------------------------

const LinePoints& SpaceState::line(LineId id) const {
  static const LinePoints none;
  const LinePoints* found = find_in(line_points_, id);
  return found == nullptr ? none : *found;
}

const mesher::Polygon& SpaceState::polygon_parts(PolygonId id) const {
  static const mesher::Polygon none;
  const NamedPolygon* found = find_in(named_polygons_, id);
  return found == nullptr ? none : found->polygon;
}

std::vector<Polyline> SpaceState::lines() const {
  std::vector<Polyline> all;
  for (const auto& [id, points] : line_points_) all.push_back({id, points});
  std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
  return all;
}

std::vector<mesher::Polygon> SpaceState::polygons() const {
  std::vector<mesher::Polygon> all;
  for (const auto& [id, named] : named_polygons_) all.push_back(named.polygon);
  std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
  return all;
}

PointId SpaceState::point(VertexHandle v) const {
  const auto it = news_.points.find(v);
  return it == news_.points.end() ? names_[v] : it->second;
}

std::optional<LineId> SpaceState::segment(EdgeHandle e) const {
  if (const auto it = news_.segments.find(e); it != news_.segments.end()) return it->second;
  const auto it = segment_names_.find(e);
  if (it == segment_names_.end() || news_.segments_taken.count(e) > 0) return std::nullopt;
  return it->second;
}

PolygonId SpaceState::polygon(PolygonHandle f) const {
  if (const auto it = news_.polygons.find(f); it != news_.polygons.end()) return it->second;
  return polygon_names_.at(f);
}

// Requires: none has come yet.
std::vector<PolygonHandle> SpaceState::polygons_at(VertexHandle point) const {
  std::vector<PolygonHandle> all;
  polygons_at_.visit_with_point(point, [&](PolygonHandle h) {
    if (store().polygons()[h].alive) all.push_back(h);
  });
  return all;
}

OnFeatures SpaceState::on_features(const std::vector<Simplex>& simplices) const {
  if (store().live_edges() == 0) return {};
  return detail::on_features(
      simplices, {pool(), vertices().roles(), store(), *this, {&polygons_at_, &news_.polygons_at}});
}

// --- Single features -------------------------------------------------------------------------

// The point with this id when all points have come and gone; 0 if there is none.
VertexHandle SpaceState::point_with(PointId id, const Ids& arrived) const {
  if (const auto it = arrived.find(id); it != arrived.end()) return it->second;
  const auto it = ids_.find(id);
  if (it == ids_.end()) return 0;
  return pool()[it->second].input && point(it->second) == id ? it->second : 0;
}

void SpaceState::take_segment(const Edge& e) {
  news_.segments_taken.insert(e.self);
  world_->erase_edge(e);
}

void SpaceState::take_polygon(PolygonId id) {
  news_.polygons_taken.push_back(id);
  world_->erase_polygon(store().polygons()[named_polygons_.at(id).record]);
}

void SpaceState::add_segment(const Part& part, const Ids& arrived) {
  const auto end = [&](PointId id) {
    const VertexHandle v = point_with(id, arrived);
    if (v == 0) fail_unknown_point(id, "an end of", mesher::Feature(part.line));
    return v;
  };
  const VertexHandle a = end(part.from), b = end(part.to);
  const Edge& e = detail::add_segment(*world_, part.line, a, b, *this);
  news_.segments[e.self] = part.line;
  news_.edges_come.push_back(e.self);
}

void SpaceState::add_polygon(const mesher::Polygon& polygon, const Ids& arrived) {
  PolygonParts parts = parts_of(polygon, [&](PointId id) { return point_with(id, arrived); });
  const Polygon& record = detail::add_polygon(*world_, polygon.id, std::move(parts), *this);
  news_.polygons[record.self] = polygon.id;
  news_.polygons_come.push_back(record.self);
  news_.polygons_at.add(record);
  news_.named_polygons.insert_or_assign(polygon.id, NamedPolygon{polygon, record.self});
}

// --- All of an update ------------------------------------------------------------------------

void SpaceState::add_others_first() {
  if (edits_.lines.empty() && edits_.polygons.empty()) return;
  add_parts(take_parts({}), {});
  require_fits({});
  make_room_for_others();
  rename_others();
  forget_news();
}

void SpaceState::make_edits(const PointEdits& edits, Ids& arrived) {
  if (edits_.limits) edit_limits(*world_, edits_.limits->options, edits_.limits->where, *engine_);
  const Parts parts = take_parts(edits);
  require_unused(edits);
  make_points(edits, arrived);
  add_parts(parts, arrived);
  if (store().live_edges() != 0) require_fits(arrived);
}

void SpaceState::add_parts(const Parts& parts, const Ids& arrived) {
  for (const Part& part : parts.segments) add_segment(part, arrived);
  for (const mesher::Polygon& polygon : parts.polygons) add_polygon(polygon, arrived);
}

// Features that go, and those of the others that have a point that moves. Returns what is to come:
// all of the new ones, and the latter again.
SpaceState::Parts SpaceState::take_parts(const PointEdits& points) {
  Parts parts;
  for (const auto& edit : edits_.lines) {
    for_each_part(edit.was, [&](PointId a, PointId b) {
      take_segment(*store().find_edge(ids_.at(a), ids_.at(b)));
    });
    for_each_part(edit.to, [&](PointId a, PointId b) {
      parts.segments.push_back({edit.id, a, b});
    });
  }
  for (const auto& edit : edits_.polygons) {
    if (!edit.was.loops.empty()) take_polygon(edit.id);
    if (!edit.to.loops.empty()) parts.polygons.push_back(edit.to);
  }
  for (const auto& edit : points) {
    if (edit.was && edit.to) take_at(ids_.at(edit.id), parts);
  }
  return parts;
}

void SpaceState::take_at(VertexHandle v, Parts& parts) {
  std::vector<const Edge*> edges;
  store().visit_edges_at(v, [&](const Edge& e) {
    if (segment(e.self)) edges.push_back(&e);
  });
  for (const Edge* e : edges) {
    parts.segments.push_back({*segment(e->self), names_[e->a], names_[e->b]});
    take_segment(*e);
  }
  for (const PolygonHandle h : polygons_at(v)) {
    const PolygonId id = polygon_names_.at(h);
    parts.polygons.push_back(named_polygons_.at(id).polygon);
    take_polygon(id);
  }
}

// Requires: take_parts.
void SpaceState::require_unused(const PointEdits& edits) const {
  for (const auto& edit : edits) {
    if (!edit.was || edit.to) continue;
    const VertexHandle v = ids_.at(edit.id);
    std::optional<LineId> line;
    store().visit_edges_at(v, [&](const Edge& e) {
      if (const auto id = segment(e.self); id && (!line || *id < *line)) line = id;
    });
    if (line) fail_in_use(edit.id, "an end of", *line);
    std::optional<PolygonId> polygon;
    for (const PolygonHandle h : polygons_at(v)) {
      const PolygonId id = polygon_names_.at(h);
      if (!polygon || id < *polygon) polygon = id;
    }
    if (polygon) fail_in_use(edit.id, "on", *polygon);
  }
}

// What has come fits to what is there.
void SpaceState::require_fits(const Ids& arrived) {
  require_fit(*world_, news_.edges_come, news_.polygons_come, *this, ask_);
  std::vector<std::pair<PointId, VertexHandle>> points(arrived.begin(), arrived.end());
  std::sort(points.begin(), points.end());
  for (const auto& [id, h] : points) {
    ask_();
    if (const auto conflict = conflict_of(pool()[h], store())) fail(*conflict, *this, store());
  }
}

// --- Names -----------------------------------------------------------------------------------

// So that rename_others() cannot fail.
void SpaceState::make_room_for_others() {
  for (const auto& edit : edits_.lines) {
    if (!edit.to.empty()) news_.line_points.emplace(edit.id, edit.to);
  }
  reserve_for(line_points_, news_.line_points);
  reserve_for(named_polygons_, news_.named_polygons);
  reserve_for(segment_names_, news_.segments);
  reserve_for(polygon_names_, news_.polygons);
}

void SpaceState::rename_others() noexcept {
  for (const auto& edit : edits_.lines) line_points_.erase(edit.id);
  line_points_.merge(news_.line_points);
  for (const EdgeHandle e : news_.segments_taken) segment_names_.erase(e);
  segment_names_.merge(news_.segments);
  for (const PolygonId id : news_.polygons_taken) {
    const PolygonHandle record = named_polygons_.at(id).record;
    polygon_names_.erase(record);
    polygons_at_.erase(store().polygons()[record]);
  }
  for (const PolygonId id : news_.polygons_taken) named_polygons_.erase(id);
  named_polygons_.merge(news_.named_polygons);
  polygon_names_.merge(news_.polygons);
  polygons_at_.merge(news_.polygons_at);
  parts_.apply(news_.parts);
}

void SpaceState::forget_news() noexcept {
  edits_ = Edits();
  news_.clear();
}

}  // namespace mesher::detail
