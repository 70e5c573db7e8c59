// The regions at rest: how they begin, and what can be asked.
#include "domain/regions.hpp"

#include <algorithm>

#include "domain/labels.hpp"
#include "domain/locate.hpp"
#include "mesh/canonical.hpp"
#include "sac/check.hpp"

namespace mesher::detail {

// --- Beginning -------------------------------------------------------------------------------

Regions::Regions(const std::vector<Corners>& triangles, const std::vector<Edge>& walls,
                 const std::vector<Seed>& seeds, Places places)
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

void Regions::flood_all(const std::vector<Corners>& triangles) {
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
      for (int i = 0; i < 3; ++i) take(tiles_[s].open_neighbour(i));
    }
    components_.edit(c) = component;
  }
}

void Regions::place_all(const std::vector<Seed>& seeds) {
  check_seeds(seeds);
  std::vector<Point<2>> places;
  for (const Seed& seed : seeds) places.push_back(seed.at);
  const auto holders = first_holding(
      places, tiles_.slots(), [&](Slot s) { return corners_of(s); }, kNone);
  for (std::size_t k = 0; k < seeds.size(); ++k) {
    const std::uint32_t i = seeds_.add(seeds[k]);
    if (holders[k] == kNone) continue;
    seeds_.hold(tiles_, i, holders[k]);
    seeds_.enter(components_, i, component_at(seeds[k].at, holders[k]));
  }
}

void Regions::keep() noexcept {
  tiles_.keep();
  components_.keep();
  seeds_.keep();
  closed_.keep();
}

void Regions::roll_back() noexcept {
  tiles_.take_back();
  components_.take_back();
  seeds_.take_back();
  closed_.take_back();
}

// --- Places ----------------------------------------------------------------------------------

std::array<Point<2>, 3> Regions::corners_of(Slot s) const {
  const Corners& c = tiles_[s].corners;
  return {places_(c[0]), places_(c[1]), places_(c[2])};
}

// A walk towards p. In a Delaunay triangulation of a convex place it ends; where it leaves the
// triangulation, or takes longer than there are triangles, all of them are looked at.
Slot Regions::locate(const Point<2>& p) const {
  Slot s = 0;
  while (s < tiles_.slots() && tiles_[s].is_free()) ++s;
  for (std::uint32_t steps = 0; s < tiles_.slots() && steps < tiles_.live(); ++steps) {
    const auto t = corners_of(s);
    int beyond = 0;
    while (beyond < 3 &&
           predicates::orient2d(t[next_corner(beyond)], t[previous_corner(beyond)], p) >= 0) {
      ++beyond;
    }
    if (beyond == 3) return s;
    s = tiles_[s].neighbours[beyond];
  }
  for (s = 0; s < tiles_.slots(); ++s) {
    if (!tiles_[s].is_free() && holding(corners_of(s), p)) return s;
  }
  return kNone;
}

// The region around p, which the closed triangle holds; kNone on a wall.
std::uint32_t Regions::component_at(const Point<2>& p, Slot s) const {
  const Tile& tile = tiles_[s];
  const Holding held = *holding(corners_of(s), p);
  const bool on_wall = (held.where == Holding::Where::edge && tile.is_wall(held.index)) ||
                       (held.where == Holding::Where::vertex && has_wall(tile.corners[held.index]));
  return on_wall ? kNone : tile.component;
}

bool Regions::has_wall(std::uint32_t vertex) const {
  bool found = false;
  tiles_.for_each_around(vertex, [&](Slot s) {
    const int i = tiles_[s].corner_of(vertex);
    found = tiles_[s].is_wall(next_corner(i)) || tiles_[s].is_wall(previous_corner(i));
    return !found;
  });
  return found;
}

// --- Questions -------------------------------------------------------------------------------

RegionLabel Regions::label_of(const Component& component) const {
  Counting counting;
  seeds_.for_each_inside(component, [&](std::uint32_t i) { counting.add(seeds_[i].seed.name); });
  return counting.label(component.exits > 0);
}

RegionLabel Regions::label(const Corners& triangle) const {
  const TileEdge side = tiles_.left_of(triangle[0], triangle[1]);
  SAC_EXPECTS(side.slot != kNone && tiles_[side.slot].corners[side.edge] == triangle[2]);
  return components_[tiles_[side.slot].component].label;
}

bool Regions::keeps(const RegionLabel& label, Extent extent) const noexcept {
  return detail::keeps(label, keeps_all(extent, encloses()));
}

std::vector<SeedFault> Regions::faults(Extent extent) const {
  const bool all_kept = keeps_all(extent, encloses());
  std::vector<SeedFault> all;
  seeds_.for_each([&](std::uint32_t i) {
    const SeedTable::Record& record = seeds_[i];
    const Seed& seed = record.seed;
    if (record.slot == kNone) {
      all.push_back({SeedFault::Kind::outside, seed.name, seed.at, {}, {}});
    } else if (record.component == kNone) {
      all.push_back({SeedFault::Kind::on_segment, seed.name, seed.at, {}, {}});
    } else if (const auto fault = fault_in(seed, components_[record.component].label, all_kept)) {
      all.push_back(*fault);
    }
  });
  return all;
}

std::vector<NamedRegion> Regions::regions() const {
  struct Named {
    std::array<Point<2>, 3> places;
    NamedRegion region;
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
  std::vector<NamedRegion> regions;
  for (Named& named : all) {
    NamedRegion& region = regions.emplace_back(named.region);
    Corners& c = region.smallest;
    std::rotate(
        c.begin(),
        std::min_element(c.begin(), c.end(),
                         [&](std::uint32_t a, std::uint32_t b) { return places_(a) < places_(b); }),
        c.end());
    region.label = label(c);
    const auto counts = counting_seed(region.label);
    if (!counts || counts->kind == SeedKind::hole) continue;
    const Seed& seed = seeds_[seeds_.find(*counts)].seed;
    region.attribute = seed.attribute;
    region.max_area = seed.max_area;
  }
  return regions;
}

}  // namespace mesher::detail
