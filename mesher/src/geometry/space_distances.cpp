// The nearest places of two segments: at an end of one, or where both lines are nearest.
#include "geometry/space_distances.hpp"

namespace mesher::detail {
namespace {

// Which parts of two segments lie before the places where the lines are nearest; of the segments,
// if that is outside. With u = b - a, v = d - c, w = a - c, the places a + s u and c + t v are
// nearest where w + s u - t v is orthogonal to both.
struct Fractions {
  double s = 0, t = 0;
};
Fractions nearest_of_lines(const Point<3>& a, const Point<3>& u, const Point<3>& c,
                           const Point<3>& v) {
  const Point<3> w = minus(a, c);
  const Point<3> normal = cross(u, v);
  const double normal2 = squared(normal);
  if (!(normal2 > 0)) return {};  // parallel: nearest at an end, too
  return {std::clamp(dot(cross(v, w), normal) / normal2, 0.0, 1.0),
          std::clamp(dot(cross(u, w), normal) / normal2, 0.0, 1.0)};
}

}  // namespace

double distance2(const Point<3>& a, const Point<3>& b, const Point<3>& c, const Point<3>& d) {
  const double at_ends =
      std::min({distance2(a, c, d), distance2(b, c, d), distance2(c, a, b), distance2(d, a, b)});
  const Point<3> u = minus(b, a), v = minus(d, c);
  const auto [s, t] = nearest_of_lines(a, u, c, v);
  return std::min(at_ends, squared(minus(plus(minus(a, c), scaled(s, u)), scaled(t, v))));
}

Point<3> nearest_place(const Point<3>& a, const Point<3>& b, const Point<3>& c, const Point<3>& d) {
  const Point<3> u = minus(b, a);
  Point<3> nearest = a;
  for (const double s : {1.0, nearest_fraction(c, a, b), nearest_fraction(d, a, b),
                         nearest_of_lines(a, u, c, minus(d, c)).s}) {
    const Point<3> x = plus(a, scaled(s, u));
    if (distance2(x, c, d) < distance2(nearest, c, d)) nearest = x;
  }
  return nearest;
}

}  // namespace mesher::detail
