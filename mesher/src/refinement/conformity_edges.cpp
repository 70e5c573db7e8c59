// Pieces of edges, and small angles.
#include <algorithm>

#include "refinement/conformity.hpp"
#include "refinement/conformity_balls.hpp"
#include "space/small_angles.hpp"

namespace mesher::detail {

/// `between`: the vertices between its ends.
void Conformity::add_pieces(const Edge& e, std::uint32_t a, std::uint32_t b,
                            std::vector<std::uint32_t>& between) {
  const auto at = [&](std::uint32_t v) { return from_a(e, vertices_[v].role.label); };
  std::sort(between.begin(), between.end(),
            [&](std::uint32_t v, std::uint32_t w) { return at(v) < at(w); });
  Subedges::Piece piece{a, b, Label::start(), Label::end(), e.self};
  for (const std::uint32_t v : between) {
    piece.b = v, piece.hi = vertices_[v].role.label;
    pieces_.add(piece);
    piece.a = v, piece.lo = piece.hi;
  }
  piece.b = b, piece.hi = Label::end();
  pieces_.add(piece);
}

bool Conformity::encroaches(std::uint32_t piece, std::uint32_t v) const noexcept {
  const Point<3>&a = place(pieces_[piece].a), &b = place(pieces_[piece].b);
  const Point<3> to_a = minus(a, place(v)), to_b = minus(b, place(v));
  return dot(to_a, to_b) < (kOpen - 1) * squared_distance(a, b);
}

/// Where features meet at a small angle at a copy of what is in the ball, else about in the middle.
auto Conformity::split_piece(std::uint32_t piece) const -> Wanted {
  const Subedges::Piece& p = pieces_[piece];
  const Edge& e = store_.edges()[p.edge];
  if (p.by != kNone && vertices_[p.by].role.on != 0 && encroaches(piece, p.by)) {
    const Vertex<3> v = record(p.by);
    const FeaturesBeside near(store_, place(p.a), kEverywhere);
    const auto copy = SmallAngles(near).copy({v, vertices_[p.by].role}, e);
    if (copy && from_a(e, p.lo) < from_a(e, copy->role.label) &&
        from_a(e, copy->role.label) < from_a(e, p.hi)) {
      return {*copy, p.a};
    }
  }
  const auto middle = EdgePiece{&e, p.lo, p.hi}.middle_if_any();
  if (!middle) throw too_close_near(place(p.a));
  return {placed_on(e, *middle), p.a};
}

bool Conformity::wants_piece_of(std::uint32_t s, double least2) {
  const auto& corners = kernel_.simplices().corners(s);
  const auto ends = [&](std::uint32_t piece) {
    return std::minmax(place(pieces_[piece].a), place(pieces_[piece].b));
  };
  std::uint32_t longest = kNone;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      const double length2 = squared_distance(place(corners[i]), place(corners[k]));
      const std::uint32_t piece = length2 < least2 ? kNone : pieces_.find(corners[i], corners[k]);
      if (piece == kNone) continue;
      if (length2 == least2 && longest != kNone && ends(longest) < ends(piece)) continue;
      least2 = length2, longest = piece;
    }
  }
  if (longest == kNone) return false;
  want_piece(longest, kNone, true);
  return true;
}

std::uint32_t Conformity::piece_at(EdgeHandle handle, const Label& at) const {
  const Edge& e = store_.edges()[handle];
  const double from = from_a(e, at);
  return pieces_.find_on(handle, [&](const Subedges::Piece& p) { return from < from_a(e, p.hi); });
}

/// As space/ knows it.
Vertex<3> Conformity::record(std::uint32_t v) const {
  Vertex<3> record;
  record.p = place(v);
  record.self = vertices_[v].point;
  return record;
}

bool Conformity::keeps(std::uint32_t v, std::uint32_t w) const {
  if (vertices_[v].role.on == 0 || vertices_[w].role.on == 0) return false;
  const FeaturesBeside near(store_, scaled(0.5, plus(place(v), place(w))), kEverywhere);
  return SmallAngles(near).keeps({record(v), vertices_[v].role}, {record(w), vertices_[w].role});
}

}  // namespace mesher::detail
