// The data that the mesher's calls share in space: that for points, and the edges and polygons of
// the input.
#pragma once

#include "program/filling.hpp"
#include "program/input_features.hpp"
#include "program/point_world.hpp"
#include "rules/sliver_rule.hpp"
#include "space/guard.hpp"
#include "space/placed.hpp"
#include "space/star_crossings.hpp"
#include "space/validity.hpp"

namespace mesher::detail {

template <class S>
struct World<S, 3> : PointWorld<S, 3> {
  using Base = PointWorld<S, 3>;
  using Base::box;
  using Base::features;
  using Base::limits;
  using Base::vertices;
  using typename Base::Agenda;

  InputFeatures<S> plc;
  FillPlans<S, 3> plans;
  Surroundings<S, 3> surroundings;
  Agenda& splits;
  Agenda& fills;
  const SliverRule slivers;
  const bool guarded;                         // space/guard.hpp
  StarCrossings::Room star_room{};            // of the star that is looked at
  const SpaceNames* feature_names = nullptr;  // for messages; null: features have none

  template <class Host>
  World(const Options<3>& options, const MeshBox<3>& mesh_box, Host& host,
        TileBorder<3>* tile_border = nullptr)
      : Base(options, mesh_box, host, tile_border),
        plc(box, vertices.pool(), features, host),
        plans(box, limits, host),
        surroundings(box, limits, Obstacles<S, 3>(features, plc.store(), this->whole_features()),
                     host),
        splits(host.make_agenda("edges", kKeyWidths)),
        fills(host.make_agenda("facets", kKeyWidths)),
        slivers(box, options.min_dihedral),
        guarded(options.rho < kGuarded) {
    host.set_environment(this);
    if constexpr (S::kTraced) plc.set_listeners(vertices, surroundings);
    if (limits.any()) post_cells(*this);
  }

  /// Calls that may have asked about the limits there run again.
  void limits_changed(const Box<3>& where) noexcept;

  /// Outside edits: as those of plc, with the events of the edges and polygons that come and go.
  const Edge& insert_edge(VertexHandle a, VertexHandle b);
  void erase_edge(const Edge& e);
  const Polygon& insert_polygon(PolygonParts parts);
  void erase_polygon(const Polygon& f);

  /// Whether there are edges, and perhaps polygons.
  [[nodiscard]] bool has_features() const noexcept { return plc.store().live_edges() != 0; }
  /// Edges are split only where there are limits: this asks for it, of those that there are.
  void post_edges();
  void retract_edges();
  void post_split(S& s, const EdgePiece& piece);
  void post_fill(S& s, const FacetPiece& piece);
  /// fill() of what a cell consists of, which is split, too.
  void post_parts(S& s, const Cell<3>& c) { detail::post_parts(s, *this, c); }
  /// Whether a piece is long for the lattice beside it. (One that is crowded is split where
  /// something crosses it, if at all; the query is how those who ask for limits here are found.)
  [[nodiscard]] bool divides(S& s, const EdgePiece& piece) {
    (void)plc.crowded(s, piece);
    return limits.is_long(EdgeBall(piece).box(), piece.length(), kLongestEdge);
  }
  /// Whether a piece is crowded, or long for the lattice beside it.
  [[nodiscard]] bool divides(S& s, const FacetPiece& piece) {
    const bool crowded = plc.crowded(s, piece);
    return crowded || limits.is_long(FacetBall(piece).box(), piece.longer_side(), kWidestPiece);
  }
  void post_split_slivers(S& s, VertexRef<3> v, int b);
  /// A vertex that cuts the cell of v, in bucket b.
  void insert_beside(S& s, const Vertex<3>& v, CellOf<3>& cell, const Placed& y, int b);
  /// What is said where there are too many vertices.
  [[nodiscard]] Error too_many() const;
  [[noreturn]] void fail_useless(const Vertex<3>& v, const Vertex<3>& x) const;
  /// `at`: in f's frame, where another feature touches f.
  [[noreturn]] void fail_too_fine(const Polygon& f, const Point<2>& at) const;

 private:
  void post_edge(const Edge& e);
  void retract_edge(const Edge& e);
  void edge_came(const Edge& e);
  void edge_goes(const Edge& e);
};

}  // namespace mesher::detail
