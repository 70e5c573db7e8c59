// Cut [Fig 5.2, 6.2]: splits a leaf that is in the way, at the position given by the shells.
//
// All calls that need a leaf cut in bucket b post the same call, which runs at the end of the
// bucket: so calls of one bucket do not affect each other through segments.
#pragma once

#include "program/split_segments.hpp"
#include "program/world.hpp"

namespace mesher::detail {

struct Cut {
  static constexpr std::string_view kName = "cut";
  template <class S>
  void operator()(S& s, LeafRef leaf, int b) const;
};
inline constexpr Cut cut{};

/// When cut(leaf, b) runs: after the bucket's ComputeNN and Complete.
[[nodiscard]] inline sac::Key cut_key(const Fixed<2>& middle, int b) {
  return {.bucket = b, .phase = 2, .order = morton<2>(middle)};
}

/// In a tile: all tiles cut a leaf, at the same turn; the new vertex is that of who owns its place.
/// What cannot be done may be possible when other tiles have said what they have.
template <class S>
void cut_in_tile(S& s, World<S, 2>& w, LeafRef leaf, int b) {
  const PieceRef piece = w.segments.ref(leaf->piece);
  w.leaves.end(s, leaf);
  try {
    if (piece.length() < w.box.side * kShortestPiece) w.fail_too_short(piece);
    const Halves halves = w.segments.halves(s, piece);
    w.leaves.begin(s, halves.lower.piece);
    w.leaves.begin(s, halves.upper.piece);
    if (!w.owns(halves.place)) return;
    const VertexRef<2> y = w.vertices.insert(s, halves.place, halves.role);
    w.post_nearest_in(s, y, b + 1);
  } catch (const Error& error) {
    w.refuse_cut(s, error);
  }
}

// split the leaf at y; add ComputeNN(y), in the next bucket
template <class S>
void Cut::operator()(S& s, LeafRef leaf, int b) const {
  auto& w = s.template environment<World<S>>();
  if (w.border != nullptr) [[unlikely]]
    return cut_in_tile(s, w, leaf, b);
  const PieceRef piece = w.segments.ref(leaf->piece);
  if (piece.length() < w.box.side * kShortestPiece) w.fail_too_short(piece);
  const Halves halves = w.segments.halves(s, piece);
  w.leaves.end(s, leaf);
  const VertexRef<2> y = w.vertices.insert(s, halves.place, halves.role);
  w.require_room(s);
  w.leaves.begin(s, halves.lower.piece);
  w.leaves.begin(s, halves.upper.piece);
  w.post_nearest_in(s, y, b + 1);
  w.post_star(s, y);
}

}  // namespace mesher::detail
