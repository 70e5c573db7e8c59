// Facets of TetGen's `.poly` files as polygons.
//
// A facet is given as polygons in its plane and holes, each of which empties the area around it.
// Loops bound the filled area; other polygons lie inside.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "mesher/graph.hpp"

namespace mesher {

/// Corners by numbers of points.
struct FacetParts {
  std::vector<std::vector<std::uint32_t>> polygons;
  std::vector<Point<3>> holes;
};

/// What it consists of, by numbers of points; a polygon's id is not set.
struct FacetPolygons {
  struct Part {
    std::vector<std::vector<std::uint32_t>> loops;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
    std::vector<std::uint32_t> points;
  };
  std::vector<Part> parts;                                        // that lie apart
  std::vector<std::pair<std::uint32_t, std::uint32_t>> segments;  // that lie in no part
  std::vector<std::size_t> useless_holes;                         // that no polygon goes around
};

/// `places`: of the points. Cost: O(polygons^2 corners).
[[nodiscard]] FacetPolygons polygons_of(const FacetParts& facet,
                                        const std::vector<Point<3>>& places);

}  // namespace mesher
