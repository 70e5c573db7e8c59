// A look at the machine's arithmetic before anything relies on it.
#include <stdexcept>
#include <string>

#include "mesher/predicates.hpp"

namespace mesher::predicates {
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
  const Point<3> p{near, z, z}, q{z, near, z}, r{z, z, near}, s{z, z, z}, t{near, near, near};
  expect(orient3d(s, p, q, r) == 1 && insphere(s, p, q, r, t) == 0, "smallest scale");
  expect(insphere(s, p, q, r, {near, near, near * (1 + ulp)}) == -1, "smallest scale");
}

}  // namespace

void self_test() {
  expect_nearest_even();
  expect_no_contraction();
  expect_no_reassociation();
  expect_exact_signs();
}

}  // namespace mesher::predicates
