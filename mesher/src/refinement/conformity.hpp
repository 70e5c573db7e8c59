// Keeps the edges and polygons of a complex unions of edges and faces of the Delaunay triangulation
// that a refinement makes [Fig 2.7, 2.8; rules F].
//
// An edge is cut into pieces. A piece is split if it is no edge of the triangulation, or if the
// centre of a poor tetrahedron would come into its diametral ball. (To split each piece that has a
// vertex in its ball is three to five times as many vertices on surfaces: most are edges all the
// same.)
//
// A polygon has no mesh of its own: it is covered by *tiles*, faces with their corners on it. Where
// it is not, there is a *gap*: an edge of the triangulation pierces it there, and it gets a vertex
// beside that, or where it is pierced. A gap is beside an edge of a tile, or a piece, since pieces
// are edges, and edges cross no faces.
//   (Two other designs. To give each polygon a triangulation in its plane [2.3]: it has to be the
//   same as that in space where points are on a circle, but for rounding, and says no more. To
//   have all of the Voronoi diagram's slice of the polygon belong to vertices on it: that asks for
//   empty balls in the plane, which faces need not have, and it misses gaps where a tile's centre
//   would be outside.)
//
// Where four vertices on a polygon are the corners of one tetrahedron, flat but for rounding, the
// polygon's tiles are those of its faces that are on its upper side, at first the normal's. So
// tiles are a surface, whatever is flat. In the end it is the side of what is enclosed, if that is
// on one side alone: then what is flat is outside.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <tuple>
#include <vector>

#include "delaunay/facets.hpp"
#include "mesher/error.hpp"
#include "refinement/conformity_balls.hpp"
#include "refinement/line_conformity.hpp"
#include "refinement/narrow_gaps.hpp"
#include "refinement/tiles.hpp"
#include "space/feature_store.hpp"
#include "space/placed.hpp"

namespace mesher::detail {

class SpaceNames;

/// What is thrown where vertices on features come too close to each other.
[[nodiscard]] Error too_close_near(const Point<3>& x);

class Conformity : public LineConformity<3, Conformity> {
 public:
  using Store = FeatureStore;
  static constexpr bool kEmptyBalls = false;

  Conformity(FeatureStore& store, Kernel& kernel);

  /// Finds the pieces. Requires: all input points are vertices.
  void start();

  /// Where the centre x of an empty ball goes instead, on a feature; nothing: none is near. By the
  /// input alone: before start(). Cost: O(log L/s), and what is near.
  [[nodiscard]] std::optional<Placed> yield(const Point<3>& x, double radius) const;

  /// Nothing: all conforms. Throws: Error (too_close: a piece is too short to be split).
  [[nodiscard]] std::optional<Wanted> next();
  /// Whether next() may find something after a look at all tiles; it looks at what has changed.
  /// Requires: it has returned nothing. Cost: O(n log n) for n tiles.
  [[nodiscard]] bool looks_again();
  /// Throws: Error (too_close: another vertex is there).
  [[noreturn]] void fail_occupied(const Placed& place) const { throw too_close_near(place.p); }

  /// Throws: Error (too_many: beyond `most`, with the ids of the features with most vertices).
  [[noreturn]] void fail_too_many(std::size_t most, const SpaceNames* names) const;
  /// Throws: SurelyTooMany.
  [[noreturn]] void fail_between(const NarrowGaps::Gap& gap, std::size_t most,
                                 const SpaceNames* names) const;

  /// The gaps beside tiles, on the sides that are not `outside(simplex)`; of many tiles the
  /// largest. Cost: O(n) for n simplices, and up to some 10^5 searches.
  template <class Outside>
  [[nodiscard]] NarrowGaps narrow_gaps(Outside&& outside) const;

  /// Throws: Error (too_close), unless the tiles of each polygon are all of it. Requires: next()
  /// has returned nothing.
  void require_whole() const;
  /// Of polygons with what is enclosed on one side alone: that it has no tetrahedra that are flat
  /// on them. Requires: as is_outside(), and nothing will be inserted. Cost: O(n) for n simplices.
  void put_flat_outside();

