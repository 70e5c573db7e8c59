// Edits of lines: segments between points that are there, that go, or that come.
#include <algorithm>

#include "facade/state.hpp"
#include "geometry/input_point.hpp"
#include "plane/require_planar.hpp"
#include "program/world_impl.hpp"
#include "text/id_text.hpp"

namespace mesher::detail {

namespace {

template <class Visit>
void for_each_part(const LinePoints& points, Visit&& visit) {
  for (std::size_t i = 1; i < points.size(); ++i) visit(points[i - 1], points[i]);
}

[[noreturn]] void fail_in_use(PointId point, LineId line) {
  throw Error(ErrorCode::point_in_use,
              "point " + id_text(point) + " cannot go: it is an end of segment " + id_text(line),
              {}, {mesher::Feature(point), mesher::Feature(line)});
}

}  // namespace

const LinePoints& State::line(LineId id) const {
  static const LinePoints none;
  const auto it = line_points_.find(id);
  return it == line_points_.end() ? none : it->second;
}

PointId State::point(VertexHandle v) const {
  const auto it = news_.points.find(v);
  return it == news_.points.end() ? names_[v] : it->second;
}

LineId State::line(SegmentHandle s) const {
  const auto it = news_.lines.find(s);
  return it == news_.lines.end() ? lines_[s] : it->second;
}

// --- Single segments -------------------------------------------------------------------------

// The point with this id when all points have come and gone; 0 if there is none.
VertexHandle State::end_of(PointId id, const Ids& arrived) const {
  if (const auto it = arrived.find(id); it != arrived.end()) return it->second;
  const auto it = ids_.find(id);
  if (it == ids_.end()) return 0;
  return pool()[it->second].input && point(it->second) == id ? it->second : 0;
}

void State::add_part(const Part& part, const Ids& arrived) {
  const auto end = [&](PointId id) {
    const VertexHandle v = end_of(id, arrived);
    return v != 0 ? v : fail_no_end(id, part.line);
  };
  const VertexHandle a = end(part.from);
  const VertexHandle b = end(part.to);
  if (const Segment* same = segments().store().find(a, b)) {
    fail_repeated(part.line, line(same->self), *same);
  }
  const PieceRef all = segments().insert(a, b);
  news_.lines[all.piece.segment] = part.line;
  news_.segments.push_back(all.piece.segment);
  world_->splits.post_from_outside<split_segment>(split_segment_key(box_, all), all);
}

void State::take_part(VertexHandle from, VertexHandle to) {
  const PieceRef all = segments().erase(from, to);
  news_.taken.insert(all.piece.segment);
  world_->splits.retract_from_outside<split_segment>(all);
}

// --- All of an update ------------------------------------------------------------------------

void State::add_others_first() {
  if (line_edits_.empty()) return;
  for (const Part& part : take_lines({})) add_part(part, {});
  require_planar({});
  make_room_for_others();
  rename_others();
  forget_news();
}

bool State::has_lines() const noexcept {
  return segments().store().live() != 0 || !news_.segments.empty();
}

void State::make_edits(const PointEdits& edits, Ids& arrived) {
  if (limits_edit_) edit_limits(*world_, limits_edit_->options, limits_edit_->where, *engine_);
  const std::vector<Part> parts = take_lines(edits);
  require_unused(edits);
  make_points(edits, arrived);
  for (const Part& part : parts) add_part(part, arrived);
  if (has_lines()) require_planar(arrived);
}

// Leaves' records refer to those of segments, and these to those of vertices.
void State::commit_others() noexcept {
  world_->leaves.commit();
  world_->segments.commit();
}

std::size_t State::other_bytes() const { return world_->segments.bytes() + world_->leaves.bytes(); }

// Lines that go, and what stays of the others but has an end that moves. Returns what is to come:
// all of new lines, and the latter again.
std::vector<State::Part> State::take_lines(const PointEdits& points) {
  std::vector<Part> parts;
  for (const auto& edit : line_edits_) {
    for_each_part(edit.was, [&](PointId a, PointId b) { take_part(ids_.at(a), ids_.at(b)); });
    for_each_part(edit.to, [&](PointId a, PointId b) { parts.push_back({edit.id, a, b}); });
  }
  for (const auto& edit : points) {
    if (!edit.was || !edit.to) continue;
    const VertexHandle v = ids_.at(edit.id);
    std::vector<Part> moved;
    segments().store().visit_at(v, [&](const Segment& s) {
      moved.push_back({lines_[s.self], names_[s.a], names_[s.b]});
    });
    for (const Part& part : moved) take_part(ids_.at(part.from), ids_.at(part.to));
    parts.insert(parts.end(), moved.begin(), moved.end());
  }
  return parts;
}

// Requires: take_lines.
void State::require_unused(const PointEdits& edits) const {
  for (const auto& edit : edits) {
    if (!edit.was || edit.to) continue;
    std::optional<LineId> user;
    segments().store().visit_at(ids_.at(edit.id), [&](const Segment& s) {
      if (!user || lines_[s.self] < *user) user = lines_[s.self];
    });
    if (user) fail_in_use(edit.id, *user);
  }
}

// What has come fits to what is there.
void State::require_planar(const Ids& arrived) {
  std::vector<std::pair<PointId, VertexHandle>> by_id(arrived.begin(), arrived.end());
  std::sort(by_id.begin(), by_id.end());
  std::vector<VertexHandle> points;
  for (const auto& [id, h] : by_id) points.push_back(h);
  PlanarityCheck(segments().store(), pool(), features(), ask_)
      .require({news_.segments, points}, *this);
}

// --- Names -----------------------------------------------------------------------------------

// So that rename_others() cannot fail.
void State::make_room_for_others() {
  for (const auto& edit : line_edits_) {
    if (!edit.to.empty()) news_.line_points.emplace(edit.id, edit.to);
  }
  const std::size_t most = line_points_.size() + news_.line_points.size();
  const auto buckets = static_cast<float>(line_points_.bucket_count());
  // One without any needs more, though its load would do.
  if (static_cast<float>(most) >= line_points_.max_load_factor() * buckets) {
    line_points_.reserve(2 * most + 16);  // never less than there is: that would move all
  }
  SegmentHandle last = 0;
  for (const SegmentHandle h : news_.segments) last = std::max(last, h);
  if (last >= lines_.capacity()) lines_.reserve(2 * std::size_t{last} + 16);
  if (last >= lines_.size()) lines_.resize(std::size_t{last} + 1);
}

void State::rename_others() noexcept {
  for (const auto& edit : line_edits_) line_points_.erase(edit.id);
  line_points_.merge(news_.line_points);
  for (const auto& [h, id] : news_.lines) lines_[h] = id;
}

void State::forget_news() noexcept {
  line_edits_ = LineEdits();
  limits_edit_.reset();
  news_.clear();
}

}  // namespace mesher::detail
