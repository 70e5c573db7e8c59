// SplitSegments [Fig 5.5, 6.4; rules A2]: segments are split before anything is refined, until no
// feature crowds a piece.
//
// Departure: what crowds a piece is a function of the input alone (segments/crowding.hpp), so a call
// on a piece depends on no other, and its order is only that a piece comes before its halves. A piece
// that is not crowded is a leaf: an edge of the mesh, until it is cut.
#pragma once

#include "program/world.hpp"

namespace mesher::detail {

struct SplitSegment {
  static constexpr std::string_view kName = "split_segment";
  template <class S>
  void operator()(S& s, PieceRef piece) const;
};
inline constexpr SplitSegment split_segment{};

/// When split_segment(piece) runs: longest first. A half is at most two thirds of a piece, and thus
/// in a later bucket; there are two an octave.
[[nodiscard]] sac::Key split_segment_key(const MeshBox<2>& box, const PieceRef& piece);

// if sigma is crowded: split it where the shells say, enqueue both halves, and the new vertex for
// BuildQT; else it is a leaf
template <class S>
void SplitSegment::operator()(S& s, PieceRef piece) const {
  auto& w = s.template environment<World<S>>();
  if (!w.segments.crowded(s, piece)) return w.leaves.begin(s, piece.piece);
  const PieceSplit split = w.segments.place(s, piece);
  const VertexRef<2> y = w.insert_on_segment(s, piece, split.at);
  w.features.insert(s, y);
  w.quadtree.template post<locate>(s, locate_key(w.box.fixed(y->p)), y);
  for (const PieceRef& half : halves(piece, split)) {
    w.splits.template post<split_segment>(s, split_segment_key(w.box, half), half);
  }
}

}  // namespace mesher::detail
