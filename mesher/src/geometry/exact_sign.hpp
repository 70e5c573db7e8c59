// The common part of exact predicates: determinants of coordinate differences, in integers.
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
// 400 limb products here (an in-sphere one 1300), each exact by construction, and no rounding to
// reason about.
#pragma once

#include <array>
#include <cstddef>
#include <stdexcept>

#include "geometry/fixed_int.hpp"

namespace mesher::predicates::detail {

/// The coordinates of N points, one point after the other.
template <std::size_t D, std::size_t N>
using Coordinates = std::array<double, D * N>;

/// Those of the difference of each point but the last to the last.
template <std::size_t W, std::size_t D, std::size_t N>
using Differences = std::array<FixedInt<W>, D*(N - 1)>;

/// The differences d must satisfy |d| < 2^(64 W - 2) =: B.
/// In the plane: |x0 y1 - y0 x1| < 2 B^2 = 2^(128 W - 3). Minors and lifts of incircle have the
/// same bound, and the sum of three of their products is below 12 B^4 < 2^(256 W - 4). Both fit the
/// sign bit of 2W and 4W limbs.
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

/// Whether d = fl(a - b) is a - b: its rounding error is (v - b) + (a - fl(d + v)) with
/// v = fl(a - d) [Knuth, TAOCP 2, 4.2.2 Theorem B], which is 0 + 0 here.
inline bool is_exact_difference(double a, double b, double d) { return a - d == b && d + b == a; }

template <std::size_t W, std::size_t D, std::size_t N, class F>
auto from_coordinates(const Coordinates<D, N>& p, int low, F f) {
  std::array<FixedInt<W>, D> last;
  for (std::size_t i = 0; i < D; ++i) last[i] = to_fixed<W>(p[D * (N - 1) + i], low);
  Differences<W, D, N> d;
  for (std::size_t i = 0; i < d.size(); ++i) d[i] = to_fixed<W>(p[i], low) - last[i % D];
  return f(d, low);
}

/// Out of line, so that the short way below stays short.
template <std::size_t D, std::size_t N, class F>
[[gnu::noinline]] auto from_coordinates(const Coordinates<D, N>& p, F f) {
  const BitRange range(p);
  if (range.width() <= kCoordinateBits<1>) {
    return from_coordinates<1, D, N>(p, range.low, f);
  }
  if (range.width() <= kCoordinateBits<2>) {
    return from_coordinates<2, D, N>(p, range.low, f);
  }
  if (range.width() <= kCoordinateBits<4>) {
    return from_coordinates<4, D, N>(p, range.low, f);
  }
  throw std::domain_error("predicate of coordinates out of the range 2^-100 to 2^100");
}

/// f(differences, low) for integers just wide enough, in units of 2^low; they are an array of
/// FixedInt<1>, 2 or 4.
template <std::size_t D, std::size_t N, class F>
auto with_integers(const Coordinates<D, N>& p, F f) {
  std::array<double, D*(N - 1)> d;
  bool exact = true;
  for (std::size_t i = 0; i < d.size(); ++i) {
    const double last = p[D * (N - 1) + i % D];
    d[i] = p[i] - last;
    exact &= is_exact_difference(p[i], last, d[i]);
  }
  if (!exact) return from_coordinates<D, N>(p, f);
  const BitRange range(d);
  if (range.width() > kDifferenceBits<1>) return from_coordinates<D, N>(p, f);
  Differences<1, D, N> integers;
  for (std::size_t i = 0; i < d.size(); ++i) integers[i] = to_fixed<1>(d[i], range.low);
  return f(integers, range.low);
}

/// sign_of(differences): a determinant's sign does not depend on the unit.
template <std::size_t D, std::size_t N, class SignOf>
int exact_sign(const Coordinates<D, N>& p, SignOf sign_of) {
  return with_integers<D, N>(p, [&](const auto& d, int) { return sign_of(d); });
}

}  // namespace mesher::predicates::detail
