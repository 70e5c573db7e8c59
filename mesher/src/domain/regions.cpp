// The regions at rest: how they begin, and what can be asked.
#include "domain/regions.hpp"

#include <algorithm>
#include <utility>

#include "domain/labels.hpp"
#include "mesh/canonical.hpp"
#include "mesh/locate.hpp"
#include "sac/check.hpp"

namespace mesher::detail {

// --- Beginning -------------------------------------------------------------------------------

template <int D>
RegionsOf<D>::RegionsOf(const std::vector<Corners>& triangles, const std::vector<Wall>& walls,
                        const std::vector<Seed<D>>& seeds, Places places)
    : places_(std::move(places)), tiles_(triangles, walls) {
  flood_all(triangles);
  place_all(seeds);
  std::uint32_t closed = 0;
  for (std::uint32_t c = 0; c < components_.size(); ++c) {
    Component& component = components_.edit(c);
    component.label = label_of(component);
    closed += component.exits == 0;
  }
  closed_.add(closed);
  keep();
}

template <int D>
void RegionsOf<D>::flood_all(const std::vector<Corners>& triangles) {
  std::vector<Slot> reached;
  for (Slot first = 0; first < triangles.size(); ++first) {
    if (tiles_[first].component != kNone) continue;
    const std::uint32_t c = components_.create();
    Component component{0, 0, first, kNone, {}};
    const auto take = [&](Slot s) {
      if (s == kNone || tiles_[s].component != kNone) return;
      tiles_.edit(s).component = c;
      ++component.size;
      component.exits += tiles_[s].exits();
      reached.push_back(s);
    };
    take(first);
    while (!reached.empty()) {
      const Slot s = reached.back();
      reached.pop_back();
      for (int i = 0; i <= D; ++i) take(tiles_[s].open_neighbour(i));
    }
    components_.edit(c) = component;
  }
}

template <int D>
void RegionsOf<D>::place_all(const std::vector<Seed<D>>& seeds) {
  check_seeds(seeds);
  std::vector<Point<D>> places;
  for (const Seed<D>& seed : seeds) places.push_back(seed.at);
  const auto holders = first_holding<D>(
      places, tiles_.slots(), [&](Slot s) { return corners_of(s); }, kNone);
  for (std::size_t k = 0; k < seeds.size(); ++k) {
    const std::uint32_t i = seeds_.add(seeds[k]);
    if (holders[k] == kNone) continue;
    seeds_.hold(tiles_, i, holders[k]);
    seeds_.enter(components_, i, component_at(seeds[k].at, holders[k]));
  }
}

template <int D>
void RegionsOf<D>::keep() noexcept {
  tiles_.keep();
  components_.keep();
  seeds_.keep();
  closed_.keep();
}

template <int D>
void RegionsOf<D>::roll_back() noexcept {
  tiles_.take_back();
  components_.take_back();
  seeds_.take_back();
  closed_.take_back();
}

// --- Places ----------------------------------------------------------------------------------

template <int D>
std::array<Point<D>, D + 1> RegionsOf<D>::corners_of(Slot s) const {
  std::array<Point<D>, D + 1> places;
  for (std::size_t i = 0; i < places.size(); ++i) places[i] = places_(tiles_[s].corners[i]);
  return places;
}

// A walk towards p. In a Delaunay triangulation of a convex place it ends; where it leaves the
// triangulation, or takes longer than there are triangles, all of them are looked at.
template <int D>
Slot RegionsOf<D>::locate(const Point<D>& p) const {
  Slot s = 0;
  while (s < tiles_.slots() && tiles_[s].is_free()) ++s;
  for (std::uint32_t steps = 0; s < tiles_.slots() && steps < tiles_.live(); ++steps) {
    const auto t = corners_of(s);
    std::size_t beyond = 0;
    while (beyond <= D && inward_side(t, beyond, p) >= 0) ++beyond;
    if (beyond > D) return s;
    s = tiles_[s].neighbours[beyond];
  }
  for (s = 0; s < tiles_.slots(); ++s) {
    if (!tiles_[s].is_free() && sides_at(corners_of(s), p)) return s;
  }
  return kNone;
}

// The region around p, which the closed triangle holds; kNone on a wall. All that hold p are
// reached across the sides that p is on.
template <int D>
std::uint32_t RegionsOf<D>::component_at(const Point<D>& p, Slot first) const {
  std::vector<Slot> reached{first};
  for (std::size_t k = 0; k < reached.size(); ++k) {
    const auto& tile = tiles_[reached[k]];
    const unsigned sides = *sides_at(corners_of(reached[k]), p);
    for (int i = 0; i <= D; ++i) {
      if ((sides >> i & 1) == 0) continue;
      if (tile.is_wall(i)) return kNone;
      const Slot n = tile.neighbours[static_cast<std::size_t>(i)];
      const bool is_new = std::find(reached.begin(), reached.end(), n) == reached.end();
      if (n != kNone && is_new) reached.push_back(n);
    }
  }
  return tiles_[first].component;
}

// --- Questions -------------------------------------------------------------------------------

template <int D>
RegionLabel RegionsOf<D>::label_of(const Component& component) const {
  Counting counting;
  seeds_.for_each_inside(component, [&](std::uint32_t i) { counting.add(seeds_[i].seed.id); });
  return counting.label(component.exits > 0);
}

template <int D>
RegionLabel RegionsOf<D>::label(const Corners& triangle) const {
  const Slot s = tiles_.find(triangle);
  SAC_EXPECTS(s != kNone);
  return components_[tiles_[s].component].label;
}

template <int D>
bool RegionsOf<D>::keeps(const RegionLabel& label, Extent extent) const noexcept {
  return detail::keeps(label, keeps_all(extent, encloses()));
}

template <int D>
std::vector<SeedFault<D>> RegionsOf<D>::faults(Extent extent) const {
  const bool all_kept = keeps_all(extent, encloses());
  std::vector<SeedFault<D>> all;
  seeds_.for_each([&](std::uint32_t i) {
    const auto& record = seeds_[i];
    const Seed<D>& seed = record.seed;
    if (record.slot == kNone) {
      all.push_back({SeedFault<D>::Kind::outside, seed.id, seed.at, {}, {}});
    } else if (record.component == kNone) {
      all.push_back({SeedFault<D>::Kind::on_segment, seed.id, seed.at, {}, {}});
    } else if (const auto fault = fault_in(seed, components_[record.component].label, all_kept)) {
      all.push_back(*fault);
    }
  });
  return all;
}

template <int D>
std::vector<NamedRegion<D>> RegionsOf<D>::regions() const {
  struct Named {
    std::array<Point<D>, D + 1> places;
    NamedRegion<D> region;
  };
  std::vector<Named> all(components_.size());
  for (Slot s = 0; s < tiles_.slots(); ++s) {
    if (tiles_[s].is_free()) continue;
    Named& named = all[tiles_[s].component];
    const auto places = smallest_first(corners_of(s));
    if (named.region.triangles++ > 0 && !(places < named.places)) continue;
    named.places = places;
    named.region.smallest = tiles_[s].corners;
  }
  std::erase_if(all, [](const Named& named) { return named.region.triangles == 0; });
  std::sort(all.begin(), all.end(),
            [](const Named& a, const Named& b) { return a.places < b.places; });
  std::vector<NamedRegion<D>> regions;
  for (Named& named : all) {
    NamedRegion<D>& region = regions.emplace_back(named.region);
    Corners& c = region.smallest;
    std::array<std::pair<Point<D>, std::uint32_t>, D + 1> placed;
    for (std::size_t i = 0; i < c.size(); ++i) placed[i] = {places_(c[i]), c[i]};
    placed = smallest_first(placed);
    for (std::size_t i = 0; i < c.size(); ++i) c[i] = placed[i].second;
    region.label = label(c);
    const auto counts = counting_seed(region.label);
    if (!counts || counts->kind == SeedKind::hole) continue;
    const Seed<D>& seed = seeds_[seeds_.find(*counts)].seed;
    region.attribute = seed.attribute;
    region.max_measure = seed.max_measure;
  }
  return regions;
}

template class RegionsOf<2>;
#ifndef MESHER_PLANE_ONLY
template class RegionsOf<3>;
#endif

}  // namespace mesher::detail
