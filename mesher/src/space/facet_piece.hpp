// Pieces of a polygon that are filled with vertices as far as they have to be [Fig 6.4].
//
// A polygon's frame is cut into rectangles with sides of about 1 : sqrt(1/2), which are halved
// across their longer sides, into such rectangles. So from one level to the next there are twice as
// many, not four times as in a quadtree, and vertices are seldom much closer than they need to be.
// In each rectangle there is one place for a vertex: a quarter of the longer side off the middle,
// to one side and the other in turn. Equal pieces then make a lattice of triangles without
// cocircular quadruples, which is 0.53 of a longer side from all places between.
//
// All that is a function of the polygon alone.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "space/feature_store.hpp"

namespace mesher::detail {

/// An argument of traced functions: equal by value, ordered by the polygon's places.
struct FacetPiece {
  const Polygon* polygon = nullptr;
  int level = 0;                     // how often the piece that has all of the polygon is halved
  std::int64_t column = 0, row = 0;  // from the frame's least corner on, in pieces of this level

  /// Along the frame's axes.
  [[nodiscard]] std::array<double, 2> sides() const noexcept;
  [[nodiscard]] double longer_side() const noexcept;
  /// Places of the frame: of the piece's middle, and where its vertex goes.
  [[nodiscard]] Point<2> middle() const noexcept;
  [[nodiscard]] Point<2> place() const noexcept;
  [[nodiscard]] std::array<FacetPiece, 2> halves() const noexcept;
  /// Whether the circle around the piece meets the polygon.
  [[nodiscard]] bool meets_polygon() const;

  friend bool operator==(const FacetPiece&, const FacetPiece&) = default;
  friend std::partial_ordering operator<=>(const FacetPiece& x, const FacetPiece& y) {
    if (x.polygon != y.polygon) {
      if (const auto c = order(*x.polygon, *y.polygon); c != 0) return c;
    }
    if (const auto c = x.level <=> y.level; c != 0) return c;
    if (const auto c = x.row <=> y.row; c != 0) return c;
    return x.column <=> y.column;
  }
  friend std::uint64_t hash_value(const FacetPiece& p) noexcept {
    std::uint64_t h = sac::mix(p.polygon->self);
    for (const std::int64_t x : {std::int64_t{p.level}, p.row, p.column}) {
      h = sac::mix(h + static_cast<std::uint64_t>(x));
    }
    return h;
  }
  friend std::ostream& operator<<(std::ostream& out, const FacetPiece& p);
  friend void label_bytes(sac::LabelSink& sink, const FacetPiece& p);

 private:
  [[nodiscard]] bool is_wide() const noexcept { return level % 2 == 0; }
};

/// Where a piece gets its vertex: at place(), or else in its middle; nowhere if neither is inside
/// the polygon and clear of what lies on that.
[[nodiscard]] std::optional<Point<3>> vertex_place(const FacetPiece& piece,
                                                   const FeatureStore& store);

}  // namespace mesher::detail
