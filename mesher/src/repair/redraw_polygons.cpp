// What facets are now.
#include <algorithm>
#include <cmath>
#include <tuple>

#include "program/space_input.hpp"
#include "repair/space_redrawing.hpp"
#include "sets/make_set.hpp"

namespace mesher::detail {

namespace {

// All that lies on it.
void add_points(const PolygonParts& parts, std::vector<VertexHandle>& points) {
  for (const Loop& loop : parts.loops) points.insert(points.end(), loop.begin(), loop.end());
  for (const auto& [a, b] : parts.edges) points.insert(points.end(), {a, b});
  points.insert(points.end(), parts.points.begin(), parts.points.end());
}

// Without the order of what lies inside.
PolygonParts sorted(PolygonParts parts) {
  for (Ends& e : parts.edges) e = in_order(e.first, e.second);
  make_set(parts.edges);
  make_set(parts.points);
  return parts;
}

bool is_same(const PolygonParts& a, const PolygonParts& b) {
  const PolygonParts x = sorted(a), y = sorted(b);
  return std::tie(x.loops, x.edges, x.points) == std::tie(y.loops, y.edges, y.points);
}

}  // namespace

PolygonParts drawn_parts(const mesher::Polygon& polygon, const Drawn<3>& drawn) {
  return parts_of(polygon, [&](PointId id) { return drawn.spot(id); });
}

SpaceRedrawing::SpaceRedrawing(const GraphFile<3>& file, const Drawing<3>& drawing,
                               const Drawn<3>& drawn)
    : Redrawing(file, drawing, drawn),
      facets_(ranked(file.graph.polygons)),
      sheets_(facets_.size()) {
  for (const Sheet& sheet : drawing.sheets()) {
    if (!sheet.is_gone()) sheets_[sheet.facet].push_back(&sheet);
  }
  const auto polygon = [&](const Sheet* s) -> const Polygon& {
    return drawing.store().polygons()[s->record];
  };
  for (auto& sheets : sheets_) {
    std::sort(sheets.begin(), sheets.end(),
              [&](const Sheet* s, const Sheet* t) { return order(polygon(s), polygon(t)) < 0; });
  }
}

// A new point may be on an edge between others.
void SpaceRedrawing::look_at_new_points() {
  for (std::size_t i = 0; i < news_.size(); ++i) {
    const auto v = static_cast<VertexHandle>(drawn_.keepers.size() + i) + Drawing<3>::kFirst;
    const auto [a, b] = drawing_.was_on(v);
    news_[i].attributes = between(place(v), place(a), place(b), attributes(a), attributes(b));
  }
  for (std::size_t f = 0; f < sheets_.size(); ++f) {
    for (const VertexHandle v : points_of(f)) {
      if (!drawn_.is_new(v)) continue;
      NewPoint& point = news(v);
      if (!point.is_used()) point.marker = facet(f).marker, point.location = location(f);
      point.polygons.insert(facet(f).id);
    }
  }
}

std::vector<VertexHandle> SpaceRedrawing::points_of(std::size_t f) const {
  std::vector<VertexHandle> points;
  for (const Sheet* sheet : sheets_[f]) add_points(sheet->parts, points);
  make_set(points);
  return points;
}

// Without what is declared and on a loop, or an end of an edge.
mesher::Polygon SpaceRedrawing::polygon_of(const Sheet& sheet) {
  const Polygon& f = drawing_.store().polygons()[sheet.record];
  mesher::Polygon polygon;
  for (const Loop& loop : sheet.parts.loops) {
    auto& corners = polygon.loops.emplace_back();
    for (const VertexHandle v : loop) corners.push_back(id(v));
  }
  std::vector<VertexHandle> known = f.corners;
  for (const EdgeHandle h : f.inner_edges) {
    if (f.corner_at(h) != Polygon::kInner) continue;
    const Edge& e = drawing_.store().edges()[h];
    polygon.edges.push_back({id(e.a), id(e.b)});
    known.insert(known.end(), {e.a, e.b});
  }
  make_set(known);
  for (const VertexHandle v : f.inner_points) {
    if (!std::binary_search(known.begin(), known.end(), v)) polygon.points.push_back(id(v));
  }
  return polygon;
}

// As it came, if nothing has happened to it but that points are others.
mesher::Polygon SpaceRedrawing::first_of(std::size_t f) {
  mesher::Polygon polygon = facet(f);
  const bool is_as_it_was = is_same(drawn_parts(polygon, drawn_), sheets_[f][0]->parts);
  if (sheets_[f].size() > 1 || !is_as_it_was) return polygon_of(*sheets_[f][0]);
  const auto rename = [&](PointId& point) { point = id(drawn_.spot(point)); };
  for (auto& loop : polygon.loops) std::for_each(loop.begin(), loop.end(), rename);
  for (auto& e : polygon.edges) std::for_each(e.begin(), e.end(), rename);
  std::for_each(polygon.points.begin(), polygon.points.end(), rename);
  return polygon;
}

void SpaceRedrawing::add_polygon(PolygonId id, std::size_t f, const mesher::Polygon& polygon) {
  out_.file.graph.polygons.push_back(polygon);
  out_.file.graph.polygons.back().marker = facet(f).marker;
  out_.file.graph.polygons.back().id = id;
  out_.file.polygons.push_back(file_.polygons[facets_[f]]);
}

void SpaceRedrawing::draw_polygons() {
  std::int64_t last = 0;
  std::vector<std::size_t> rank(sheets_.size());
  for (std::size_t f = 0; f < sheets_.size(); ++f) {
    rank[facets_[f]] = f;
    last = std::max(last, static_cast<std::int64_t>(facet(f).id));
  }
  for (const std::size_t f : rank) {
    if (!sheets_[f].empty()) add_polygon(facet(f).id, f, first_of(f));
  }
  for (std::size_t f = 0; f < sheets_.size(); ++f) {
    note_points_on(f);
    look_at_shape(f);
    for (std::size_t i = 1; i < sheets_[f].size(); ++i) {
      const PolygonId fresh = next_id<PolygonId>(last);
      add_polygon(fresh, f, polygon_of(*sheets_[f][i]));
      out_.notes.back().polygons.push_back(fresh);
    }
  }
  note_losses();
}

Point<3> SpaceRedrawing::first_place(std::size_t f) const {
  for (const auto& loop : facet(f).loops) {
    if (!loop.empty()) return place_of(loop[0]);
  }
  return {};
}

RepairNote<3>& SpaceRedrawing::note_polygon(RepairKind kind, std::size_t f, const Point<3>& at) {
  RepairNote<3>& made = note(kind, {}, {}, at, location(f));
  made.polygons = {facet(f).id};
  return made;
}

void SpaceRedrawing::note_points_on(std::size_t f) {
  std::vector<VertexHandle> before;
  add_points(drawn_parts(facet(f), drawn_), before);
  make_set(before);
  for (const VertexHandle v : points_of(f)) {
    if (drawn_.is_new(v) || std::binary_search(before.begin(), before.end(), v)) continue;
    note_polygon(RepairKind::split_at_point, f, place(v)).points.push_back(id(v));
  }
}

// Whether it was flat, and how far from where it was it is now. The last note is of its parts.
void SpaceRedrawing::look_at_shape(std::size_t f) {
  const mesher::Polygon& polygon = facet(f);
  Polygon shape;
  auto loops = polygon.loops;
  std::erase_if(loops, [](const auto& loop) { return loop.size() < 3; });
  if (!loops.empty()) put_in_order(loops, [&](PointId v) { return place_of(v); });
  for (const auto& loop : loops) {
    for (const PointId v : loop) shape.places.push_back(place_of(v));
    shape.loop_end.push_back(static_cast<std::uint32_t>(shape.places.size()));
  }
  const bool has_shape = !loops.empty() && find_shape(shape);
  if (has_shape && is_flat(shape)) {
    const double own = detail::deviation(shape).height;  // its corners are not in a plane, either
    for (const VertexHandle v : points_of(f)) {
      const double off = std::sqrt(distance2(place(v), shape)) - own;
      if (off > 0) deviates_by(off * off);
    }
  }
  const Point<3> at = first_place(f);
  if (sheets_[f].empty()) {
    note_polygon(RepairKind::dropped_polygon, f, at);
  } else if (has_shape && !is_flat(shape)) {
    const Deviation most = detail::deviation(shape);
    note_polygon(RepairKind::bent_polygon, f, most.at).deviation = most.height;
  } else if (sheets_[f].size() > 1) {
    note_polygon(RepairKind::cut_polygon, f, at);
  }
}

void SpaceRedrawing::note_losses() {
  auto losses = drawing_.losses();
  make_set(losses);
  for (const auto& [loser, taker] : losses) {
    note_polygon(RepairKind::overlap, loser, first_place(loser))
        .polygons.push_back(facet(taker).id);
  }
}

Repaired<3> redraw(const GraphFile<3>& file, const Drawing<3>& drawing, const Drawn<3>& drawn) {
  return SpaceRedrawing(file, drawing, drawn).redraw();
}

}  // namespace mesher::detail
