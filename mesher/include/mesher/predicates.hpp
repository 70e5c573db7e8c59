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
// Guarantees of every function here:
//  (1) The sign is that of the real (or symbolically perturbed) number, never of a rounding.
//  (2) Swapping two points flips the sign.
//  (3) Scaling all coordinates by a power of two, or moving them without rounding, keeps it.
//  (4) Nothing is allocated or shared: any thread may call, and equal calls give equal results.
//
// Requires (of every coordinate): 0, or of magnitude 2^-160 to 2^101. This is the range of inputs,
// 2^-100 to 2^100, with room for the vertices that a mesher puts between them. Points that spread
// over more bits than the exact evaluation holds (253; never points of one mesh) throw
// std::domain_error; other violations may go unnoticed.
//
// The idea: an inline floating-point filter decides all but near-degenerate calls by an a priori
// bound of its own error; the remaining calls are computed in integers just wide enough for the
// given points (src/geometry/exact_sign.hpp).
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
/// callers need not translate or scale coordinates first.
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
  const double det =
      (d_lift * abc.value - c_lift * dab.value) + (b_lift * cda.value - a_lift * bcd.value);
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
/// The rule depends only on the order of coordinates, so neither the order of the points, nor other
/// points, nor a translation changes a result. The Delaunay triangulation of any finite set not on
/// one line exists by it and is unique: the triangles abc with every other point outside are a
/// triangulation of the convex hull, each point a vertex.
///   Proof. Rank the points 1..m in lexicographic order; let h_t(p) = |p|^2 + t^(m - rank(p) + 1).
/// The determinant D(t) of the rows px, py, h_t(p), 1 of four points is a polynomial in t: D(0) is
/// the in-circle determinant, the other coefficients are the cofactors of the heights (orientations
/// of three of the points, signs alternating), the greatest point's at the lowest power of t. If
/// D(0) = 0 and not all four are on a line, they are on a circle, which meets a line at most twice:
/// no cofactor is 0, and the greatest point's decides for small t > 0. That is the sign returned.
///   There are finitely many quadruples, so one t is small enough for all of them, and also to keep
/// every point below the hull of the other lifted points, as it is strictly for t = 0. All results
/// are then those of one set of points in space, each on its lower hull, and no four coplanar
/// except in a vertical plane. So the facets of the lower hull are triangles and project to a
/// triangulation; a triangle is a facet just if all other points are above its plane, which is what
/// "outside" means. It refines the Delaunay subdivision, since a nonzero D(0) keeps its sign.
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
[[nodiscard]] inline int insphere_perturbed(const Point<3>& a, const Point<3>& b, const Point<3>& c,
                                            const Point<3>& d, const Point<3>& e) {
  const int sign = insphere(a, b, c, d, e);
  return sign != 0 ? sign : detail::cospherical_tie(a, b, c, d, e);
}

/// Tests that double arithmetic is IEEE, rounded to nearest, each operation by itself (no
/// contraction, reassociation or excess precision). Call it at start. Throws: std::logic_error that
/// names the deviation.
void self_test();

}  // namespace mesher::predicates

