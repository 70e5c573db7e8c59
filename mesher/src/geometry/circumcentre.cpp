// Centres in doubles, and as exact quotients.
#include "geometry/circumcentre.hpp"

#include <cmath>

#include "geometry/exact_sign.hpp"
#include "geometry/space_vectors.hpp"

namespace mesher::detail {

namespace {

// What |a||b||c| / det may be at most for doubles.
constexpr double kFlatCentre = 1e7;

// A bound on the error of 2 w.q for |w| <= 4 |q|, in units of k |q| |w|; k = |a||b||c| / det >= 1,
// u = 2^-53. An entry of a is rounded once. A product a2 (b x c) has 4 rounded entries and 6
// operations more, the sum of three two: at most 12 u for each of its monomials, whose absolute
// values sum to at most sqrt(2) |a|^2 |b||c|. So the numerator is off by
// 12 sqrt(2) u |a||b||c| (|a| + |b| + |c|), and |a|, |b|, |c| <= 2 |q|: q by 51 u k |q|. The
// determinant, 8 u for each monomial, sqrt(2) |a||b||c| in all, moves q by 12 u k |q|. Twice that
// for 2 w.q makes 126, the rounding of w, of the sum and of |w|^2 at most 32 more. (Beyond 4 |q|,
// 2 w.q - |w|^2 <= -|w|^2 / 2 is clear.) This is more than twice as much.
constexpr double kRoundedCentre = 512 * 0x1p-53;
// The same for a centre that has only been rounded: 2 u for q, the 32 u as above.
constexpr double kExactCentre = 64 * 0x1p-53;

template <std::size_t W>
using Vector = std::array<predicates::detail::FixedInt<W>, 3>;

template <std::size_t W>
Vector<2 * W> exact_cross(const predicates::detail::FixedInt<W>* a,
                          const predicates::detail::FixedInt<W>* b) {
  using predicates::detail::minor;
  return {minor(a[1], a[2], b[1], b[2]), minor(a[2], a[0], b[2], b[0]),
          minor(a[0], a[1], b[0], b[1])};
}

/// d: the differences a, b, c, integers in units of 2^low. All sums are among those of insphere.
template <std::size_t W>
Point<3> centre(const std::array<predicates::detail::FixedInt<W>, 9>& d, int low) {
  using predicates::detail::to_double;
  const auto *a = &d[0], *b = &d[3], *c = &d[6];
  const Vector<2 *W> bc = exact_cross(b, c), ca = exact_cross(c, a), ab = exact_cross(a, b);
  const auto lift = [](const auto* p) { return p[0] * p[0] + p[1] * p[1] + p[2] * p[2]; };
  const double det = to_double(a[0] * bc[0] + a[1] * bc[1] + a[2] * bc[2]);
  Point<3> q;
  for (std::size_t i = 0; i < 3; ++i) {
    const double sum = to_double(lift(a) * bc[i] + lift(b) * ca[i] + lift(c) * ab[i]);
    q[i] = std::ldexp(sum / det, low - 1);
  }
  return q;
}

[[gnu::noinline]] Circumcentre exact_centre(const Point<3>& v, const Point<3>& a, const Point<3>& b,
                                            const Point<3>& c) {
  const Point<3> q = predicates::detail::with_integers<3, 4>(
      {a[0], a[1], a[2], b[0], b[1], b[2], c[0], c[1], c[2], v[0], v[1], v[2]},
      [](const auto& differences, int low) { return centre(differences, low); });
  const double q2 = squared(q);
  return {q, q2, kExactCentre * kExactCentre * q2};
}

Circumcentre from_smallest(const Point<3>& v, const Point<3>& first, const Point<3>& second,
                           const Point<3>& third) {
  const Point<3> a = minus(first, v), b = minus(second, v), c = minus(third, v);
  const Point<3> bc = cross(b, c), ca = cross(c, a), ab = cross(a, b);
  const double det = dot(a, bc);
  const double a2 = squared(a), b2 = squared(b), c2 = squared(c);
  const double spread2 = a2 * b2 * c2;
  if (!(det > 0) || spread2 > kFlatCentre * kFlatCentre * (det * det)) {
    return exact_centre(v, first, second, third);
  }
  const double f = 0.5 / det;
  Point<3> q;
  for (std::size_t i = 0; i < 3; ++i) q[i] = (a2 * bc[i] + b2 * ca[i] + c2 * ab[i]) * f;
  const double q2 = squared(q);
  return {q, q2, 4 * kRoundedCentre * kRoundedCentre * (spread2 * f * f) * q2};
}

/// d: the differences a, b. All sums are among those of incircle.
template <std::size_t W>
Point<2> centre(const std::array<predicates::detail::FixedInt<W>, 4>& d, int low) {
  using predicates::detail::minor;
  using predicates::detail::to_double;
  const auto a2 = d[0] * d[0] + d[1] * d[1], b2 = d[2] * d[2] + d[3] * d[3];
  const double det = to_double(minor(d[0], d[1], d[2], d[3]));
  return {std::ldexp(to_double(a2 * d[3] - b2 * d[1]) / det, low - 1),
          std::ldexp(to_double(b2 * d[0] - a2 * d[2]) / det, low - 1)};
}

}  // namespace

Point<2> exact_circumcentre(const Point<2>& v, const Point<2>& a, const Point<2>& b) {
  return predicates::detail::with_integers<2, 3>(
      {a[0], a[1], b[0], b[1], v[0], v[1]},
      [](const auto& differences, int low) { return centre(differences, low); });
}

Circumcentre circumcentre(const Point<3>& v, const Point<3>& a, const Point<3>& b,
                          const Point<3>& c) {
  if (b < a && b < c) return from_smallest(v, b, c, a);
  if (c < a && c < b) return from_smallest(v, c, a, b);
  return from_smallest(v, a, b, c);
}

}  // namespace mesher::detail
