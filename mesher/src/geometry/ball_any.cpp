// Centres in doubles, and as exact quotients.
#include "geometry/ball_any.hpp"

#include "geometry/any_vectors.hpp"
#include "geometry/space_vectors.hpp"

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

// All numerators, and the determinant.
template <std::size_t D>
struct Quotients {
  std::array<double, D> numerator;
  double determinant;
};
template <std::size_t D>
Quotients<D> quotients(const Matrix<double, D>& m) {
  Quotients<D> all;
  for (std::size_t i = 0; i < D; ++i) all.numerator[i] = numerator(m, i);
  all.determinant = determinant(m);
  return all;
}
// The adjugate by the minors of pairs of rows, applied to the lifts.
Quotients<4> quotients(const Matrix<double, 4>& m) {
  const auto s = pair_minors(m[0], m[1]), t = pair_minors(m[2], m[3]);
  const double h0 = lift(m[0]), h1 = lift(m[1]), h2 = lift(m[2]), h3 = lift(m[3]);
  // Of the pair (0, 1) and (2, 3), in which columns a, b, c remain of a row; by their minors.
  const auto row = [&](std::size_t i, std::size_t a, std::size_t b, std::size_t c, const auto& of,
                       std::size_t bc, std::size_t ac, std::size_t ab) {
    return m[i][a] * of[bc] - m[i][b] * of[ac] + m[i][c] * of[ab];
  };
  const auto sum = [&](std::size_t a, std::size_t b, std::size_t c, std::size_t bc, std::size_t ac,
                       std::size_t ab) {
    return h0 * row(1, a, b, c, t, bc, ac, ab) - h1 * row(0, a, b, c, t, bc, ac, ab) +
           h2 * row(3, a, b, c, s, bc, ac, ab) - h3 * row(2, a, b, c, s, bc, ac, ab);
  };
  return {{sum(1, 2, 3, 5, 4, 3), -sum(0, 2, 3, 5, 2, 1), sum(0, 1, 3, 4, 2, 0),
           -sum(0, 1, 2, 3, 1, 0)},
          s[0] * t[5] - s[1] * t[4] + s[2] * t[3] + s[3] * t[2] - s[4] * t[1] + s[5] * t[0]};
}

template <int D>
[[gnu::noinline]] BallCentre<D> exact_centre(const Point<D>& v, const BallCorners<D>& corners) {
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
BallCentre<D> ball_centre(const Point<D>& v, BallCorners<D> corners) {
  std::sort(corners.begin(), corners.end());
  Matrix<double, D> rows;
  double spread2 = 1;
  for (std::size_t i = 0; i < D; ++i) {
    rows[i] = minus(corners[i], v);
    spread2 *= squared(rows[i]);
  }
  const auto [sums, det] = quotients(rows);
  if (!(det != 0) || !(spread2 <= kFlat * kFlat * (det * det))) return exact_centre<D>(v, corners);
  BallCentre<D> centre;
  for (std::size_t i = 0; i < D; ++i) centre.q[i] = sums[i] / det / 2;
  centre.length2 = squared(centre.q);
  centre.tolerance2 = kRounded * kRounded * (spread2 / (det * det)) * centre.length2;
  return centre;
}

template BallCentre<3> ball_centre<3>(const Point<3>&, BallCorners<3>);
template BallCentre<4> ball_centre<4>(const Point<4>&, BallCorners<4>);

}  // namespace mesher::detail
