// What is around an edge of a triangulation.
#pragma once

#include <cstdint>
#include <vector>

#include "delaunay/facets.hpp"
#include "delaunay/kernel.hpp"

namespace mesher::detail {

/// Whether an edge is there, and of which vertex of the simplices around it something is true.
struct AtEdge {
  bool is_there = false;
  std::uint32_t by = kNone;
};

/// Of the edge ab: the first vertex, but its ends, of which encroaches(w). If that is asked of a
/// ball around ab, and any vertex is in it, one of these is. `star`: scratch. Cost: O(star of a).
template <class Kernel, class Encroaches>
[[nodiscard]] AtEdge look_at_edge(Kernel& kernel, std::uint32_t a, std::uint32_t b,
                                  std::vector<std::uint32_t>& star, Encroaches&& encroaches) {
  AtEdge at;
  kernel.find_in_star(a, star, [](std::uint32_t) { return false; });
  for (const std::uint32_t s : star) {
    const auto& corners = kernel.simplices().corners(s);
    if (corner_of(corners, b) == corners.size()) continue;
    at.is_there = true;
    for (const std::uint32_t w : corners) {
      if (w == a || w == b || w == kInfinite || !encroaches(w)) continue;
      at.by = w;
      return at;
    }
  }
  return at;
}

}  // namespace mesher::detail
