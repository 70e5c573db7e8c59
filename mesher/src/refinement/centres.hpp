// Where a refinement splits a simplex.
//
// At an off-centre [Ungor 2004]: on the way from the middle of the shortest edge to the
// circumcentre, in space at most rho edges from the middle [rules D8]. What would be beside a side
// of the box or outside of it goes onto the side.
#pragma once

#include <cstdint>

#include "delaunay/kernel.hpp"
#include "geometry/grid.hpp"

namespace mesher::detail {

/// In the ball of its simplex, `radius` from the nearest of its corners.
template <int D>
struct Centre {
  Point<D> place;
  double radius;
  bool on_side;  // of the box
};

template <int D>
class Centres {
 public:
  using Kernel = DelaunayKernel<D, BallLayout<D>>;

  Centres(const MeshBox<D>& box, double rho);

  /// Of a simplex that is no ghost.
  [[nodiscard]] Centre<D> of(const Kernel& kernel, std::uint32_t s) const;
  /// That s's centre takes s out, and is not too near to its corners: of doubles there are not
  /// enough where input points are nearly equal. Throws: Error(too_close).
  void require_apart(const Kernel& kernel, std::uint32_t s, const Centre<D>& centre) const;

 private:
  [[nodiscard]] Centre<D> moved_to_sides(const Centre<D>& centre, double margin) const;

  MeshBox<D> box_;
  double height_;  // of an off-centre, in units of the edge
  double tiny_;
};

}  // namespace mesher::detail
