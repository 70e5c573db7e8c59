// What an update brings of points' and lines' names, until it is done.
#pragma once

#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "facade/pending_lines.hpp"
#include "records/segment.hpp"

namespace mesher::detail {

struct LineNews {
  using Lines = std::unordered_map<LineId, LinePoints>;

  std::unordered_map<VertexHandle, PointId> points;
  std::unordered_map<SegmentHandle, LineId> lines;  // of segments
  std::vector<SegmentHandle> segments;              // in the order in which they came
  Lines line_points;
  std::unordered_set<SegmentHandle> taken;  // segments that went; some have come again

  /// Forgets all. Tables that were large once are given back: to clear them again takes time in
  /// their size.
  void clear() noexcept {
    points = decltype(points)();  // not {}, an empty list, for which a table keeps its size
    lines = decltype(lines)();
    segments.clear();
    line_points = Lines();
    taken = decltype(taken)();
  }
  /// How many buckets the tables have: what it takes to clear them.
  [[nodiscard]] std::size_t buckets() const noexcept {
    return points.bucket_count() + lines.bucket_count() + line_points.bucket_count() +
           taken.bucket_count();
  }
};

}  // namespace mesher::detail
