// Filling the largest gap balls.
#include "rules/voronoi_aspect.hpp"

#include <limits>

#include "geometry/plane.hpp"

namespace mesher::detail {

// inserts: x is a corner of the clipped cell. input: paper map (i).
Promise VoronoiAspect::promise_for(double rho) {
  return {.gamma = 2 * rho, .inserts = kReads / 2, .input = (rho + 1) / (rho - 1)};
}

VoronoiAspect::VoronoiAspect(const Options<2>& options, const MeshBox<2>& box, const Limits&)
    : InsertionRule(options, box, promise_for(options.rho)) {}

std::optional<InsertionRule::NewPoint> VoronoiAspect::next_point(const VoronoiCell& cell, int,
                                                                 const EdgeFilter*) const {
  double nearest2 = std::numeric_limits<double>::infinity();
  for (int i = 0; i < cell.size(); ++i) {
    if (cell.real(i)) nearest2 = std::min(nearest2, squared(cell.neighbour(i)));
  }
  double farthest2 = 0;
  double length2 = 0;
  Point<2> point{};
  for (int i = 0; i < cell.size(); ++i) {
    const int j = cell.next(i);
    double shortest2 = nearest2;
    if (cell.real(i) && cell.real(j)) {
      shortest2 = std::min(shortest2, squared_distance(cell.place(i), cell.place(j)));
    }
    if (cell.corner2(i) < farthest2 || !exceeds(cell.corner2(i), shortest2)) continue;
    const Point<2> x = plus(cell.center().p, cell.corner(i));
    if (cell.corner2(i) == farthest2 && point < x) continue;
    if (!is_centre(cell, i)) continue;
    farthest2 = cell.corner2(i);
    length2 = shortest2;
    point = x;
  }
  if (farthest2 == 0) return std::nullopt;
  return new_point(cell, point, length2, growth2());
}

}  // namespace mesher::detail
