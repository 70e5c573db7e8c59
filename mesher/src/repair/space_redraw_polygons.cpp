// What facets are now.
#include <algorithm>
#include <cmath>
#include <tuple>

#include "repair/merging.hpp"
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

const Point<3>& first_place(const mesher::Polygon& polygon,
                            const std::unordered_map<PointId, Point<3>>& places) {
  static constexpr Point<3> kNone{};
  for (const auto& loop : polygon.loops) {
    if (!loop.empty()) return places.at(loop[0]);
  }
  return kNone;
}

}  // namespace

std::vector<VertexHandle> SpaceRedrawing::points_of(std::size_t f) const {
  std::vector<VertexHandle> points;
  for (const Sheet* sheet : sheets_[f]) add_points(sheet->parts, points);
  make_set(points);
  return points;
}

// Without what is declared and on a loop, or an end of an edge.
mesher::Polygon SpaceRedrawing::polygon_of(const Sheet& sheet) const {
  const Polygon& f = drawing_.store().polygons()[sheet.record];
  mesher::Polygon polygon;
  for (const Loop& loop : sheet.parts.loops) {
    auto& corners = polygon.loops.emplace_back();
    for (const VertexHandle v : loop) corners.push_back(ids_[v]);
  }
  std::vector<VertexHandle> known = f.corners;
  for (const EdgeHandle h : f.inner_edges) {
    if (f.corner_at(h) != Polygon::kInner) continue;
    const Edge& e = drawing_.store().edges()[h];
    polygon.edges.push_back({ids_[e.a], ids_[e.b]});
    known.insert(known.end(), {e.a, e.b});
  }
  make_set(known);
  for (const VertexHandle v : f.inner_points) {
    if (!std::binary_search(known.begin(), known.end(), v)) polygon.points.push_back(ids_[v]);
  }
  return polygon;
}

// As it came, if nothing has happened to it but that points are others.
mesher::Polygon SpaceRedrawing::first_of(std::size_t f) const {
  mesher::Polygon polygon = facet(f);
  const bool is_as_it_was = is_same(drawn_parts(polygon, handles_), sheets_[f][0]->parts);
  if (sheets_[f].size() > 1 || !is_as_it_was) return polygon_of(*sheets_[f][0]);
  const auto rename = [&](PointId& id) { id = ids_[handles_.at(id)]; };
  for (auto& loop : polygon.loops) std::for_each(loop.begin(), loop.end(), rename);
  for (auto& e : polygon.edges) std::for_each(e.begin(), e.end(), rename);
  std::for_each(polygon.points.begin(), polygon.points.end(), rename);
  return polygon;
}

void SpaceRedrawing::add_polygon(PolygonId id, std::size_t f, const mesher::Polygon& polygon) {
  out_.file.graph.polygons.push_back(polygon);
  out_.file.graph.polygons.back().marker = facet(f).marker;
  out_.file.graph.polygons.back().id = id;
  out_.file.polygons.push_back(file_.polygons[drawn_.facets[f]]);
}

void SpaceRedrawing::draw_polygons() {
  std::int64_t last = 0;
  std::vector<std::size_t> rank(sheets_.size());
  for (std::size_t f = 0; f < sheets_.size(); ++f) {
    rank[drawn_.facets[f]] = f;
    last = std::max(last, static_cast<std::int64_t>(facet(f).id));
  }
  for (const std::size_t f : rank) {
    if (!sheets_[f].empty()) add_polygon(facet(f).id, f, first_of(f));
  }
  for (std::size_t f = 0; f < sheets_.size(); ++f) {
    note_points_on(f);
    look_at_shape(f);
    for (std::size_t i = 1; i < sheets_[f].size(); ++i) {
      const PolygonId id = next_id<PolygonId>(last);
      add_polygon(id, f, polygon_of(*sheets_[f][i]));
      late_.back().polygons.push_back(id);
    }
  }
  note_losses();
}

RepairNote<3>& SpaceRedrawing::note_polygon(RepairKind kind, std::size_t f, const Point<3>& at) {
  late_.push_back({kind, {}, {}, at, location_of_polygon(f), {facet(f).id}});
  return late_.back();
}

void SpaceRedrawing::note_points_on(std::size_t f) {
  std::vector<VertexHandle> before;
  add_points(drawn_parts(facet(f), handles_), before);
  make_set(before);
  for (const VertexHandle v : points_of(f)) {
    if (is_new(v) || std::binary_search(before.begin(), before.end(), v)) continue;
    note_polygon(RepairKind::split_at_point, f, drawing_.place(v)).points.push_back(ids_[v]);
  }
}

// Whether it was flat, and how far from where it was it is now. The last note is of its parts.
void SpaceRedrawing::look_at_shape(std::size_t f) {
  const mesher::Polygon& polygon = facet(f);
  Polygon shape;
  auto loops = polygon.loops;
  std::erase_if(loops, [](const auto& loop) { return loop.size() < 3; });
  if (!loops.empty()) put_in_order(loops, [&](PointId v) { return places_.at(v); });
  for (const auto& loop : loops) {
    for (const PointId v : loop) shape.places.push_back(places_.at(v));
    shape.loop_end.push_back(static_cast<std::uint32_t>(shape.places.size()));
  }
  const bool has_shape = !loops.empty() && find_shape(shape);
  if (has_shape && is_flat(shape)) {
    const double own = detail::deviation(shape).height;  // its corners are not in a plane, either
    for (const VertexHandle v : points_of(f)) {
      const double off = std::sqrt(distance2(drawing_.place(v), shape)) - own;
      if (off > 0) deviation2_ = std::max(deviation2_, off * off);
    }
  }
  const Point<3> at = first_place(polygon, places_);
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
    const Point<3> at = first_place(facet(loser), places_);
    note_polygon(RepairKind::overlap, loser, at).polygons.push_back(facet(taker).id);
  }
}

}  // namespace mesher::detail
