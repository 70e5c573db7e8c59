// The exact side of predicates of shrunken balls.
//
// Differences get a limb more than exact_sign() found them to need, so that no sum of their
// products overflows: in W + 1 limbs they are below 2^(64 (W + 1) - 66), and a polynomial here has
// fewer than 2^60 monomials with its factors.
#include <stdexcept>

#include "geometry/exact_sign.hpp"
#include "mesher/predicates.hpp"

namespace mesher::predicates::detail {

namespace {

template <std::size_t W>
using Vector = std::array<FixedInt<W>, 3>;

/// The last limb says the sign alone.
template <std::size_t W>
FixedInt<W + 1> wider(const FixedInt<W>& x) {
  return x * FixedInt<1>{{1}};
}
/// The i-th difference, in the plane with z = 0.
template <int D, std::size_t W, std::size_t N>
Vector<W + 1> vector(const std::array<FixedInt<W>, N>& d, std::size_t i) {
  Vector<W + 1> v;
  for (std::size_t axis = 0; axis < D; ++axis) v[axis] = wider(d[D * i + axis]);
  return v;
}
template <std::size_t V, std::size_t W>
FixedInt<V + W> dot(const Vector<V>& a, const Vector<W>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
template <std::size_t W>
FixedInt<2 * W> squared(const Vector<W>& a) {
  return dot(a, a);
}
template <std::size_t V, std::size_t W>
Vector<V + W> cross(const Vector<V>& a, const Vector<W>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
template <std::size_t V, std::size_t W>
Vector<V + W> times(const FixedInt<V>& x, const Vector<W>& a) {
  return {x * a[0], x * a[1], x * a[2]};
}
template <std::size_t W>
Vector<W> operator+(const Vector<W>& a, const Vector<W>& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
template <std::size_t W>
Vector<W> operator-(const Vector<W>& a, const Vector<W>& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
template <std::size_t W>
FixedInt<W> four_times(const FixedInt<W>& x) {
  const FixedInt<W> twice = x + x;
  return twice + twice;
}

/// k^2 as square / unit.
struct Factor {
  explicit Factor(double k) {
    if (k == 0) {
      unit.limb[0] = 1;
      return;
    }
    if (!(k >= 0x1p-10 && k <= 1)) throw std::domain_error("factor of a radius out of 2^-10 to 1");
    const Parts parts(k);
    const auto twice = static_cast<std::size_t>(-2 * parts.exponent);  // 104 to 124
    unit.limb[1] = std::uint64_t{1} << (twice - 64);
    FixedInt<1> fraction;
    fraction.limb[0] = parts.fraction;
    square = fraction * fraction;
  }
  FixedInt<2> square, unit;
};

template <std::size_t D>
void put(const std::array<double, D>& p, double* at) {
  std::copy(p.begin(), p.end(), at);
}
/// The coordinates of points, one after the other.
template <std::size_t D, class... Points>
auto coordinates(const std::array<double, D>& first, const Points&... others) {
  std::array<double, D*(1 + sizeof...(others))> all;
  double* at = all.data();
  put(first, at);
  (put(others, at += D), ...);
  return all;
}

}  // namespace

template <int D>
int in_shrunken_ball_exact(const Point<D>& a, const Point<D>& b, const Point<D>& p, double k) {
  const Factor factor(k);
  return exact_sign<D, 3>(coordinates(a, b, p), [&](const auto& d) {
    const auto u = vector<D>(d, 0), v = vector<D>(d, 1);
    return sign(factor.square * squared(v - u) - factor.unit * squared(u + v));
  });
}

template <int D>
int in_shrunken_ball_exact(const Point<D>& a, const Point<D>& b, const Point<D>& c,
                           const Point<D>& p, double k) {
  const Factor factor(k);
  return exact_sign<D, 4>(coordinates(b, c, p, a), [&](const auto& d) {
    const auto e = vector<D>(d, 0), f = vector<D>(d, 1), w = vector<D>(d, 2);
    const auto n = cross(e, f);
    const auto e2 = squared(e), f2 = squared(f);
    const auto q = times(e2, cross(f, n)) + times(f2, cross(n, e));
    const auto lengths = e2 * f2 * squared(f - e);
    const auto without_k = four_times(dot(w, q) - squared(n) * squared(w)) - lengths;
    return sign(factor.unit * without_k + factor.square * lengths);
  });
}

int in_shrunken_ball_exact(const Point<3>& a, const Point<3>& b, const Point<3>& c,
                           const Point<3>& d, const Point<3>& p, double k) {
  const Factor factor(k);
  return exact_sign<3, 5>(coordinates(b, c, d, p, a), [&](const auto& differences) {
    const auto e = vector<3>(differences, 0), f = vector<3>(differences, 1);
    const auto g = vector<3>(differences, 2), w = vector<3>(differences, 3);
    const auto fg = cross(f, g);
    const auto t = dot(e, fg);
    const auto q =
        times(squared(e), fg) + times(squared(f), cross(g, e)) + times(squared(g), cross(e, f));
    const auto q2 = squared(q);
    const auto without_k = four_times(t * (dot(w, q) - t * squared(w))) - q2;
    return sign(factor.unit * without_k + factor.square * q2);
  });
}

template int in_shrunken_ball_exact<2>(const Point<2>&, const Point<2>&, const Point<2>&, double);
template int in_shrunken_ball_exact<2>(const Point<2>&, const Point<2>&, const Point<2>&,
                                       const Point<2>&, double);
#ifndef MESHER_PLANE_ONLY
template int in_shrunken_ball_exact<3>(const Point<3>&, const Point<3>&, const Point<3>&, double);
template int in_shrunken_ball_exact<3>(const Point<3>&, const Point<3>&, const Point<3>&,
                                       const Point<3>&, double);
#endif

}  // namespace mesher::predicates::detail
