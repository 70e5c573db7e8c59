// Lines along rods, by id; a rod belongs to the first that leads along it.
#include "repair/redraw.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <tuple>
#include <unordered_map>

namespace mesher::detail {

namespace {

constexpr std::uint32_t kNobody = ~std::uint32_t{0};

struct Line {
  FeatureId id{};
  std::int64_t marker = 0;
  std::vector<FeatureId> points;
  FilePosition position;
  bool segment = false;
  std::vector<std::vector<Spot>> runs;  // along rods of its own, gaps between them
  bool ring = false;
};

// The lines of a file, segments first.
std::vector<Line> lines_of(const PslgFile& f) {
  std::vector<Line> lines;
  for (std::size_t i = 0; i < f.pslg.segments.size(); ++i) {
    const Pslg::Segment& s = f.pslg.segments[i];
    lines.push_back({s.id, s.marker, {s.from, s.to}, f.segments[i], true, {}, false});
  }
  for (std::size_t i = 0; i < f.pslg.polylines.size(); ++i) {
    const Pslg::Polyline& line = f.pslg.polylines[i];
    const bool ring = line.points.front() == line.points.back();
    lines.push_back({line.id, line.marker, line.points, f.polylines[i], false, {}, ring});
  }
  return lines;
}

// Throws: Error(too_many).
FeatureId next_id(std::int64_t& last) {
  if (last == std::numeric_limits<std::int64_t>::max()) {
    throw Error(ErrorCode::too_many, "no id is left for what a repair makes");
  }
  return FeatureId{++last};
}

class Redrawing {
 public:
  Redrawing(const PslgFile& file, const Drawing& drawing, const std::vector<Spot>& spots,
            const std::vector<std::size_t>& keepers)
      : file_(file),
        drawing_(drawing),
        spots_(spots),
        keepers_(keepers),
        lines_(lines_of(file)),
        owners_(drawing.rods().size(), kNobody),
        news_(drawing.places().size() - keepers.size()) {
    for (std::size_t i = 0; i < spots.size(); ++i) by_id_.emplace(file.pslg.points[i].id, i);
  }

