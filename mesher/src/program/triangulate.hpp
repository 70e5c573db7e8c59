// Triangulate [§4.3.1]: the Delaunay star of every vertex is a call.
//
// Exact predicates with ties decided by coordinates make the Delaunay triangulation unique, so the
// vertices of a simplex agree on it; it is output by the one with the smallest coordinates.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "program/world.hpp"

namespace mesher::detail {

struct Star {
  static constexpr std::string_view kName = "star";
  template <class S, int D>
  void operator()(S& s, VertexRef<D> v) const {
    auto& w = s.template environment<World<S, D>>();
    w.output(s, v, *w.vertices.star(s, v));
  }
};
inline constexpr Star star{};

template <std::size_t N>
[[nodiscard]] sac::Key star_key(const std::array<std::uint64_t, N>& f) {
  return {.order = morton<N>(f)};
}

/// Calls emit(simplex) for each simplex of v's star that v outputs: its corners positively
/// oriented, v first. Virtual neighbours bound nothing.
template <int D, class Emit>
void for_each_own_simplex(const Vertex<D>& v, const CellOf<D>& cell, Emit&& emit) {
  for (int t = 0; t < cell.corners(); ++t) {
    std::array<VertexHandle, D + 1> simplex{v.self};
    bool own = true;
    for (std::size_t k = 0; k < D; ++k) {
      const int i = cell.ends(t)[k];
      own = own && cell.real(i) && v.p < cell.place(i);
      simplex[k + 1] = cell.handle(i);
    }
    if (own) emit(simplex);
  }
}

/// The same for a star that was written down.
template <int D, class Emit>
void for_each_own_simplex(const VertexPool<D>& pool, const Vertex<D>& v,
                          std::span<const std::uint32_t> record, Emit&& emit) {
  CellOf<D>::for_each_link_simplex(record, [&](const std::array<std::uint32_t, D>& ends) {
    std::array<VertexHandle, D + 1> simplex{v.self};
    bool own = true;
    for (std::size_t k = 0; k < D; ++k) {
      own = own && ends[k] < CellOf<D>::kVirtual && v.p < pool[ends[k]].p;
      simplex[k + 1] = ends[k];
    }
    if (own) emit(simplex);
  });
}

}  // namespace mesher::detail
