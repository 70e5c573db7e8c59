// A triangulation of many points as flat arrays.
#pragma once

#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "delaunay/build.hpp"
#include "delaunay/facets.hpp"
#include "delaunay/kernel.hpp"
#include "delaunay/spatial_order.hpp"

namespace mesher::detail {

/// Simplices that are no ghosts: corners, positively oriented, and the simplex across from each
/// (kNone on the hull).
template <int D>
struct FlatTriangulation {
  std::vector<typename SimplexStore<D>::Ids> simplices, neighbours;
};

/// Corners are called name(v). Allocates nothing.
template <int D, class Name>
[[nodiscard]] FlatTriangulation<D> without_ghosts(SimplexStore<D> store, Name&& name) {
  using Ids = typename SimplexStore<D>::Ids;
  store.remove_if([](const Ids& c) { return corner_of(c, kInfinite) <= D; });
  FlatTriangulation<D> flat{store.release_corners(), store.release_across()};
  for (Ids& c : flat.simplices) {
    for (std::uint32_t& v : c) v = name(v);
  }
  for (Ids& a : flat.neighbours) {
    for (std::uint32_t& code : a) code = code == kNone ? kNone : code >> 2;
  }
  return flat;
}

/// The triangulation of `points`, corners called name(i) for points[i]. Calls duplicate(i, k) for a
/// point that is equal to an earlier one k, and step() for each point. Vertices are kept in the
/// order of insertion, so that what is near is near in memory.
template <int D, class Name, class Duplicate, class Step>
[[nodiscard]] FlatTriangulation<D> triangulate(std::span<const Point<D>> points, Name&& name,
                                               Duplicate&& duplicate, Step&& step) {
  const std::vector<std::uint32_t> order = spatial_order<D>(points);
  DelaunayKernel<D> kernel;
  kernel.reserve(points.size());
  for (const std::uint32_t i : order) kernel.add_place(points[i]);
  std::vector<std::uint32_t> vertices(order.size());
  std::iota(vertices.begin(), vertices.end(), 1u);
  const auto of = [&](std::uint32_t v) { return order[v - 1]; };
  build<D>(
      kernel, vertices, [&](std::uint32_t v, std::uint32_t w) { duplicate(of(v), of(w)); }, step);
  return without_ghosts<D>(std::move(kernel).release(),
                           [&](std::uint32_t v) { return name(of(v)); });
}

}  // namespace mesher::detail
