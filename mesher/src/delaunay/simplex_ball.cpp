// Circumcentres by the dozen, and bounds on their errors.
//
// Let u = 2^-53, q the centre relative to p, r = |q|, and k >= 1 the product of the lengths of the
// other corners, relative to p, over their determinant. An entry of a corner is rounded once.
//   plane:  a^2 by - b^2 ay: 4u for the square, 1u for the entry, 2u more: 7u for each monomial,
//           whose absolute values, as vectors, sum to |a||b|(|a| + |b|) <= 4r |a||b|. Over twice
//           the determinant that is 14 u k r. The determinant: 4u for monomials that sum to
//           |a||b| at most (Cauchy): 4 u k r.
//   space:  51 u k r and 12 u k r (geometry/circumcentre.cpp).
// With the quotient and the products by it 3u r more: q is off by 66 u k r at most, if k is so
// small that squares of these do not count: k <= 10^7, the most flatness. So is r, with 4u r more
// for the sum of squares and the root. Adding p rounds by u (|p| + r) at most. A distance to the
// centre has 5u more. All in all a point is inside for sure if it is nearer to the rounded centre
// than
//   r - u (2 * 66 k + 12) r - u |p| >= r - e,   e = u (320 k r + 2 |p|_1),
// and outside if it is farther than r + e. That is more than twice as much.
#include "delaunay/simplex_ball.hpp"

#include <cmath>
#include <limits>

#include "geometry/wide_lanes.hpp"

namespace mesher::detail {

namespace {

constexpr double kUnit = 0x1p-53;

// The squares of radii r - e and r + e, moved outward by more than the rounding to floats, 2^-24,
// and such that nothing is sure where the floats end.
constexpr double kUp = 1 + 0x1p-22, kDown = 1 - 0x1p-22;
constexpr double kLeast = std::numeric_limits<float>::min();
constexpr double kMost = std::numeric_limits<float>::max() / 2;

[[gnu::always_inline]] inline double inner_of(double r, double e) noexcept {
  const double at = r - e, square = at * at * kDown;
  return !(at > 0) || square < kLeast ? 0 : square > kMost ? kMost : square;
}
[[gnu::always_inline]] inline double outer_of(double r, double e) noexcept {
  const double square = (r + e) * (r + e) * kUp;
  return square < kLeast ? kLeast : square;
}
[[gnu::always_inline]] inline double lesser(double a, double b) noexcept { return a < b ? a : b; }

}  // namespace

/// Of coordinates near p, twice: see above.
template <int D>
double BallBatch<D>::rounding() const noexcept {
  double sum = 0;
  for (const double x : p_) sum += std::abs(x);
  return 2 * kUnit * sum;
}

template <>
MESHER_WIDE_LANES void BallBatch<2>::run(Block& b) const noexcept {
  const double from_p = rounding(), px = p_[0], py = p_[1];
  for (std::size_t l = 0; l < kLanes; ++l) {
    const double ax = b.corner[0][0][l], ay = b.corner[0][1][l];
    const double bx = b.corner[1][0][l], by = b.corner[1][1][l];
    const double a2 = ax * ax + ay * ay, b2 = bx * bx + by * by;
    const double ex = ax - bx, ey = ay - by;
    const double f = 0.5 / (ax * by - ay * bx);
    const double x = (a2 * by - b2 * ay) * f, y = (b2 * ax - a2 * bx) * f;
    const double r2 = x * x + y * y, r = std::sqrt(r2);
    const double flatness = std::sqrt(a2 * b2) * (2 * f);
    const double e = 320 * kUnit * flatness * r + from_p;
    b.centre[0][l] = px + x;
    b.centre[1][l] = py + y;
    b.radius2[l] = r2;
    b.shortest2[l] = lesser(lesser(a2, b2), ex * ex + ey * ey);
    b.inner2[l] = inner_of(r, e);
    b.outer2[l] = outer_of(r, e);
    b.flatness[l] = f > 0 ? flatness : std::numeric_limits<double>::infinity();
  }
}

template <>
MESHER_WIDE_LANES void BallBatch<3>::run(Block& b) const noexcept {
  const double from_p = rounding(), px = p_[0], py = p_[1], pz = p_[2];
  const auto squared = [](double x, double y, double z) { return x * x + y * y + z * z; };
  for (std::size_t l = 0; l < kLanes; ++l) {
    const double ax = b.corner[0][0][l], ay = b.corner[0][1][l], az = b.corner[0][2][l];
    const double bx = b.corner[1][0][l], by = b.corner[1][1][l], bz = b.corner[1][2][l];
    const double cx = b.corner[2][0][l], cy = b.corner[2][1][l], cz = b.corner[2][2][l];
    const double a2 = squared(ax, ay, az), b2 = squared(bx, by, bz), c2 = squared(cx, cy, cz);
    const double bcx = by * cz - bz * cy, bcy = bz * cx - bx * cz, bcz = bx * cy - by * cx;
    const double cax = cy * az - cz * ay, cay = cz * ax - cx * az, caz = cx * ay - cy * ax;
    const double abx = ay * bz - az * by, aby = az * bx - ax * bz, abz = ax * by - ay * bx;
    const double f = 0.5 / (ax * bcx + ay * bcy + az * bcz);
    const double x = (a2 * bcx + b2 * cax + c2 * abx) * f;
    const double y = (a2 * bcy + b2 * cay + c2 * aby) * f;
    const double z = (a2 * bcz + b2 * caz + c2 * abz) * f;
    const double r2 = squared(x, y, z), r = std::sqrt(r2);
    const double flatness = std::sqrt(a2 * b2 * c2) * (2 * f);
    const double e = 320 * kUnit * flatness * r + from_p;
    const double ab2 = squared(ax - bx, ay - by, az - bz);
    const double ac2 = squared(ax - cx, ay - cy, az - cz);
    const double bc2 = squared(bx - cx, by - cy, bz - cz);
    b.centre[0][l] = px + x;
    b.centre[1][l] = py + y;
    b.centre[2][l] = pz + z;
    b.radius2[l] = r2;
    b.shortest2[l] = lesser(lesser(lesser(a2, b2), lesser(c2, ab2)), lesser(ac2, bc2));
    b.inner2[l] = inner_of(r, e);
    b.outer2[l] = outer_of(r, e);
    b.flatness[l] = f > 0 ? flatness : std::numeric_limits<double>::infinity();
  }
}

template <int D>
void BallBatch<D>::set_centre(std::size_t k, const Point<D>& q) noexcept {
  Block& b = blocks_[k / kLanes];
  const std::size_t l = k % kLanes;
  double r2 = 0;
  for (std::size_t i = 0; i < D; ++i) {
    b.centre[i][l] = p_[i] + q[i];
    r2 += q[i] * q[i];
  }
  const double r = std::sqrt(r2), e = 320 * kUnit * kMostFlatness * r + rounding();
  b.radius2[l] = r2;
  b.inner2[l] = inner_of(r, e);
  b.outer2[l] = outer_of(r, e);
}

template class BallBatch<2>;
#ifndef MESHER_PLANE_ONLY
template class BallBatch<3>;
#endif

}  // namespace mesher::detail
