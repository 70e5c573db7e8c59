// The lines to blame.
#include "segments/lost_edge.hpp"

#include <algorithm>
#include <set>
#include <string>
#include <utility>

#include "input.hpp"

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

// The leaf's line, then the first of the others.
std::vector<FeatureId> lines_of(const Leaf& leaf, const std::set<SegmentHandle>& others,
                                const Names& names) {
  constexpr std::size_t kMost = 4;
  std::vector<FeatureId> ids{names.line(leaf.piece.segment)};
  for (const SegmentHandle s : others) ids.push_back(names.line(s));
  std::sort(ids.begin() + 1, ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  ids.resize(std::min(ids.size(), kMost));
  return ids;
}

std::string list(const std::vector<FeatureId>& ids) {
  if (ids.empty()) return "lines";
  std::string text;
  for (const FeatureId id : ids) {
    text += text.empty() ? "segment " : ", segment ";
    text += std::to_string(static_cast<std::int64_t>(id));
  }
  return text;
}

}  // namespace

void LostEdge::require_none(const VertexSearch<2>& vertices, const SegmentPool& segments,
                            const Names* names) const {
  if (first_ == nullptr) return;
  const std::set<SegmentHandle> others = segments_in_ball(*first_, vertices);
  std::vector<FeatureId> ids;
  if (names != nullptr) ids = lines_of(*first_, others, *names);
  std::string text = list(ids) + " meet ";
  if (!others.empty()) {
    text += "at " + place_text(common_end(*first_->segment, segments[*others.begin()])) + " ";
  }
  throw Error(ErrorCode::too_close,
              text + "at angles too small for double precision: no edge joins " +
                  place_text(first_->lo) + " and " + place_text(first_->hi),
              {}, std::move(ids));
}

}  // namespace mesher::detail
