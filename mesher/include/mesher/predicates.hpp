// Exact signs of the determinants of Delaunay triangulation in the plane and in space: orientation,
// in-circle and in-sphere.
//
//   orient2d(a,b,c)      sign of | ax-cx  ay-cy |
//                                | bx-cx  by-cy |
//   incircle(a,b,c,d)    sign of the determinant of rows  px-dx  py-dy  (px-dx)^2+(py-dy)^2,
//                        p = a, b, c
//   orient3d(a,b,c,d)    minus the sign of that of rows  px-dx  py-dy  pz-dz,  p = a, b, c
//   insphere(a,b,c,d,e)  minus the sign of that of rows  px-ex  py-ey  pz-ez  and their squares'
//                        sum, p = a, b, c, d
//
// What holds of every function here:
//  (1) The sign is that of the real (or symbolically perturbed) number, never of a rounding.
//  (2) Swapping two points flips the sign.
//  (3) Scaling all coordinates by a power of two, or moving them without rounding, keeps it.
//  (4) Nothing is allocated or shared: any thread may call, and equal calls give equal results.
//
// Requires (of every coordinate): 0, or of magnitude 2^-160 to 2^101: the range of inputs, 2^-100
// to 2^100, with room for the vertices that a mesher puts between them. Points that spread over
// more bits than the exact evaluation holds (253; never points of one mesh) throw
// std::domain_error; other breaches may go unnoticed.
//
// The idea: a floating-point filter, inline, decides all but near-degenerate calls by an a priori
// bound of its own error; what is left is computed in integers just wide enough for the points at
// hand (src/geometry/exact_sign.hpp).
#pragma once

#include <cfloat>
#include <cmath>
#include <limits>

#include "mesher/mesh.hpp"

#ifdef __FAST_MATH__
#error "mesher needs IEEE arithmetic: build without -ffast-math"
#endif

