// Keeps lines unions of edges of the Delaunay triangulation that a refinement makes, as far as the
// plane and space agree on how: what vertices are, the pieces of segments between them, and which
// pieces are wanted, that is, to be split.
//
// What is different is asked of Self, the class that is derived from this:
//   known(role, point)      what a vertex is
//   encroaches(piece, v)    whether a vertex is in the ball of a piece
//   visit_pieces_dug(visit) the pieces whose edges are dug away
//   require_edge(piece)     throws if a piece that is no edge never will be; not at all in space
//   is_wall(s, i)           whether the facet across from corner i of s is one
//   kEmptyBalls             whether a piece is split that has a vertex in its ball
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <tuple>
#include <vector>

#include "delaunay/kernel.hpp"
#include "plane/segment_store.hpp"
#include "records/roles.hpp"
#include "refinement/at_edge.hpp"
#include "refinement/enclosed.hpp"
#include "refinement/subedges.hpp"
#include "space/placed.hpp"

namespace mesher::detail {

template <int D, class Self>
class LineConformity {
 public:
  using Kernel = DelaunayKernel<D, BallLayout<D>>;
  using Placed = PlacedIn<D>;
  /// A vertex that is needed, and a vertex near it. `otherwise`: on no line, if one is at `place`.
  struct Wanted {
    Placed place;
    std::uint32_t beside;
    std::optional<Placed> otherwise{};
  };

  /// What the next place of the kernel is: its role, and the input point's handle, or 0.
  void add_vertex(const Role& role, VertexHandle point) {
    vertices_.push_back(self().known(role, point));
  }
  /// The same of a vertex that is there. Requires: start() was not called.
  void set_vertex(std::uint32_t v, const Role& role, VertexHandle point) {
    vertices_[v] = self().known(role, point);
  }
  void drop_vertex() noexcept { vertices_.pop_back(); }
  /// What next() has returned comes elsewhere, on no line.
  void take_otherwise() noexcept { splitting_ = kNone; }

  /// Of a vertex that is dug: whether it encroaches on pieces; these are wanted then.
  [[nodiscard]] bool yields_to_edges(std::uint32_t v) {
    bool yields = false;
    self().visit_pieces_dug([&](std::uint32_t piece) {
      if (!self().encroaches(piece, v)) return;
      want_piece(piece, kNone, true);
      yields = true;
    });
    return yields;
  }

  /// Of a vertex that is dug: whether it is in the ball of a piece.
  [[nodiscard]] bool encroaches_on_edges(std::uint32_t v) {
    bool encroaches = false;
    self().visit_pieces_dug(
        [&](std::uint32_t piece) { encroaches = encroaches || self().encroaches(piece, v); });
    return encroaches;
  }

  /// Finds what walls enclose, less what holes are in that are not within `near` of walls; whether
  /// that is anything. Requires: as is_outside().
  bool find_regions(std::span<const Point<D>> holes, double near) {
    return enclosed_.find(holes, near, [&](auto s, auto i) { return self().is_wall(s, i); });
  }
  /// As Enclosed::name_region().
  void name_region(const Point<D>& p, std::uint32_t name, double near, bool outside_too) {
    enclosed_.name_region(p, name, near, outside_too,
                          [&](auto s, auto i) { return self().is_wall(s, i); });
  }
  /// As Enclosed::name(). Requires and cost: as is_outside().
  [[nodiscard]] std::uint32_t region(std::uint32_t s) {
    return enclosed_.name(s, [&](auto t, auto i) { return self().is_wall(t, i); });
  }
  /// Whether no walls enclose s, or it is in a hole. Requires: next() has returned nothing, and
  /// nothing was inserted since; find_regions(). Cost: amortized O(1) for each that was made.
  [[nodiscard]] bool is_outside(std::uint32_t s) {
    return enclosed_.is_outside(s, [&](auto t, auto i) { return self().is_wall(t, i); });
  }

  [[nodiscard]] const Subedges& pieces() const noexcept { return pieces_; }

 protected:
  struct Known {
    Role role;
    VertexHandle point;
    bool on_edge;
    bool on_polygon = false;  // in space
  };

  LineConformity(const SegmentStoreOf<D>& segments, Kernel& kernel)
      : kernel_(kernel), vertices_(1), enclosed_(kernel), segments_(segments) {}

  [[nodiscard]] Known known_by_edges(const Role& role, VertexHandle point) const {
    const bool is_end = point != 0 && segments_.visit_at(point, [](const auto&) { return true; });
    return {role, point, edge_of(role) != 0 || is_end};
  }
  [[nodiscard]] const Point<D>& place(std::uint32_t v) const noexcept { return kernel_.place(v); }

  /// Adds the pieces of all segments, in canonical order, by add(segment, a, b), where a and b are
  /// its ends; then looks at them. Requires: all input points are vertices.
  template <class Add>
  void start_pieces(Add&& add) {
    const std::vector<std::uint32_t> vertex_of = vertices_by_point();
    for (const SegmentOf<D>* s : segments_in_order()) add(*s, vertex_of[s->a], vertex_of[s->b]);
    for (std::uint32_t i = 0; i < pieces_.size(); ++i) look_at_piece(i);
  }
  /// What is around a piece; no vertex in its ball is looked for if that does not matter.
  [[nodiscard]] AtEdge at_piece(std::uint32_t piece) {
    const Subedges::Piece& p = pieces_[piece];
    return look_at_edge(kernel_, p.a, p.b, star_, [&](std::uint32_t w) {
      return Self::kEmptyBalls && self().encroaches(piece, w);
    });
  }
  void look_at_piece(std::uint32_t piece) {
    const AtEdge at = at_piece(piece);
    if (!at.is_there) self().require_edge(piece);
    if (!at.is_there || at.by != kNone) want_piece(piece, at.by);
  }
  /// `by`: a vertex in its ball or in its way, if it is known and stays. `by_centre`: it is split
  /// even if it is an edge.
  void want_piece(std::uint32_t piece, std::uint32_t by, bool by_centre = false) {
    if (pieces_.set_encroached(piece, by, by_centre)) wanted_pieces_.push_back(piece);
  }
  void require_edge(std::uint32_t) const noexcept {}

  Kernel& kernel_;
  std::vector<Known> vertices_;  // by vertex, from infinity on
  Subedges pieces_;
  std::vector<std::uint32_t> wanted_pieces_;
  std::uint32_t splitting_ = kNone;  // the piece that next() has split
  std::vector<std::uint32_t> star_;  // scratch
  Enclosed<D> enclosed_;

 private:
  [[nodiscard]] Self& self() noexcept { return static_cast<Self&>(*this); }

  [[nodiscard]] std::vector<std::uint32_t> vertices_by_point() const {
    std::vector<std::uint32_t> vertex_of;
    for (std::uint32_t v = 1; v < vertices_.size(); ++v) {
      const VertexHandle point = vertices_[v].point;
      if (point == 0) continue;
      if (vertex_of.size() <= point) vertex_of.resize(point + 1, kNone);
      vertex_of[point] = v;
    }
    return vertex_of;
  }
  [[nodiscard]] std::vector<const SegmentOf<D>*> segments_in_order() const {
    std::vector<const SegmentOf<D>*> all;
    segments_.pool().for_each([&](const SegmentOf<D>& s) {
      if (s.alive) all.push_back(&s);
    });
    std::sort(all.begin(), all.end(), [](const auto* s, const auto* t) {
      return std::tie(s->place_a, s->place_b) < std::tie(t->place_a, t->place_b);
    });
    return all;
  }

  const SegmentStoreOf<D>& segments_;
};

}  // namespace mesher::detail
