// SplitSegments in space [Fig 6.4; rules C]: splits edges of the input before refinement, until no
// piece is long for the lattice beside it. Without limits of size it is not asked for.
//
// What crowds a piece splits none: Complete makes an edge a union of the mesh's edges, where
// something crosses it (space/star_crossings.hpp), and queries the edge itself [rules C3].
#pragma once

#include "program/build_qt.hpp"
#include "program/space_world.hpp"
#include "program/split_segments.hpp"

namespace mesher::detail {

struct SplitEdge {
  static constexpr std::string_view kName = "split_edge";
  template <class S>
  void operator()(S& s, EdgePiece piece) const;
};
inline constexpr SplitEdge split_edge{};

/// When split_edge(piece) runs: longest first.
[[nodiscard]] inline sac::Key split_edge_key(const MeshBox<3>& box, const EdgePiece& piece) {
  return {.bucket = split_bucket(piece.length()),
          .order = morton<3>(box.fixed(place_at(*piece.edge, piece.lo)))};
}

// if the piece is long for the lattice beside it: split it in the middle, enqueue both
// halves, and the new vertex for BuildQT
template <class S>
void SplitEdge::operator()(S& s, EdgePiece piece) const {
  auto& w = s.template environment<World<S, 3>>();
  if (!w.divides(s, piece)) return;
  const Label middle = piece.middle();
  const Placed y = placed_on(*piece.edge, middle);
  insert_on_feature(s, w, y.p, y.role);
  w.post_split(s, {piece.edge, piece.lo, middle});
  w.post_split(s, {piece.edge, middle, piece.hi});
}

}  // namespace mesher::detail
