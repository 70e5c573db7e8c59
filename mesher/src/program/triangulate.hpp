// Triangulate [§4.3.1]. With the engine, in the plane and in space, the triangulation of all
// vertices is kept from update to update (index/kept_triangulation.hpp); in a static run all
// vertices are triangulated at once. Beyond space the Delaunay star of every vertex is a call.
//
// Exact predicates with ties decided by coordinates make the Delaunay triangulation unique, so all
// give the same simplices, and the vertices of a simplex agree on it; of their stars it is output
// by the one with the smallest coordinates.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "index/triangulate_pool.hpp"
#include "program/world.hpp"

namespace mesher::detail {

struct Star {
  static constexpr std::string_view kName = "star";
  template <class S, int D>
  void operator()(S& s, VertexRef<D> v) const {
    auto& w = s.template environment<World<S, D>>();
    static_cast<void>(w.vertices.star(s, v));  // recorded: the output, or what a tile asks
  }
};
inline constexpr Star star{};

template <std::size_t N>
[[nodiscard]] sac::Key star_key(const std::array<std::uint64_t, N>& f) {
  return {.order = morton<N>(f)};
}

/// Calls emit(simplex) for each simplex of v's star, as it was written down, that v outputs: its
/// corners positively oriented, v first. Virtual neighbours bound nothing.
template <int D, class Emit>
void for_each_own_simplex(const VertexPool<D>& pool, const Vertex<D>& v,
                          std::span<const std::uint32_t> record, Emit&& emit) {
  CellOf<D>::for_each_link_simplex(record, [&](const std::array<std::uint32_t, D>& ends) {
    std::array<VertexHandle, D + 1> simplex{v.self};
    bool is_own = true;
    for (std::size_t k = 0; k < D; ++k) {
      is_own = is_own && ends[k] < CellOf<D>::kVirtual && v.p < pool[ends[k]].p;
      simplex[k + 1] = ends[k];
    }
    if (is_own) emit(simplex);
  });
}

/// The simplices of all vertices; ticks once for each.
template <int D>
void triangulate_at_once(const VertexPool<D>& pool, PlainOutput<D>& plain) {
  plain.simplices = triangulate(pool, [&] { plain.tick(); }).simplices;
}
/// The same beyond space, star by star.
template <int D>
void triangulate_star_by_star(sac::PlainScope& s, VertexIndex<sac::PlainScope, D>& vertices,
                              PlainOutput<D>& plain) {
  std::vector<std::uint32_t> record;
  vertices.pool().for_each([&](Vertex<D>& v) {
    plain.tick();
    vertices.star(s, {&v})->write(record);
    for_each_own_simplex(vertices.pool(), v, record,
                         [&](const auto& simplex) { plain.simplices.push_back(simplex); });
  });
}

}  // namespace mesher::detail
