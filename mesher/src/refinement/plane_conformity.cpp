// Pieces of segments, and what insertions do to them.
#include "refinement/plane_conformity.hpp"

#include <algorithm>
#include <utility>

#include "geometry/diametral_ball.hpp"
#include "program/split_segments.hpp"

namespace mesher::detail {

// --- Pieces ----------------------------------------------------------------------------------

PieceRef PlaneConformity::ref(std::uint32_t piece) const noexcept {
  const Subedges::Piece& p = pieces_[piece];
  return store_.segments.ref({p.lo, p.hi, p.edge, p.kind});
}

Halves PlaneConformity::halves(const PieceRef& piece) const {
  sac::PlainScope none;
  return store_.segments.halves(none, piece);
}

void PlaneConformity::start() {
  for (std::uint32_t v = 1; v < vertices_.size(); ++v) {
    if (const Role& role = vertices_[v].role; role.on != 0) between_.push_back({role, v});
  }
  std::sort(between_.begin(), between_.end(),
            [](const Between& x, const Between& y) { return is_before(x, y.role); });
  start_pieces([&](const Segment& s, std::uint32_t a, std::uint32_t b) {
    pieces_.add({a, b, Label::start(), Label::end(), s.self});
  });
}

/// The vertex that there was at the start; kNone: there was none.
std::uint32_t PlaneConformity::vertex_at(const Role& role) const {
  const auto at = std::lower_bound(between_.begin(), between_.end(), role, is_before);
  return at == between_.end() || at->role != role ? kNone : at->v;
}

/// A vertex of its segment between its ends is apart: the piece is no edge then, however that
/// vertex was rounded, since a circle past it would have half of the box inside.
auto PlaneConformity::relation_to(std::uint32_t piece, std::uint32_t v) const -> Relation {
  const Subedges::Piece& p = pieces_[piece];
  const Role& role = vertices_[v].role;
  if (v == p.a || v == p.b || role.on == p.edge) return Relation::apart;
  if (!in_diametral_ball(place(v), place(p.a), place(p.b))) return Relation::apart;
  if (role.on == 0) return Relation::in_ball;
  const bool beside = leaf(piece).ends_as_far(store_.segments.pool()[role.on], role.label);
  return beside ? Relation::beside : Relation::in_ball;
}

auto PlaneConformity::relation(std::uint32_t piece, std::uint32_t v) -> Relation {
  const Relation is = relation_to(piece, v);
  if (is == Relation::beside) {
    if (overruled_.size() <= piece) overruled_.resize(piece + std::size_t{1});
    overruled_[piece] = true;
  }
  return is;
}

Leaf PlaneConformity::leaf(std::uint32_t piece) const {
  Leaf leaf;
  leaf.piece = ref(piece).piece;
  leaf.segment = &store_.segments.pool()[leaf.piece.segment];
  leaf.lo = place(pieces_[piece].a), leaf.hi = place(pieces_[piece].b);
  return leaf;
}

auto PlaneConformity::next() -> std::optional<Wanted> {
  while (!wanted_pieces_.empty()) {
    const std::uint32_t piece = wanted_pieces_.back();
    wanted_pieces_.pop_back();
    const PieceRef all = ref(piece);
    if (all.length() < store_.box.side * kShortestPiece) store_.fail_too_short(all);
    const Halves parts = halves(all);
    if (const std::uint32_t v = vertex_at(parts.role); v != kNone) {
      split_piece(piece, v);
      continue;
    }
    splitting_ = piece;
    return Wanted{{parts.place, parts.role}, pieces_[piece].a};
  }
  return std::nullopt;
}

void PlaneConformity::split_piece(std::uint32_t piece, std::uint32_t at) {
  const Halves parts = halves(ref(piece));
  const std::uint32_t other =
      pieces_.split(piece, at, parts.role.label, {parts.lower.piece.kind, parts.upper.piece.kind});
  if (is_overruled(piece)) {
    overruled_.resize(pieces_.size());
    overruled_[other] = true;
  }
  look_at_piece(piece);
  look_at_piece(other);
}

bool PlaneConformity::keeps(std::uint32_t v, std::uint32_t w) const {
  if (!vertices_[v].on_edge || !vertices_[w].on_edge) return false;
  const auto on_lines = [&](std::uint32_t u) {
    return VertexOnLines{place(u), vertices_[u].role, vertices_[u].point};
  };
  return is_exempt(store_.segments.store(), on_lines(v), on_lines(w));
}

// --- Insertions ------------------------------------------------------------------------------

void PlaneConformity::before_fill(std::uint32_t v) {
  beside_.clear();
  visit_pieces_dug([&](std::uint32_t piece) {
    const Relation is = relation(piece, v);
    if (is == Relation::in_ball) {
      want_piece(piece, v);
    } else if (is_overruled(piece)) {
      beside_.push_back(piece);
    }
  });
}

void PlaneConformity::after_fill(std::uint32_t v) {
  if (splitting_ != kNone) split_piece(std::exchange(splitting_, kNone), v);
  for (const std::uint32_t piece : beside_) look_at_piece(piece);
  enclosed_.forget_made();
}

bool PlaneConformity::is_wall(std::uint32_t s, std::uint32_t i) const {
  const auto [a, b] = facet_across<2>(kernel_.simplices().corners(s), i);
  return vertices_[a].on_edge && vertices_[b].on_edge && pieces_.find(a, b) != kNone;
}

}  // namespace mesher::detail
