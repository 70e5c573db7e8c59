// What polygons enclose, and whether all of them is there.
#include <algorithm>
#include <utility>

#include "delaunay/facets.hpp"
#include "svr/conformity.hpp"
#include "svr/conformity_balls.hpp"

namespace mesher::detail {

/// Unknown ones are joined to known ones around them; those that tiles alone are around are inside.
bool Conformity::is_outside(std::uint32_t s) {
  if (region_[s] != Region::unknown) return region_[s] == Region::outside;
  std::vector<std::uint32_t> all{s};
  region_[s] = Region::inside;
  bool outside = false;
  for (std::size_t k = 0; k < all.size(); ++k) {
    for (std::uint32_t i = 0; i < 4; ++i) {
      const std::uint32_t other = kernel_.simplices().across(all[k])[i] >> 2;
      if (is_wall(all[k], i)) continue;
      if (region_[other] == Region::unknown) {
        region_[other] = Region::inside;
        all.push_back(other);
      }
      outside = outside || region_[other] == Region::outside;
    }
  }
  if (outside) {
    for (const std::uint32_t t : all) region_[t] = Region::outside;
  }
  return outside;
}

bool Conformity::find_regions(std::span<const Point<3>> holes) {
  const auto& simplices = kernel_.simplices();
  region_.assign(simplices.places(), Region::unknown);
  std::uint32_t any = kNone;
  for (std::uint32_t s = 0; s < simplices.places(); ++s) {
    if (!simplices.alive(s)) continue;
    any = s;
    if (kernel_.is_ghost(s)) flood_outside(s);
  }
  for (const Point<3>& p : holes) flood_outside(kernel_.walk(p, any));
  bool encloses = false;
  for (std::uint32_t s = 0; s < simplices.places(); ++s) {
    if (!simplices.alive(s) || region_[s] != Region::unknown) continue;
    region_[s] = Region::inside;
    encloses = true;
  }
  return encloses;
}

void Conformity::flood_outside(std::uint32_t from) {
  if (std::exchange(region_[from], Region::outside) == Region::outside) return;
  std::vector<std::uint32_t> all{from};
  while (!all.empty()) {
    const std::uint32_t s = all.back();
    all.pop_back();
    for (std::uint32_t i = 0; i < 4; ++i) {
      const std::uint32_t other = kernel_.simplices().across(s)[i] >> 2;
      if (region_[other] == Region::outside || is_wall(s, i)) continue;
      region_[other] = Region::outside;
      all.push_back(other);
    }
  }
}

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
