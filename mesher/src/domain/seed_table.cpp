#include "domain/seed_table.hpp"

#include <algorithm>

#include "sac/check.hpp"

namespace mesher::detail {
namespace {

bool name_before(const std::pair<SeedName, std::uint32_t>& entry, const SeedName& name) {
  return entry.first < name;
}

}  // namespace

std::uint32_t SeedTable::find(const SeedName& name) const noexcept {
  const auto it = std::lower_bound(names_.begin(), names_.end(), name, name_before);
  return it != names_.end() && it->first == name ? it->second : kNone;
}

SeedTable::Names& SeedTable::edit_names() {
  if (!kept_names_) kept_names_ = names_;
  return names_;
}

std::uint32_t SeedTable::add(const Seed& seed) {
  Record record;
  record.seed = seed;
  std::uint32_t i = free_[0];
  if (i == kNone) {
    i = records_.add(record);
    SAC_EXPECTS(i < Tile::kNoSeed);
  } else {
    free_.edit(0) = records_[i].next_held;
    records_.edit(i) = record;
  }
  Names& names = edit_names();
  names.insert(std::lower_bound(names.begin(), names.end(), seed.name, name_before),
               {seed.name, i});
  return i;
}

void SeedTable::remove(std::uint32_t i) {
  Names& names = edit_names();
  names.erase(std::lower_bound(names.begin(), names.end(), records_[i].seed.name, name_before));
  Record empty;
  empty.next_held = free_[0];
  records_.edit(i) = empty;
  free_.edit(0) = i;
}

void SeedTable::hold(Tiles& tiles, std::uint32_t i, Slot slot) {
  Tile& tile = tiles.edit(slot);
  Record& record = records_.edit(i);
  record.slot = slot;
  record.next_held = tile.seed == Tile::kNoSeed ? kNone : std::uint32_t{tile.seed};
  tile.seed = i & Tile::kNoSeed;
}

void SeedTable::let_go(Tiles& tiles, std::uint32_t i) {
  const Slot slot = records_[i].slot;
  if (slot == kNone) return;
  const std::uint32_t next = records_[i].next_held;
  if (tiles[slot].seed == i) {
    tiles.edit(slot).seed = next == kNone ? Tile::kNoSeed : next & Tile::kNoSeed;
  } else {
    std::uint32_t before = tiles[slot].seed;
    while (records_[before].next_held != i) before = records_[before].next_held;
    records_.edit(before).next_held = next;
  }
  drop(i);
}

void SeedTable::drop(std::uint32_t i) {
  Record& record = records_.edit(i);
  record.slot = record.next_held = kNone;
}

void SeedTable::leave(Components& components, const Record& record) {
  const std::uint32_t next = record.next_inside, previous = record.previous_inside;
  if (next != kNone) records_.edit(next).previous_inside = previous;
  if (previous != kNone) {
    records_.edit(previous).next_inside = next;
  } else {
    components.edit(record.component).seed = next;
  }
}

void SeedTable::enter(Components& components, std::uint32_t i, std::uint32_t component) {
  if (records_[i].component == component) return;
  if (records_[i].component != kNone) leave(components, records_[i]);
  const std::uint32_t first = component == kNone ? kNone : components[component].seed;
  if (first != kNone) records_.edit(first).previous_inside = i;
  if (component != kNone) components.edit(component).seed = i;
  Record& record = records_.edit(i);
  record.component = component;
  record.next_inside = first;
  record.previous_inside = kNone;
}

void SeedTable::keep() noexcept {
  records_.keep();
  free_.keep();
  kept_names_.reset();
}

void SeedTable::take_back() noexcept {
  records_.take_back();
  free_.take_back();
  if (kept_names_) names_ = std::move(*kept_names_);
  kept_names_.reset();
}

void SeedTable::check_invariants(const Tiles& tiles, const Components& components) const {
  std::size_t held = 0, inside = 0, placed = 0, placed_inside = 0;
  for (const auto& [name, i] : names_) {
    SAC_INVARIANT(records_[i].seed.name == name);
    placed += records_[i].slot != kNone;
    placed_inside += records_[i].component != kNone;
  }
  for (Slot s = 0; s < tiles.slots(); ++s) {
    for_each_held(tiles[s], [&](std::uint32_t i) {
      SAC_INVARIANT(records_[i].slot == s && !tiles[s].is_free());
      ++held;
    });
  }
  for (std::uint32_t c = 0; c < components.size(); ++c) {
    std::uint32_t previous = kNone;
    for_each_inside(components[c], [&](std::uint32_t i) {
      SAC_INVARIANT(records_[i].component == c && records_[i].previous_inside == previous);
      previous = i;
      ++inside;
    });
  }
  SAC_INVARIANT(held == placed && inside == placed_inside);
}

}  // namespace mesher::detail
