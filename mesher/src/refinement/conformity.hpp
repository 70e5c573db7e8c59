// Keeps the edges and polygons of a complex unions of edges and faces of the Delaunay triangulation
// that a refinement makes [Fig 2.7, 2.8; rules C].
//
// An edge is cut into pieces. A piece with a vertex in its diametral ball is *encroached*, and is
// split; one without is an edge of the triangulation. So the meshes M_f of edges are lists.
//
// A polygon has no mesh of its own. The Voronoi diagram cuts it into parts, and the corners of
// these, the crossings, are kept by the faces that they are dual to (crossings.hpp). If no part is
// of a vertex that is not on the polygon, the parts are the Voronoi diagram of those on it, and the
// faces that cross are its Delaunay triangulation: M_f, read off M. A crossing that has another
// vertex is *foreign*; the polygon gets a vertex there. Only what an insertion takes out can change
// crossings: each part of the new vertex has a corner of a part that was there, since
// its cell is convex and edges are not encroached; and that is nearer to it than to its own.
//   (The other design gave each polygon a triangulation in its plane [2.3]. It has to be the same
//   as that in space where points are on a circle, but for rounding, and it says no more.)
//
// On which side of a polygon's plane a circumcentre is, is found once for a tetrahedron: so
// faces between sides are closed surfaces, flat tetrahedra or not.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "mesher/error.hpp"
#include "refinement/crossings.hpp"
#include "refinement/line_conformity.hpp"
#include "space/feature_store.hpp"
#include "space/placed.hpp"

namespace mesher::detail {

/// What is thrown where vertices on features come too close to each other.
[[nodiscard]] Error too_close_near(const Point<3>& x);

class Conformity : public LineConformity<3, Conformity> {
 public:
  using Store = FeatureStore;

  Conformity(FeatureStore& store, Kernel& kernel);

  /// Finds the pieces. Requires: all input points are vertices.
  void start();

  /// Where the centre x of an empty ball goes instead, on a feature; nothing: none is near. By the
  /// input alone: before start(). Cost: O(log L/s), and what is near.
  [[nodiscard]] std::optional<Placed> yield(const Point<3>& x, double radius) const;

  /// Nothing: all conforms. Throws: Error (too_close: a piece is too short to be split).
  [[nodiscard]] std::optional<Wanted> next();
  /// Throws: Error (too_close: another vertex is there).
  [[noreturn]] void fail_occupied(const Placed& place) const { throw too_close_near(place.p); }

  /// Throws: Error (too_close), unless the tiles of each polygon are all of it. Requires: next()
  /// has returned nothing.
  void require_whole() const;

  /// Whether a simplex stays that is poor by the edge vw: where features meet at a small angle.
  [[nodiscard]] bool keeps(std::uint32_t v, std::uint32_t w) const;

  // --- Of a vertex that is dug
  /// Whether it encroaches on pieces, or on tiles: these are wanted then.
  [[nodiscard]] bool yields(std::uint32_t v);
  /// Before the hole is filled.
  void before_fill(std::uint32_t v);
  /// Afterwards.
  void after_fill(std::uint32_t v);

  [[nodiscard]] const Polygon& polygon_of(const Crossings::Crossing& tile) const noexcept {
    return polygon(tile.polygon);
  }
  [[nodiscard]] const Crossings& crossings() const noexcept { return crossings_; }

 private:
  friend LineConformity;
  enum class Side : std::uint8_t { unknown, none, below, above };
  // Polygons are called by their place in canonical order, from 1 on.
  using Rank = std::uint32_t;
  using Polygons = std::span<const Rank>;  // ascending
  // Lists of polygons by handles of edges or points.
  struct Lists {
    std::vector<std::uint32_t> begin;
    std::vector<Rank> all;
    [[nodiscard]] Polygons operator[](std::uint32_t h) const noexcept {
      if (h + 1 >= begin.size()) return {};
      return {all.data() + begin[h], all.data() + begin[h + 1]};
    }
  };

