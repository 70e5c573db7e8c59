// Finds and names the faults that make an input not planar, near the feature that causes them.
#pragma once

#include <optional>
#include <vector>

#include "index/features.hpp"
#include "mesher/error.hpp"
#include "plane/crowding.hpp"
#include "plane/segment_store.hpp"
#include "records/roles.hpp"

namespace mesher::detail {

/// What features are called.
class Names {
 public:
  [[nodiscard]] virtual PointId point(VertexHandle v) const = 0;
  [[nodiscard]] virtual LineId line(SegmentHandle s) const = 0;

 protected:
  ~Names() = default;
};

/// What a feature is in the way of.
struct Conflict {
  enum class Kind { overlap, point_on_segment, crossing };  // the first is named of several
  Kind kind = Kind::overlap;
  const Segment* segment = nullptr;
  const Segment* other = nullptr;    // of overlap and crossing
  const Vertex<2>* point = nullptr;  // on the segment
};

/// What live segments and points a live segment overlaps, crosses or has on it, the first in
/// canonical order. Exact. Cost: O(log L/s), and what is near.
template <class S>
[[nodiscard]] std::optional<Conflict> conflict_of(const Segment& s, SegmentStore& segments,
                                                  const Features<S>& points);
/// The same for an input point.
[[nodiscard]] std::optional<Conflict> conflict_of(const Vertex<2>& v, SegmentStore& segments);

/// Throws: Error (overlapping_segments, point_on_segment, crossing_segments) with the ids of both
/// and the place.
[[noreturn]] void fail(const Conflict& conflict, const Names& names);

/// Throws: Error, as the name says, with the ids of both.
[[noreturn]] void fail_repeated(LineId line, LineId other, const Segment& s);
[[noreturn]] void fail_zero_length(LineId line, PointId point, std::vector<Position> places);
[[noreturn]] VertexHandle fail_no_end(PointId point, LineId line);  // unknown_id

/// A segment and a feature that are too close to each other, near a piece that the feature crowds.
[[nodiscard]] Error too_close_to_segment(const PieceRef& piece, Witness witness, const Names* names,
                                         const VertexPool<2>& points, const SegmentPool& segments);

/// Features that need vertices too close to each other.
[[nodiscard]] Error too_close_vertices(const Vertex<2>& v, const Vertex<2>& w, const Names& names,
                                       const Roles& roles);

/// Where the lines ab and cd, which cross, do so; rounded.
[[nodiscard]] Point<2> crossing(const Segment& s, const Segment& t);

namespace planarity {

/// How s conflicts with another segment, if it does. A far end of one that lies on the other is a
/// matter of that point, unless the two are on one line.
[[nodiscard]] std::optional<Conflict> conflict_with(const Segment& s, const Segment& t);
[[nodiscard]] std::optional<Conflict> conflict_with(const Segment& s, const Vertex<2>& v);
/// Keeps the first in canonical order.
void keep_first(std::optional<Conflict>& first, const std::optional<Conflict>& conflict);

}  // namespace planarity

template <class S>
std::optional<Conflict> conflict_of(const Segment& s, SegmentStore& segments,
                                    const Features<S>& points) {
  std::optional<Conflict> first;
  segments.visit_near(s.place_a, s.place_b, 0, [&](const Segment& t) {
    if (t.self != s.self) planarity::keep_first(first, planarity::conflict_with(s, t));
    return false;
  });
  const auto around = [&](int i) { return std::minmax(s.place_a[i], s.place_b[i]); };
  const Box<2> area{{around(0).first, around(1).first}, {around(0).second, around(1).second}};
  points.visit_points_in(area, [&](const Vertex<2>& v) {
    planarity::keep_first(first, planarity::conflict_with(s, v));
    return false;
  });
  return first;
}

}  // namespace mesher::detail
