// The points, segments and polygons that come out, and what has been done.
#include "repair/space_redraw.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "repair/merging.hpp"
#include "repair/space_redrawing.hpp"
#include "sets/make_set.hpp"

namespace mesher::detail {

PolygonParts drawn_parts(const mesher::Polygon& polygon,
                         const std::unordered_map<PointId, VertexHandle>& handles) {
  PolygonParts parts;
  for (const auto& loop : polygon.loops) {
    Loop& corners = parts.loops.emplace_back();
    for (const PointId id : loop) corners.push_back(handles.at(id));
  }
  for (const auto& [a, b] : polygon.edges) parts.edges.emplace_back(handles.at(a), handles.at(b));
  for (const PointId id : polygon.points) parts.points.push_back(handles.at(id));
  return parts;
}

SpaceRedrawing::SpaceRedrawing(const GraphFile<3>& file, const SpaceDrawing& drawing,
                               const Drawn& drawn)
    : file_(file),
      plc_(file.graph),
      drawing_(drawing),
      drawn_(drawn),
      sheets_(plc_.polygons.size()) {
  for (std::size_t i = 0; i < plc_.points.size(); ++i) {
    handles_.emplace(plc_.points[i].id, drawn.points[i]);
    places_.emplace(plc_.points[i].id, plc_.points[i].at);
  }
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

Repaired<3> SpaceRedrawing::redraw() {
  merge_points();
  add_new_points();
  draw_segments();
  draw_polygons();
  for (auto& note : late_) out_.notes.push_back(std::move(note));
  copy_rest();
  std::sort(out_.notes.begin(), out_.notes.end(), [](const auto& a, const auto& b) {
    return std::tie(a.kind, a.lines, a.polygons, a.points, a.at) <
           std::tie(b.kind, b.lines, b.polygons, b.points, b.at);
  });
  out_.tolerance = drawing_.tolerance();
  out_.deviation = std::sqrt(deviation2_);
  return std::move(out_);
}

// --- Points ----------------------------------------------------------------------------------

void SpaceRedrawing::merge_points() {
  const auto& points = plc_.points;
  const std::size_t n = plc_.attributes_per_point;
  ids_.resize(drawing_.points() + 1);
  markers_.resize(ids_.size());
  attributes_.resize(ids_.size());
  for (std::size_t k = 0; k < drawn_.keepers.size(); ++k) {
    const std::size_t i = drawn_.keepers[k];
    ids_[k + 1] = points[i].id;
    markers_[k + 1] = points[i].marker;
    const auto first = plc_.attributes.begin() + static_cast<std::ptrdiff_t>(i * n);
    attributes_[k + 1].assign(first, first + static_cast<std::ptrdiff_t>(n));
  }
  std::vector<std::size_t> gone;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!stays(i)) gone.push_back(i);
  }
  std::sort(gone.begin(), gone.end(), [&](auto i, auto j) { return points[i].id < points[j].id; });
  for (const std::size_t i : gone) {
    const VertexHandle v = drawn_.points[i];
    if (markers_[v] == 0) markers_[v] = points[i].marker;
    deviation2_ = std::max(deviation2_, squared_distance(points[i].at, drawing_.place(v)));
    out_.notes.push_back({RepairKind::merged_points,
                          {},
                          {points[i].id, ids_[v]},
                          drawing_.place(v),
                          file_.location_of_point(i)});
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (stays(i)) add_point(drawn_.points[i], points[i].at, file_.points[i]);
  }
}

void SpaceRedrawing::add_point(VertexHandle v, const Point<3>& at, FilePosition position) {
  out_.file.graph.points.push_back({ids_[v], at, markers_[v]});
  out_.file.points.push_back(position);
  auto& all = out_.file.graph.attributes;
  all.insert(all.end(), attributes_[v].begin(), attributes_[v].end());
}

// Those that somebody has, with notes of who.
void SpaceRedrawing::add_new_points() {
  std::map<VertexHandle, std::array<std::vector<std::size_t>, 2>> users;  // segments, facets
  for (std::size_t s = 0; s < drawing_.paths().size(); ++s) {
    for (const VertexHandle v : drawing_.paths()[s]) {
      if (is_new(v)) users[v][0].push_back(s);
    }
  }
  for (std::size_t f = 0; f < sheets_.size(); ++f) {
    for (const VertexHandle v : points_of(f)) {
      if (is_new(v)) users[v][1].push_back(f);
    }
  }
  std::int64_t last = 0;
  for (const auto& p : plc_.points) last = std::max(last, static_cast<std::int64_t>(p.id));
  for (VertexHandle v = static_cast<VertexHandle>(drawn_.keepers.size()) + 1; v < ids_.size();
       ++v) {
    interpolate(v);
    const auto it = users.find(v);
    if (it == users.end()) continue;
    ids_[v] = next_id<PointId>(last);
    auto& [segments, facets] = it->second;
    make_set(segments);
    RepairNote<3> note{RepairKind::split_at_crossing, {}, {ids_[v]}, drawing_.place(v), {}};
    for (const std::size_t s : segments) note.lines.push_back(segment(s).id);
    for (const std::size_t f : facets) note.polygons.push_back(facet(f).id);
    note.location =
        segments.empty() ? location_of_polygon(facets[0]) : location_of_segment(segments[0]);
    markers_[v] = segments.empty() ? facet(facets[0]).marker : segment(segments[0]).marker;
    out_.notes.push_back(std::move(note));
    add_point(v, drawing_.place(v), {});
  }
}

