// The points and lines that come out, and what has been done.
#include "repair/redraw.hpp"

#include <algorithm>
#include <limits>
#include <tuple>

#include "repair/merging.hpp"
#include "repair/redrawing.hpp"

namespace mesher::detail {

std::int64_t next_number(std::int64_t& last) {
  if (last == std::numeric_limits<std::int64_t>::max()) {
    throw Error(ErrorCode::too_many, "no id is left for what a repair makes");
  }
  return ++last;
}

// The lines of a file, segments first.
std::vector<Redrawing::Line> Redrawing::lines_of(const GraphFile<2>& f) {
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

Redrawing::Redrawing(const GraphFile<2>& file, const Drawing& drawing,
                     const std::vector<Spot>& spots, const std::vector<std::size_t>& keepers)
    : file_(file),
      drawing_(drawing),
      spots_(spots),
      keepers_(keepers),
      lines_(lines_of(file)),
      owners_(drawing.rods().size(), kNobody),
      news_(drawing.places().size() - keepers.size()) {
  for (std::size_t i = 0; i < spots.size(); ++i) by_id_.emplace(file.graph.points[i].id, i);
}

Repaired<2> Redrawing::redraw() {
  merge_points();
  draw_lines();
  add_new_points();
  for (const Line& line : lines_) keep(line);
  for (const std::uint32_t l : order_) rename_rest(lines_[l]);
  copy_rest();
  sort_notes();
  out_.tolerance = drawing_.tolerance();
  return std::move(out_);
}

// --- Points ----------------------------------------------------------------------------------

void Redrawing::merge_points() {
  const auto& points = file_.graph.points;
  const std::size_t n = file_.graph.attributes_per_point;
  std::vector<std::int64_t> markers;
  for (const std::size_t k : keepers_) markers.push_back(points[k].marker);
  std::vector<std::size_t> gone;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (keepers_[spots_[i]] != i) gone.push_back(i);
  }
  std::sort(gone.begin(), gone.end(), [&](auto i, auto j) { return points[i].id < points[j].id; });
  for (const std::size_t i : gone) {
    const Spot s = spots_[i];
    if (markers[s] == 0) markers[s] = points[i].marker;
    note(RepairKind::merged_points, {}, {points[i].id, id(s)}, s, file_.location_of_point(i));
  }
  auto& out = out_.file;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (keepers_[spots_[i]] != i) continue;
    out.graph.points.push_back({points[i].id, points[i].at, markers[spots_[i]]});
    out.points.push_back(file_.points[i]);
    const auto first = file_.graph.attributes.begin() + static_cast<std::ptrdiff_t>(i * n);
    out.graph.attributes.insert(out.graph.attributes.end(), first,
                                first + static_cast<std::ptrdiff_t>(n));
  }
}

void Redrawing::add_new_points() {
  std::int64_t last = 0;
  for (const auto& point : file_.graph.points) {
    last = std::max(last, static_cast<std::int64_t>(point.id));
  }
  auto& out = out_.file;
  for (std::size_t i = 0; i < news_.size(); ++i) {
    NewPoint& point = news_[i];
    if (point.lines.empty()) continue;
    const auto s = static_cast<Spot>(keepers_.size() + i);
    point.id = next_id<PointId>(last);
    out.graph.points.push_back({point.id, drawing_.place(s), point.marker});
    out.points.push_back({});
    out.graph.attributes.insert(out.graph.attributes.end(), point.attributes.begin(),
                                point.attributes.end());
    note(RepairKind::split_at_crossing, {point.lines.begin(), point.lines.end()}, {point.id}, s,
         point.place);
  }
}

// --- Lines -----------------------------------------------------------------------------------

void Redrawing::add(LineId line_id, const Line& line, const std::vector<Spot>& run,
                    bool as_segment) {
  auto& out = out_.file;
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

void Redrawing::keep(const Line& line) {
  last_line_ = std::max(last_line_, static_cast<std::int64_t>(line.id));
  if (line.runs.empty()) {
    note(RepairKind::dropped_line, {line.id}, {}, spots_[by_id_.at(line.points[0])], place(line));
    return;
  }
  add(line.id, line, line.runs[0], line.segment && line.runs[0].size() == 2);
}

void Redrawing::rename_rest(const Line& line) {
  for (std::size_t i = 1; i < line.runs.size(); ++i) {
    const auto& run = line.runs[i];
    const LineId fresh = next_id<LineId>(last_line_);
    add(fresh, line, run, run.size() == 2);
    note(RepairKind::renamed, {line.id, fresh}, {}, run[0], place(line));
  }
}

// --- The rest --------------------------------------------------------------------------------

void Redrawing::copy_rest() {
  auto& out = out_.file;
  out.file = file_.file;
  out.point_file = file_.point_file;
  out.notes = file_.notes;
  out.graph.attributes_per_point = file_.graph.attributes_per_point;
  out.graph.seeds = file_.graph.seeds;
  out.seeds = file_.seeds;
}

void Redrawing::sort_notes() {
  std::sort(out_.notes.begin(), out_.notes.end(),
            [](const RepairNote<2>& a, const RepairNote<2>& b) {
              return std::tie(a.kind, a.lines, a.points, a.at) <
                     std::tie(b.kind, b.lines, b.points, b.at);
            });
}

Repaired<2> redraw(const GraphFile<2>& file, const Drawing& drawing, const std::vector<Spot>& spots,
                   const std::vector<std::size_t>& keepers) {
  return Redrawing(file, drawing, spots, keepers).redraw();
}

}  // namespace mesher::detail
