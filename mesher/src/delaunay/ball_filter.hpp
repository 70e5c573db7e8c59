// Quick answers to "is p in the ball of this simplex?": the filters of a Delaunay kernel.
//
// Those of mesher/predicates.hpp compute beside the determinant the sum S of the absolute values of
// its monomials, which is as much work again. These bound S by the longest distance m^(1/2) of a
// corner to p, and leave a little more to the others. With |r|^2 <= m for each row r:
//   plane:  |bx cy| + |cx by| <= |b| |c| <= m by Cauchy's inequality, thrice times a lift: S <= 3
//           m^2.
//   space:  such a sum for three rows is the scalar product of (|ax|, |ay|, |az|) and three sums of
//           the kind above, so at most |a| sqrt(3) m <= sqrt(3) m^(3/2); four times a lift:
//           S <= 4 sqrt(3) m^(5/2).
// The determinant's error is at most 10u(1 + 18u) S and 15u(1 + 26u) S as there, so 30u and 103.93u
// suffice; what is added pays for the roundings of m and its powers, below 20u of the bound. And
// for the last rounding of a bound that is not normal, see kUnderflow there.
//
// On grids, where ties abound, nothing is rounded: if coordinates are multiples of some 2^low, and
// no difference exceeds 2^b of these units, then no sum exceeds 2^(4b + 4) units (plane) or
// 2^(5b + 7) (space), which are integers in a double for b = 12 and b = 9. Then a determinant of 0
// is a tie.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "geometry/fixed_int.hpp"
#include "mesher/predicates.hpp"

namespace mesher::detail {

inline constexpr double kPlaneBound = 30.1 * predicates::detail::kUnitRoundoff;
inline constexpr double kSpaceBound = 104 * predicates::detail::kUnitRoundoff;

/// What is known of a point and a ball.
enum class BallSide : std::int8_t { outside = -1, tie = 0, inside = 1, unsure = 2 };

/// 2^exponent. Requires: it is normal.
[[nodiscard]] constexpr double power_of_two(int exponent) noexcept {
  return std::bit_cast<double>(static_cast<std::uint64_t>(exponent + 1023) << 52);
}

/// Below which distance from p the determinants of points with p's unit or a greater one are not
/// rounded: a power of two, or 0.
template <std::size_t D>
[[nodiscard]] double exact_reach(const std::array<double, D>& p) noexcept {
  const int low = predicates::detail::BitRange(p).low;
  // The determinant's unit is normal; of the origin any unit will do.
  return low < -200 ? 0 : power_of_two(std::min(low, 400) + (D == 2 ? 12 : 9));
}

/// From a determinant whose error is at most `bound`, or 0 if m is less than the square of `reach`.
[[nodiscard]] inline BallSide side_of(double det, double bound, double m, double reach) noexcept {
  if (det > bound) return BallSide::inside;
  if (det < -bound) return BallSide::outside;
  if (!(m < reach * reach)) return BallSide::unsure;
  return det > 0    ? BallSide::inside
         : det < 0  ? BallSide::outside
         : det == 0 ? BallSide::tie
                    : BallSide::unsure;
}

/// incircle(a, b, c, p), as far as that is sure; if a coordinate is not a number it is not.
[[nodiscard]] inline BallSide in_ball_quickly(const Point<2>& a, const Point<2>& b,
                                              const Point<2>& c, const Point<2>& p,
                                              double reach) noexcept {
  const double ax = a[0] - p[0], ay = a[1] - p[1];
  const double bx = b[0] - p[0], by = b[1] - p[1];
  const double cx = c[0] - p[0], cy = c[1] - p[1];
  const double a_lift = ax * ax + ay * ay, b_lift = bx * bx + by * by, c_lift = cx * cx + cy * cy;
  const double det =
      (a_lift * (bx * cy - cx * by) + b_lift * (cx * ay - ax * cy)) + c_lift * (ax * by - bx * ay);
  const double m = std::max(std::max(a_lift, b_lift), c_lift);
  const double bound = kPlaneBound * (m * m);
  return side_of(det, bound, m, reach);
}

/// insphere(a, b, c, d, p), likewise.
[[nodiscard]] inline BallSide in_ball_quickly(const Point<3>& a, const Point<3>& b,
                                              const Point<3>& c, const Point<3>& d,
                                              const Point<3>& p, double reach) noexcept {
  const double ax = a[0] - p[0], ay = a[1] - p[1], az = a[2] - p[2];
  const double bx = b[0] - p[0], by = b[1] - p[1], bz = b[2] - p[2];
  const double cx = c[0] - p[0], cy = c[1] - p[1], cz = c[2] - p[2];
  const double dx = d[0] - p[0], dy = d[1] - p[1], dz = d[2] - p[2];
  const double ab = ax * by - bx * ay, bc = bx * cy - cx * by, cd = cx * dy - dx * cy;
  const double da = dx * ay - ax * dy, ac = ax * cy - cx * ay, bd = bx * dy - dx * by;
  const double abc = (az * bc - bz * ac) + cz * ab, bcd = (bz * cd - cz * bd) + dz * bc;
  const double cda = (cz * da + dz * ac) + az * cd, dab = (dz * ab + az * bd) + bz * da;
  const double a_lift = (ax * ax + ay * ay) + az * az, b_lift = (bx * bx + by * by) + bz * bz;
  const double c_lift = (cx * cx + cy * cy) + cz * cz, d_lift = (dx * dx + dy * dy) + dz * dz;
  const double det = (c_lift * dab - d_lift * abc) + (a_lift * bcd - b_lift * cda);
  const double m = std::max(std::max(a_lift, b_lift), std::max(c_lift, d_lift));
  const double bound = kSpaceBound * ((m * m) * std::sqrt(m)) + predicates::detail::kUnderflow;
  return side_of(det, bound, m, reach);
}

}  // namespace mesher::detail