// Exact signs for shrunken balls of simplices: whether p is in B(c, k r), where c is the
// circumcentre of a segment, triangle or tetrahedron, in the plane or in space, r its circumradius,
// and k a factor. The circumball of a simplex of lower dimension is the smallest one with its
// corners on the sphere [Hudson, 2.2]. For simplices of full dimension and k = 1 these are incircle
// and insphere; [3.3] found no implementation of the others.
//
//   in_shrunken_ball(a, b, p, k)        of the segment ab
//   in_shrunken_ball(a, b, c, p, k)     of the triangle abc
//   in_shrunken_ball(a, b, c, d, p, k)  of the tetrahedron abcd, in space
//
// Returns: +1 if p is strictly inside, 0 if it is on the sphere, -1 if it is outside, for the real
// numbers, never for a rounding. The order of the corners has no influence.
//
// Requires: coordinates as above; points that spread over more than 253 bits throw
// std::domain_error; k is 0, or 2^-10 to 1; corners are not on a line (for a tetrahedron: not in a
// plane). Both ends of a segment may be one point: a ball without interior.
//
// Method: centres are quotients; multiplied by their denominators, the conditions are polynomials
// in differences of coordinates, of degree 2 for segments, 6 for triangles and 8 for tetrahedra:
//   segment      k^2 |b - a|^2 - |(a - p) + (b - p)|^2
// and with e = b - a, f = c - a, g = d - a, w = p - a
//   triangle     4 (w.Q - |n|^2 |w|^2) - (1 - k^2) |e|^2 |f|^2 |f - e|^2
//                for n = e x f, Q = |e|^2 (f x n) + |f|^2 (n x e), as the centre is
//                a + Q / (2 |n|^2) and r = |e| |f| |f - e| / (2 |n|)
//   tetrahedron  4 t (w.Q - t |w|^2) - (1 - k^2) |Q|^2
//                for t = e.(f x g), Q = |e|^2 (f x g) + |f|^2 (g x e) + |g|^2 (e x f), as the
//                centre is a + Q / (2 t).
// A filter decides all but near-degenerate calls; integers just wide enough decide the rest.
namespace mesher::predicates {

namespace detail {

/// Error bounds of the filters, in units of u = 2^-53; each is more than twice the error derived
/// here. A difference has 1u, a square of a vector 5u, 1 - k^2 = (1 - k)(1 + k) 3u, all relative.
/// Errors of sums that may cancel are relative to the sums of absolute values, which for a cross
/// product are, as a vector, at most sqrt(2) times the product of both lengths.
///   segment: 7u e^2 for the first term. An entry of u + v, u = a - p, v = b - p, has 2u of |u| +
///     |v|, the square 7u of (|u| + |v|)^2. As this and e^2 are at most 2 (u^2 + v^2), both terms
///     have 28u, their difference 4u more: 32u (u^2 + v^2).
///   triangle: with n 4u, Q has 14u of 2 e^2 f^2 (|e| + |f|), so 4 w.Q 144u e^2 f^2 |w| (|e| +
///     |f|); 4 n^2 w^2 has 136u e^2 f^2 w^2, the last term 21u e^2 f^2 (f - e)^2; differences add
///     16u, 16u and 2u of these. With |w| (|e| + |f|) <= w^2 + (e^2 + f^2) / 2 and (f - e)^2 <=
///     2 (e^2 + f^2) all is at most 312u e^2 f^2 (e^2 + f^2 + w^2).
///   tetrahedron: t has 8u of sqrt(2) P, P = |e||f||g|, Q 12u of sqrt(2) P L, L = |e| + |f| + |g|,
///     so w.Q - t w^2 has sqrt(2) P |w| (17u L + 15u |w|), 4 t times that P^2 |w| (208u L + 192u
///     |w|); the last term 62u P^2 L^2; the difference 8u, 8u and 2u more. With 2 |w| L <= w^2 +
///     L^2 and L^2 <= 3 (e^2 + f^2 + g^2): 516u P^2 (e^2 + f^2 + g^2 + w^2).
inline constexpr double kSegmentBallBound = 72 * kUnitRoundoff;
inline constexpr double kTriangleBallBound = 640 * kUnitRoundoff;
inline constexpr double kTetrahedronBallBound = 1152 * kUnitRoundoff;
/// Products of up to five differences are multiples of 2^-1060, so not rounded where they are not
/// normal. Those of six or eight are products of two such, times at most 1 - k^2 or 4: their
/// rounding errors, 2^-1075 each, and that of the bound, are below this.
inline constexpr double kBallUnderflow = 0x1p-1060;

/// The sign of `value` if it is beyond the bound, else 0.
[[nodiscard]] inline int sign_beyond(double value, double bound) noexcept {
  return std::abs(value) > bound ? sign(value) : 0;
}

/// a - b.
template <std::size_t D>
[[nodiscard]] inline std::array<double, D> difference(const std::array<double, D>& a,
                                                      const std::array<double, D>& b) noexcept {
  std::array<double, D> d;
  for (std::size_t i = 0; i < D; ++i) d[i] = a[i] - b[i];
  return d;
}
template <std::size_t D>
[[nodiscard]] inline double product(const std::array<double, D>& a,
                                    const std::array<double, D>& b) noexcept {
  double sum = a[0] * b[0] + a[1] * b[1];
  if constexpr (D == 3) sum += a[2] * b[2];
  return sum;
}
[[nodiscard]] inline Point<3> cross_product(const Point<3>& a, const Point<3>& b) noexcept {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

template <int D>
[[nodiscard]] int in_shrunken_ball_filter(const Point<D>& a, const Point<D>& b, const Point<D>& p,
                                          double k) noexcept {
  const Point<D> e = difference(b, a), u = difference(a, p), v = difference(b, p);
  Point<D> sum;
  for (std::size_t i = 0; i < D; ++i) sum[i] = u[i] + v[i];
  const double value = k * k * product(e, e) - product(sum, sum);
  return sign_beyond(value, kSegmentBallBound * (product(u, u) + product(v, v)));
}

/// For triangles; in the plane computed as in space.
[[nodiscard]] inline int in_shrunken_ball_filter(const Point<3>& a, const Point<3>& b,
                                                 const Point<3>& c, const Point<3>& p,
                                                 double k) noexcept {
  const Point<3> e = difference(b, a), f = difference(c, a), w = difference(p, a);
  const Point<3> g = difference(c, b), n = cross_product(e, f);
  const Point<3> fn = cross_product(f, n), ne = cross_product(n, e);
  const double e2 = product(e, e), f2 = product(f, f), w2 = product(w, w);
  Point<3> q;
  for (std::size_t i = 0; i < 3; ++i) q[i] = e2 * fn[i] + f2 * ne[i];
  const double value =
      4 * (product(w, q) - product(n, n) * w2) - (1 - k) * (1 + k) * (e2 * f2 * product(g, g));
  return sign_beyond(value, kTriangleBallBound * (e2 * f2) * (e2 + f2 + w2) + kBallUnderflow);
}
[[nodiscard]] inline int in_shrunken_ball_filter(const Point<2>& a, const Point<2>& b,
                                                 const Point<2>& c, const Point<2>& p,
                                                 double k) noexcept {
  const auto in_space = [](const Point<2>& x) { return Point<3>{x[0], x[1], 0}; };
  return in_shrunken_ball_filter(in_space(a), in_space(b), in_space(c), in_space(p), k);
}

[[nodiscard]] inline int in_shrunken_ball_filter(const Point<3>& a, const Point<3>& b,
                                                 const Point<3>& c, const Point<3>& d,
                                                 const Point<3>& p, double k) noexcept {
  const Point<3> e = difference(b, a), f = difference(c, a), g = difference(d, a);
  const Point<3> w = difference(p, a);
  const Point<3> fg = cross_product(f, g), ge = cross_product(g, e), ef = cross_product(e, f);
  const double e2 = product(e, e), f2 = product(f, f), g2 = product(g, g), w2 = product(w, w);
  Point<3> q;
  for (std::size_t i = 0; i < 3; ++i) q[i] = e2 * fg[i] + f2 * ge[i] + g2 * ef[i];
  const double t = product(e, fg);
  const double value = 4 * t * (product(w, q) - t * w2) - (1 - k) * (1 + k) * product(q, q);
  return sign_beyond(value,
                     kTetrahedronBallBound * (e2 * f2 * g2) * (e2 + f2 + g2 + w2) + kBallUnderflow);
}

/// The predicates without a filter.
template <int D>
[[nodiscard]] int in_shrunken_ball_exact(const Point<D>& a, const Point<D>& b, const Point<D>& p,
                                         double k);
template <int D>
[[nodiscard]] int in_shrunken_ball_exact(const Point<D>& a, const Point<D>& b, const Point<D>& c,
                                         const Point<D>& p, double k);
[[nodiscard]] int in_shrunken_ball_exact(const Point<3>& a, const Point<3>& b, const Point<3>& c,
                                         const Point<3>& d, const Point<3>& p, double k);

}  // namespace detail

/// The sign for the ball of the segment ab. D is 2 or 3.
template <std::size_t D>
[[nodiscard]] int in_shrunken_ball(const std::array<double, D>& a, const std::array<double, D>& b,
                                   const std::array<double, D>& p, double k) {
  const int sign = detail::in_shrunken_ball_filter<D>(a, b, p, k);
  return sign != 0 ? sign : detail::in_shrunken_ball_exact<D>(a, b, p, k);
}

/// The sign for the ball of the triangle abc. D is 2 or 3.
template <std::size_t D>
[[nodiscard]] int in_shrunken_ball(const std::array<double, D>& a, const std::array<double, D>& b,
                                   const std::array<double, D>& c, const std::array<double, D>& p,
                                   double k) {
  const int sign = detail::in_shrunken_ball_filter(a, b, c, p, k);
  return sign != 0 ? sign : detail::in_shrunken_ball_exact<D>(a, b, c, p, k);
}

/// The sign for the ball of the tetrahedron abcd.
[[nodiscard]] inline int in_shrunken_ball(const Point<3>& a, const Point<3>& b, const Point<3>& c,
                                          const Point<3>& d, const Point<3>& p, double k) {
  const int sign = detail::in_shrunken_ball_filter(a, b, c, d, p, k);
  return sign != 0 ? sign : detail::in_shrunken_ball_exact(a, b, c, d, p, k);
}

}  // namespace mesher::predicates
