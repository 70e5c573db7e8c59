// Balls through D + 1 points in any dimension: their centres, and exact in-ball tests.
//
// For few dimensions, and few calls, since a filter decides nearly all. In the integers of
// exact_sign.hpp, with B as there: a determinant of K differences is below K! B^K, a lift below D
// B^2. For D = 4 that is 24 B^4 < 2^(256 W - 3), 4 B^2 < 2^(128 W - 1); the sum of four products of
// a lift and a minor is below 96 B^5 < 2^(320 W - 3), that of five of a lift and a determinant
// below 480 B^6 < 2^(384 W - 3): all fit the limbs of their factors.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "geometry/exact_sign.hpp"
#include "mesher/mesh.hpp"

namespace mesher::detail {

template <class T, std::size_t K>
using Matrix = std::array<std::array<T, K>, K>;

/// Without a row and a column.
template <class T, std::size_t K>
[[nodiscard]] Matrix<T, K - 1> without(const Matrix<T, K>& m, std::size_t row, std::size_t column) {
  Matrix<T, K - 1> rest;
  for (std::size_t i = 0; i + 1 < K; ++i) {
    for (std::size_t j = 0; j + 1 < K; ++j) rest[i][j] = m[i + (i >= row)][j + (j >= column)];
  }
  return rest;
}

/// The minors of two rows of four, by columns 01, 02, 03, 12, 13, 23.
template <class T>
[[nodiscard]] auto pair_minors(const std::array<T, 4>& a, const std::array<T, 4>& b) {
  const auto minor = [&](std::size_t i, std::size_t k) { return a[i] * b[k] - a[k] * b[i]; };
  return std::array{minor(0, 1), minor(0, 2), minor(0, 3), minor(1, 2), minor(1, 3), minor(2, 3)};
}

/// Along the first column, or of four rows by pairs; of integers with as many limbs as the product
/// needs.
template <class T, std::size_t K>
[[nodiscard]] auto determinant(const Matrix<T, K>& m) {
  if constexpr (K == 1) {
    return m[0][0];
  } else if constexpr (K == 4) {
    const auto s = pair_minors(m[0], m[1]), t = pair_minors(m[2], m[3]);
    return s[0] * t[5] - s[1] * t[4] + s[2] * t[3] + s[3] * t[2] - s[4] * t[1] + s[5] * t[0];
  } else {
    auto sum = m[0][0] * determinant(without(m, 0, 0));
    for (std::size_t i = 1; i < K; ++i) {
      const auto term = m[i][0] * determinant(without(m, i, 0));
      sum = i % 2 == 0 ? sum + term : sum - term;
    }
    return sum;
  }
}

template <class T, std::size_t K>
[[nodiscard]] auto lift(const std::array<T, K>& x) {
  auto sum = x[0] * x[0];
  for (std::size_t i = 1; i < K; ++i) sum = sum + x[i] * x[i];
  return sum;
}

/// D points, and one more.
template <int D>
using BallCorners = std::array<Point<D>, D>;

/// f(rows, low): of `points` relative to the last of them, in integers just wide enough, in units
/// of 2^low.
template <int D, std::size_t N, class F>
auto with_rows(const std::array<Point<D>, N>& points, F f) {
  predicates::detail::Coordinates<D, N> coordinates;
  for (std::size_t i = 0; i < N; ++i) {
    std::copy(points[i].begin(), points[i].end(), coordinates.begin() + D * i);
  }
  return predicates::detail::with_integers<D, N>(coordinates, [&](const auto& d, int low) {
    std::array<std::array<std::decay_t<decltype(d[0])>, D>, N - 1> rows;
    for (std::size_t i = 0; i + 1 < N; ++i) {
      std::copy_n(d.begin() + D * i, D, rows[i].begin());
    }
    return f(rows, low);
  });
}

/// The sign of the determinant of the points relative to the last. On grids most that are in one
/// hyperplane are so across an axis, which needs no arithmetic; a determinant in doubles is off by
/// less than 384 u times the product of the distances (ball_any.cpp).
template <int D>
[[nodiscard]] int orientation(const std::array<Point<D>, D + 1>& points) {
  static_assert(D <= 4);
  for (std::size_t i = 0; i < D; ++i) {
    const auto is_level = [&](const Point<D>& p) { return p[i] == points[D][i]; };
    if (std::all_of(points.begin(), points.end(), is_level)) return 0;
  }
  Matrix<double, D> near;
  double spread2 = 1;
  for (std::size_t i = 0; i < D; ++i) {
    for (std::size_t k = 0; k < D; ++k) near[i][k] = points[i][k] - points[D][k];
    spread2 *= lift(near[i]);
  }
  const double about = determinant(near);
  if (about * about > 0x1p-86 * spread2) return about > 0 ? 1 : -1;
  return with_rows<D>(points, [](const auto& rows, int) { return sign(determinant(rows)); });
}

/// Whether all points are corners of one box with sides along the axes, hence on one sphere: on
/// grids most ties are of this kind.
template <int D, std::size_t N>
[[nodiscard]] bool are_corners_of_box(const std::array<Point<D>, N>& points) {
  for (std::size_t i = 0; i < D; ++i) {
    const double one = points[0][i];
    double other = one;
    for (const Point<D>& p : points) {
      if (p[i] == one || p[i] == other) continue;
      if (other != one) return false;
      other = p[i];
    }
  }
  return true;
}

/// Whether w is in the ball of v and the corners, around which v is positively oriented: 1 inside,
/// -1 outside, 0 on the sphere.
template <int D>
[[nodiscard]] int in_ball(const Point<D>& v, const BallCorners<D>& corners, const Point<D>& w) {
  std::array<Point<D>, D + 2> points;
  std::copy(corners.begin(), corners.end(), points.begin());
  points[D] = w, points[D + 1] = v;
  if (are_corners_of_box<D>(points)) return 0;
  return with_rows<D>(points, [](const auto& rows, int) {
    using Row = std::decay_t<decltype(rows[0])>;
    const auto without_row = [&](std::size_t k) {
      std::array<Row, D> rest;
      for (std::size_t i = 0; i < D; ++i) rest[i] = rows[i + (i >= k)];
      return determinant(rest);
    };
    auto sum = lift(rows[D]) * without_row(D);
    for (std::size_t i = 0; i < D; ++i) {
      const auto term = lift(rows[i]) * without_row(i);
      sum = (i + D) % 2 == 0 ? sum + term : sum - term;
    }
    return -sign(sum);
  });
}

/// The same where points on the sphere are decided by coordinates: as if each were lifted by an
/// infinitesimal, of a higher order the smaller it is, so that the greatest is outside. That is the
/// sign of the first height's cofactor that is not 0. The cofactor of w is the orientation of the
/// corners; two points that are swapped flip the sign. 0: all are in one hyperplane.
template <int D>
[[nodiscard]] int in_ball_perturbed(const Point<D>& v, const BallCorners<D>& corners,
                                    const Point<D>& w) {
  if (const int exact = in_ball<D>(v, corners, w); exact != 0) return exact;
  constexpr std::size_t kW = D;
  std::array<Point<D>, D + 2> points;
  std::copy(corners.begin(), corners.end(), points.begin());
  points[kW] = w, points[D + 1] = v;
  std::array<std::size_t, D + 2> order;
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return points[b] < points[a]; });
  for (const std::size_t greatest : order) {
    auto rest = points;
    std::swap(rest[greatest], rest[kW]);
    std::array<Point<D>, D + 1> others;
    std::copy_n(rest.begin(), D, others.begin());
    others[D] = rest[D + 1];
    const int sign = orientation<D>(others);
    if (sign != 0) return greatest == kW ? -sign : sign;
  }
  return 0;
}

template <int D>
struct BallCentre {
  Point<D> q{};           // relative to v
  double length2 = 0;     // |q|^2
  double tolerance2 = 0;  // the square of a bound on the error of 2 w.q, in units of |w|
};

/// The centre of the ball of v and the corners, in whatever order they are: the same to the last
/// bit. As in space (circumcentre.hpp) in doubles where these are good for it, else a quotient of
/// exact integers, rounded once. Requires: they are not in one hyperplane.
template <int D>
[[nodiscard]] BallCentre<D> ball_centre(const Point<D>& v, BallCorners<D> corners);

}  // namespace mesher::detail
