// Disencroach a polygon [Fig 6.4; rules C]: where other features are near, a polygon gets vertices
// of a lattice of its own before refinement.
//
// Departure: not the corners of the polygon's Voronoi diagram that are far from their vertices, one
// by one. Whether a piece is crowded, and whether there is room for its vertex, are functions of
// the input alone (space/facet_piece.hpp), so a call depends on no other, and an edit changes the
// pieces whose balls it reaches.
#pragma once

#include "program/build_qt.hpp"
#include "program/space_world.hpp"
#include "program/split_segments.hpp"

namespace mesher::detail {

struct FillFacet {
  static constexpr std::string_view kName = "fill_facet";
  template <class S>
  void operator()(S& s, FacetPiece piece) const;
};
inline constexpr FillFacet fill_facet{};

/// When fill_facet(piece) runs: a piece before its halves.
[[nodiscard]] inline sac::Key fill_facet_key(const MeshBox<3>& box, const FacetPiece& piece) {
  return {.bucket = piece.level,
          .order = morton<3>(box.fixed(piece.polygon->plane.at(piece.middle())))};
}

// look(), and what it looks at as steps of the call.
template <class S, class Look>
auto weighed(S& s, const FeatureStore& store, Look&& look) {
  const std::uint64_t before = store.looked_at();
  const auto found = look();
  s.weigh(store.looked_at() - before);
  return found;
}

// if the piece is crowded, or long for the lattice beside it: enqueue the halves that have some of
// the polygon. Else, if it is a half and there is room: add its vertex, and enqueue that for
// BuildQT
template <class S>
void FillFacet::operator()(S& s, FacetPiece piece) const {
  auto& w = s.template environment<World<S, 3>>();
  const Polygon& f = *piece.polygon;
  if (w.divides(s, piece)) {
    if (piece.longer_side() < w.box.side * kShortestPiece) w.fail_too_fine(f, piece.middle());
    for (const FacetPiece& half : piece.halves()) {
      const bool meets = weighed(s, w.plc.store(), [&] { return half.meets_polygon(); });
      if (meets) w.post_fill(s, half);
    }
    return;
  }
  if (piece.level == 0) return;
  const auto place = weighed(s, w.plc.store(), [&] { return vertex_place(piece, w.plc.store()); });
  if (!place || w.plc.hemmed_in(s, piece)) return;
  insert_on_feature(s, w, *place, role_on(f));
}

}  // namespace mesher::detail
