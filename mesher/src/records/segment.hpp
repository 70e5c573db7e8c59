// Segments: their records, the exact labels of places on them, and their pieces.
//
// A place on a segment is named by its distance from one of the two ends, an exact number [rules
// A1]: two places are the same if their labels are, whatever rounding makes of their coordinates.
// A segment's record is found by its two ends, so calls about it are recognised again.
#pragma once

#include <bit>
#include <cmath>
#include <compare>
#include <cstdint>
#include <memory>
#include <ostream>
#include <tuple>
#include <utility>
#include <vector>

#include "records/vertex.hpp"

namespace mesher::detail {

using SegmentHandle = std::uint32_t;  // 0: none

/// A segment between two input points, `a` the lexicographically smaller one.
template <int D>
struct SegmentOf {
  VertexHandle a = 0;
  VertexHandle b = 0;
  Point<D> place_a{}, place_b{};
  double length = 0;               // |ab|, rounded once
  SegmentHandle self = 0;          // in a free record: the next free one
  bool alive = false;              // part of the input that is being meshed
  bool changed = false;            // listed by next_changed
  bool bounds = false;             // it is only there as a side of polygons with few
  SegmentHandle next_changed = 0;  // in the list of what has come or gone since the last update
  SegmentHandle next_at_a = 0, next_at_b = 0;  // others at its ends
  std::uint32_t tile = 0;                      // the first of its tiles
  sac::Handle place_observers = 0;  // edges of calls that observe how its pieces are split

  /// The other end's, of one end.
  [[nodiscard]] VertexHandle other(VertexHandle end) const noexcept { return end == a ? b : a; }
  [[nodiscard]] bool has_end(VertexHandle v) const noexcept { return v == a || v == b; }
};
using Segment = SegmentOf<2>;

/// A place on a segment: a distance >= 0 from a, or from b. The sign bit says from which.
class Label {
 public:
  Label() = default;
  Label(double distance, bool from_b) noexcept
      : bits_(std::bit_cast<std::uint64_t>(distance) | std::uint64_t{from_b} << 63) {}
  [[nodiscard]] static Label start() noexcept { return {0, false}; }
  [[nodiscard]] static Label end() noexcept { return {0, true}; }

  [[nodiscard]] double distance() const noexcept { return std::bit_cast<double>(bits_ << 1 >> 1); }
  [[nodiscard]] bool from_b() const noexcept { return bits_ >> 63 != 0; }
  /// The distance from a (or b) on a segment of this length.
  [[nodiscard]] double from(bool end_b, double length) const noexcept {
    return from_b() == end_b ? distance() : length - distance();
  }
  /// All that it is.
  [[nodiscard]] std::uint64_t bits() const noexcept { return bits_; }

  friend bool operator==(const Label&, const Label&) = default;
  /// By distances, from a before from b. (Numbers >= 0 are ordered as their bits are.)
  friend std::strong_ordering operator<=>(const Label& x, const Label& y) noexcept {
    return std::rotl(x.bits_, 1) <=> std::rotl(y.bits_, 1);
  }

 private:
  std::uint64_t bits_ = 0;
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
  friend auto operator<=>(const Piece&, const Piece&) = default;
  friend std::uint64_t hash_value(const Piece& p) noexcept {
    std::uint64_t h = sac::mix(p.segment + (static_cast<std::uint64_t>(p.kind) << 32));
    for (const Label& l : {p.lo, p.hi}) h = sac::mix(h + l.bits());
    return h;
  }
};

/// Records at fixed addresses, addressed by handles; freed ones are used again.
template <int D>
class SegmentPoolOf {
 public:
  using Segment = SegmentOf<D>;

  SegmentPoolOf() { chunks_.push_back(std::make_unique<Segment[]>(kChunk)); }

