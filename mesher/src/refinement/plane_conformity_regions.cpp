// What segments enclose.
#include "delaunay/facets.hpp"
#include "refinement/plane_conformity.hpp"

namespace mesher::detail {

bool PlaneConformity::find_regions(std::span<const Point<2>> holes, double near) {
  return enclosed_.find(holes, near, [&](auto s, auto i) { return is_wall(s, i); });
}

bool PlaneConformity::is_wall(std::uint32_t s, std::uint32_t i) const {
  const auto [a, b] = facet_across<2>(kernel_.simplices().corners(s), i);
  return vertices_[a].on_edge && vertices_[b].on_edge && pieces_.find(a, b) != kNone;
}

}  // namespace mesher::detail
