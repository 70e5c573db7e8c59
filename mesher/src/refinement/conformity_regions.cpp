// What polygons enclose, and whether all of them is there.
#include <algorithm>

#include "delaunay/facets.hpp"
#include "refinement/conformity.hpp"
#include "refinement/conformity_balls.hpp"

namespace mesher::detail {

bool Conformity::is_wall(std::uint32_t s, std::uint32_t i) const {
  const Facet facet = facet_across<3>(kernel_.simplices().corners(s), i);
  return all_on_polygons(facet) && crossings_.find(face_across(facet)) != kNone;
}

/// Of a polygon the tiles at each piece of its border are one, at other edges two.
void Conformity::require_whole() const {
  struct At {
    Rank f;
    std::uint32_t a, b;
    auto operator<=>(const At&) const = default;
  };
  std::vector<At> there, wanted;
  const auto add = [](std::vector<At>& to, Rank f, std::uint32_t a, std::uint32_t b) {
    to.push_back({f, std::min(a, b), std::max(a, b)});
  };
  crossings_.for_each([&](const Crossings::Crossing& tile) {
    const auto& [a, b, c] = tile.face;
    add(there, tile.polygon, a, b), add(there, tile.polygon, b, c), add(there, tile.polygon, a, c);
  });
  for (std::uint32_t i = 0; i < pieces_.size(); ++i) {
    const Subedges::Piece& p = pieces_[i];
    for (const Rank f : at_edge_[p.edge]) {
      add(wanted, f, p.a, p.b);
      if (polygon(f).corner_at(p.edge) == Polygon::kInner) add(wanted, f, p.a, p.b);
    }
  }
  std::sort(there.begin(), there.end());
  std::sort(wanted.begin(), wanted.end());
  auto next = wanted.begin();
  for (auto it = there.begin(); it != there.end();) {
    const auto end = std::find_if(it, there.end(), [&](const At& at) { return at != *it; });
    const auto last = std::find_if(next, wanted.end(), [&](const At& at) { return at != *it; });
    if (next != wanted.end() && *next < *it) break;
    if (end - it != (next == last ? 2 : last - next)) throw too_close_near(place(it->a));
    it = end, next = last;
  }
  if (next != wanted.end()) throw too_close_near(place(next->a));
}

}  // namespace mesher::detail
