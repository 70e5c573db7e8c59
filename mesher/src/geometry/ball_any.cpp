// Centres in doubles, and as exact quotients.
#include "geometry/ball_any.hpp"

#include "geometry/any_space.hpp"
#include "geometry/space.hpp"

namespace mesher::detail {

namespace {

// What the product of the corners' distances may be at most, in units of the determinant.
constexpr double kFlat = 1e6;

// A bound on the error of 2 w.q for |w| <= 4 |q|, in units of k |q| |w|; k = product / determinant,
// u = 2^-53, D <= 4. A monomial of a minor has three entries, each rounded once, two products and
// five sums: 10 u, and the lift of a row 6 u. Six monomials, each at most the product of three
// distances, four rows, whose distances are at most 2 |q|, and the sums of those: the numerator is
// off by 6 (16 + 4) u 8 product |q| along each axis, so by twice that; q by half of it, 960 u k
// |q|. The determinant has 24 monomials, of 16 u: 384 u k |q|. Twice the sum is 2688 u, for 2 w.q;
// what w, the sum and |w|^2 are rounded by is at most 48 u more. This is twice as much.
constexpr double kRounded = 8192 * 0x1p-53;
// The same for a centre that has only been rounded.
constexpr double kExact = 128 * 0x1p-53;

template <class T, std::size_t D>
auto numerator(const Matrix<T, D>& rows, std::size_t axis) {
  auto sum = lift(rows[0]) * determinant(without(rows, 0, axis));
  for (std::size_t i = 1; i < D; ++i) {
    const auto term = lift(rows[i]) * determinant(without(rows, i, axis));
    sum = i % 2 == 0 ? sum + term : sum - term;
  }
  return axis % 2 == 0 ? sum : sum - (sum + sum);
}

template <int D>
[[gnu::noinline]] BallCentre<D> exact_centre(const Point<D>& v, const Corners<D>& corners) {
  std::array<Point<D>, D + 1> points;
  std::copy(corners.begin(), corners.end(), points.begin());
  points[D] = v;
  BallCentre<D> centre;
  centre.q = with_rows<D>(points, [](const auto& rows, int low) {
    const auto det = leading(determinant(rows));
    Point<D> q;
    for (std::size_t i = 0; i < D; ++i) {
      const auto sum = leading(numerator(rows, i));
      q[i] = std::ldexp(sum.fraction / det.fraction, sum.exponent - det.exponent + low - 1);
    }
    return q;
  });
  centre.length2 = squared(centre.q);
  centre.tolerance2 = kExact * kExact * centre.length2;
  return centre;
}

}  // namespace

template <int D>
BallCentre<D> ball_centre(const Point<D>& v, Corners<D> corners) {
  std::sort(corners.begin(), corners.end());
  Matrix<double, D> rows;
  double spread2 = 1;
  for (std::size_t i = 0; i < D; ++i) {
    rows[i] = minus(corners[i], v);
    spread2 *= squared(rows[i]);
  }
  const double det = determinant(rows);
  if (!(det != 0) || !(spread2 <= kFlat * kFlat * (det * det))) return exact_centre<D>(v, corners);
  BallCentre<D> centre;
  for (std::size_t i = 0; i < D; ++i) centre.q[i] = numerator(rows, i) / det / 2;
  centre.length2 = squared(centre.q);
  centre.tolerance2 = kRounded * kRounded * (spread2 / (det * det)) * centre.length2;
  return centre;
}

template BallCentre<3> ball_centre<3>(const Point<3>&, Corners<3>);
template BallCentre<4> ball_centre<4>(const Point<4>&, Corners<4>);

}  // namespace mesher::detail
