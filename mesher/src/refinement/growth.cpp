// Sizes of vertices.
#include "refinement/growth.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/plane_vectors.hpp"
#include "geometry/space_vectors.hpp"

namespace mesher::detail {

namespace {

constexpr double kAnySize = std::numeric_limits<double>::infinity();

}  // namespace

template <int D>
double Growth<D>::at(const Kernel& kernel, std::uint32_t s, const Point<D>& p) const {
  double size = kAnySize;
  for (const std::uint32_t v : kernel.simplices().corners(s)) {
    size = std::min(size, size_[v] + slope_ * std::sqrt(squared_distance(kernel.place(v), p)));
  }
  return size;
}

template <int D>
double Growth<D>::least(const Kernel& kernel, std::uint32_t s) const {
  double size = kAnySize;
  for (const std::uint32_t v : kernel.simplices().corners(s)) size = std::min(size, size_[v]);
  return size;
}

template <int D>
void Growth<D>::start(const Kernel& kernel) {
  size_.assign(kernel.places() + 1, kAnySize);
  kernel.for_each_finite([&](std::uint32_t s) {
    const auto& corners = kernel.simplices().corners(s);
    double longest2 = 0;
    for (std::size_t i = 0; i <= D; ++i) {
      for (std::size_t k = 0; k < i; ++k) {
        longest2 = std::max(longest2,
                            squared_distance(kernel.place(corners[i]), kernel.place(corners[k])));
      }
    }
    const double longest = std::sqrt(longest2);
    for (const std::uint32_t v : corners) size_[v] = std::min(size_[v], longest);
  });
  for (std::uint32_t v = 1; v < size_.size(); ++v) lowered_.push({size_[v], v});
}

template <int D>
void Growth<D>::lower(std::uint32_t v, double size) {
  if (!(size < size_[v])) return;
  size_[v] = size;
  lowered_.push({size, v});
}

template <int D>
void Growth<D>::bound(const Kernel& kernel, std::uint32_t s, double size) {
  for (const std::uint32_t v : kernel.simplices().corners(s)) lower(v, size);
}

template <int D>
void Growth<D>::add_dug(const Kernel& kernel, std::uint32_t v, double size) {
  size_.resize(kernel.places() + 1, kAnySize);
  const auto grown = [&](double from, std::uint32_t w) {
    return from + slope_ * std::sqrt(squared_distance(kernel.place(v), kernel.place(w)));
  };
  kernel.for_each_in_link([&](std::uint32_t w) {
    if (w != kInfinite) size = std::min(size, grown(size_[w], w));
  });
  size_[v] = size;
  bool lowers = false;
  kernel.for_each_in_link(
      [&](std::uint32_t w) { lowers = lowers || (w != kInfinite && grown(size, w) < size_[w]); });
  if (lowers) lowered_.push({size, v});
}

template class Growth<2>;
#ifndef MESHER_PLANE_ONLY
template class Growth<3>;
#endif

}  // namespace mesher::detail
