// What segments enclose.
#include "delaunay/facets.hpp"
#include "svr/plane_conformity.hpp"

namespace mesher::detail {

/// A hole on a segment is none.
bool PlaneConformity::find_regions(std::span<const Point<2>> holes) {
  const std::uint32_t any = kernel_.find_in_star(1, star_, [](std::uint32_t) { return true; });
  std::vector<std::uint32_t> in_holes;
  for (const Point<2>& p : holes) {
    const std::uint32_t s = kernel_.walk(p, any);
    if (!is_on_wall(p, s)) in_holes.push_back(s);
  }
  return enclosed_.find(in_holes, [&](auto s, auto i) { return is_wall(s, i); });
}

bool PlaneConformity::is_on_wall(const Point<2>& p, std::uint32_t s) const {
  const auto& corners = kernel_.simplices().corners(s);
  for (std::uint32_t i = 0; i < 3; ++i) {
    if (corners[i] == kInfinite) continue;
    if (place(corners[i]) == p && vertices_[corners[i]].on_edge) return true;
    if (!is_wall(s, i)) continue;
    const auto [a, b] = facet_across<2>(corners, i);
    if (predicates::orient2d(place(a), place(b), p) == 0) return true;
  }
  return false;
}

bool PlaneConformity::is_wall(std::uint32_t s, std::uint32_t i) const {
  const auto [a, b] = facet_across<2>(kernel_.simplices().corners(s), i);
  return vertices_[a].on_edge && vertices_[b].on_edge && pieces_.find(a, b) != kNone;
}

}  // namespace mesher::detail
