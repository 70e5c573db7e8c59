// Of many points at once.
#include "mesher/delaunay.hpp"

#include <algorithm>
#include <utility>

#include "delaunay/bulk.hpp"
#include "delaunay/check_places.hpp"

namespace mesher {

template <int D>
Delaunay<D> delaunay(std::span<const Point<D>> points) {
  detail::check_places<D>(points);
  Delaunay<D> result;
  auto flat = detail::triangulate<D>(
      points, [](std::uint32_t i) { return i; },
      [&](std::uint32_t i, std::uint32_t original) {
        result.duplicates.push_back({i, original});
      },
      [] {});
  result.simplices = std::move(flat.simplices);
  result.neighbours = std::move(flat.neighbours);
  std::sort(result.duplicates.begin(), result.duplicates.end());
  return result;
}

template Delaunay<2> delaunay<2>(std::span<const Point<2>>);
#ifndef MESHER_PLANE_ONLY
template Delaunay<3> delaunay<3>(std::span<const Point<3>>);
#endif

}  // namespace mesher
