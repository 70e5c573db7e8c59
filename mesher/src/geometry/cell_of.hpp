// The clipped Voronoi cell of each dimension: the plane's and space's own, else the one for any.
// All have the same verbs.
#pragma once

#include "geometry/plane.hpp"
#include "geometry/space.hpp"
#include "geometry/voronoi_cell.hpp"
#include "geometry/voronoi_cell3.hpp"
#include "geometry/voronoi_cell_any.hpp"

namespace mesher::detail {

template <int D>
struct CellTraits {
  using Cell = VoronoiCellAny<D>;
};
template <>
struct CellTraits<2> {
  using Cell = VoronoiCell;
};
template <>
struct CellTraits<3> {
  using Cell = VoronoiCell3;
};

template <int D>
using CellOf = typename CellTraits<D>::Cell;

}  // namespace mesher::detail