  /// Whether a simplex stays that is poor by the edge vw: where features meet at a small angle.
  [[nodiscard]] bool keeps(std::uint32_t v, std::uint32_t w) const;

  /// Whether an edge of s is a piece, at least as long as this, squared: the longest is wanted
  /// then.
  [[nodiscard]] bool wants_piece_of(std::uint32_t s, double least2);

  // --- Of a vertex that is dug
  /// Whether it encroaches on pieces, or on tiles: these are wanted then.
  [[nodiscard]] bool yields(std::uint32_t v);
  /// Whether it is in the ball of a piece or a tile.
  [[nodiscard]] bool encroaches_on_features(std::uint32_t v);
  /// Whether pieces or tiles would no longer be there.
  [[nodiscard]] bool is_disturbed() const;
  /// Before the hole is filled.
  void before_fill(std::uint32_t v);
  /// Afterwards.
  void after_fill(std::uint32_t v);

  [[nodiscard]] const Polygon& polygon_of(const Tiles::Tile& tile) const noexcept {
    return polygon(tile.polygon);
  }
  [[nodiscard]] const Tiles& tiles() const noexcept { return tiles_; }

 private:
  friend LineConformity;
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

  // --- Tiles
  void start_polygons();
  template <class Visit>
  void visit_common_polygons(const Facet& facet, Visit&& visit) const;
  void look_at_facet(std::uint32_t s, std::uint32_t i);
  void look_at_all();
  [[nodiscard]] bool is_tile(std::uint32_t s, std::uint32_t i, Rank f) const;
  [[nodiscard]] bool is_above(std::uint32_t s, std::uint32_t i, Rank f) const;
  [[nodiscard]] EdgeHandle common_edge(std::uint32_t v, std::uint32_t w) const;
  [[nodiscard]] bool has_three_on_edge(const std::array<std::uint32_t, 4>& corners, Rank f) const;
  [[nodiscard]] Point<3> middle_of(const Face& face) const;
  [[nodiscard]] Point<3> centre_of(const Face& face, const Polygon& f) const;
  [[nodiscard]] double area_of(const Face& face) const;
  void want_tile(std::uint32_t tile, const Point<3>& from);
  void erase(std::uint32_t tile);
  template <class Visit>
  void visit_tiles_of(std::uint32_t s, Visit&& visit) const;
  template <class Visit>
  void visit_tiles_around(std::uint32_t v, Visit&& visit) const;
  [[nodiscard]] bool is_wall(std::uint32_t s, std::uint32_t i) const;

  // --- Gaps
  // A side of an edge, in the plane of a polygon that it is on.
  struct Side {
    Rank polygon;
    std::uint32_t a, b;
    Point<3> towards;  // at right angles to ab
  };
  // A simplex in the way of a tile, and its edge uv that pierces the polygon.
  struct Gap {
    Rank polygon;
    std::uint32_t simplex;
    std::uint32_t u, v;
    Point<3> at;
  };
  void note_loose(Rank f);
  [[nodiscard]] bool is_covered_again(Rank f) const;
  [[nodiscard]] bool is_towards(const Side& side, std::uint32_t v) const;
  void find_open_sides(Rank f);
  void find_new_open_sides(Rank f);
  void sort_open_sides(std::size_t first);
  void suspect(Rank f, std::uint32_t a, std::uint32_t b) {
    suspects_[f].push_back({std::min(a, b), std::max(a, b)});
  }
  void suspect(Rank f, const Face& face) {
    suspect(f, face[0], face[1]), suspect(f, face[1], face[2]), suspect(f, face[0], face[2]);
  }
  [[nodiscard]] std::optional<Gap> gap_at(const Side& side);
  [[nodiscard]] std::optional<Gap> next_gap();

  // --- Where polygons get vertices
  [[nodiscard]] std::optional<Placed> place_for(const Tiles::Tile& tile,
                                                const Point<3>& from) const;
  [[nodiscard]] Placed place_for(const Gap& gap) const;
  [[nodiscard]] std::optional<Point<3>> foot_in(const Polygon& f, const Point<3>& x,
                                                const Face& face, const Point<3>& centre) const;
  [[nodiscard]] bool is_nearest(std::uint32_t v, const Point<3>& x) const;
  template <class Helps>
  [[nodiscard]] Placed place_near(const Polygon& f, const Point<3>& x, double d2,
                                  Helps&& helps) const;
  [[nodiscard]] bool cuts_cell(std::uint32_t v, const Point<3>& x) const;
  [[nodiscard]] Vertex<3> record(std::uint32_t v) const;
  [[nodiscard]] Wanted wanted(const Placed& place, std::uint32_t beside, const Placed& otherwise);

