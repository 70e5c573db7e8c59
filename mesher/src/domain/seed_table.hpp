// The seeds of a changing triangulation: the triangle of each, and the seeds of each region.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "domain/components.hpp"

namespace mesher::detail {

/// Seeds by number; each is in the list of the triangle that holds it and in that of its region.
template <int D>
class SeedTableOf {
 public:
  using Tile = TileOf<D>;
  using Tiles = TilesOf<D>;
  struct Record {
    Seed<D> seed{};
    Slot slot = kNone;                // that holds it; kNone: not in the triangulation
    std::uint32_t component = kNone;  // kNone on a wall, too
    // In the list of the triangle; next_held of a free record: the next free one.
    std::uint32_t next_held = kNone, previous_held = kNone;
    std::uint32_t next_inside = kNone, previous_inside = kNone;  // in the region's list
  };

  SeedTableOf() { free_.add(kNone); }

  [[nodiscard]] const Record& operator[](std::uint32_t i) const noexcept { return records_[i]; }
  /// kNone if there is no such seed.
  [[nodiscard]] std::uint32_t find(const SeedId& name) const noexcept;
  [[nodiscard]] std::size_t size() const noexcept { return names_.size(); }
  /// Calls visit(number) for every seed, ascending by name.
  template <class Visit>
  void for_each(Visit&& visit) const {
    for (const auto& [name, i] : names_) visit(i);
  }
  /// Calls visit(number) for the seeds that a triangle holds.
  template <class Visit>
  void for_each_held(const Tile& tile, Visit&& visit) const {
    if (tile.seed == Tile::kNoSeed) return;
    for (std::uint32_t i = tile.seed; i != kNone;) {
      const std::uint32_t next = records_[i].next_held;
      visit(i);
      i = next;
    }
  }
  template <class Visit>
  void for_each_inside(const Component& component, Visit&& visit) const {
    for (std::uint32_t i = component.seed; i != kNone; i = records_[i].next_inside) visit(i);
  }

  /// Requires: no such seed. Cost: O(log seeds).
  std::uint32_t add(const Seed<D>& seed);
  /// Requires: it is held nowhere and in no region. Cost: O(log seeds).
  void remove(std::uint32_t i);

  /// Requires: it is held nowhere. Cost: O(1).
  void hold(Tiles& tiles, std::uint32_t i, Slot slot);
  /// Cost: O(1): many seeds may be in one triangle, and go.
  void let_go(Tiles& tiles, std::uint32_t i);
  /// The triangle that held it is no more, and neither is its list.
  void drop(std::uint32_t i);
  /// kNone: leaves the region that it is in. Cost: O(1): all seeds of a region may come to another.
  void enter(Components& components, std::uint32_t i, std::uint32_t component);

  void keep() noexcept;
  void take_back() noexcept;
  void check_invariants(const Tiles& tiles, const Components& components) const;

 private:
  using Names = std::map<SeedId, std::uint32_t>;
  struct NameEdit {
    SeedId name;
    Names::node_type removed{};  // empty: the name was added
  };

  // Takes it out of the list of its region. Cost: O(1).
  void leave(Components& components, const Record& record);
  Journal<Record> records_;
  Journal<std::uint32_t> free_;  // one
  Names names_;
  std::vector<NameEdit> name_edits_;  // since the last keep()
};

}  // namespace mesher::detail
