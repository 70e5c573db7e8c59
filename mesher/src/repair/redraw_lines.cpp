// What lines lead along, and which points they lead through.
#include <algorithm>
#include <cmath>

#include "repair/redrawing.hpp"

namespace mesher::detail {

// A line leads through a point that it did not, between two of its points.
void Redrawing::lead_through(const Line& line, std::size_t from, std::size_t to, Spot s) {
  if (!is_new(s)) {
    note(RepairKind::split_at_point, {line.id}, {id(s)}, s, place(line));
    return;
  }
  NewPoint& point = news(s);
  if (point.lines.empty()) {
    const Point<2>&a = file_.graph.points[from].at, &b = file_.graph.points[to].at;
    const Point<2>& p = drawing_.place(s);
    const double x = b[0] - a[0], y = b[1] - a[1];
    const double along = ((p[0] - a[0]) * x + (p[1] - a[1]) * y) / (x * x + y * y);
    const double t = std::clamp(along, 0.0, 1.0);
    point.marker = line.marker;
    point.place = place(line);
    const std::size_t n = file_.graph.attributes_per_point;
    for (std::size_t k = 0; k < n; ++k) {
      const double u = file_.graph.attributes[from * n + k], w = file_.graph.attributes[to * n + k];
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
    const Point<2>&a = file_.graph.points[from].at, &b = file_.graph.points[to].at;
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
    out_.deviation = std::max(out_.deviation, distance2(file_.graph.points[i].at, p, p));
  }
  out_.deviation = std::sqrt(out_.deviation);
}

}  // namespace mesher::detail
