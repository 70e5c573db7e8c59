// Measures of single cells.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "livemesh.h"
#include "mesher/mesh.hpp"

namespace lm {

template <int D>
using Corners = std::array<mesher::Point<D>, D + 1>;

namespace detail {

inline constexpr double kDegrees = 180 / std::numbers::pi;

template <std::size_t N>
[[nodiscard]] std::array<double, N> between(const std::array<double, N>& a,
                                            const std::array<double, N>& b) noexcept {
  std::array<double, N> v;
  for (std::size_t i = 0; i < N; ++i) v[i] = b[i] - a[i];
  return v;
}
template <std::size_t N>
[[nodiscard]] double dot(const std::array<double, N>& u, const std::array<double, N>& v) noexcept {
  double sum = 0;
  for (std::size_t i = 0; i < N; ++i) sum += u[i] * v[i];
  return sum;
}
template <std::size_t N>
[[nodiscard]] double length(const std::array<double, N>& u) noexcept {
  return std::sqrt(dot(u, u));
}
[[nodiscard]] inline mesher::Point<3> cross(const mesher::Point<3>& u,
                                            const mesher::Point<3>& v) noexcept {
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}
/// The length of the product of two vectors: twice the area between them.
[[nodiscard]] inline double area(const mesher::Point<2>& u, const mesher::Point<2>& v) noexcept {
  return std::abs(u[0] * v[1] - u[1] * v[0]);
}
[[nodiscard]] inline double area(const mesher::Point<3>& u, const mesher::Point<3>& v) noexcept {
  return length(cross(u, v));
}
/// The angle at b, degrees.
template <std::size_t N>
[[nodiscard]] double angle(const std::array<double, N>& a, const std::array<double, N>& b,
                           const std::array<double, N>& c) noexcept {
  const auto u = between(b, a), v = between(b, c);
  return std::atan2(area(u, v), dot(u, v)) * kDegrees;
}

}  // namespace detail

[[nodiscard]] inline double measure_of(const Corners<2>& t) noexcept {
  return detail::area(detail::between(t[0], t[1]), detail::between(t[0], t[2])) / 2;
}
[[nodiscard]] inline double measure_of(const Corners<3>& t) noexcept {
  using namespace detail;
  return std::abs(dot(between(t[0], t[1]), cross(between(t[0], t[2]), between(t[0], t[3])))) / 6;
}

template <std::size_t N>
[[nodiscard]] double shortest_edge(const std::array<std::array<double, N - 1>, N>& t) noexcept {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < N; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      least = std::min(least, detail::length(detail::between(t[i], t[j])));
    }
  }
  return least;
}

/// Circumradius over shortest edge; infinite for a cell without measure.
[[nodiscard]] inline double radius_edge_of(const Corners<2>& t) noexcept {
  using namespace detail;
  const double product =
      length(between(t[0], t[1])) * length(between(t[1], t[2])) * length(between(t[2], t[0]));
  return product / (4 * measure_of(t)) / shortest_edge(t);
}
[[nodiscard]] inline double radius_edge_of(const Corners<3>& t) noexcept {
  using namespace detail;
  // With opposite edges a a', b b', c c': 24 R V = sqrt((p+q+r)(-p+q+r)(p-q+r)(p+q-r)), p = a a'.
  const auto product = [&](int i, int j, int k, int l) {
    return length(between(t[i], t[j])) * length(between(t[k], t[l]));
  };
  const double p = product(0, 1, 2, 3), q = product(0, 2, 1, 3), r = product(0, 3, 1, 2);
  const double square = (p + q + r) * (-p + q + r) * (p - q + r) * (p + q - r);
  return std::sqrt(std::max(square, 0.0)) / (24 * measure_of(t)) / shortest_edge(t);
}

/// Calls visit(degrees) for each angle of a triangle, or of the faces of a tetrahedron.
template <std::size_t N, class Visit>
void for_each_angle(const std::array<std::array<double, N - 1>, N>& t, Visit&& visit) {
  for (std::size_t i = 0; i < N; ++i) {
    for (std::size_t j = 0; j < N; ++j) {
      for (std::size_t k = 0; k < j; ++k) {
        if (i != j && i != k) visit(detail::angle(t[j], t[i], t[k]));
      }
    }
  }
}

/// Calls visit(degrees) for each dihedral angle of a tetrahedron.
template <class Visit>
void for_each_dihedral(const Corners<3>& t, Visit&& visit) {
  using namespace detail;
  constexpr std::array<std::array<std::size_t, 4>, 6> kEdges{
      {{0, 1, 2, 3}, {0, 2, 1, 3}, {0, 3, 1, 2}, {1, 2, 0, 3}, {1, 3, 0, 2}, {2, 3, 0, 1}}};
  for (const auto& [i, j, k, l] : kEdges) {
    const auto edge = between(t[i], t[j]);
    const auto u = cross(edge, between(t[i], t[k])), v = cross(edge, between(t[i], t[l]));
    visit(std::atan2(length(cross(u, v)), dot(u, v)) * kDegrees);
  }
}

/// Requires: the measure exists in this dimension.
template <int D>
[[nodiscard]] double quality_of(const Corners<D>& t, std::int32_t measure) {
  if (measure == LM_CELL_MEASURE) return measure_of(t);
  if (measure == LM_RADIUS_EDGE_RATIO) return radius_edge_of(t);
  double least = 180, most = 0;
  const auto visit = [&](double degrees) {
    least = std::min(least, degrees);
    most = std::max(most, degrees);
  };
  if (measure == LM_MIN_ANGLE || measure == LM_MAX_ANGLE) {
    for_each_angle(t, visit);
  } else if constexpr (D == 3) {
    for_each_dihedral(t, visit);
  }
  return measure == LM_MIN_ANGLE || measure == LM_MIN_DIHEDRAL ? least : most;
}

}  // namespace lm
