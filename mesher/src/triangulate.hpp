// Triangulate [§4.3.1]: the Delaunay star of every vertex is a call.
//
// Exact predicates with ties decided by coordinates make the Delaunay triangulation unique, so the
// three vertices of a triangle agree on it; it is output by the one with the smallest coordinates.
#pragma once

#include "world.hpp"

namespace mesher::detail {

struct Star {
  static constexpr std::string_view kName = "star";
  template <class S>
  void operator()(S& s, VertexRef<2> v) const {
    auto& w = s.template environment<World<S>>();
    w.output(s, v, w.vertices.star(s, v));
  }
};
inline constexpr Star star{};

[[nodiscard]] inline sac::Key star_key(const Fixed<2>& f) { return {.order = morton<2>(f)}; }

/// Calls emit(triangle) for each triangle of v's star that v outputs: its corners counterclockwise,
/// v first. `ring`: the m neighbours of v counterclockwise; virtual ones bound nothing.
template <class Emit>
void for_each_own_triangle(const VertexPool<2>& pool, const Vertex<2>& v,
                           const std::uint32_t* ring, int m, Emit&& emit) {
  for (int i = 0; i < m; ++i) {
    const std::uint32_t a = ring[i];
    const std::uint32_t b = ring[i + 1 == m ? 0 : i + 1];
    if (a >= VoronoiCell::kVirtual || b >= VoronoiCell::kVirtual) continue;
    if (pool[a].p < v.p || pool[b].p < v.p) continue;
    emit(std::array<VertexHandle, 3>{v.self, a, b});
  }
}

}  // namespace mesher::detail