void SpaceRedrawing::interpolate(VertexHandle v) {
  const auto [a, b] = drawing_.was_on(v);
  const double t = nearest_fraction(drawing_.place(v), drawing_.place(a), drawing_.place(b));
  for (std::size_t k = 0; k < plc_.attributes_per_point; ++k) {
    attributes_[v].push_back(attributes_[a][k] * (1 - t) + attributes_[b][k] * t);
  }
}

// --- Segments --------------------------------------------------------------------------------

void SpaceRedrawing::draw_segments() {
  std::int64_t last = 0;
  for (const auto& s : plc_.segments) last = std::max(last, static_cast<std::int64_t>(s.id));
  std::map<Ends, std::size_t> owners;
  std::vector<std::vector<Ends>> pieces(plc_.segments.size());
  for (std::size_t s = 0; s < pieces.size(); ++s) {
    const Path& path = drawing_.paths()[s];
    if (path.front() == path.back()) note_segment(RepairKind::zero_length, s, path[0], true);
    std::set<std::size_t> lost;
    for (std::size_t i = 1; i < path.size(); ++i) {
      const VertexHandle v = path[i - 1], w = path[i];
      if (i > 1 && !is_new(v)) note_segment(RepairKind::split_at_point, s, v, true);
      measure(v, s);
      if (v == w) continue;
      const auto [it, is_first] = owners.emplace(Ends{std::min(v, w), std::max(v, w)}, s);
      if (is_first) {
        pieces[s].push_back({v, w});
      } else if (lost.insert(it->second).second) {
        note_segment(RepairKind::overlap, s, v, false).lines.push_back(segment(it->second).id);
      }
    }
    if (pieces[s].empty()) note_segment(RepairKind::dropped_line, s, path[0], false);
  }
  std::vector<std::size_t> rank(pieces.size());
  for (std::size_t s = 0; s < pieces.size(); ++s) rank[drawn_.segments[s]] = s;
  for (const std::size_t s : rank) {
    if (!pieces[s].empty()) add_segment(segment(s).id, s, pieces[s][0]);
  }
  for (std::size_t s = 0; s < pieces.size(); ++s) {
    for (std::size_t i = 1; i < pieces[s].size(); ++i) {
      const LineId id = next_id<LineId>(last);
      add_segment(id, s, pieces[s][i]);
      note_segment(RepairKind::renamed, s, pieces[s][i].first, false).lines.push_back(id);
    }
  }
}

void SpaceRedrawing::add_segment(LineId id, std::size_t s, const Ends& ends) {
  out_.file.graph.segments.push_back({id, ids_[ends.first], ids_[ends.second], segment(s).marker});
  out_.file.segments.push_back(file_.segments[drawn_.segments[s]]);
}

RepairNote<3>& SpaceRedrawing::note_segment(RepairKind kind, std::size_t s, VertexHandle v,
                                            bool names_it) {
  late_.push_back({kind, {segment(s).id}, {}, drawing_.place(v), location_of_segment(s)});
  if (names_it) late_.back().points.push_back(ids_[v]);
  return late_.back();
}

void SpaceRedrawing::measure(VertexHandle v, std::size_t s) {
  const Point<3>&a = places_.at(segment(s).from), &b = places_.at(segment(s).to);
  deviation2_ = std::max(deviation2_, distance2(drawing_.place(v), a, b));
}

// --- The rest --------------------------------------------------------------------------------

void SpaceRedrawing::copy_rest() {
  auto& out = out_.file;
  out.file = file_.file;
  out.point_file = file_.point_file;
  out.notes = file_.notes;
  out.graph.attributes_per_point = plc_.attributes_per_point;
  out.graph.seeds = plc_.seeds;
  out.seeds = file_.seeds;
}

Repaired<3> redraw(const GraphFile<3>& file, const SpaceDrawing& drawing, const Drawn& drawn) {
  return SpaceRedrawing(file, drawing, drawn).redraw();
}

}  // namespace mesher::detail
