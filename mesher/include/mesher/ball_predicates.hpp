// Exact signs for shrunken balls of simplices: whether p is in B(c, k r), where c is the
// circumcentre of a segment, triangle or tetrahedron, in the plane or in space, r its circumradius,
// and k a factor. The circumball of a simplex of lower dimension is the smallest one with its
// corners on the sphere [Hudson, 2.2]. Of full dimension and k = 1 these are incircle and insphere;
// the others are those that [3.3] finds nowhere.
//
//   in_shrunken_ball(a, b, p, k)        of the segment ab
//   in_shrunken_ball(a, b, c, p, k)     of the triangle abc
//   in_shrunken_ball(a, b, c, d, p, k)  of the tetrahedron abcd, in space
//
// Returns: +1 if p is strictly inside, 0 if it is on the sphere, -1 if it is outside: of the real
// numbers, never of a rounding. In whatever order corners come.
//
// Requires: coordinates as in predicates.hpp, and likewise points that spread over 253 bits at the
// most, or std::domain_error is thrown; k is 0, or 2^-10 to 1; corners are not on a line (of a
// tetrahedron: in a plane). Both ends of a segment may be one point: a ball without inside.
//
// How. Centres are quotients; multiplied by their denominators the conditions are polynomials in
// differences of coordinates, of degree 2 for segments, 6 for triangles and 8 for tetrahedra:
//   segment      k^2 |b - a|^2 - |(a - p) + (b - p)|^2
// and with e = b - a, f = c - a, g = d - a, w = p - a
//   triangle     4 (w.Q - |n|^2 |w|^2) - (1 - k^2) |e|^2 |f|^2 |f - e|^2
//                for n = e x f, Q = |e|^2 (f x n) + |f|^2 (n x e), as the centre is
//                a + Q / (2 |n|^2) and r = |e| |f| |f - e| / (2 |n|)
//   tetrahedron  4 t (w.Q - t |w|^2) - (1 - k^2) |Q|^2
//                for t = e.(f x g), Q = |e|^2 (f x g) + |f|^2 (g x e) + |g|^2 (e x f), as the
//                centre is a + Q / (2 t).
// A filter decides all but near-degenerate calls, the rest integers just wide enough.
#pragma once

#include "mesher/predicates.hpp"

namespace mesher::predicates {

namespace detail {

/// Bounds of the filters' errors, in units of u = 2^-53; each is more than twice what follows. A
/// difference has 1u, a square of a vector 5u, 1 - k^2 = (1 - k)(1 + k) 3u, all relative. Of sums
/// that may cancel, errors are counted in the sums of absolute values, which for a cross product
/// are, as a vector, at most sqrt(2) times the product of both lengths.
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
/// normal. Those of six or eight are products of two such, times 1 - k^2 or 4 at the most: what
/// they lose, 2^-1075 each, and what the bound loses, is below this.
inline constexpr double kBallUnderflow = 0x1p-1060;

/// The sign of `value` if it is beyond the bound, else 0.
[[nodiscard]] inline int sign_beyond(double value, double bound) noexcept {
  return std::abs(value) > bound ? sign(value) : 0;
}

/// a - b. (Points are arrays of doubles; space.hpp is not public.)
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

/// In the plane as if in space.
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

/// Of the segment ab. D is 2 or 3.
template <std::size_t D>
[[nodiscard]] int in_shrunken_ball(const std::array<double, D>& a, const std::array<double, D>& b,
                                   const std::array<double, D>& p, double k) {
  const int sign = detail::in_shrunken_ball_filter<D>(a, b, p, k);
  return sign != 0 ? sign : detail::in_shrunken_ball_exact<D>(a, b, p, k);
}

/// Of the triangle abc. D is 2 or 3.
template <std::size_t D>
[[nodiscard]] int in_shrunken_ball(const std::array<double, D>& a, const std::array<double, D>& b,
                                   const std::array<double, D>& c, const std::array<double, D>& p,
                                   double k) {
  const int sign = detail::in_shrunken_ball_filter(a, b, c, p, k);
  return sign != 0 ? sign : detail::in_shrunken_ball_exact<D>(a, b, c, p, k);
}

/// Of the tetrahedron abcd.
[[nodiscard]] inline int in_shrunken_ball(const Point<3>& a, const Point<3>& b, const Point<3>& c,
                                          const Point<3>& d, const Point<3>& p, double k) {
  const int sign = detail::in_shrunken_ball_filter(a, b, c, d, p, k);
  return sign != 0 ? sign : detail::in_shrunken_ball_exact(a, b, c, d, p, k);
}

}  // namespace mesher::predicates
