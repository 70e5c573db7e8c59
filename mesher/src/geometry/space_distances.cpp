// The nearest places of two segments: at an end of one, or where both lines are nearest.
#include "geometry/space_distances.hpp"

namespace mesher::detail {
namespace {

// Squared distance of the lines at their nearest, if that is inside both segments; else of two
// other places of them. With u = b - a, v = d - c, w = a - c, the places a + s u and c + t v are
// nearest where w + s u - t v is orthogonal to both.
double lines_distance2(const Point<3>& a, const Point<3>& u, const Point<3>& c, const Point<3>& v) {
  const Point<3> w = minus(a, c);
  const Point<3> normal = cross(u, v);
  const double normal2 = squared(normal);
  if (!(normal2 > 0)) return squared(w);  // parallel: nearest at an end, too
  const double s = std::clamp(dot(cross(v, w), normal) / normal2, 0.0, 1.0);
  const double t = std::clamp(dot(cross(u, w), normal) / normal2, 0.0, 1.0);
  return squared(minus(plus(w, scaled(s, u)), scaled(t, v)));
}

}  // namespace

double distance2(const Point<3>& a, const Point<3>& b, const Point<3>& c, const Point<3>& d) {
  const double at_ends =
      std::min({distance2(a, c, d), distance2(b, c, d), distance2(c, a, b), distance2(d, a, b)});
  return std::min(at_ends, lines_distance2(a, minus(b, a), c, minus(d, c)));
}

}  // namespace mesher::detail
