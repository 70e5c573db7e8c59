// Counting the points in the cells of a grid.
//
// Two far parts of n points can have n^2 pairs that the Delaunay triangulation joins, as those on a
// line and on a circle around it. Here a line of cells has 32 n^(1/3) points at most.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "geometry/box.hpp"
#include "refinement/refine.hpp"

namespace mesher {

namespace {

// Of points at random 1 - 1/e of the cells have one, of 10^7 none has more than 12; of points on a
// grid a cell has 2^D where one more does not fit.
constexpr double kLeastShare = 0.4;
constexpr std::uint8_t kMostInCell = 32;

// A grid of at most n cubes on a box, or none (no cells) if the box is thinner than one.
template <int D>
struct Cells {
  Point<D> lo;
  std::array<std::size_t, D> along{};
  std::size_t count = 1;
  double size;

  Cells(const Box<D>& box, std::size_t n) : lo(box.lo) {
    double volume = 1;
    for (int i = 0; i < D; ++i) volume *= box.hi[i] - box.lo[i];
    size = std::pow(volume / static_cast<double>(n), 1.0 / D);
    for (int i = 0; i < D; ++i) {
      const double wide = std::floor((box.hi[i] - box.lo[i]) / size);
      along[i] = wide >= 1 && wide <= static_cast<double>(n) ? static_cast<std::size_t>(wide) : 0;
      count *= along[i];
    }
  }
  [[nodiscard]] std::size_t of(const Point<D>& p) const {
    std::size_t cell = 0;
    for (int i = 0; i < D; ++i) {
      const auto at = static_cast<std::size_t>((p[i] - lo[i]) / size);
      cell = cell * along[i] + std::min(at, along[i] - 1);
    }
    return cell;
  }
};

}  // namespace

template <int D>
bool are_evenly_spread(const std::vector<Point<D>>& points) {
  if (points.empty()) return false;
  const auto is_finite = [](const Point<D>& p) {
    return std::all_of(p.begin(), p.end(), [](double x) { return std::isfinite(x); });
  };
  if (!std::all_of(points.begin(), points.end(), is_finite)) return false;
  const Cells<D> cells(detail::bounding_box<D>(points), points.size());
  if (cells.count == 0) return false;
  std::vector<std::uint8_t> in_cell(cells.count);
  std::size_t used = 0;
  for (const Point<D>& p : points) {
    std::uint8_t& count = in_cell[cells.of(p)];
    used += count == 0 ? 1 : 0;
    if (++count > kMostInCell) return false;
  }
  return static_cast<double>(used) >= kLeastShare * static_cast<double>(points.size());
}

template bool are_evenly_spread<2>(const std::vector<Point<2>>&);
#ifndef MESHER_PLANE_ONLY
template bool are_evenly_spread<3>(const std::vector<Point<3>>&);
#endif

}  // namespace mesher
