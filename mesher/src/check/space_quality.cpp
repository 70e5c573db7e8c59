// Angles and radius-edge ratios of tetrahedra.
#include "check/space_quality.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "geometry/circumcentre.hpp"
#include "geometry/space_vectors.hpp"
#include "geometry/wide_lanes.hpp"
#include "mesher/check.hpp"
#include "text/text.hpp"

namespace mesher {
namespace {

using detail::cross;
using detail::dot;
using detail::minus;
using CornerPlaces = std::array<Point<3>, 4>;

double shortest_edge(const CornerPlaces& p) {
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
  /// An angle with a cotangent between -x and x is neither the new least nor the new greatest. 0 if
  /// there is no such x.
  [[nodiscard]] double unremarkable() const {
    const double x = std::min(highest_, -lowest_);
    return x > 0 ? x : 0;
  }

 private:
  double highest_ = std::numeric_limits<double>::quiet_NaN(), lowest_ = highest_;  // cotangents
  Angle least_{}, most_{};
};

// Those between the faces. The cross product of two normals is the edge of both times the
// determinant.
Angles dihedrals(const CornerPlaces& p) {
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

// What is looked at first: whether all dihedral angles have cotangents between -cotangent and
// cotangent, and whether the circumradius is below `ratio` times the shortest edge.
struct Limits {
  double cotangent, ratio;  // ratio: at least 1/2
};

// Tetrahedra whose lanes go through one loop: the compiler takes several at a time.
constexpr std::size_t kLanes = 4;
struct Lanes {
  std::array<std::array<std::array<double, kLanes>, 3>, 4> corner;
  std::array<double, kLanes> angles, radius;  // positive: surely within the limit

  void set(std::size_t l, const Mesh<3>& mesh, const Mesh<3>::Simplex& s) {
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t axis = 0; axis < 3; ++axis) corner[i][axis][l] = mesh.vertices[s[i]][axis];
    }
  }
};

[[gnu::always_inline]] inline double lesser(double a, double b) noexcept { return a < b ? a : b; }

// The same as dihedrals() and radius_edge(), as far as limits need it: in squares. What is near one
// is not within: of angles by 2^-40. Nor is for radii what is nearly flat or long: the determinant
// has an error of 2^-49 |b||c||d|, here 2^-29 of it at most, and the centre, not yet divided by it,
// one of 2^-47 |b||c||d| times the longest of these edges, 2^-23 of what it is compared with,
// rounded up to 2^-20 (circumcentre.cpp).
MESHER_WIDE_LANES void look(Lanes& all, const Limits& limits) {
  constexpr double kNearAngle = 1 - 0x1p-40, kNearRadius = 1 - 0x1p-20, kNormal = 0x1p-960;
  constexpr double kFlat = 0x1p-40, kLong = 0x1p8;
  const double cotangent2 = limits.cotangent * limits.cotangent * kNearAngle;
  const double ratio2 = 4 * limits.ratio * limits.ratio * kNearRadius;
  const auto dot = [](double ax, double ay, double az, double bx, double by, double bz) {
    return ax * bx + ay * by + az * bz;
  };
  const auto& p = all.corner;
  for (std::size_t l = 0; l < kLanes; ++l) {
    const double bx = p[1][0][l] - p[0][0][l], by = p[1][1][l] - p[0][1][l];
    const double bz = p[1][2][l] - p[0][2][l], cx = p[2][0][l] - p[0][0][l];
    const double cy = p[2][1][l] - p[0][1][l], cz = p[2][2][l] - p[0][2][l];
    const double dx = p[3][0][l] - p[0][0][l], dy = p[3][1][l] - p[0][1][l];
    const double dz = p[3][2][l] - p[0][2][l], ex = cx - bx, ey = cy - by, ez = cz - bz;
    const double fx = dx - bx, fy = dy - by, fz = dz - bz, gx = dx - cx, gy = dy - cy, gz = dz - cz;
    const double b2 = dot(bx, by, bz, bx, by, bz), c2 = dot(cx, cy, cz, cx, cy, cz);
    const double d2 = dot(dx, dy, dz, dx, dy, dz), e2 = dot(ex, ey, ez, ex, ey, ez);
    const double f2 = dot(fx, fy, fz, fx, fy, fz), g2 = dot(gx, gy, gz, gx, gy, gz);
    // Normals, named by the corner across.
    const double nbx = dy * cz - dz * cy, nby = dz * cx - dx * cz, nbz = dx * cy - dy * cx;
    const double ncx = by * dz - bz * dy, ncy = bz * dx - bx * dz, ncz = bx * dy - by * dx;
    const double ndx = cy * bz - cz * by, ndy = cz * bx - cx * bz, ndz = cx * by - cy * bx;
    const double nax = ey * fz - ez * fy, nay = ez * fx - ex * fz, naz = ex * fy - ey * fx;
    const double determinant = dot(bx, by, bz, nbx, nby, nbz);
    const double determinant2 = determinant * determinant;
    const double shortest2 = lesser(lesser(lesser(b2, c2), lesser(d2, e2)), lesser(f2, g2));
    const double sine2 = cotangent2 * determinant2;
    const auto room = [&](double cosine, double edge2) { return sine2 * edge2 - cosine * cosine; };
    const double at_b = room(dot(ncx, ncy, ncz, ndx, ndy, ndz), b2);
    const double at_c = room(dot(nbx, nby, nbz, ndx, ndy, ndz), c2);
    const double at_d = room(dot(nbx, nby, nbz, ncx, ncy, ncz), d2);
    const double at_e = room(dot(nax, nay, naz, ndx, ndy, ndz), e2);
    const double at_f = room(dot(nax, nay, naz, ncx, ncy, ncz), f2);
    const double at_g = room(dot(nax, nay, naz, nbx, nby, nbz), g2);
    all.angles[l] = lesser(lesser(lesser(at_b, at_c), lesser(at_d, at_e)),
                           lesser(lesser(at_f, at_g), sine2 * shortest2 - kNormal));
    const double x = b2 * nbx + c2 * ncx + d2 * ndx, y = b2 * nby + c2 * ncy + d2 * ndy;
    const double z = b2 * nbz + c2 * ncz + d2 * ndz;
    const double limit = ratio2 * determinant2 * shortest2;
    const double longest2 = -lesser(lesser(-b2, -c2), -d2);
    all.radius[l] =
        lesser(lesser(determinant2 - kFlat * b2 * c2 * d2, kLong * shortest2 - longest2),
               lesser(limit - dot(x, y, z, x, y, z), limit - kNormal));
  }
}

// Calls visit(tetrahedron, within, below) for those that are not surely within both limits, by
// angles and by radius; these are limits() as it was a few tetrahedra before.
template <class LimitsNow, class Visit>
void for_each_but(const Mesh<3>& mesh, LimitsNow&& limits, Visit&& visit) {
  Lanes lanes{};
  const auto& all = mesh.simplices;
  for (std::size_t from = 0; from < all.size(); from += kLanes) {
    const std::size_t used = std::min(kLanes, all.size() - from);
    for (std::size_t l = 0; l < used; ++l) lanes.set(l, mesh, all[from + l]);
    look(lanes, limits());
    for (std::size_t l = 0; l < used; ++l) {
      const bool within = lanes.angles[l] > 0, below = lanes.radius[l] > 0;
      if (!within || !below) visit(all[from + l], within, below);
    }
  }
}

}  // namespace

