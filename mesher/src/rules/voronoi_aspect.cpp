// Filling the largest gap balls.
#include "rules/voronoi_aspect.hpp"

#include <limits>
#include <tuple>

namespace mesher::detail {

// inserts: x is a corner of the clipped cell. input: paper map (i).
template <int D>
Promise VoronoiAspect<D>::promise_for(double rho) {
  return {.gamma = 2 * rho, .inserts = kReads<D> / 2, .input = (rho + 1) / (rho - 1)};
}

template <int D>
VoronoiAspect<D>::VoronoiAspect(const Options<D>& options, const MeshBox<D>& box,
                                const LimitsOf<D>&)
    : Base(options, box, promise_for(options.rho)) {}

template <int D>
auto VoronoiAspect<D>::next_point(const CellOf<D>& cell, int, const EdgeFilter<D>*) const
    -> std::optional<NewPoint> {
  double nearest2 = std::numeric_limits<double>::infinity();
  for (int i = 0; i < cell.size(); ++i) {
    if (cell.real(i)) nearest2 = std::min(nearest2, squared(cell.neighbour(i)));
  }
  double farthest2 = 0;
  double length2 = 0;
  Point<D> point{};
  for (int i = 0; i < cell.corners(); ++i) {
    const auto ends = cell.ends(i);
    double shortest2 = nearest2;
    for (std::size_t k = 0; k < ends.size(); ++k) {
      for (std::size_t j = k + 1; j < ends.size(); ++j) {
        if (!cell.real(ends[k]) || !cell.real(ends[j])) continue;
        shortest2 = std::min(shortest2, squared_distance(cell.place(ends[k]), cell.place(ends[j])));
      }
    }
    if (cell.corner2(i) < farthest2 || !Base::exceeds(cell.corner2(i), shortest2)) continue;
    const Point<D> x = plus(cell.center().p, cell.corner(i));
    // Of equals, the one that asks for the least: simplices with one circumcentre.
    if (cell.corner2(i) == farthest2 && std::tie(point, length2) < std::tie(x, shortest2)) continue;
    if (!Base::is_centre(cell, i)) continue;
    farthest2 = cell.corner2(i);
    length2 = shortest2;
    point = x;
  }
  if (farthest2 == 0) return std::nullopt;
  return Base::new_point(cell, point, length2, Base::growth2());
}

template class VoronoiAspect<2>;
#ifndef MESHER_PLANE_ONLY
template class VoronoiAspect<3>;
template class VoronoiAspect<4>;
#endif

}  // namespace mesher::detail
