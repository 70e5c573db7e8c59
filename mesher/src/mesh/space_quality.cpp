// Angles and radius-edge ratios of tetrahedra.
#include "mesh/space_quality.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "geometry/circumcentre.hpp"
#include "geometry/space.hpp"
#include "io/text.hpp"
#include "mesher/space_check.hpp"

namespace mesher {
namespace {

using detail::cross;
using detail::dot;
using detail::minus;
using Corners = std::array<Point<3>, 4>;

double shortest_edge(const Corners& p) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = i + 1; j < 4; ++j) {
      least = std::min(least, detail::squared_distance(p[i], p[j]));
    }
  }
  return std::sqrt(least);
}

// The angle at the edge pq between the faces pqr and pqs. Their normals' cross product is the edge
// times the determinant.
double dihedral_deg(const Point<3>& p, const Point<3>& q, const Point<3>& r, const Point<3>& s) {
  constexpr double kDegrees = 180 / 3.141592653589793;
  const Point<3> edge = minus(q, p), to_r = minus(r, p), to_s = minus(s, p);
  const double sine = std::sqrt(dot(edge, edge)) * std::abs(dot(edge, cross(to_r, to_s)));
  return std::atan2(sine, dot(cross(edge, to_r), cross(edge, to_s))) * kDegrees;
}

struct Range {
  double least = std::numeric_limits<double>::infinity();
  double most = -std::numeric_limits<double>::infinity();

  void add(double x) {
    least = std::min(least, x);
    most = std::max(most, x);
  }
};

Range dihedrals_deg(const Corners& p) {
  constexpr int kEdges[][4] = {{0, 1, 2, 3}, {0, 2, 1, 3}, {0, 3, 1, 2},
                               {1, 2, 0, 3}, {1, 3, 0, 2}, {2, 3, 0, 1}};
  Range angles;
  for (const auto& [a, b, c, d] : kEdges) angles.add(dihedral_deg(p[a], p[b], p[c], p[d]));
  return angles;
}

}  // namespace

detail::RadiusEdge detail::radius_edge(const Point<3>& a, const Point<3>& b, const Point<3>& c,
                                       const Point<3>& d) {
  const Circumcentre centre = circumcentre(a, b, c, d);
  const double edge = shortest_edge({a, b, c, d});
  return {std::sqrt(centre.length2) / edge, std::sqrt(centre.tolerance2) / 2 / edge};
}

std::size_t count_above(const Mesh<3>& mesh, double rho) {
  return static_cast<std::size_t>(std::count_if(
      mesh.simplices.begin(), mesh.simplices.end(),
      [&](const auto& s) { return detail::is_above(detail::radius_edge(mesh, s), rho); }));
}

SpaceQuality quality(const Mesh<3>& mesh) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  if (mesh.simplices.empty()) return {kNone, kNone, kNone, 0};
  Range angles, ratios;
  std::size_t slivers = 0;
  for (const auto& [a, b, c, d] : mesh.simplices) {
    const auto& v = mesh.vertices;
    const Range of_this = dihedrals_deg({v[a], v[b], v[c], v[d]});
    angles.add(of_this.least);
    angles.add(of_this.most);
    if (of_this.least < kSliverDegrees) ++slivers;
    ratios.add(detail::radius_edge(mesh, {a, b, c, d}).ratio);
  }
  return {angles.least, angles.most, ratios.most, slivers};
}

namespace detail {

Verdict check_volumes(const Mesh<3>& mesh, double most) {
  constexpr double kRounding = 1e-9;
  double largest = 0;
  for (std::size_t i = 0; i < mesh.simplices.size(); ++i) {
    const auto& [a, b, c, d] = mesh.simplices[i];
    const auto& v = mesh.vertices;
    const double volume =
        std::abs(dot(minus(v[b], v[a]), cross(minus(v[c], v[a]), minus(v[d], v[a])))) / 6;
    largest = std::max(largest, volume);
    if (volume <= most * (1 + kRounding)) continue;
    return Verdict::bad("tetrahedron " + std::to_string(i + 1) + " has the volume " + text::to_text(volume) + ", above " +
                        text::to_text(most));
  }
  return Verdict::good("volumes at most " + text::to_text(largest));
}

}  // namespace detail

}  // namespace mesher
