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

template <int D>
void BallBatch<D>::make_room(std::size_t n) {
  if (room_ >= n) return;
  columns_.resize(kColumns * 2 * n);
  room_ = 2 * n;
}

template <int D>
void BallBatch<D>::start(const Point<D>& p, std::size_t n) noexcept {
  p_ = p;
  count_ = n;
  size_ = 0;
  for (const double x : p) size_ += std::abs(x);
}

template <>
void BallBatch<2>::run() noexcept {
  const double* const __restrict ax = column(0), * const __restrict ay = column(1);
  const double* const __restrict bx = column(2), * const __restrict by = column(3);
  double* const __restrict cx = column(kCentre), * const __restrict cy = column(kCentre + 1);
  double* const __restrict radius2 = column(kRadius2), * const __restrict flat = column(kFlatness);
  double* const __restrict inner2 = column(kInner2), * const __restrict outer2 = column(kOuter2);
  double* const __restrict shortest2 = column(kShortest2);
  const double px = p_[0], py = p_[1], rounding = 2 * kUnit * size_;
  for (std::size_t k = 0; k < count_; ++k) {
    const double a2 = ax[k] * ax[k] + ay[k] * ay[k], b2 = bx[k] * bx[k] + by[k] * by[k];
    const double ex = ax[k] - bx[k], ey = ay[k] - by[k];
    const double f = 0.5 / (ax[k] * by[k] - ay[k] * bx[k]);
    const double x = (a2 * by[k] - b2 * ay[k]) * f, y = (b2 * ax[k] - a2 * bx[k]) * f;
    const double r2 = x * x + y * y, r = std::sqrt(r2);
    const double flatness = std::sqrt(a2 * b2) * (2 * f);
    const double e = 320 * kUnit * flatness * r + rounding;
    cx[k] = px + x, cy[k] = py + y;
    radius2[k] = r2;
    shortest2[k] = lesser(lesser(a2, b2), ex * ex + ey * ey);
    inner2[k] = inner_of(r, e), outer2[k] = outer_of(r, e);
    flat[k] = f > 0 ? flatness : std::numeric_limits<double>::infinity();
  }
}

template <>
void BallBatch<3>::run() noexcept {
  const double* const __restrict ax = column(0), * const __restrict ay = column(1);
  const double* const __restrict az = column(2), * const __restrict bx = column(3);
  const double* const __restrict by = column(4), * const __restrict bz = column(5);
  const double* const __restrict cx = column(6), * const __restrict cy = column(7);
  const double* const __restrict cz = column(8);
  double* const __restrict qx = column(kCentre), * const __restrict qy = column(kCentre + 1);
  double* const __restrict qz = column(kCentre + 2), * const __restrict flat = column(kFlatness);
  double* const __restrict radius2 = column(kRadius2);
  double* const __restrict inner2 = column(kInner2), * const __restrict outer2 = column(kOuter2);
  double* const __restrict shortest2 = column(kShortest2);
  const double px = p_[0], py = p_[1], pz = p_[2], rounding = 2 * kUnit * size_;
  const auto squared = [](double x, double y, double z) { return x * x + y * y + z * z; };
  for (std::size_t k = 0; k < count_; ++k) {
    const double a2 = squared(ax[k], ay[k], az[k]), b2 = squared(bx[k], by[k], bz[k]);
    const double c2 = squared(cx[k], cy[k], cz[k]);
    const double bcx = by[k] * cz[k] - bz[k] * cy[k], bcy = bz[k] * cx[k] - bx[k] * cz[k];
    const double bcz = bx[k] * cy[k] - by[k] * cx[k];
    const double cax = cy[k] * az[k] - cz[k] * ay[k], cay = cz[k] * ax[k] - cx[k] * az[k];
    const double caz = cx[k] * ay[k] - cy[k] * ax[k];
    const double abx = ay[k] * bz[k] - az[k] * by[k], aby = az[k] * bx[k] - ax[k] * bz[k];
    const double abz = ax[k] * by[k] - ay[k] * bx[k];
    const double f = 0.5 / (ax[k] * bcx + ay[k] * bcy + az[k] * bcz);
    const double x = (a2 * bcx + b2 * cax + c2 * abx) * f;
    const double y = (a2 * bcy + b2 * cay + c2 * aby) * f;
    const double z = (a2 * bcz + b2 * caz + c2 * abz) * f;
    const double r2 = squared(x, y, z), r = std::sqrt(r2);
    const double flatness = std::sqrt(a2 * b2 * c2) * (2 * f);
    const double e = 320 * kUnit * flatness * r + rounding;
    const double ab2 = squared(ax[k] - bx[k], ay[k] - by[k], az[k] - bz[k]);
    const double ac2 = squared(ax[k] - cx[k], ay[k] - cy[k], az[k] - cz[k]);
    const double bc2 = squared(bx[k] - cx[k], by[k] - cy[k], bz[k] - cz[k]);
    qx[k] = px + x, qy[k] = py + y, qz[k] = pz + z;
    radius2[k] = r2;
    shortest2[k] = lesser(lesser(lesser(a2, b2), lesser(c2, ab2)), lesser(ac2, bc2));
    inner2[k] = inner_of(r, e), outer2[k] = outer_of(r, e);
    flat[k] = f > 0 ? flatness : std::numeric_limits<double>::infinity();
  }
}

template <int D>
void BallBatch<D>::set_centre(std::size_t k, const Point<D>& q) noexcept {
  double r2 = 0;
  for (std::size_t i = 0; i < D; ++i) {
    column(kCentre + i)[k] = p_[i] + q[i];
    r2 += q[i] * q[i];
  }
  const double r = std::sqrt(r2), e = kUnit * (320 * kMostFlatness * r + 2 * size_);
  column(kRadius2)[k] = r2;
  column(kInner2)[k] = inner_of(r, e);
  column(kOuter2)[k] = outer_of(r, e);
}

template class BallBatch<2>;
template class BallBatch<3>;

}  // namespace mesher::detail
