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
// 400 limb products here (an in-sphere one 1300), each exact by construction, and no rounding to reason about.
#include "mesher/predicates.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <stdexcept>
#include <utility>

#include "geometry/fixed_int.hpp"

namespace mesher::predicates {
namespace detail {
namespace {

/// The coordinates of N points, one point after the other.
template <std::size_t D, std::size_t N>
using Coordinates = std::array<double, D * N>;

/// Those of the difference of each point but the last to the last.
template <std::size_t W, std::size_t D, std::size_t N>
using Differences = std::array<FixedInt<W>, D*(N - 1)>;

/// The differences d must satisfy |d| < 2^(64 W - 2) =: B.
/// In the plane: |x0 y1 - y0 x1| < 2 B^2 = 2^(128 W - 3). Minors and lifts of incircle have the same
/// bound, and the sum of three of their products is below 12 B^4 < 2^(256 W - 4). Both fit the sign
/// bit of 2W and 4W limbs.
/// In space: the sum of three products of a minor and a difference is below 6 B^3 < 2^(192 W - 3),
/// a lift below 3 B^2, the sum of four of their products below 72 B^5 < 2^(320 W - 3): 3W, 2W, 5W.
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
int determinant_sign(const Differences<W, 2, 3>& d) {
  const auto& [ax, ay, bx, by] = d;
  return sign(minor(ax, ay, bx, by));
}

template <std::size_t W>
int determinant_sign(const Differences<W, 2, 4>& d) {
  const auto& [ax, ay, bx, by, cx, cy] = d;
  return sign((ax * ax + ay * ay) * minor(bx, by, cx, cy) +
              (bx * bx + by * by) * minor(cx, cy, ax, ay) +
              (cx * cx + cy * cy) * minor(ax, ay, bx, by));
}

/// The determinant of three rows x, y, z.
template <std::size_t W>
FixedInt<3 * W> minor(const FixedInt<W>* a, const FixedInt<W>* b, const FixedInt<W>* c) {
  return minor(b[0], b[1], c[0], c[1]) * a[2] + minor(c[0], c[1], a[0], a[1]) * b[2] +
         minor(a[0], a[1], b[0], b[1]) * c[2];
}

template <std::size_t W>
int determinant_sign(const Differences<W, 3, 4>& d) {
  return -sign(minor(&d[0], &d[3], &d[6]));
}

template <std::size_t W>
int determinant_sign(const Differences<W, 3, 5>& d) {
  const FixedInt<W>*a = &d[0], *b = &d[3], *c = &d[6], *e = &d[9];
  const auto lift = [](const FixedInt<W>* p) { return p[0] * p[0] + p[1] * p[1] + p[2] * p[2]; };
  const FixedInt<5 * W> even = lift(e) * minor(a, b, c) + lift(b) * minor(c, e, a);
  return -sign(even - (lift(c) * minor(e, a, b) + lift(a) * minor(b, c, e)));
}

/// Whether d = fl(a - b) is a - b: its rounding error is (v - b) + (a - fl(d + v)) with
/// v = fl(a - d) [Knuth, TAOCP 2, 4.2.2 Theorem B], which is 0 + 0 here.
bool is_exact_difference(double a, double b, double d) { return a - d == b && d + b == a; }

template <std::size_t W, std::size_t D, std::size_t N>
int sign_from_coordinates(const Coordinates<D, N>& p, int low) {
  std::array<FixedInt<W>, D> last;
  for (std::size_t i = 0; i < D; ++i) last[i] = to_fixed<W>(p[D * (N - 1) + i], low);
  Differences<W, D, N> d;
  for (std::size_t i = 0; i < d.size(); ++i) d[i] = to_fixed<W>(p[i], low) - last[i % D];
  return determinant_sign<W>(d);
}

/// Out of line, so that the short way below stays short.
template <std::size_t D, std::size_t N>
[[gnu::noinline]] int sign_from_coordinates(const Coordinates<D, N>& p) {
  const BitRange range(p);
  if (range.width() <= kCoordinateBits<1>) return sign_from_coordinates<1, D, N>(p, range.low);
  if (range.width() <= kCoordinateBits<2>) return sign_from_coordinates<2, D, N>(p, range.low);
  if (range.width() <= kCoordinateBits<4>) return sign_from_coordinates<4, D, N>(p, range.low);
  throw std::domain_error("predicate of coordinates out of the range 2^-100 to 2^100");
}

template <std::size_t D, std::size_t N>
int exact_sign(const Coordinates<D, N>& p) {
  std::array<double, D*(N - 1)> d;
  bool exact = true;
  for (std::size_t i = 0; i < d.size(); ++i) {
    const double last = p[D * (N - 1) + i % D];
    d[i] = p[i] - last;
    exact &= is_exact_difference(p[i], last, d[i]);
  }
  if (!exact) return sign_from_coordinates<D, N>(p);
  const BitRange range(d);
  if (range.width() > kDifferenceBits<1>) return sign_from_coordinates<D, N>(p);
  Differences<1, D, N> integers;
  for (std::size_t i = 0; i < d.size(); ++i) integers[i] = to_fixed<1>(d[i], range.low);
  return determinant_sign<1>(integers);
}

}  // namespace

int orient2d_exact(const Point<2>& a, const Point<2>& b, const Point<2>& c) {
  return exact_sign<2, 3>({a[0], a[1], b[0], b[1], c[0], c[1]});
}

int incircle_exact(const Point<2>& a, const Point<2>& b, const Point<2>& c, const Point<2>& d) {
  return exact_sign<2, 4>({a[0], a[1], b[0], b[1], c[0], c[1], d[0], d[1]});
}

int orient3d_exact(const Point<3>& a, const Point<3>& b, const Point<3>& c, const Point<3>& d) {
  return exact_sign<3, 4>(
      {a[0], a[1], a[2], b[0], b[1], b[2], c[0], c[1], c[2], d[0], d[1], d[2]});
}

int insphere_exact(const Point<3>& a, const Point<3>& b, const Point<3>& c, const Point<3>& d,
                   const Point<3>& e) {
  return exact_sign<3, 5>({a[0], a[1], a[2], b[0], b[1], b[2], c[0], c[1], c[2], d[0], d[1], d[2],
                           e[0], e[1], e[2]});
}

/// The first cofactor of a height that is not 0, the greatest point's first. The cofactor of e is
/// minus the orientation of abcd; two points that are swapped flip the sign, so that of another
/// point is the orientation with e in its place.
int cospherical_tie(const Point<3>& a, const Point<3>& b, const Point<3>& c, const Point<3>& d,
                    const Point<3>& e) {
  const std::array<const Point<3>*, 5> points{&a, &b, &c, &d, &e};
  std::array<std::size_t, 5> order{0, 1, 2, 3, 4};
  std::sort(order.begin(), order.end(),
            [&](std::size_t i, std::size_t k) { return *points[i] > *points[k]; });
  for (const std::size_t i : order) {
    auto rest = points;
    std::swap(rest[i], rest[4]);
    const int orientation = orient3d(*rest[0], *rest[1], *rest[2], *rest[3]);
    if (orientation != 0) return i == 4 ? -orientation : orientation;
  }
  return 0;  // all in one plane
}

/// The cofactor of the height of the greatest point in the determinant with rows px, py, h(p), 1; it
/// is not 0 (see incircle_perturbed).
int cocircular_tie(const Point<2>& a, const Point<2>& b, const Point<2>& c, const Point<2>& d) {
  const Point<2>& ab = std::max(a, b);
  const Point<2>& cd = std::max(c, d);
  if (ab < cd) return cd == d ? -orient2d(a, b, c) : orient2d(a, b, d);
  return ab == b ? -orient2d(a, c, d) : orient2d(b, c, d);
}

}  // namespace detail

}  // namespace mesher::predicates
