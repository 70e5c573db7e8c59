// The points and lines that come out, and what has been done.
#include "repair/redraw.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "repair/redrawing.hpp"

namespace mesher::detail {

std::int64_t next_number(std::int64_t& last) {
  if (last == std::numeric_limits<std::int64_t>::max()) {
    throw Error(ErrorCode::too_many, "no id is left for what a repair makes");
  }
  return ++last;
}

// The lines of a file, segments first.
template <int D>
std::vector<typename Redrawing<D>::Line> Redrawing<D>::lines_of(const GraphFile<D>& f) {
  std::vector<Line> lines;
  for (std::size_t i = 0; i < f.graph.segments.size(); ++i) {
    const mesher::Segment& s = f.graph.segments[i];
    lines.push_back({s.id, s.marker, {s.from, s.to}, f.segments[i], true, {}, false});
  }
  for (std::size_t i = 0; i < f.graph.polylines.size(); ++i) {
    const mesher::Polyline& line = f.graph.polylines[i];
    const bool ring = line.points.front() == line.points.back();
    lines.push_back({line.id, line.marker, line.points, f.polylines[i], false, {}, ring});
  }
  return lines;
}

template <int D>
Redrawing<D>::Redrawing(const GraphFile<D>& file, const Drawing<D>& drawing, const Drawn<D>& drawn)
    : file_(file),
      drawing_(drawing),
      drawn_(drawn),
      news_(drawing.places().size() - drawn.keepers.size()),
      lines_(lines_of(file)),
      order_(ranked(lines_)) {}

template <int D>
Repaired<D> Redrawing<D>::redraw() {
  merge_points();
  for (std::size_t rank = 0; rank < order_.size(); ++rank) draw(rank);
  look_at_new_points();
  add_new_points();
  for (const Line& line : lines_) keep(line);
  for (const std::size_t l : order_) rename_rest(lines_[l]);
  draw_polygons();
  copy_rest();
  sort_notes();
  out_.deviation = std::sqrt(out_.deviation);
  return std::move(out_);
}

// --- Points ----------------------------------------------------------------------------------

template <int D>
void Redrawing<D>::merge_points() {
  const auto& points = file_.graph.points;
  std::vector<std::int64_t> markers;
  for (const std::size_t k : drawn_.keepers) markers.push_back(points[k].marker);
  const auto marker = [&](std::size_t i) -> std::int64_t& {
    return markers[drawn_.number_of(drawn_.spots[i])];
  };
  for (const std::size_t i : ranked(points)) {
    if (drawn_.stays(i)) continue;
    const Spot s = drawn_.spots[i];
    if (marker(i) == 0) marker(i) = points[i].marker;
    deviates_by(squared_distance(points[i].at, place(s)));
    note(RepairKind::merged_points, {}, {points[i].id, id(s)}, place(s),
         file_.location_of_point(i));
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!drawn_.stays(i)) continue;
    add_point(points[i].id, points[i].at, marker(i), file_.points[i], attributes_of(i));
  }
}

template <int D>
void Redrawing<D>::add_point(PointId id, const Point<D>& at, std::int64_t marker,
                             FilePosition position, std::span<const double> attributes) {
  GraphFile<D>& out = out_.file;
  out.graph.points.push_back({id, at, marker});
  out.points.push_back(position);
  out.graph.attributes.insert(out.graph.attributes.end(), attributes.begin(), attributes.end());
}

template <int D>
void Redrawing<D>::add_new_points() {
  std::int64_t last = 0;
  for (const auto& p : file_.graph.points) last = std::max(last, static_cast<std::int64_t>(p.id));
  for (std::size_t i = drawn_.keepers.size(); i < drawing_.places().size(); ++i) {
    NewPoint& point = news_[i - drawn_.keepers.size()];
    if (!point.is_used()) continue;
    point.id = next_id<PointId>(last);
    const Point<D>& at = drawing_.places()[i];
    add_point(point.id, at, point.marker, {}, point.attributes);
    note(RepairKind::split_at_crossing, {point.lines.begin(), point.lines.end()}, {point.id}, at,
         point.location)
        .polygons.assign(point.polygons.begin(), point.polygons.end());
  }
}

// --- What lines lead along -------------------------------------------------------------------

template <int D>
std::vector<double> Redrawing<D>::between(const Point<D>& p, const Point<D>& a, const Point<D>& b,
                                          std::span<const double> at_a,
                                          std::span<const double> at_b) {
  const Point<D> along = minus(b, a);
  const double t = std::clamp(dot(minus(p, a), along) / squared(along), 0.0, 1.0);
  std::vector<double> all;
  for (std::size_t k = 0; k < at_a.size(); ++k) all.push_back(at_a[k] * (1 - t) + at_b[k] * t);
  return all;
}

