// Pieces of segments, and what insertions do to them.
#include "refinement/plane_conformity.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include "delaunay/facets.hpp"
#include "geometry/diametral_ball.hpp"
#include "program/split_segments.hpp"
#include "refinement/at_edge.hpp"

namespace mesher::detail {

PlaneConformity::PlaneConformity(Store& store, Kernel& kernel)
    : store_(store), kernel_(kernel), vertices_(1), enclosed_(kernel) {}

auto PlaneConformity::known(const Role& role, VertexHandle point) const -> Known {
  const bool is_end =
      point != 0 && store_.segments.store().visit_at(point, [](const Segment&) { return true; });
  return {role, point, role.on != 0 || is_end};
}

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
  std::vector<std::uint32_t> vertex_of;
  for (std::uint32_t v = 1; v < vertices_.size(); ++v) {
    const auto& [role, point, on_edge] = vertices_[v];
    if (role.on != 0) between_.push_back({role, v});
    if (point == 0) continue;
    if (vertex_of.size() <= point) vertex_of.resize(point + 1, kNone);
    vertex_of[point] = v;
  }
  std::sort(between_.begin(), between_.end(),
            [](const Between& x, const Between& y) { return is_before(x, y.role); });
  std::vector<const Segment*> segments;
  store_.segments.pool().for_each([&](const Segment& s) {
    if (s.alive) segments.push_back(&s);
  });
  std::sort(segments.begin(), segments.end(), [](const Segment* s, const Segment* t) {
    return std::tie(s->place_a, s->place_b) < std::tie(t->place_a, t->place_b);
  });
  for (const Segment* s : segments) {
    pieces_.add({vertex_of[s->a], vertex_of[s->b], Label::start(), Label::end(), s->self});
  }
  for (std::uint32_t i = 0; i < pieces_.size(); ++i) look_at_piece(i);
}

/// The vertex that there was at the start; kNone: there was none.
std::uint32_t PlaneConformity::vertex_at(const Role& role) const {
  const auto at = std::lower_bound(between_.begin(), between_.end(), role, is_before);
  return at == between_.end() || at->role != role ? kNone : at->v;
}

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

/// A piece with a vertex of its segment between its ends is no edge, however that vertex was
/// rounded: a circle past it would have half of the box inside.
void PlaneConformity::look_at_piece(std::uint32_t piece) {
  const Subedges::Piece& p = pieces_[piece];
  const AtEdge at = look_at_edge(kernel_, p.a, p.b, star_, [&](std::uint32_t w) {
    return relation(piece, w) == Relation::in_ball;
  });
  if (!at.is_there) require_edge(piece);
  if (!at.is_there || at.by != kNone) want_piece(piece, at.by);
}

void PlaneConformity::want_piece(std::uint32_t piece, std::uint32_t by) {
  if (pieces_.set_encroached(piece, by)) wanted_.push_back(piece);
}

auto PlaneConformity::next() -> std::optional<Wanted> {
  while (!wanted_.empty()) {
    const std::uint32_t piece = wanted_.back();
    wanted_.pop_back();
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

/// Calls visit(piece) for those that are edges of what is dug away.
template <class Visit>
void PlaneConformity::visit_pieces_dug(Visit&& visit) const {
  if (pieces_.size() == 0) return;
  for (const std::uint32_t s : kernel_.doomed()) {
    const auto& corners = kernel_.simplices().corners(s);
    for (std::uint32_t i = 0; i < 3; ++i) {
      const auto [a, b] = facet_across<2>(corners, i);
      if (!vertices_[a].on_edge || !vertices_[b].on_edge) continue;
      const std::uint32_t across = kernel_.simplices().across(s)[i] >> 2;
      if (kernel_.is_doomed(across) && across < s) continue;
      if (const std::uint32_t piece = pieces_.find(a, b); piece != kNone) visit(piece);
    }
  }
}

bool PlaneConformity::yields_to_edges(std::uint32_t v) {
  bool yields = false;
  visit_pieces_dug([&](std::uint32_t piece) {
    if (relation(piece, v) != Relation::in_ball) return;
    want_piece(piece, v);
    yields = true;
  });
  return yields;
}

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

}  // namespace mesher::detail
