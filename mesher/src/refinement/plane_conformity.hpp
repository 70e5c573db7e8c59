// Keeps segments in the plane unions of edges of the Delaunay triangulation that a refinement makes
// [Fig 2.1, 2.7, 2.8; rules A].
//
// A segment is cut into pieces, the leaves of a binary tree that depends on the input alone
// (plane/shells.hpp): so vertices on segments that meet at a small angle come in pairs, at equal
// distances from where they meet. A piece with a vertex in its closed diametral ball is
// *encroached*, and is split; one without is an edge of the triangulation. If no piece is
// encroached, no centre of a triangle is behind one. At angles below double precision labels decide
// (plane/leaf.hpp); an edge that this costs is an error (plane/lost_edge.hpp).
//
// Departures from rules A: nothing is split before points are inserted (A2), since no edit is to be
// local here; and while points are left, new vertices yield to places that their segments have
// in their trees, whether the places above are vertices or not.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "delaunay/facets.hpp"
#include "plane/exempt.hpp"
#include "program/world.hpp"
#include "refinement/line_conformity.hpp"

namespace mesher::detail {

class PlaneConformity : public LineConformity<2, PlaneConformity> {
 public:
  /// The points, and the segments between them.
  using Store = World<sac::PlainScope, 2>;
  static constexpr bool kEmptyBalls = true;

  PlaneConformity(Store& store, Kernel& kernel)
      : LineConformity(store.segments.store(), kernel), store_(store) {}

  /// Finds the pieces. Requires: all input points are vertices.
  void start();

  /// Where the centre x of an empty ball goes instead, on a segment; nothing: none is near. By the
  /// input alone: before start(). Cost: O(log L/s), and what is near.
  [[nodiscard]] std::optional<Placed> yield(const Point<2>& x, double radius) const;

  /// Nothing: all conforms. Throws: Error (too_close: a piece is too short to be split).
  [[nodiscard]] std::optional<Wanted> next();
  /// It knows of all that is wanted.
  [[nodiscard]] static constexpr bool looks_again() noexcept { return false; }
  /// Throws: Error (too_close: another vertex is there).
  [[noreturn]] void fail_occupied(const Placed& place) const;
  /// Throws: Error (too_many: beyond `most`, with the ids of the lines with most vertices).
  [[noreturn]] void fail_too_many(std::size_t most) const;

  /// Whether a triangle on the left of v -> w stays that is poor by this edge: where segments meet
  /// at a small angle.
  [[nodiscard]] bool keeps(std::uint32_t v, std::uint32_t w) const;

  // --- Of a vertex that is dug
  [[nodiscard]] bool yields(std::uint32_t v) { return yields_to_edges(v); }
  [[nodiscard]] bool encroaches_on_features(std::uint32_t v) { return encroaches_on_edges(v); }
  /// Before the hole is filled.
  void before_fill(std::uint32_t v);
  /// Afterwards.
  void after_fill(std::uint32_t v);

 private:
  friend LineConformity;
  // A vertex on a segment that there was at the start.
  struct Between {
    Role role;
    std::uint32_t v;
  };
  static bool is_before(const Between& x, const Role& role) noexcept {
    return x.role.on != role.on ? x.role.on < role.on : x.role.label < role.label;
  }
  // What a vertex is to a piece.
  enum class Relation : std::uint8_t {
    apart,
    in_ball,
    beside,  // outside of the ball by its label, in it by its rounded place
  };

  [[nodiscard]] Known known(const Role& role, VertexHandle point) const {
    return known_by_edges(role, point);
  }
  [[nodiscard]] PieceRef ref(std::uint32_t piece) const noexcept;
  [[nodiscard]] Halves halves(const PieceRef& piece) const;
  [[nodiscard]] std::optional<Placed> place_near(const Segment& s, double from_a,
                                                 double radius) const;
  [[nodiscard]] Relation relation(std::uint32_t piece, std::uint32_t v);
  [[nodiscard]] Relation relation_to(std::uint32_t piece, std::uint32_t v) const;
  [[nodiscard]] bool encroaches(std::uint32_t piece, std::uint32_t v) {
    return relation(piece, v) == Relation::in_ball;
  }
  /// Then its ball may hold vertices, so that one outside of it may cost its edge.
  [[nodiscard]] bool is_overruled(std::uint32_t piece) const {
    return piece < overruled_.size() && overruled_[piece];
  }
  [[nodiscard]] std::uint32_t vertex_at(const Role& role) const;
  [[nodiscard]] Leaf leaf(std::uint32_t piece) const;
  void require_edge(std::uint32_t piece) const;
  void split_piece(std::uint32_t piece, std::uint32_t at);
  template <class Visit>
  void visit_pieces_dug(Visit&& visit) const;
  [[nodiscard]] bool is_wall(std::uint32_t s, std::uint32_t i) const;

  Store& store_;
  std::vector<Between> between_;       // by segment and label
  std::vector<std::uint32_t> beside_;  // pieces that an insertion may have cost their edges
  std::vector<bool> overruled_;        // by piece: of a vertex beside it, or a part of such a one
};

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

}  // namespace mesher::detail