  [[nodiscard]] Known known(const Role& role, VertexHandle point) const;
  template <class KeysOf>
  [[nodiscard]] Lists lists(KeysOf&& keys_of) const;
  [[nodiscard]] Polygons polygons(std::uint32_t v) const noexcept;
  [[nodiscard]] bool is_on(std::uint32_t v, Rank f) const noexcept;
  [[nodiscard]] const Polygon& polygon(Rank f) const noexcept { return *by_rank_[f]; }

  [[nodiscard]] bool encroaches(std::uint32_t piece, std::uint32_t v) const noexcept;
  void add_pieces(const Edge& e, std::uint32_t a, std::uint32_t b,
                  std::vector<std::uint32_t>& between);
  [[nodiscard]] std::uint32_t piece_at(EdgeHandle handle, const Label& at) const;
  [[nodiscard]] Wanted split_piece(std::uint32_t piece) const;
  template <class Visit>
  void visit_pieces_dug(Visit&& visit) const;
  [[nodiscard]] bool is_made(std::uint32_t piece) const;

  void start_polygons();
  void find_crossings(Rank f, std::vector<std::uint32_t> cells, std::vector<Rank>& seen_for);
  template <class Visit>
  void look_at_faces(const std::vector<std::uint32_t>& all, bool with_borders, Rank f,
                     Visit&& visit);
  void look_at_made(Rank f);
  std::uint32_t look_at_face(std::uint32_t s, std::uint32_t i, Rank f, bool crosses);
  [[nodiscard]] Side side(std::uint32_t s, Rank f) const;
  [[nodiscard]] bool all_on_polygons(const std::array<std::uint32_t, 3>& facet) const noexcept;
  [[nodiscard]] bool is_above(std::uint32_t s, Rank f) const;
  [[nodiscard]] Point<3> middle_of(const Face& face, const Polygon& f) const;
  [[nodiscard]] bool is_wall(std::uint32_t s, std::uint32_t i) const;
  [[nodiscard]] std::optional<Crossings::Crossing> crossing_of(const Face& face, std::uint32_t s,
                                                               std::uint32_t t, Rank f) const;
  void want_crossing(std::uint32_t crossing, const Point<3>& from);
  [[nodiscard]] Placed place_for(const Crossings::Crossing& crossing) const;
  [[nodiscard]] std::optional<Point<3>> foot_in(const Polygon& f, const Point<3>& x,
                                                const Crossings::Crossing& crossing) const;
  [[nodiscard]] bool is_nearest(std::uint32_t v, const Point<3>& x) const;
  [[nodiscard]] Placed place_near(const Polygon& f, const Point<3>& x, std::uint32_t v) const;
  [[nodiscard]] bool cuts_cell(std::uint32_t v, const Point<3>& x) const;
  [[nodiscard]] Vertex<3> record(std::uint32_t v) const;
  void erase(std::uint32_t crossing);
  template <class Visit>
  void visit_crossings_of(std::uint32_t s, Visit&& visit) const;

  FeatureStore& store_;
  std::vector<const Polygon*> by_rank_;
  std::vector<Rank> rank_;  // by handle
  Lists at_edge_, at_point_;
  Crossings crossings_;
  std::vector<std::uint32_t> wanted_crossings_;
  std::size_t foreign_ = 0;                // crossings that are no tiles
  bool has_polygons_ = false;              // their crossings are known
  std::vector<std::uint32_t> dug_pieces_;  // scratch
  std::vector<Rank> touched_;              // scratch: whose crossings an insertion may change
  std::vector<Side> sides_;                // scratch: by simplex, unknown between calls
};

/// Calls visit(piece) for the pieces whose edges are in the hole that is dug, some repeatedly.
template <class Visit>
void Conformity::visit_pieces_dug(Visit&& visit) const {
  for (const std::uint32_t s : kernel_.doomed()) {
    const auto& corners = kernel_.simplices().corners(s);
    for (std::size_t i = 0; i < 4; ++i) {
      if (!vertices_[corners[i]].on_edge) continue;
      for (std::size_t k = 0; k < i; ++k) {
        if (!vertices_[corners[k]].on_edge) continue;
        const std::uint32_t piece = pieces_.find(corners[i], corners[k]);
        if (piece != kNone) visit(piece);
      }
    }
  }
}

}  // namespace mesher::detail