  Repaired redraw() {
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

 private:
  // A point that was not there: the lines through it, and what the first of these makes it.
  struct NewPoint {
    FeatureId id{};
    std::int64_t marker = 0;
    std::vector<double> attributes;
    Place place;
    std::set<FeatureId> lines;
  };

  [[nodiscard]] bool is_new(Spot s) const { return s >= keepers_.size(); }
  [[nodiscard]] NewPoint& news(Spot s) { return news_[s - keepers_.size()]; }
  [[nodiscard]] FeatureId id(Spot s) {
    return is_new(s) ? news(s).id : file_.pslg.points[keepers_[s]].id;
  }
  [[nodiscard]] Place place(const Line& line) const {
    return {file_.file, line.position.line, line.position.column};
  }
  void note(RepairKind kind, std::vector<FeatureId> lines, std::vector<FeatureId> points, Spot at,
            Place place) {
    out_.notes.push_back(
        {kind, std::move(lines), std::move(points), drawing_.place(at), std::move(place)});
  }

  void merge_points();
  void draw_lines();
  void draw(std::uint32_t line);
  void draw_piece(std::uint32_t line, std::size_t from, std::size_t to);
  void lead_through(const Line& line, std::size_t from, std::size_t to, Spot s);
  void step(std::uint32_t line, Spot from, Spot to, bool& is_open);
  void close_ring(Line& line);
  void add_new_points();
  void keep(const Line& line);
  void rename_rest(const Line& line);
  void add(FeatureId id, const Line& line, const std::vector<Spot>& run, bool as_segment);
  void copy_rest();
  void sort_notes();

  const PslgFile& file_;
  const Drawing& drawing_;
  const std::vector<Spot>& spots_;
  const std::vector<std::size_t>& keepers_;
  std::unordered_map<FeatureId, std::size_t> by_id_;
  std::vector<Line> lines_;
  std::vector<std::uint32_t> order_;                        // lines by id
  std::vector<std::uint32_t> owners_;                       // of rods
  std::set<std::pair<std::uint32_t, std::uint32_t>> lost_;  // of this line, to that
  std::vector<NewPoint> news_;
  std::int64_t last_line_ = 0;
  Repaired out_;
};

// --- Points ----------------------------------------------------------------------------------

void Redrawing::merge_points() {
  const auto& points = file_.pslg.points;
  const std::size_t n = file_.pslg.attributes_per_point;
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
    note(RepairKind::merged_points, {}, {points[i].id, id(s)}, s, file_.place_of_point(i));
  }
  auto& out = out_.file;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (keepers_[spots_[i]] != i) continue;
    out.pslg.points.push_back({points[i].id, points[i].at, markers[spots_[i]]});
    out.points.push_back(file_.points[i]);
    const auto first = file_.pslg.attributes.begin() + static_cast<std::ptrdiff_t>(i * n);
    out.pslg.attributes.insert(out.pslg.attributes.end(), first,
                               first + static_cast<std::ptrdiff_t>(n));
  }
}

void Redrawing::add_new_points() {
  std::int64_t last = 0;
  for (const auto& point : file_.pslg.points) {
    last = std::max(last, static_cast<std::int64_t>(point.id));
  }
  auto& out = out_.file;
  for (std::size_t i = 0; i < news_.size(); ++i) {
    NewPoint& point = news_[i];
    if (point.lines.empty()) continue;
    const auto s = static_cast<Spot>(keepers_.size() + i);
    point.id = next_id(last);
    out.pslg.points.push_back({point.id, drawing_.place(s), point.marker});
    out.points.push_back({});
    out.pslg.attributes.insert(out.pslg.attributes.end(), point.attributes.begin(),
                               point.attributes.end());
    note(RepairKind::split_at_crossing, {point.lines.begin(), point.lines.end()}, {point.id}, s,
         point.place);
  }
}

// --- Lines -----------------------------------------------------------------------------------

// A line leads through a point that it did not, between two of its points.
void Redrawing::lead_through(const Line& line, std::size_t from, std::size_t to, Spot s) {
  if (!is_new(s)) {
    note(RepairKind::split_at_point, {line.id}, {id(s)}, s, place(line));
    return;
  }
  NewPoint& point = news(s);
  if (point.lines.empty()) {
    const Point<2>&a = file_.pslg.points[from].at, &b = file_.pslg.points[to].at;
    const Point<2>& p = drawing_.place(s);
    const double x = b[0] - a[0], y = b[1] - a[1];
    const double along = ((p[0] - a[0]) * x + (p[1] - a[1]) * y) / (x * x + y * y);
    const double t = std::clamp(along, 0.0, 1.0);
    point.marker = line.marker;
    point.place = place(line);
    const std::size_t n = file_.pslg.attributes_per_point;
    for (std::size_t k = 0; k < n; ++k) {
      const double u = file_.pslg.attributes[from * n + k], w = file_.pslg.attributes[to * n + k];
      point.attributes.push_back(u * (1 - t) + w * t);
    }
  }
  point.lines.insert(line.id);
}

void Redrawing::step(std::uint32_t l, Spot from, Spot to, bool& is_open) {
  Line& line = lines_[l];
  std::uint32_t& owner = owners_[drawing_.find(from, to)];
  if (owner == kNobody) {
    owner = l;
    if (!is_open) line.runs.push_back({from});
    line.runs.back().push_back(to);
    is_open = true;
    return;
  }
  is_open = false;
  if (!lost_.emplace(l, owner).second) return;
  note(RepairKind::overlap, {line.id, lines_[owner].id}, {}, from, place(line));
}

void Redrawing::draw(std::uint32_t l) {
  bool is_open = false;
  bool first_is_own = true;
  bool any = false;
  Line& line = lines_[l];
  for (std::size_t k = 1; k < line.points.size(); ++k) {
    const std::size_t from = by_id_.at(line.points[k - 1]), to = by_id_.at(line.points[k]);
    Spot s = spots_[from];
    if (s == spots_[to]) {
      note(RepairKind::zero_length, {line.id}, {id(s)}, s, place(line));
      continue;
    }
    const Point<2>&a = file_.pslg.points[from].at, &b = file_.pslg.points[to].at;
    drawing_.walk(drawing_.find(s, spots_[to]), s, [&](Spot t) {
      if (t != spots_[to]) lead_through(line, from, to, t);
      out_.deviation = std::max(out_.deviation, distance2(drawing_.place(t), a, b));
      step(l, s, t, is_open);
      if (!any) first_is_own = is_open;
      any = true;
      s = t;
    });
  }
  if (line.ring && is_open && first_is_own && line.runs.size() > 1) close_ring(line);
}

// The run behind the last gap goes on as the first.
void Redrawing::close_ring(Line& line) {
  auto& first = line.runs.front();
  auto& last = line.runs.back();
  last.insert(last.end(), first.begin() + 1, first.end());
  first = std::move(last);
  line.runs.pop_back();
}

void Redrawing::draw_lines() {
  for (std::uint32_t l = 0; l < lines_.size(); ++l) order_.push_back(l);
  std::sort(order_.begin(), order_.end(),
            [&](std::uint32_t l, std::uint32_t m) { return lines_[l].id < lines_[m].id; });
  for (const std::uint32_t l : order_) draw(l);
  for (const auto& [id, i] : by_id_) {  // of points, what merging has moved
    const Point<2>& p = drawing_.place(spots_[i]);
    out_.deviation = std::max(out_.deviation, distance2(file_.pslg.points[i].at, p, p));
  }
  out_.deviation = std::sqrt(out_.deviation);
}

void Redrawing::add(FeatureId line_id, const Line& line, const std::vector<Spot>& run,
                    bool as_segment) {
  auto& out = out_.file;
  std::vector<FeatureId> points;
  for (const Spot s : run) points.push_back(id(s));
  if (as_segment) {
    out.pslg.segments.push_back({line_id, points[0], points[1], line.marker});
    out.segments.push_back(line.position);
    return;
  }
  out.pslg.polylines.push_back({line_id, std::move(points), line.marker});
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
    const FeatureId fresh = next_id(last_line_);
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
  out.pslg.attributes_per_point = file_.pslg.attributes_per_point;
  out.pslg.holes = file_.pslg.holes;
  out.holes = file_.holes;
  out.pslg.regions = file_.pslg.regions;
  out.regions = file_.regions;
  out.pslg.sizes = file_.pslg.sizes;
}

void Redrawing::sort_notes() {
  std::sort(out_.notes.begin(), out_.notes.end(), [](const RepairNote& a, const RepairNote& b) {
    return std::tie(a.kind, a.lines, a.points, a.at) < std::tie(b.kind, b.lines, b.points, b.at);
  });
}

}  // namespace

Repaired redraw(const PslgFile& file, const Drawing& drawing, const std::vector<Spot>& spots,
                const std::vector<std::size_t>& keepers) {
  return Redrawing(file, drawing, spots, keepers).redraw();
}

}  // namespace mesher::detail
