// The segments at a point with many of them, by direction: finds the longest near one of them.
//
// A zone [rules A1] asks for the longest segment within an angle. Looking at all costs their
// number, for each of them after an edit of one; here it is the logarithm. Answers are those of
// looking at all, bit for bit: directions order the legs, and those so near to the edge of an angle
// that rounding might decide are tested one by one.
#pragma once

#include <cstddef>
#include <unordered_map>
#include <vector>

#include "plane/segment_store.hpp"

namespace mesher::detail {

/// The longest of the other segments at an end of one; 0: there is none.
struct LongestBeside {
  double within_20 = 0;  ///< at under 20 degrees
  double within_60 = 0;  ///< at under 60, but not under 20
  friend bool operator==(const LongestBeside&, const LongestBeside&) = default;
};

/// By looking at all. Cost: O(segments there).
[[nodiscard]] LongestBeside longest_beside(const SegmentStore& segments, const Segment& s,
                                           VertexHandle end);

/// The segments at one point.
class LegFan {
 public:
  /// Cost: O(d log d) for d segments there.
  LegFan(const SegmentStore& segments, VertexHandle apex);

  /// As longest_beside. Requires: s was there when the fan was made, and is.
  /// Cost: O(log d), and the legs within 10^-9 of 20 or 60 degrees.
  [[nodiscard]] LongestBeside beside(const Segment& s) const;
  [[nodiscard]] std::size_t bytes() const noexcept {
    return legs_.capacity() * sizeof(Leg) + longest_.capacity() * sizeof(double);
  }

 private:
  struct Leg {
    double direction;  // radians, -pi to pi
    Point<2> along;
    SegmentHandle self;
  };
  [[nodiscard]] std::size_t index_of(const Segment& s) const;
  [[nodiscard]] std::size_t first_from(double direction) const;
  [[nodiscard]] double longest(std::size_t from, std::size_t to) const;
  template <class Visit>
  void visit_ranges(double from, double to, Visit&& visit) const;

  VertexHandle apex_;
  std::vector<Leg> legs_;        // by direction
  std::vector<double> longest_;  // a binary tree: the legs' lengths from legs_.size() on
};

/// Fans of the points that have been asked for and have many segments.
class LegFans {
 public:
  /// As detail::longest_beside. Throws: std::bad_alloc.
  [[nodiscard]] LongestBeside longest_beside(const SegmentStore& segments, const Segment& s,
                                             VertexHandle end);
  /// Segments at this point have come or gone.
  void forget(VertexHandle apex) noexcept { fans_.erase(apex); }
  [[nodiscard]] std::size_t bytes() const noexcept;

 private:
  static constexpr int kFew = 32;  // are looked at one by one

  std::unordered_map<VertexHandle, LegFan> fans_;
};

}  // namespace mesher::detail