namespace mesher::predicates {

static_assert(std::numeric_limits<double>::is_iec559 && std::numeric_limits<double>::digits == 53);
static_assert(FLT_EVAL_METHOD == 0, "intermediate results must be doubles");

namespace detail {

/// u: a rounded operation is the exact one times 1+e with |e| <= u. Under the range above nothing
/// underflows or overflows: a coordinate is an integer multiple of 2^-212 (52 bits below 2^-160) of
/// magnitude <= 2^101. Multiples stay multiples under rounding, so a nonzero difference is between
/// 2^-212 and 2^102, and a product of four between 2^-848 and 2^408; sums of those stay under
/// 2^412, their error bounds above 2^-900: all normal. Only insphere has products of five, its last
/// ones, which may be as small as 2^-1060: see kUnderflow. So the filters work at every scale, and
/// nobody need move or scale coordinates first.
inline constexpr double kUnitRoundoff = 0x1p-53;

/// Both filters compute X, a sum of n monomials, as det = fl(X~), where X~ is exact but for the
/// last rounding, and S~, the same sum of absolute values. Let k count the factors 1+e on a
/// monomial of X~, and m those on one of S~. Then
///     |X~ - X| <= ((1+u)^k - 1) S,   S <= S~ (1-u)^-m,   |X~| >= |det| (1-u),
/// and the product fl(c S~) is at least c S~ (1-u). So |det| > fl(c S~) proves sign det = sign X if
///     c >= ((1+u)^k - 1) (1-u)^-(m+2)  =  k u + (k(k-1)/2 + k(m+2)) u^2 + O(u^3).
/// Orientation: differences 2, product 1: k = 3; one more addition in S~: m = 4: 3u + 21 u^2 + ...
inline constexpr double kOrientBound = (3.0 + 32.0 * kUnitRoundoff) * kUnitRoundoff;
/// In-circle: minor 4 (two differences, product, subtraction), lift 4 (two differences, product,
/// sum), their product 1, first sum 1: k = 10, m = 11: 10u + 175 u^2 + ...
inline constexpr double kIncircleBound = (10.0 + 256.0 * kUnitRoundoff) * kUnitRoundoff;

/// In space, orientation: minor 4 (two differences, product, subtraction), a difference and a
/// product 2, first sum 1: k = 7, m = 8: 7u + 91 u^2 + ...
inline constexpr double kOrient3dBound = (7.0 + 128.0 * kUnitRoundoff) * kUnitRoundoff;
/// In-sphere: minor of three rows 8, lift 5 (two differences, product, two sums), their product 1,
/// first sum 1: k = 15, m = 16: 15u + 375 u^2 + ...; one factor more for the sum with kUnderflow.
inline constexpr double kInsphereBound = (15.0 + 512.0 * kUnitRoundoff) * kUnitRoundoff;
/// Products of five are exact where they are not normal: multiples of 2^-1060, as all their factors
/// are multiples. But fl(c S~) may then be less than c S~, by half of the least double at most.
inline constexpr double kUnderflow = 0x1p-1074;

[[nodiscard]] constexpr int sign(double x) noexcept { return (x > 0) - (x < 0); }

/// The sign of orient2d if rounding cannot have changed it, else 0.
[[nodiscard]] inline int orient2d_filter(const Point<2>& a, const Point<2>& b,
                                         const Point<2>& c) noexcept {
  const double left = (a[0] - c[0]) * (b[1] - c[1]);
  const double right = (a[1] - c[1]) * (b[0] - c[0]);
  const double det = left - right;
  const double size = std::abs(left) + std::abs(right);
  return std::abs(det) > kOrientBound * size ? sign(det) : 0;
}

/// The sign of incircle if rounding cannot have changed it, else 0.
[[nodiscard]] inline int incircle_filter(const Point<2>& a, const Point<2>& b, const Point<2>& c,
                                         const Point<2>& d) noexcept {
  const double ax = a[0] - d[0], ay = a[1] - d[1];
  const double bx = b[0] - d[0], by = b[1] - d[1];
  const double cx = c[0] - d[0], cy = c[1] - d[1];
  const double bc = bx * cy, cb = cx * by, a_lift = ax * ax + ay * ay;
  const double ca = cx * ay, ac = ax * cy, b_lift = bx * bx + by * by;
  const double ab = ax * by, ba = bx * ay, c_lift = cx * cx + cy * cy;
  const double det = (a_lift * (bc - cb) + b_lift * (ca - ac)) + c_lift * (ab - ba);
  const double size =
      (a_lift * (std::abs(bc) + std::abs(cb)) + b_lift * (std::abs(ca) + std::abs(ac))) +
      c_lift * (std::abs(ab) + std::abs(ba));
  return std::abs(det) > kIncircleBound * size ? sign(det) : 0;
}

/// The sign of orient3d if rounding cannot have changed it, else 0.
[[nodiscard]] inline int orient3d_filter(const Point<3>& a, const Point<3>& b, const Point<3>& c,
                                         const Point<3>& d) noexcept {
  const double ax = a[0] - d[0], ay = a[1] - d[1], az = a[2] - d[2];
  const double bx = b[0] - d[0], by = b[1] - d[1], bz = b[2] - d[2];
  const double cx = c[0] - d[0], cy = c[1] - d[1], cz = c[2] - d[2];
  const double bc = bx * cy, cb = cx * by, ca = cx * ay, ac = ax * cy, ab = ax * by, ba = bx * ay;
  const double det = (az * (bc - cb) + bz * (ca - ac)) + cz * (ab - ba);
  const double size = (std::abs(az) * (std::abs(bc) + std::abs(cb)) +
                       std::abs(bz) * (std::abs(ca) + std::abs(ac))) +
                      std::abs(cz) * (std::abs(ab) + std::abs(ba));
  return std::abs(det) > kOrient3dBound * size ? -sign(det) : 0;
}

/// A number with the sum of the absolute values of its monomials.
struct Sized {
  double value, size;
};
[[nodiscard]] inline Sized minor2(double ax, double ay, double bx, double by) noexcept {
  const double left = ax * by, right = bx * ay;
  return {left - right, std::abs(left) + std::abs(right)};
}
/// The determinant of three rows, from their last entries and the minors of the other two rows.
[[nodiscard]] inline Sized minor3(double az, Sized bc, double bz, Sized ca, double cz,
                                  Sized ab) noexcept {
  return {(az * bc.value + bz * ca.value) + cz * ab.value,
          (std::abs(az) * bc.size + std::abs(bz) * ca.size) + std::abs(cz) * ab.size};
}

/// The sign of insphere if rounding cannot have changed it, else 0.
[[nodiscard]] inline int insphere_filter(const Point<3>& a, const Point<3>& b, const Point<3>& c,
                                         const Point<3>& d, const Point<3>& e) noexcept {
  const double ax = a[0] - e[0], ay = a[1] - e[1], az = a[2] - e[2];
  const double bx = b[0] - e[0], by = b[1] - e[1], bz = b[2] - e[2];
  const double cx = c[0] - e[0], cy = c[1] - e[1], cz = c[2] - e[2];
  const double dx = d[0] - e[0], dy = d[1] - e[1], dz = d[2] - e[2];
  const Sized ab = minor2(ax, ay, bx, by), bc = minor2(bx, by, cx, cy), cd = minor2(cx, cy, dx, dy);
  const Sized da = minor2(dx, dy, ax, ay), ac = minor2(ax, ay, cx, cy), bd = minor2(bx, by, dx, dy);
  const Sized ca{-ac.value, ac.size}, db{-bd.value, bd.size};
  const Sized bcd = minor3(bz, cd, cz, db, dz, bc), cda = minor3(cz, da, dz, ac, az, cd);
  const Sized dab = minor3(dz, ab, az, bd, bz, da), abc = minor3(az, bc, bz, ca, cz, ab);
  const double a_lift = (ax * ax + ay * ay) + az * az, b_lift = (bx * bx + by * by) + bz * bz;
  const double c_lift = (cx * cx + cy * cy) + cz * cz, d_lift = (dx * dx + dy * dy) + dz * dz;
  const double det = (d_lift * abc.value - c_lift * dab.value) +
                     (b_lift * cda.value - a_lift * bcd.value);
  const double size =
      (d_lift * abc.size + c_lift * dab.size) + (b_lift * cda.size + a_lift * bcd.size);
  return std::abs(det) > kInsphereBound * size + kUnderflow ? -sign(det) : 0;
}

/// The predicates without a filter.
[[nodiscard]] int orient2d_exact(const Point<2>& a, const Point<2>& b, const Point<2>& c);
[[nodiscard]] int incircle_exact(const Point<2>& a, const Point<2>& b, const Point<2>& c,
                                 const Point<2>& d);

[[nodiscard]] int orient3d_exact(const Point<3>& a, const Point<3>& b, const Point<3>& c,
                                 const Point<3>& d);
[[nodiscard]] int insphere_exact(const Point<3>& a, const Point<3>& b, const Point<3>& c,
                                 const Point<3>& d, const Point<3>& e);

/// insphere_perturbed of five distinct points on one sphere and not all in one plane.
[[nodiscard]] int cospherical_tie(const Point<3>& a, const Point<3>& b, const Point<3>& c,
                                  const Point<3>& d, const Point<3>& e);

/// incircle_perturbed of four distinct points on one circle.
[[nodiscard]] int cocircular_tie(const Point<2>& a, const Point<2>& b, const Point<2>& c,
                                 const Point<2>& d);

}  // namespace detail

/// Sign of the area of abc: +1 counterclockwise, -1 clockwise, 0 on a line.
/// Cost: about 2 ns; nearly on a line some 20 ns, at most 0.3 us.
[[nodiscard]] inline int orient2d(const Point<2>& a, const Point<2>& b, const Point<2>& c) {
  const int sign = detail::orient2d_filter(a, b, c);
  return sign != 0 ? sign : detail::orient2d_exact(a, b, c);
}

/// For counterclockwise abc: +1 if d is strictly inside their circle, -1 if strictly outside, 0 if
/// on it. The opposite for clockwise abc.
/// Cost: about 5 ns; nearly on a circle some 60 ns, at most 1 us.
[[nodiscard]] inline int incircle(const Point<2>& a, const Point<2>& b, const Point<2>& c,
                                  const Point<2>& d) {
  const int sign = detail::incircle_filter(a, b, c, d);
  return sign != 0 ? sign : detail::incircle_exact(a, b, c, d);
}

/// incircle, never 0: four points on one circle are decided as if every point p were lifted not to
/// |p|^2 but infinitesimally higher, to |p|^2 + eps(p), where eps(p) exceeds every multiple of
/// eps(q) if p is lexicographically greater than q. In short: the greatest of the four is outside
/// the circle of the others.
///
/// The rule sees only the order of coordinates, so neither the order in which points come, nor
/// other points, nor a translation changes an answer. The Delaunay triangulation of any finite set
/// not on one line exists by it and is unique: the triangles abc with every other point outside are
/// a triangulation of the convex hull, each point a vertex.
///   Proof. Rank the points 1..m in lexicographic order; let h_t(p) = |p|^2 + t^(m - rank(p) + 1).
/// The determinant D(t) of the rows px, py, h_t(p), 1 of four points is a polynomial in t: D(0) is
/// the in-circle determinant, the other coefficients are the cofactors of the heights (orientations
/// of three of the points, signs alternating), the greatest point's at the lowest power of t. If
/// D(0) = 0 and not all four are on a line, they are on a circle, which meets a line at most twice:
/// no cofactor is 0, and the greatest point's decides for small t > 0. That is the sign returned.
///   There are finitely many quadruples, so one t is small enough for all of them, and also to keep
/// every point below the hull of the other lifted points, as it is strictly for t = 0. All answers
/// are then those of one set of points in space, each on its lower hull, and no four coplanar but
/// in a vertical plane. So the facets of the lower hull are triangles and project to a
/// triangulation; a triangle is a facet just if all other points are above its plane, which is what
/// "outside" says. It refines the Delaunay subdivision, since a nonzero D(0) keeps its sign.
///   Requires: a, b, c, d distinct and not all on one line (so for abc not on a line and d another
///   point, in any order of the four).
[[nodiscard]] inline int incircle_perturbed(const Point<2>& a, const Point<2>& b, const Point<2>& c,
                                            const Point<2>& d) {
  const int sign = incircle(a, b, c, d);
  return sign != 0 ? sign : detail::cocircular_tie(a, b, c, d);
}

/// Sign of the volume of abcd: +1 if abc is counterclockwise seen from d, -1 if clockwise, 0 in a
/// plane. Cost: about 5 ns; nearly in a plane some 60 ns, at most 1 us.
[[nodiscard]] inline int orient3d(const Point<3>& a, const Point<3>& b, const Point<3>& c,
                                  const Point<3>& d) {
  const int sign = detail::orient3d_filter(a, b, c, d);
  return sign != 0 ? sign : detail::orient3d_exact(a, b, c, d);
}

/// For positively oriented abcd: +1 if e is strictly inside their sphere, -1 if strictly outside, 0
/// if on it. The opposite for negatively oriented abcd.
/// Cost: about 13 ns; nearly on a sphere some 0.4 us, at most 5 us.
[[nodiscard]] inline int insphere(const Point<3>& a, const Point<3>& b, const Point<3>& c,
                                  const Point<3>& d, const Point<3>& e) {
  const int sign = detail::insphere_filter(a, b, c, d, e);
  return sign != 0 ? sign : detail::insphere_exact(a, b, c, d, e);
}

/// insphere, never 0: incircle_perturbed one dimension up, with the same properties and the same
/// proof but for one step. Of five points on one sphere four may lie in one plane, and the cofactor
/// of the fifth is then 0. If the fifth is the greatest, the next one's cofactor decides: it is not
/// 0, since three of the four are on a circle and so not on a line, and the fifth is not in their
/// plane.
///   Requires: the five points distinct and not all in one plane.
[[nodiscard]] inline int insphere_perturbed(const Point<3>& a, const Point<3>& b,
                                            const Point<3>& c, const Point<3>& d,
                                            const Point<3>& e) {
  const int sign = insphere(a, b, c, d, e);
  return sign != 0 ? sign : detail::cospherical_tie(a, b, c, d, e);
}

/// Refuses a build or a machine state whose double arithmetic is not IEEE, rounded to nearest, each
/// operation by itself (no contraction, reassociation or excess precision). Call it at start.
/// Throws: std::logic_error, saying what was found.
void self_test();

}  // namespace mesher::predicates
