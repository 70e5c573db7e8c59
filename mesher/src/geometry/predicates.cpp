// The exact side of the predicates: determinants of coordinate differences, in integers.
//
// The coordinates given are multiples of some 2^low, so their determinants are integers in a power
// of that unit. How many bits they need is read off the doubles, and the narrowest width is taken:
//   1 limb   coordinate differences of up to 62 bits, if exact as doubles (always so on grids,
//            mostly so for points near each other), or coordinates of up to 61 bits
//   2 limbs  coordinates of up to 125 bits: nearly all other points
//   4 limbs  coordinates of up to 253 bits: the rest. An input coordinate, of magnitude 2^-100 to
//            2^100, is a multiple of 2^-152 below 2^101; that of a new vertex is 0 or above 2^-60
//            of its box's side, so a multiple of 2^-113 of a side that bounds it
// Why not the usual expansions, sums of doubles: an in-circle determinant at full range takes some
// 400 limb products here, each exact by construction, and no rounding to reason about.
#include "mesher/predicates.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <stdexcept>
#include <string>

#include "geometry/fixed_int.hpp"

namespace mesher::predicates {
namespace detail {
namespace {

/// x, y of the difference of each point but the last to the last.
template <std::size_t W, std::size_t N>
using Differences = std::array<FixedInt<W>, 2 * N - 2>;

/// The differences d must satisfy |d| < 2^(64 W - 2) =: B. Orientation: |x0 y1 - y0 x1| < 2 B^2
/// = 2^(128 W - 3). Minors and lifts of incircle have the same bound, and the sum of three of their
/// products is below 12 B^4 < 2^(256 W - 4). Both fit the sign bit of 2W and 4W limbs.
template <std::size_t W>
constexpr int kDifferenceBits = 64 * static_cast<int>(W) - 2;

/// A difference of two coordinates has one bit more than they.
template <std::size_t W>
constexpr int kCoordinateBits = kDifferenceBits<W> - 1;

template <std::size_t W>
FixedInt<2 * W> minor(const FixedInt<W>& x0, const FixedInt<W>& y0, const FixedInt<W>& x1,
                      const FixedInt<W>& y1) {
  return x0 * y1 - y0 * x1;
}

template <std::size_t W>
int determinant_sign(const Differences<W, 3>& d) {
  const auto& [ax, ay, bx, by] = d;
  return sign(minor(ax, ay, bx, by));
}

template <std::size_t W>
int determinant_sign(const Differences<W, 4>& d) {
  const auto& [ax, ay, bx, by, cx, cy] = d;
  return sign((ax * ax + ay * ay) * minor(bx, by, cx, cy) +
              (bx * bx + by * by) * minor(cx, cy, ax, ay) +
              (cx * cx + cy * cy) * minor(ax, ay, bx, by));
}

/// Whether d = fl(a - b) is a - b: its rounding error is (v - b) + (a - fl(d + v)) with
/// v = fl(a - d) [Knuth, TAOCP 2, 4.2.2 Theorem B], which is 0 + 0 here.
bool is_exact_difference(double a, double b, double d) { return a - d == b && d + b == a; }

/// The points' coordinates, x and y in turn.
template <std::size_t N>
using Coordinates = std::array<double, 2 * N>;

template <std::size_t W, std::size_t N>
int sign_from_coordinates(const Coordinates<N>& p, int low) {
  const FixedInt<W> last_x = to_fixed<W>(p[2 * N - 2], low);
  const FixedInt<W> last_y = to_fixed<W>(p[2 * N - 1], low);
  Differences<W, N> d;
  for (std::size_t i = 0; i < d.size(); ++i) {
    d[i] = to_fixed<W>(p[i], low) - (i % 2 == 0 ? last_x : last_y);
  }
  return determinant_sign<W>(d);
}

/// Out of line, so that the short way below stays short.
template <std::size_t N>
[[gnu::noinline]] int sign_from_coordinates(const Coordinates<N>& p) {
  const BitRange range(p);
  if (range.width() <= kCoordinateBits<1>) return sign_from_coordinates<1, N>(p, range.low);
  if (range.width() <= kCoordinateBits<2>) return sign_from_coordinates<2, N>(p, range.low);
  if (range.width() <= kCoordinateBits<4>) return sign_from_coordinates<4, N>(p, range.low);
  throw std::domain_error("predicate of coordinates out of the range 2^-100 to 2^100");
}

template <std::size_t N>
int exact_sign(const Coordinates<N>& p) {
  std::array<double, 2 * N - 2> d;
  bool exact = true;
  for (std::size_t i = 0; i < d.size(); ++i) {
    const double last = p[2 * N - 2 + i % 2];
    d[i] = p[i] - last;
    exact &= is_exact_difference(p[i], last, d[i]);
  }
  if (!exact) return sign_from_coordinates<N>(p);
  const BitRange range(d);
  if (range.width() > kDifferenceBits<1>) return sign_from_coordinates<N>(p);
  Differences<1, N> integers;
  for (std::size_t i = 0; i < d.size(); ++i) integers[i] = to_fixed<1>(d[i], range.low);
  return determinant_sign<1>(integers);
}

}  // namespace

int orient2d_exact(const Point<2>& a, const Point<2>& b, const Point<2>& c) {
  return exact_sign<3>({a[0], a[1], b[0], b[1], c[0], c[1]});
}

int incircle_exact(const Point<2>& a, const Point<2>& b, const Point<2>& c, const Point<2>& d) {
  return exact_sign<4>({a[0], a[1], b[0], b[1], c[0], c[1], d[0], d[1]});
}

/// The cofactor of the height of the greatest point in the determinant with rows px, py, h(p), 1.
int cocircular_tie(const Point<2>& a, const Point<2>& b, const Point<2>& c, const Point<2>& d) {
  const Point<2>& ab = std::max(a, b);
  const Point<2>& cd = std::max(c, d);
  if (ab < cd) return cd == d ? -orient2d(a, b, c) : orient2d(a, b, d);
  return ab == b ? -orient2d(a, c, d) : orient2d(b, c, d);
}

}  // namespace detail

namespace {

/// A number that the compiler must not know.
double opaque(double x) {
  volatile double hidden = x;
  return hidden;
}

void expect(bool holds, const char* what) {
  if (!holds) throw std::logic_error(std::string("unsuitable floating-point arithmetic: ") + what);
}

/// Half a unit in the last place of 1 is a tie, a bit more than that is not; either sign.
void expect_nearest_even() {
  const double one = opaque(1), half = opaque(0x1p-53), more = opaque(0x1.00001p-53);
  const double odd = opaque(1 + 0x1p-52);
  expect(one + half == 1 && -one - half == -1, "ties do not round to even");
  expect(odd + half == 1 + 0x1p-51 && -odd - half == -1 - 0x1p-51, "ties do not round to even");
  expect(one + more == odd && -one - more == -odd, "sums do not round to nearest");
  // (1 + 2^-52)^2 = 1 + 2^-51 + 2^-104, and (1 + 2^-52)(1 - 2^-52) = 1 - 2^-104
  expect(odd * odd == 1 + 0x1p-51, "products do not round to nearest");
  expect(odd * opaque(1 - 0x1p-52) == 1, "products do not round to nearest");
}

/// x^2 = 1 + 2^-29 + 2^-60 rounds to y; a fused operation would keep the 2^-60.
void expect_no_contraction() {
  const double x = opaque(1 + 0x1p-30), y = opaque(1 + 0x1p-29);
  expect(x * x - y == 0, "a*b - c is contracted");
  expect(y - x * x == 0, "c - a*b is contracted");
  expect(x * x + -y == 0, "a*b + c is contracted");
  const double a = opaque(x), b = opaque(x);
  expect(a * b - x * x == 0, "a*b - c*d is contracted");
  const double product = a * x;
  expect(product - y == 0, "a*b - c is contracted across statements");
}

/// What algebra would simplify away, or registers of more than 53 bits keep.
void expect_no_reassociation() {
  const double one = opaque(1), tiny = opaque(0x1p-60);
  expect((one + tiny) - one == 0, "(a + b) - a is simplified, or kept in excess precision");
  expect((tiny + one) - one == 0, "(a + b) - b is simplified, or kept in excess precision");
  expect((tiny - one) + one == 0, "(a - b) + b is simplified, or kept in excess precision");
  expect(one - (one - tiny) == 0, "a - (a - b) is simplified, or kept in excess precision");
  const double third = opaque(0x1.5555555555555p-2), x = opaque(3), y = opaque(0x1p-51);
  expect(third * x + third * y != third * (x + y), "a*b + a*c is factored");
}

/// Known answers, each by another way through the predicates.
void expect_exact_signs() {
  const double z = opaque(0), one = opaque(1), ulp = opaque(0x1p-52), far = opaque(0x1p100);
  const double near = opaque(0x1p-100);
  const Point<2> o{z, z}, x{one, z}, y{z, one}, xy{one, one};
  expect(orient2d(o, x, y) == 1 && incircle(o, x, y, {one / 4, one / 4}) == 1, "filter");
  expect(orient2d(o, xy, {2 * one, 2 * one + 2 * ulp}) == 1, "collinear but for one bit");
  expect(incircle(o, x, xy, y) == 0 && incircle(o, x, xy, {z, one + ulp}) == -1, "cocircular");
  expect(orient2d({-far, -far}, {near, near}, {far, far}) == 0, "widest range");
  expect(orient2d({-far, -far}, {z, near}, {far, far}) == -1, "widest range");
}

}  // namespace

void self_test() {
  expect_nearest_even();
  expect_no_contraction();
  expect_no_reassociation();
  expect_exact_signs();
}

}  // namespace mesher::predicates
