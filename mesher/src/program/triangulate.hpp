// Triangulate [§4.3.1]: the Delaunay star of every vertex is a call.
//
// Exact predicates with ties decided by coordinates make the Delaunay triangulation unique, so the
// three vertices of a triangle agree on it; it is output by the one with the smallest coordinates.
#pragma once

#include "program/world.hpp"

namespace mesher::detail {

struct Star {
  static constexpr std::string_view kName = "star";
  template <class S>
  void operator()(S& s, VertexRef<2> v) const {
    auto& w = s.template environment<World<S>>();
    w.output(s, v, *w.vertices.star(s, v));
  }
};
inline constexpr Star star{};

[[nodiscard]] inline sac::Key star_key(const Fixed<2>& f) { return {.order = morton<2>(f)}; }

/// Calls emit(triangle) for each triangle of v's star that v outputs: its corners counterclockwise,
/// v first. v has m neighbours, counterclockwise: code(i) is a handle or a virtual neighbour, which
/// bounds nothing; place(i) is asked of handles only.
template <class Code, class Place, class Emit>
void for_each_own_triangle(const Vertex<2>& v, int m, Code&& code, Place&& place, Emit&& emit) {
  const auto later = [&](int i) {
    return code(i) < VoronoiCell::kVirtual && v.p < place(i);
  };
  for (int i = 0; i < m; ++i) {
    const int j = i + 1 == m ? 0 : i + 1;
    if (later(i) && later(j)) emit(std::array<VertexHandle, 3>{v.self, code(i), code(j)});
  }
}

/// The same for a recorded star.
template <class Emit>
void for_each_own_triangle(const VertexPool<2>& pool, const Vertex<2>& v,
                           const std::uint32_t* ring, int m, Emit&& emit) {
  for_each_own_triangle(
      v, m, [&](int i) { return ring[i]; }, [&](int i) { return pool[ring[i]].p; }, emit);
}

}  // namespace mesher::detail