detail::RadiusEdge detail::radius_edge(const Point<3>& a, const Point<3>& b, const Point<3>& c,
                                       const Point<3>& d) {
  const Circumcentre centre = circumcentre(a, b, c, d);
  const double edge = shortest_edge({a, b, c, d});
  return {std::sqrt(centre.length2) / edge, std::sqrt(centre.tolerance2) / 2 / edge};
}

std::size_t count_above(const Mesh<3>& mesh, double rho) {
  std::size_t count = 0;
  for_each_but(
      mesh,
      [&] {
        return Limits{std::numeric_limits<double>::infinity(), rho};
      },
      [&](const auto& s, bool, bool is_below) {
        if (!is_below && detail::is_above(detail::radius_edge(mesh, s), rho)) ++count;
      });
  return count;
}

// Few tetrahedra are worse than those before them, or slivers: only these cost roots and quotients.
SpaceQuality quality(const Mesh<3>& mesh) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  constexpr double kNoSliver = 11;  // cotangents up to it are of more than 5 degrees
  static_assert(kSliverDegrees <= 5);
  if (mesh.simplices.empty()) return {kNone, kNone, kNone, 0};
  Angles angles;
  double worst = 0;
  std::size_t slivers = 0;
  for_each_but(
      mesh,
      [&] {
        return Limits{std::min(angles.unremarkable(), kNoSliver), worst};
      },
      [&](const auto& s, bool within, bool is_below) {
        if (!within) {
          const auto& v = mesh.vertices;
          const Angles all = dihedrals({v[s[0]], v[s[1]], v[s[2]], v[s[3]]});
          angles.add(all.least());
          angles.add(all.most());
          const Angle& least = all.least();
          if (least.cotangent() > kNoSliver && least.degrees() < kSliverDegrees) ++slivers;
        }
        if (!is_below) worst = std::max(worst, detail::radius_edge(mesh, s).ratio);
      });
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
