// Of many points at once.
#include "mesher/delaunay.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include "delaunay/build.hpp"
#include "delaunay/check_place.hpp"
#include "delaunay/spatial_order.hpp"

namespace mesher {

namespace {

/// The points in the order of insertion, as vertices 1, 2, ...; those that are equal to others are
/// appended to `duplicates`.
template <int D>
detail::SimplexStore<D> simplices_of(std::span<const Point<D>> points,
                                     const std::vector<std::uint32_t>& order,
                                     std::vector<typename Delaunay<D>::Duplicate>& duplicates) {
  detail::DelaunayKernel<D> kernel;
  kernel.reserve(points.size());
  for (const std::uint32_t i : order) kernel.add_place(points[i]);
  std::vector<std::uint32_t> vertices(order.size());
  for (std::uint32_t k = 0; k < vertices.size(); ++k) vertices[k] = k + 1;
  detail::build<D>(kernel, vertices, [&](std::uint32_t v, std::uint32_t equal) {
    duplicates.push_back({order[v - 1], order[equal - 1]});
  });
  return std::move(kernel).release();
}

}  // namespace

template <int D>
Delaunay<D> delaunay(std::span<const Point<D>> points) {
  for (std::size_t i = 0; i < points.size(); ++i) detail::check_place<D>(points[i], i + 1);
  const std::vector<std::uint32_t> order = detail::spatial_order<D>(points);
  Delaunay<D> result;
  auto store = simplices_of<D>(points, order, result.duplicates);
  std::sort(result.duplicates.begin(), result.duplicates.end());
  std::tie(result.simplices, result.neighbours) =
      detail::without_ghosts(std::move(store), [&](std::uint32_t v) { return order[v - 1]; });
  return result;
}

template Delaunay<2> delaunay<2>(std::span<const Point<2>>);
template Delaunay<3> delaunay<3>(std::span<const Point<3>>);

}  // namespace mesher
