// SplitSegments [Fig 5.5, 6.4; rules A2]: splits segments before refinement, until no feature
// crowds a piece.
//
// Departure: what crowds a piece is a function of the input alone (plane/crowding.hpp), so a
// call on a piece depends on no other, and its order is only that a piece comes before its halves.
// A piece that is not crowded is a leaf: an edge of the mesh, until it is cut.
#pragma once

#include "program/build_qt.hpp"
#include "program/world.hpp"

namespace mesher::detail {

/// A crowded piece is not split if it is shorter than this times the box's side: its ends are still
/// some finest cells apart.
inline constexpr double kShortestPiece = 0x1p-44;

/// The lattice is kept out of the balls of leaves [rules A7.1]: the gap must not be larger than
/// what a lattice's triangle leaves. The spacing is the least in the ball, not only on the piece:
/// so the lattice's points that a leaf blocks have its ends near by.
[[nodiscard]] inline bool is_long(const Limits<2>& limits, const PieceRef& piece) {
  constexpr double kLongest = 1.4;
  if (!limits.any()) return false;
  const Point<2> a = piece.lo(), b = piece.hi();
  const double length = std::sqrt(squared_distance(a, b));
  const Point<2> middle{a[0] + (b[0] - a[0]) / 2, a[1] + (b[1] - a[1]) / 2};
  return limits.is_long(around(middle, length / 2), length, kLongest);
}

struct SplitSegment {
  static constexpr std::string_view kName = "split_segment";
  template <class S>
  void operator()(S& s, PieceRef piece) const;
};
inline constexpr SplitSegment split_segment{};

/// Buckets of pieces, longest first. A half is at most two thirds of a piece, and thus in a later
/// bucket: there are two an octave, [1/2, sqrt(1/2)) and [sqrt(1/2), 1) times a power of 2.
[[nodiscard]] inline int split_bucket(double length) noexcept {
  constexpr double kRootHalf = 0.70710678118654752;
  int exponent = 0;
  const bool upper = std::frexp(length, &exponent) >= kRootHalf;
  return -(2 * exponent + (upper ? 1 : 0));
}

/// When split_segment(piece) runs.
[[nodiscard]] inline sac::Key split_segment_key(const MeshBox<2>& box, const PieceRef& piece) {
  return {.bucket = split_bucket(piece.length()), .order = morton<2>(box.fixed(piece.lo()))};
}

/// A vertex on a feature, before anything is refined: BuildQT takes it for a point of the input.
template <class S, class AnyWorld, class Place>
void insert_on_feature(S& s, AnyWorld& w, const Place& place, const Role& role) {
  const auto v = w.vertices.insert_early(s, place, role);
  w.require_room(s);
  w.features.insert(s, v);
  if (w.locates) w.quadtree.template post<locate>(s, locate_key(w.box.fixed(v->p)), v);
}

// if sigma is crowded, or long for the lattice beside it: split it where the shells say, enqueue
// both halves, and the new vertex for BuildQT; else it is a leaf
template <class S>
void SplitSegment::operator()(S& s, PieceRef piece) const {
  auto& w = s.template environment<World<S>>();
  const bool crowded = w.segments.crowded(s, piece);  // first: who asks is found by this
  const bool divides = crowded || is_long(w.limits, piece);
  if (!divides) return w.leaves.begin(s, piece.piece);
  if (piece.length() < w.box.side * kShortestPiece) w.fail_too_short(piece);
  const Halves halves = w.segments.halves(s, piece);
  insert_on_feature(s, w, halves.place, halves.role);
  w.post_split(s, halves.lower);
  w.post_split(s, halves.upper);
}

}  // namespace mesher::detail
