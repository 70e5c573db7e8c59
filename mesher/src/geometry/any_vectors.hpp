// Vectors in more than three dimensions.
#pragma once

#include <array>
#include <cstddef>

namespace mesher::detail {

template <std::size_t N>
requires(N > 3) [[nodiscard]] std::array<double, N> plus(const std::array<double, N>& a,
                                                         const std::array<double, N>& b) {
  std::array<double, N> sum;
  for (std::size_t i = 0; i < N; ++i) sum[i] = a[i] + b[i];
  return sum;
}
template <std::size_t N>
requires(N > 3) [[nodiscard]] std::array<double, N> minus(const std::array<double, N>& a,
                                                          const std::array<double, N>& b) {
  std::array<double, N> difference;
  for (std::size_t i = 0; i < N; ++i) difference[i] = a[i] - b[i];
  return difference;
}
template <std::size_t N>
requires(N > 3)
    [[nodiscard]] std::array<double, N> scaled(double s, const std::array<double, N>& a) {
  std::array<double, N> product;
  for (std::size_t i = 0; i < N; ++i) product[i] = s * a[i];
  return product;
}
template <std::size_t N>
requires(N > 3)
    [[nodiscard]] double dot(const std::array<double, N>& a, const std::array<double, N>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < N; ++i) sum += a[i] * b[i];
  return sum;
}
template <std::size_t N>
requires(N > 3) [[nodiscard]] double squared(const std::array<double, N>& a) { return dot(a, a); }
template <std::size_t N>
requires(N > 3) [[nodiscard]] double squared_distance(const std::array<double, N>& a,
                                                      const std::array<double, N>& b) {
  return squared(minus(a, b));
}

}  // namespace mesher::detail