  FeatureStore& store_;
  std::vector<const Polygon*> by_rank_;
  std::vector<Rank> rank_;  // by handle
  Lists at_edge_, at_point_;
  Tiles tiles_;
  std::vector<std::uint32_t> wanted_tiles_;
  std::vector<bool> is_turned_;        // by polygon: its upper side is not the normal's
  std::vector<double> lost_, gained_;  // by polygon: the area of tiles since the last look
  std::vector<Rank> loose_;            // polygons that have lost tiles
  std::vector<bool> is_loose_;         // by polygon
  std::vector<Side> open_;             // sides of edges where tiles were missing
  // By polygon: edges of tiles that came or went, and pieces that were split, since its open sides
  // were found.
  std::vector<std::vector<std::array<std::uint32_t, 2>>> suspects_;
  std::vector<bool> has_looked_;           // by polygon: at all of it, at first
  std::vector<bool> has_gap_;              // by polygon: one was found at the last look
  std::size_t looked_again_ = 0;           // with so many vertices
  bool has_polygons_ = false;              // their tiles are known
  std::vector<std::uint32_t> dug_pieces_;  // scratch
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

/// Calls visit(tile, across) for the tiles among the faces of s.
template <class Visit>
void Conformity::visit_tiles_of(std::uint32_t s, Visit&& visit) const {
  const auto& corners = kernel_.simplices().corners(s);
  std::uint32_t on_polygons = 0;
  for (const std::uint32_t w : corners) on_polygons += vertices_[w].on_polygon ? 1 : 0;
  if (on_polygons < 3) return;
  for (std::uint32_t i = 0; i < 4; ++i) {
    if (on_polygons == 3 && vertices_[corners[i]].on_polygon) continue;
    for (std::uint32_t t = tiles_.find(face_across(facet_across<3>(corners, i))); t != kNone;) {
      const std::uint32_t next = tiles_[t].next;
      visit(t, kernel_.simplices().across(s)[i] >> 2);
      t = next;
    }
  }
}

template <class Outside>
NarrowGaps Conformity::narrow_gaps(Outside&& outside) const {
  struct Part {
    double area;
    std::uint32_t tile, beside;
  };
  std::vector<Part> parts;
  const auto& simplices = kernel_.simplices();
  for (std::uint32_t s = 0; s < simplices.places(); ++s) {
    if (!simplices.alive(s)) continue;
    const auto& corners = simplices.corners(s);
    if (std::find(corners.begin(), corners.end(), kInfinite) != corners.end()) continue;
    visit_tiles_of(s, [&](std::uint32_t t, std::uint32_t) {
      if (outside(s)) return;
      const Face& face = tiles_[t].face;
      const auto is_across = [&](std::uint32_t v) {
        return std::find(face.begin(), face.end(), v) == face.end();
      };
      parts.push_back({area_of(face), t, *std::find_if(corners.begin(), corners.end(), is_across)});
    });
  }
  constexpr std::size_t kMostParts = 1 << 14;
  const std::size_t count = std::min(parts.size(), kMostParts);
  std::partial_sort(parts.begin(), parts.begin() + static_cast<std::ptrdiff_t>(count), parts.end(),
                    [](const Part& p, const Part& q) {
                      if (p.area != q.area) return p.area > q.area;
                      return std::tie(p.tile, p.beside) < std::tie(q.tile, q.beside);
                    });
  NarrowGaps gaps(store_);
  for (std::size_t k = 0; k < count; ++k) {
    const Tiles::Tile& tile = tiles_[parts[k].tile];
    const auto& [a, b, c] = tile.face;
    gaps.add(polygon_of(tile), {place(a), place(b), place(c)}, place(parts[k].beside));
  }
  return gaps;
}

}  // namespace mesher::detail
