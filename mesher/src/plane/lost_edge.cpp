// The lines to blame.
#include "plane/lost_edge.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "geometry/input_point.hpp"
#include "geometry/small_angle.hpp"
#include "text/text.hpp"

namespace mesher::detail {

namespace {

// The segments with vertices in the leaf's ball, its own left out.
std::set<SegmentHandle> segments_in_ball(const Leaf& leaf, const VertexSearch<2>& vertices) {
  std::set<SegmentHandle> all;
  vertices.for_each_in_ball(leaf.lo, leaf.hi, [&](const Vertex<2>& v) {
    if (!v.alive || !v.on_segment || !leaf.has_in_ball(v.p)) return;
    all.insert(vertices.role(v).on);
  });
  all.erase(leaf.piece.segment);
  return all;
}

Point<2> common_end(const Segment& s, const Segment& t) {
  return t.has_end(s.a) ? s.place_a : s.place_b;
}

Point<2> direction_from(const Point<2>& end, const Segment& s) {
  const Point<2>& other = s.place_a == end ? s.place_b : s.place_a;
  return {other[0] - end[0], other[1] - end[1]};
}

// Where the leaf's segment meets the others, and the smallest angle at which it does.
std::string meeting(const Segment& s, const std::set<SegmentHandle>& others,
                    const SegmentPool& segments) {
  const Point<2> apex = common_end(s, segments[*others.begin()]);
  double least = kSmall;
  for (const SegmentHandle other : others) {
    const Segment& t = segments[other];
    if (t.place_a != apex && t.place_b != apex) continue;
    least = std::min(least, degrees_between(direction_from(apex, s), direction_from(apex, t)));
  }
  return "at " + place_text(apex) + " at angles down to " + text::to_text(least) + " degrees, ";
}

// The leaf's line, then the first of the others.
std::vector<mesher::Feature> lines_of(const Leaf& leaf, const std::set<SegmentHandle>& others,
                                      const Names& names) {
  constexpr std::size_t kMost = 4;
  std::vector<LineId> ids{names.line(leaf.piece.segment)};
  for (const SegmentHandle s : others) ids.push_back(names.line(s));
  std::sort(ids.begin() + 1, ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  ids.resize(std::min(ids.size(), kMost));
  std::vector<mesher::Feature> lines;
  for (const LineId id : ids) lines.push_back(mesher::Feature(id));
  return lines;
}

std::string list(const std::vector<mesher::Feature>& lines) {
  if (lines.empty()) return "lines";
  std::string text;
  for (const mesher::Feature& line : lines) text += (text.empty() ? "" : ", ") + text_of(line);
  return text;
}

}  // namespace

Error lost_edge(const Leaf& leaf, const std::set<SegmentHandle>& others,
                const SegmentPool& segments, const Names* names) {
  std::vector<mesher::Feature> lines;
  if (names != nullptr) lines = lines_of(leaf, others, *names);
  std::string text = list(lines) + " meet ";
  text += others.empty() ? "at angles " : meeting(*leaf.segment, others, segments);
  return Error(ErrorCode::too_close,
               text + "too small for double precision: no edge joins " + place_text(leaf.lo) +
                   " and " + place_text(leaf.hi),
               {}, std::move(lines), {position_of(leaf.lo), position_of(leaf.hi)});
}

void LostEdge::require_none(const VertexSearch<2>& vertices, const SegmentPool& segments,
                            const Names* names) const {
  if (first_ == nullptr) return;
  throw lost_edge(*first_, segments_in_ball(*first_, vertices), segments, names);
}

}  // namespace mesher::detail