  [[nodiscard]] Segment& operator[](SegmentHandle h) const noexcept {
    return chunks_[h / kChunk][h % kChunk];
  }
  /// Throws: std::bad_alloc, and then changes nothing.
  /// Requires: a.p < b.p.
  [[nodiscard]] Segment& create(const Vertex<D>& a, const Vertex<D>& b) {
    const SegmentHandle h = free_ != 0 ? free_ : fresh();
    free_ = (*this)[h].self;
    double length2 = 0;
    for (int i = 0; i < D; ++i) length2 += (b.p[i] - a.p[i]) * (b.p[i] - a.p[i]);
    Segment& s = (*this)[h] = Segment{.a = a.self,
                                      .b = b.self,
                                      .place_a = a.p,
                                      .place_b = b.p,
                                      .length = std::sqrt(length2),
                                      .self = h};
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
  /// No handle in use is larger.
  [[nodiscard]] SegmentHandle last() const noexcept { return next_ - 1; }
  [[nodiscard]] std::size_t bytes() const noexcept {
    return chunks_.size() * kChunk * sizeof(Segment);
  }

 private:
  static constexpr SegmentHandle kChunk = 256;

  SegmentHandle fresh() {
    if (next_ % kChunk == 0) chunks_.push_back(std::make_unique<Segment[]>(kChunk));
    return next_++;
  }

  std::vector<std::unique_ptr<Segment[]>> chunks_;
  SegmentHandle free_ = 0;
  SegmentHandle next_ = 1;
  std::size_t size_ = 0;
};
using SegmentPool = SegmentPoolOf<2>;

/// Where a place on a segment is: measured from the nearer end; an end is where it is, bit for bit.
[[nodiscard]] inline Point<2> place_of(const Segment& s, const Label& label) {
  const double from_a = label.from(false, s.length);
  const double from_b = label.from(true, s.length);
  const bool near_a = from_a <= from_b;
  const Point<2>& o = near_a ? s.place_a : s.place_b;
  const Point<2>& e = near_a ? s.place_b : s.place_a;
  const double t = (near_a ? from_a : from_b) / s.length;
  return {o[0] + t * (e[0] - o[0]), o[1] + t * (e[1] - o[1])};
}

/// A piece as an argument of traced functions: equal by value, ordered by coordinates.
struct PieceRef {
  const Segment* segment = nullptr;
  Piece piece;

  [[nodiscard]] Point<2> lo() const { return place_of(*segment, piece.lo); }
  [[nodiscard]] Point<2> hi() const { return place_of(*segment, piece.hi); }
  /// Measured along the segment.
  [[nodiscard]] double length() const noexcept {
    return piece.hi.from(false, segment->length) - piece.lo.from(false, segment->length);
  }

  friend bool operator==(const PieceRef& a, const PieceRef& b) { return a.piece == b.piece; }
  friend std::partial_ordering operator<=>(const PieceRef& x, const PieceRef& y) {
    if (const auto c = x.segment->place_a <=> y.segment->place_a; c != 0) return c;
    if (const auto c = x.segment->place_b <=> y.segment->place_b; c != 0) return c;
    const auto rest = [](const Piece& p) { return std::tuple(p.lo, p.hi, p.kind); };
    return rest(x.piece) <=> rest(y.piece);
  }
  friend std::uint64_t hash_value(const PieceRef& r) noexcept { return hash_value(r.piece); }
  friend std::ostream& operator<<(std::ostream& out, const PieceRef& r) {
    const Point<2> lo = r.lo(), hi = r.hi();
    return out << '(' << lo[0] << ' ' << lo[1] << ")-(" << hi[0] << ' ' << hi[1] << ')';
  }
  friend void label_bytes(sac::LabelSink& sink, const PieceRef& r) {
    for (const Point<2>& p : {r.segment->place_a, r.segment->place_b}) {
      for (const double x : p) sink.number(std::bit_cast<std::uint64_t>(x));
    }
    for (const Label& l : {r.piece.lo, r.piece.hi}) {
      sink.number(l.bits());
    }
    sink.number(static_cast<std::uint64_t>(r.piece.kind));
  }
};

}  // namespace mesher::detail
