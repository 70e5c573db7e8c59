// The regions that updates have led to, against those that are found from scratch.
#include <algorithm>
#include <map>

#include "domain/regions.hpp"
#include "sac/check.hpp"

namespace mesher::detail {
namespace {

// The triangulation of the moment. Vertices keep their numbers; a number without one is at 0.
struct Snapshot {
  Mesh<2> mesh;
  std::vector<MeshEdge> walls;
  std::vector<Slot> slots;  // one per triangle
};

Snapshot snapshot(const Tiles& tiles, const Regions::Places& places) {
  Snapshot now;
  for (Slot s = 0; s < tiles.slots(); ++s) {
    const Tile& t = tiles[s];
    if (t.is_free()) continue;
    now.slots.push_back(s);
    now.mesh.simplices.push_back(t.corners);
    for (int i = 0; i < 3; ++i) {
      const auto [low, high] =
          std::minmax(t.corners[next_corner(i)], t.corners[previous_corner(i)]);
      if (t.is_wall(i)) now.walls.push_back({low, high, {}, 0});
      if (now.mesh.vertices.size() <= high) now.mesh.vertices.resize(high + std::size_t{1});
      now.mesh.vertices[high] = places(high);
      now.mesh.vertices[low] = places(low);
    }
  }
  return now;
}

}  // namespace

void Regions::check_invariants() const {
  tiles_.check_invariants();
  seeds_.check_invariants(tiles_, components_);
  const Snapshot now = snapshot(tiles_, places_);
  std::vector<Seed> seeds;
  seeds_.for_each([&](std::uint32_t i) { seeds.push_back(seeds_[i].seed); });
  for (const Extent extent : {Extent::enclosed, Extent::box}) {
    const Domain domain = find_domain(now.mesh, now.walls, seeds, extent);
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

}  // namespace mesher::detail