template <int D>
void Redrawing<D>::draw(std::size_t rank) {
  const std::size_t l = order_[rank];
  Line& line = lines_[l];
  bool is_open = false;
  bool first_is_own = true;
  bool any = false;
  for (std::size_t k = 1; k < line.points.size(); ++k) {
    const std::size_t from = drawn_.by_id.at(line.points[k - 1]),
                      to = drawn_.by_id.at(line.points[k]);
    const Spot first = drawn_.spots[from], last = drawn_.spots[to];
    if (first == last) {
      note(RepairKind::zero_length, {line.id}, {id(first)}, place(first), location(line));
      continue;
    }
    const std::vector<Spot> way = this->way(rank, first, last);
    for (std::size_t i = 1; i < way.size(); ++i) {
      if (way[i] != last) lead_through(line, from, to, way[i]);
      step(l, way[i - 1], way[i], is_open);
      if (!any) first_is_own = is_open;
      any = true;
    }
  }
  if (line.ring && is_open && first_is_own && line.runs.size() > 1) close_ring(line);
}

// The points between two that a line has, those included.
template <int D>
std::vector<Spot> Redrawing<D>::way(std::size_t rank, Spot from, Spot to) const {
  if constexpr (D == 2) {
    static_cast<void>(rank);
    return drawing_.way(from, to);
  } else {
    return drawing_.paths()[rank];
  }
}

// A line leads through a point that it did not, between two of the file's points.
template <int D>
void Redrawing<D>::lead_through(const Line& line, std::size_t from, std::size_t to, Spot s) {
  const Point<D>&a = file_.graph.points[from].at, &b = file_.graph.points[to].at;
  deviates_by(distance2(place(s), a, b));
  if (!drawn_.is_new(s)) {
    note(RepairKind::split_at_point, {line.id}, {id(s)}, place(s), location(line));
    return;
  }
  NewPoint& point = news(s);
  if (!point.is_used()) {
    point.marker = line.marker;
    point.location = location(line);
    if constexpr (D == 2) {
      point.attributes = between(place(s), a, b, attributes_of(from), attributes_of(to));
    }
  }
  point.lines.insert(line.id);
}

template <int D>
void Redrawing<D>::step(std::size_t l, Spot from, Spot to, bool& is_open) {
  Line& line = lines_[l];
  const auto [owner, is_own] = owners_.emplace(ends_key(from, to), l);
  if (is_own) {
    if (!is_open || D == 3) line.runs.push_back({from});
    line.runs.back().push_back(to);
    is_open = true;
    return;
  }
  is_open = false;
  if (!lost_.emplace(l, owner->second).second) return;
  note(RepairKind::overlap, {line.id, lines_[owner->second].id}, {}, place(from), location(line));
}

// The run behind the last gap goes on as the first.
template <int D>
void Redrawing<D>::close_ring(Line& line) {
  auto& first = line.runs.front();
  auto& last = line.runs.back();
  last.insert(last.end(), first.begin() + 1, first.end());
  first = std::move(last);
  line.runs.pop_back();
}

// --- Lines -----------------------------------------------------------------------------------

template <int D>
void Redrawing<D>::add(LineId line_id, const Line& line, const std::vector<Spot>& run,
                       bool as_segment) {
  GraphFile<D>& out = out_.file;
  std::vector<PointId> points;
  for (const Spot s : run) points.push_back(id(s));
  if (as_segment) {
    out.graph.segments.push_back({line_id, points[0], points[1], line.marker});
    out.segments.push_back(line.position);
    return;
  }
  out.graph.polylines.push_back({line_id, std::move(points), line.marker});
  out.polylines.push_back(line.position);
}

template <int D>
void Redrawing<D>::keep(const Line& line) {
  last_line_ = std::max(last_line_, static_cast<std::int64_t>(line.id));
  if (line.runs.empty()) {
    const Spot s = drawn_.spot(line.points[0]);
    note(RepairKind::dropped_line, {line.id}, {}, place(s), location(line));
    return;
  }
  add(line.id, line, line.runs[0], line.segment && line.runs[0].size() == 2);
}

template <int D>
void Redrawing<D>::rename_rest(const Line& line) {
  for (std::size_t i = 1; i < line.runs.size(); ++i) {
    const auto& run = line.runs[i];
    const LineId fresh = next_id<LineId>(last_line_);
    add(fresh, line, run, run.size() == 2);
    note(RepairKind::renamed, {line.id, fresh}, {}, place(run[0]), location(line));
  }
}

// --- The rest --------------------------------------------------------------------------------

template <int D>
void Redrawing<D>::copy_rest() {
  GraphFile<D>& out = out_.file;
  out.file = file_.file;
  out.point_file = file_.point_file;
  out.notes = file_.notes;
  out.graph.attributes_per_point = file_.graph.attributes_per_point;
  out.graph.seeds = file_.graph.seeds;
  out.seeds = file_.seeds;
}

template <int D>
void Redrawing<D>::sort_notes() {
  std::sort(out_.notes.begin(), out_.notes.end(),
            [](const RepairNote<D>& a, const RepairNote<D>& b) {
              return std::tie(a.kind, a.lines, a.polygons, a.points, a.at) <
                     std::tie(b.kind, b.lines, b.polygons, b.points, b.at);
            });
}

template class Redrawing<2>;
template class Redrawing<3>;

Repaired<2> redraw(const GraphFile<2>& file, const Drawing<2>& drawing, const Drawn<2>& drawn) {
  return Redrawing<2>(file, drawing, drawn).redraw();
}

}  // namespace mesher::detail
