// The type of the clipped Voronoi cell for each dimension: special ones for the plane and for
// space, else the general one. All have the same functions.
#pragma once

#include "cells/voronoi_cell.hpp"
#include "cells/voronoi_cell3.hpp"
#include "cells/voronoi_cell_any.hpp"
#include "geometry/plane_vectors.hpp"
#include "geometry/space_vectors.hpp"

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
