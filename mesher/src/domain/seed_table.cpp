#include "domain/seed_table.hpp"

#include <tuple>
#include <utility>

#include "sac/check.hpp"

namespace mesher::detail {

template <int D>
std::uint32_t SeedTableOf<D>::find(const SeedId& name) const noexcept {
  const auto it = names_.find(name);
  return it != names_.end() ? it->second : kNone;
}

template <int D>
std::uint32_t SeedTableOf<D>::add(const Seed<D>& seed) {
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
  name_edits_.push_back({seed.id});
  names_.emplace(seed.id, i);
  return i;
}

template <int D>
void SeedTableOf<D>::remove(std::uint32_t i) {
  const SeedId name = records_[i].seed.id;
  name_edits_.push_back({name});
  name_edits_.back().removed = names_.extract(name);
  Record empty;
  empty.next_held = free_[0];
  records_.edit(i) = empty;
  free_.edit(0) = i;
}

template <int D>
void SeedTableOf<D>::hold(Tiles& tiles, std::uint32_t i, Slot slot) {
  Tile& tile = tiles.edit(slot);
  const std::uint32_t first = tile.seed == Tile::kNoSeed ? kNone : std::uint32_t{tile.seed};
  if (first != kNone) records_.edit(first).previous_held = i;
  tile.seed = i & Tile::kNoSeed;
  Record& record = records_.edit(i);
  record.slot = slot;
  record.next_held = first;
}

template <int D>
void SeedTableOf<D>::let_go(Tiles& tiles, std::uint32_t i) {
  const auto [next, previous, slot] =
      std::tuple(records_[i].next_held, records_[i].previous_held, records_[i].slot);
  if (slot == kNone) return;
  if (next != kNone) records_.edit(next).previous_held = previous;
  if (previous != kNone) {
    records_.edit(previous).next_held = next;
  } else {
    tiles.edit(slot).seed = next == kNone ? Tile::kNoSeed : next & Tile::kNoSeed;
  }
  drop(i);
}

template <int D>
void SeedTableOf<D>::drop(std::uint32_t i) {
  Record& record = records_.edit(i);
  record.slot = record.next_held = record.previous_held = kNone;
}

template <int D>
void SeedTableOf<D>::leave(Components& components, const Record& record) {
  const std::uint32_t next = record.next_inside, previous = record.previous_inside;
  if (next != kNone) records_.edit(next).previous_inside = previous;
  if (previous != kNone) {
    records_.edit(previous).next_inside = next;
  } else {
    components.edit(record.component).seed = next;
  }
}

template <int D>
void SeedTableOf<D>::enter(Components& components, std::uint32_t i, std::uint32_t component) {
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

template <int D>
void SeedTableOf<D>::keep() noexcept {
  records_.keep();
  free_.keep();
  name_edits_ = decltype(name_edits_)();  // not {}, for which a vector keeps its size
}

template <int D>
void SeedTableOf<D>::take_back() noexcept {
  records_.take_back();
  free_.take_back();
  for (; !name_edits_.empty(); name_edits_.pop_back()) {
    NameEdit& edit = name_edits_.back();
    if (edit.removed.empty()) {
      names_.erase(edit.name);
    } else {
      names_.insert(std::move(edit.removed));
    }
  }
}

template <int D>
void SeedTableOf<D>::check_invariants(const Tiles& tiles, const Components& components) const {
  std::size_t held = 0, inside = 0, placed = 0, placed_inside = 0;
  for (const auto& [name, i] : names_) {
    SAC_INVARIANT(records_[i].seed.id == name);
    placed += records_[i].slot != kNone;
    placed_inside += records_[i].component != kNone;
  }
  for (Slot s = 0; s < tiles.slots(); ++s) {
    std::uint32_t previous = kNone;
    for_each_held(tiles[s], [&](std::uint32_t i) {
      SAC_INVARIANT(records_[i].slot == s && !tiles[s].is_free());
      SAC_INVARIANT(records_[i].previous_held == previous);
      previous = i;
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

template class SeedTableOf<2>;
#ifndef MESHER_PLANE_ONLY
template class SeedTableOf<3>;
#endif

}  // namespace mesher::detail
