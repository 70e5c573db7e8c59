// The default meshing domain: the bounding box of the input on a coarse power-of-two grid.
//
// All arithmetic is exact but for the difference of two coordinates, which only picks the grid:
// division by a power of two, floor and ceil to an integer of at most 53 bits, and back. Input
// coordinates are 0 or of magnitude 2^-100 to 2^100, so nothing under- or overflows.
#include "mesher/mesh.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/box.hpp"

namespace mesher {
namespace {

double power_of_two(int exponent) { return std::ldexp(1.0, exponent); }

// In (side/8, side/4] for the longest side, a power of two. Where all points are one, the largest
// coordinate stands for the side. Never below the spacing of doubles at the largest coordinate:
// then a side moved by one step is another double.
template <int D>
double grid_step(const Box<D>& box) {
  double side = 0, largest = 0;
  for (int i = 0; i < D; ++i) {
    side = std::max(side, box.hi[i] - box.lo[i]);
    largest = std::max({largest, std::abs(box.lo[i]), std::abs(box.hi[i])});
  }
  if (side == 0) side = largest == 0 ? 1.0 : largest;
  const double step = power_of_two(std::ilogb(side) - 2);
  return largest == 0 ? step : std::max(step, power_of_two(std::ilogb(largest) - 52));
}

}  // namespace

template <int D>
Box<D> snapped_domain(const std::vector<Point<D>>& points) {
  Box<D> box;
  box.hi.fill(1.0);
  if (points.empty()) return box;
  box = detail::bounding_box<D>(points);
  const double step = grid_step<D>(box);
  for (int i = 0; i < D; ++i) {
    box.lo[i] = std::floor(box.lo[i] / step) * step + 0.0;  // + 0.0: no negative zero
    box.hi[i] = std::ceil(box.hi[i] / step) * step + 0.0;
    if (box.lo[i] < box.hi[i]) continue;
    box.lo[i] -= step;  // a side without extent lies on the grid: keep it in the middle
    box.hi[i] += step;
  }
  return box;
}

template Box<2> snapped_domain<2>(const std::vector<Point<2>>&);
#ifndef MESHER_PLANE_ONLY
template Box<3> snapped_domain<3>(const std::vector<Point<3>>&);
#endif

}  // namespace mesher
