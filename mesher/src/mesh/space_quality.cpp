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

// An angle by its sine and cosine times something.
struct Angle {
  double sine, cosine;

  // Less for greater angles.
  [[nodiscard]] double cotangent() const {
    return sine == 0 && cosine == 0 ? std::numeric_limits<double>::infinity() : cosine / sine;
  }
  [[nodiscard]] double degrees() const {
    constexpr double kDegrees = 180 / 3.141592653589793;
    return std::atan2(sine, cosine) * kDegrees;
  }
};

// The least and the greatest of some.
class Angles {
 public:
  void add(const Angle& angle) {
    const double cotangent = angle.cotangent();
    if (!(cotangent <= highest_)) highest_ = cotangent, least_ = angle;
    if (!(cotangent >= lowest_)) lowest_ = cotangent, most_ = angle;
  }
  [[nodiscard]] const Angle& least() const { return least_; }
  [[nodiscard]] const Angle& most() const { return most_; }

 private:
  double highest_ = std::numeric_limits<double>::quiet_NaN(), lowest_ = highest_;  // cotangents
  Angle least_{}, most_{};
};

// Those between the faces. The cross product of two normals is the edge of both times the
// determinant.
Angles dihedrals(const Corners& p) {
  const Point<3> b = minus(p[1], p[0]), c = minus(p[2], p[0]), d = minus(p[3], p[0]);
  const Point<3> e = minus(p[2], p[1]), f = minus(p[3], p[1]), g = minus(p[3], p[2]);
  // Of the faces across from p[1], p[2], p[3], p[0], all outward, or all inward.
  const Point<3> at_b = cross(d, c), at_c = cross(b, d), at_d = cross(c, b), at_a = cross(e, f);
  const double determinant = std::abs(dot(b, cross(c, d)));
  Angles angles;
  const auto add = [&](const Point<3>& edge, const Point<3>& m, const Point<3>& n) {
    angles.add({std::sqrt(dot(edge, edge)) * determinant, -dot(m, n)});
  };
  add(b, at_c, at_d), add(c, at_b, at_d), add(d, at_b, at_c);
  add(e, at_a, at_d), add(f, at_a, at_c), add(g, at_a, at_b);
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
  constexpr double kNoSliver = 11;  // cotangents up to it are of more than 5 degrees
  static_assert(kSliverDegrees <= 5);
  if (mesh.simplices.empty()) return {kNone, kNone, kNone, 0};
  Angles angles;
  double worst = 0;
  std::size_t slivers = 0;
  for (const auto& [a, b, c, d] : mesh.simplices) {
    const auto& v = mesh.vertices;
    const Angles of_this = dihedrals({v[a], v[b], v[c], v[d]});
    angles.add(of_this.least());
    angles.add(of_this.most());
    const Angle& least = of_this.least();
    if (least.cotangent() > kNoSliver && least.degrees() < kSliverDegrees) ++slivers;
    worst = std::max(worst, detail::radius_edge(mesh, {a, b, c, d}).ratio);
  }
  return {angles.least().degrees(), angles.most().degrees(), worst, slivers};
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
    return Verdict::bad("tetrahedron " + std::to_string(i + 1) + " has the volume " +
                        text::to_text(volume) + ", above " + text::to_text(most));
  }
  return Verdict::good("volumes at most " + text::to_text(largest));
}

}  // namespace detail

}  // namespace mesher
