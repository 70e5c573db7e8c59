// What polygons enclose, and whether all of them is there.
#include <algorithm>

#include "delaunay/facets.hpp"
#include "refinement/conformity.hpp"
#include "refinement/conformity_balls.hpp"

namespace mesher::detail {

namespace {

/// The corner that is not one of the face's.
std::size_t corner_across(const std::array<std::uint32_t, 4>& corners, const Face& face) {
  for (std::size_t i = 0;; ++i) {
    if (std::find(face.begin(), face.end(), corners[i]) == face.end()) return i;
  }
}

}  // namespace

void Conformity::put_flat_outside() {
  enum : std::uint8_t { kEnclosedBelow = 1, kOther = 2 };
  std::vector<std::uint8_t> seen(by_rank_.size());
  const auto& simplices = kernel_.simplices();
  for (std::uint32_t s = 0; s < simplices.places(); ++s) {
    if (!simplices.alive(s)) continue;
    visit_tiles_of(s, [&](std::uint32_t t, std::uint32_t other) {
      const Rank f = tiles_[t].polygon;
      const std::size_t i = corner_across(simplices.corners(s), tiles_[t].face);
      if (is_above(s, static_cast<std::uint32_t>(i), f)) return;
      seen[f] |= !is_outside(s) && is_outside(other) ? kEnclosedBelow : kOther;
    });
  }
  bool any = false;
  for (Rank f = 1; f < seen.size(); ++f) {
    is_turned_[f] = seen[f] == kEnclosedBelow;
    any = any || is_turned_[f];
  }
  if (any) look_at_all();
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
  tiles_.for_each([&](const Tiles::Tile& tile) {
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
