// Angles and radius-edge ratios of triangles.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "mesher/check.hpp"

namespace mesher {
namespace {

struct Sides {
  double shortest, middle, longest;  // squared lengths
  double twice_area;
};

Sides sides_of(const Point<2>& a, const Point<2>& b, const Point<2>& c) {
  const double abx = b[0] - a[0], aby = b[1] - a[1];
  const double acx = c[0] - a[0], acy = c[1] - a[1];
  const double bcx = c[0] - b[0], bcy = c[1] - b[1];
  double squares[] = {abx * abx + aby * aby, acx * acx + acy * acy, bcx * bcx + bcy * bcy};
  std::sort(std::begin(squares), std::end(squares));
  return {squares[0], squares[1], squares[2], std::abs(abx * acy - aby * acx)};
}

// R = product of the sides / (4 area); over the shortest side.
double radius_edge(const Sides& s) { return std::sqrt(s.middle * s.longest) / (2 * s.twice_area); }

// The smallest angle is between the two longer sides: its sine is twice the area over their
// product, its cosine the law of cosines'.
double min_angle_deg(const Sides& s) {
  constexpr double kDegrees = 180 / 3.141592653589793;
  const double twice_dot = s.middle + s.longest - s.shortest;
  return std::atan2(2 * s.twice_area, twice_dot) * kDegrees;
}

}  // namespace

double radius_edge(const Point<2>& a, const Point<2>& b, const Point<2>& c) {
  return radius_edge(sides_of(a, b, c));
}

double smallest_angle_deg(const Point<2>& a, const Point<2>& b, const Point<2>& c) {
  return min_angle_deg(sides_of(a, b, c));
}

Quality quality(const Mesh<2>& mesh) {
  Quality worst{std::numeric_limits<double>::infinity(), -1};
  for (const auto& t : mesh.simplices) {
    const Sides s = sides_of(mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]);
    worst.min_angle_deg = std::min(worst.min_angle_deg, min_angle_deg(s));
    worst.max_radius_edge = std::max(worst.max_radius_edge, radius_edge(s));
  }
  if (worst.max_radius_edge >= 0) return worst;
  return {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN()};
}

}  // namespace mesher
