// The box of a tree of positions that are all known at the start.
#pragma once

#include <algorithm>
#include <vector>

#include "geometry/box.hpp"
#include "geometry/grid.hpp"

namespace mesher::detail {

/// A cube with all of the places; not empty, however few they are.
template <int D>
[[nodiscard]] MeshBox<D> cube_around(const std::vector<Point<D>>& places) {
  const Box<D> all = bounding_box<D>(places);
  double side = 0;
  for (int i = 0; i < D; ++i) side = std::max(side, all.hi[i] - all.lo[i]);
  return {all.lo, side > 0 ? side : 1};
}

}  // namespace mesher::detail
