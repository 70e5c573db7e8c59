// What is around an edge of a triangulation.
#pragma once

#include <cstdint>
#include <vector>

#include "delaunay/facets.hpp"
#include "delaunay/kernel.hpp"
#include "mesher/predicates.hpp"

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

/// Which simplex has the edge ab, and whether that is known.
struct OnTheWay {
  bool is_known = false;
  std::uint32_t simplex = kNone;  // none: there is no such edge
};

/// By a walk in the star of a, from s on, over facets that b is beyond: in a Delaunay triangulation
/// it does not go in circles. Where b is on the plane of a facet, or the walk leaves the hull,
/// nothing is known. Cost: O(steps).
template <class Kernel>
[[nodiscard]] OnTheWay walk_to_edge(const Kernel& kernel, std::uint32_t s, std::uint32_t a,
                                    std::uint32_t b) {
  constexpr int kMost = 4096;
  for (int steps = 0; steps < kMost; ++steps) {
    if (kernel.is_ghost(s)) return {};
    const auto corners = kernel.simplices().corners(s);
    if (corner_of(corners, b) != corners.size()) return {true, s};
    std::uint32_t next = kNone;
    bool is_inside = true;
    for (std::uint32_t i = 0; i < 4 && next == kNone; ++i) {
      if (corners[i] == a) continue;
      auto with_b = corners;
      with_b[i] = b;
      const auto& [p, q, r, t] = with_b;
      const int side =
          predicates::orient3d(kernel.place(p), kernel.place(q), kernel.place(r), kernel.place(t));
      if (side < 0) next = kernel.simplices().across(s)[i] >> 2;
      is_inside = is_inside && side > 0;
    }
    if (next == kNone) return {is_inside, kNone};
    s = next;
  }
  return {};
}

/// The simplices with the edge ab, in space; none: it is no edge. Cost: O(steps of a walk, and
/// them), or O(star of a) where that says nothing.
template <class Kernel>
void find_at_edge(Kernel& kernel, std::uint32_t a, std::uint32_t b,
                  std::vector<std::uint32_t>& found) {
  const auto has = [&](std::uint32_t s, std::uint32_t v) {
    const auto& corners = kernel.simplices().corners(s);
    return corner_of(corners, v) != corners.size();
  };
  const std::uint32_t first = kernel.find_in_star(a, found, [](std::uint32_t) { return true; });
  const OnTheWay on_the_way = walk_to_edge(kernel, first, a, b);
  if (!on_the_way.is_known) {
    kernel.find_in_star(a, found, [](std::uint32_t) { return false; });
    std::erase_if(found, [&](std::uint32_t s) { return !has(s, b); });
    return;
  }
  found.clear();
  if (on_the_way.simplex == kNone) return;
  std::uint32_t s = on_the_way.simplex, leaves = kNone;  // the corner that the next one has not
  do {
    found.push_back(s);
    const auto& corners = kernel.simplices().corners(s);
    std::uint32_t over = kNone, kept = kNone;
    for (std::uint32_t i = 0; i < 4; ++i) {
      if (corners[i] == a || corners[i] == b) continue;
      if (over == kNone && (leaves == kNone || corners[i] == leaves)) {
        over = i;
      } else {
        kept = corners[i];
      }
    }
    leaves = kept;
    s = kernel.simplices().across(s)[over] >> 2;
  } while (s != on_the_way.simplex);
}

}  // namespace mesher::detail
