// Segments: their records, the exact labels of places on them, and their pieces.
//
// A place on a segment is named by its distance from one of the two ends, an exact number [rules
// A1]: two places are the same if their labels are, whatever rounding makes of their coordinates.
// A segment's record is found by its two ends, so calls about it are recognised again.
#pragma once

#include <compare>
#include <cstdint>
#include <memory>
#include <ostream>
#include <utility>
#include <vector>

#include "index/vertex.hpp"

namespace mesher::detail {

using SegmentHandle = std::uint32_t;  // 0: none

/// A segment between two input points, `a` the lexicographically smaller one.
struct Segment {
  VertexHandle a = 0;
  VertexHandle b = 0;
  SegmentHandle self = 0;  // in a free record: the next free one
  bool alive = false;      // part of the input that is being meshed
  double length = 0;       // |ab|, rounded once
};

/// A place on a segment: `distance` from a, or from b.
struct Label {
  double distance = 0;
  bool from_b = false;

  [[nodiscard]] static Label start() noexcept { return {0, false}; }
  [[nodiscard]] static Label end() noexcept { return {0, true}; }
  /// The distance from a (or b) on a segment of this length.
  [[nodiscard]] double from(bool end_b, double length) const noexcept {
    return from_b == end_b ? distance : length - distance;
  }
  friend bool operator==(const Label&, const Label&) = default;
};

/// How a piece is split [rules A1]: where its distances are measured from, and what its halves are.
enum class PieceKind : std::uint8_t {
  whole,        ///< the segment: chooses its origin
  from_a,       ///< distances from a
  from_b,       ///< distances from b
  from_a_to_b,  ///< from a, but the last piece before b, which has a zone, from b
  from_b_to_a,  ///< the mirror image
};

/// A part of a segment between two labelled places, `lo` nearer to a. A value: an argument of
/// traced functions.
struct Piece {
  Label lo, hi;
  SegmentHandle segment = 0;
  PieceKind kind = PieceKind::whole;
  friend bool operator==(const Piece&, const Piece&) = default;
};

/// Records at fixed addresses, addressed by handles; freed ones are used again.
class SegmentPool {
 public:
  SegmentPool() { chunks_.push_back(std::make_unique<Segment[]>(kChunk)); }

  [[nodiscard]] Segment& operator[](SegmentHandle h) const noexcept {
    return chunks_[h / kChunk][h % kChunk];
  }
  /// Throws: std::bad_alloc, and then changes nothing.
  [[nodiscard]] Segment& create(VertexHandle a, VertexHandle b, double length) {
    const SegmentHandle h = free_ != 0 ? free_ : fresh();
    free_ = (*this)[h].self;
    Segment& s = (*this)[h] = Segment{a, b, h, false, length};
    ++size_;
    return s;
  }
  /// Requires: nobody refers to s any more.
  void release(Segment& s) noexcept {
    const SegmentHandle h = s.self;
    s = Segment{};
    s.self = std::exchange(free_, h);
    --size_;
  }
  /// Calls visit(segment) for every record in use, in the order of handles.
  template <class Visit>
  void for_each(Visit&& visit) const {
    for (SegmentHandle h = 1; h < next_; ++h) {
      if ((*this)[h].self == h) visit((*this)[h]);
    }
  }
  [[nodiscard]] std::size_t size() const noexcept { return size_; }

 private:
  static constexpr SegmentHandle kChunk = 1024;

  SegmentHandle fresh() {
    if (next_ % kChunk == 0) chunks_.push_back(std::make_unique<Segment[]>(kChunk));
    return next_++;
  }

  std::vector<std::unique_ptr<Segment[]>> chunks_;
  SegmentHandle free_ = 0;
  SegmentHandle next_ = 1;
  std::size_t size_ = 0;
};

/// Where a place on a segment is: measured from the nearer end; an end is where it is, bit for bit.
[[nodiscard]] inline Point<2> place_of(const VertexPool<2>& pool, const Segment& s,
                                       const Label& label) {
  const double from_a = label.from(false, s.length);
  const double from_b = label.from(true, s.length);
  const bool near_a = from_a <= from_b;
  const Point<2>& o = pool[near_a ? s.a : s.b].p;
  const Point<2>& e = pool[near_a ? s.b : s.a].p;
  const double t = (near_a ? from_a : from_b) / s.length;
  return {o[0] + t * (e[0] - o[0]), o[1] + t * (e[1] - o[1])};
}

}  // namespace mesher::detail
