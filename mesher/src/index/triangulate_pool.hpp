// The triangulation of all vertices of a pool, at once.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "delaunay/bulk.hpp"
#include "records/vertex.hpp"

namespace mesher::detail {

/// Of the vertices that are alive, corners called by their handles; calls step() for each.
template <int D, class Step>
[[nodiscard]] FlatTriangulation<D> triangulate(const VertexPool<D>& pool, Step&& step) {
  std::vector<VertexHandle> handles;
  std::vector<Point<D>> places;
  pool.for_each([&](const Vertex<D>& v) {
    if (!v.alive) return;
    handles.push_back(v.self);
    places.push_back(v.p);
  });
  return triangulate<D>(
      std::span<const Point<D>>(places), [&](std::uint32_t i) { return handles[i]; },
      [](std::uint32_t, std::uint32_t) {}, std::forward<Step>(step));
}

}  // namespace mesher::detail
