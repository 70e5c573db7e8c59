// The regions that updates have led to, against those that are found from scratch.
#include <algorithm>
#include <map>

#include "domain/regions.hpp"
#include "sac/check.hpp"

namespace mesher::detail {
namespace {

// The triangulation of the moment. Vertices keep their numbers; a number without one is at 0.
template <int D>
struct Snapshot {
  Mesh<D> mesh;
  std::vector<WallOf<D>> walls;
  std::vector<Slot> slots;  // one per triangle
};

template <int D>
WallOf<D> wall_at(const SideOf<D>& corners) {
  if constexpr (D == 2) {
    return {corners[0], corners[1], {}, 0};
  } else {
    return {corners, {}, 0};
  }
}

template <int D>
SideOf<D> side_of(const CornersOf<D>& corners, std::size_t across) {
  SideOf<D> side;
  std::size_t n = 0;
  for (std::size_t i = 0; i <= D; ++i) {
    if (i != across) side[n++] = corners[i];
  }
  std::sort(side.begin(), side.end());
  return side;
}

template <int D>
Snapshot<D> snapshot(const TilesOf<D>& tiles, const typename RegionsOf<D>::Places& places) {
  Snapshot<D> now;
  for (Slot s = 0; s < tiles.slots(); ++s) {
    const TileOf<D>& t = tiles[s];
    if (t.is_free()) continue;
    now.slots.push_back(s);
    now.mesh.simplices.push_back(t.corners);
    for (std::size_t i = 0; i <= D; ++i) {
      const std::uint32_t v = t.corners[i];
      if (now.mesh.vertices.size() <= v) now.mesh.vertices.resize(v + std::size_t{1});
      now.mesh.vertices[v] = places(v);
      if (t.is_wall(static_cast<int>(i))) now.walls.push_back(wall_at<D>(side_of<D>(t.corners, i)));
    }
  }
  return now;
}

}  // namespace

template <int D>
void RegionsOf<D>::check_invariants() const {
  tiles_.check_invariants();
  seeds_.check_invariants(tiles_, components_);
  const Snapshot<D> now = snapshot<D>(tiles_, places_);
  std::vector<Seed<D>> seeds;
  seeds_.for_each([&](std::uint32_t i) { seeds.push_back(seeds_[i].seed); });
  for (const Extent extent : {Extent::enclosed, Extent::box}) {
    const Domain<D> domain = find_domain<D>(now.mesh, now.walls, seeds, extent);
    SAC_INVARIANT(faults(extent) == domain.faults);
    std::map<std::uint32_t, std::uint32_t> names;  // components by the regions found
    std::uint32_t closed = 0;
    for (std::uint32_t t = 0; t < now.slots.size(); ++t) {
      const auto component = tiles_[now.slots[t]].component;
      SAC_INVARIANT(names.emplace(domain.region_of[t], component).first->second == component);
      const RegionLabel& found = domain.regions[domain.region_of[t]].label;
      SAC_INVARIANT(components_[component].label == found);
      SAC_INVARIANT(keeps(found, extent) == domain.keeps(t));
    }
    for (const auto& [region, component] : names) {
      SAC_INVARIANT(components_[component].size == domain.regions[region].triangles);
      SAC_INVARIANT(tiles_[components_[component].any].component == component);
      closed += domain.regions[region].label.zone != Zone::outside;
    }
    SAC_INVARIANT(closed == closed_[0]);
  }
  std::uint32_t live = 0;
  for (std::uint32_t c = 0; c < components_.size(); ++c) live += components_[c].size > 0;
  SAC_INVARIANT(live == regions().size());
}

template void RegionsOf<2>::check_invariants() const;
#ifndef MESHER_PLANE_ONLY
template void RegionsOf<3>::check_invariants() const;
#endif

}  // namespace mesher::detail
