// The faces that polygons are unions of, by their corners and by polygons.
#pragma once

#include <tsl/robin_map.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "delaunay/simplex_store.hpp"
#include "space/feature.hpp"

namespace mesher::detail {

/// The corners of a face, ascending.
using Face = std::array<std::uint32_t, 3>;
[[nodiscard]] inline Face face_of(std::uint32_t a, std::uint32_t b, std::uint32_t c) noexcept {
  Face face{a, b, c};
  if (face[0] > face[1]) std::swap(face[0], face[1]);
  if (face[1] > face[2]) std::swap(face[1], face[2]);
  if (face[0] > face[1]) std::swap(face[0], face[1]);
  return face;
}

class Tiles {
 public:
  struct Tile {
    Face face{};
    std::uint32_t polygon = 0;
    Point<3> from{};  // what encroaches on it, if it waits
    bool alive = false;
    bool waiting = false;        // in the queue of those that are to be split
    std::uint32_t place = 0;     // in the list of its polygon
    std::uint32_t next = kNone;  // of the same face; free ones: the next free one
  };

  /// For polygons 1 to `last`.
  void make_room(std::uint32_t last) { of_.resize(last + std::size_t{1}); }

  [[nodiscard]] const Tile& operator[](std::uint32_t i) const noexcept { return all_[i]; }
  /// Of a polygon, in an order that a run decides.
  [[nodiscard]] std::span<const std::uint32_t> of(std::uint32_t polygon) const noexcept {
    return of_[polygon];
  }
  /// The first of a face; kNone: there is none.
  [[nodiscard]] std::uint32_t find(const Face& face) const {
    const auto it = first_.find(face);
    return it == first_.end() ? kNone : it->second;
  }
  [[nodiscard]] std::uint32_t find(const Face& face, std::uint32_t polygon) const {
    std::uint32_t i = find(face);
    while (i != kNone && all_[i].polygon != polygon) i = all_[i].next;
    return i;
  }
  /// Requires: find(face, polygon) == kNone.
  std::uint32_t add(const Face& face, std::uint32_t polygon) {
    std::uint32_t i = free_;
    if (i == kNone) {
      i = static_cast<std::uint32_t>(all_.size());
      all_.emplace_back();
    } else {
      free_ = all_[i].next;
    }
    const auto [it, is_new] = first_.try_emplace(face, i);
    all_[i] = {.face = face,
               .polygon = polygon,
               .alive = true,
               .place = static_cast<std::uint32_t>(of_[polygon].size()),
               .next = is_new ? kNone : it->second};
    it.value() = i;
    of_[polygon].push_back(i);
    return i;
  }
  void erase(std::uint32_t i) {
    const auto it = first_.find(all_[i].face);
    if (it->second == i) {
      if (all_[i].next == kNone) {
        first_.erase(it);
      } else {
        it.value() = all_[i].next;
      }
    } else {
      std::uint32_t before = it->second;
      while (all_[before].next != i) before = all_[before].next;
      all_[before].next = all_[i].next;
    }
    std::vector<std::uint32_t>& list = of_[all_[i].polygon];
    list[all_[i].place] = list.back();
    all_[list.back()].place = all_[i].place;
    list.pop_back();
    all_[i].alive = false;
    if (!all_[i].waiting) release(i);
  }
  void set_waiting(std::uint32_t i, const Point<3>& from) noexcept {
    all_[i].waiting = true;
    all_[i].from = from;
  }
  /// It does not wait any more.
  void set_done(std::uint32_t i) noexcept {
    all_[i].waiting = false;
    if (!all_[i].alive) release(i);
  }
  /// Calls visit(tile) for each.
  template <class Visit>
  void for_each(Visit&& visit) const {
    for (const Tile& tile : all_) {
      if (tile.alive) visit(tile);
    }
  }

 private:
  struct Hash {
    std::size_t operator()(const Face& f) const noexcept {
      return sac::mix(sac::mix(std::uint64_t{f[0]} << 32 | f[1]) + f[2]);
    }
  };
  void release(std::uint32_t i) noexcept {
    all_[i].next = free_;
    free_ = i;
  }

  std::vector<Tile> all_;
  std::vector<std::vector<std::uint32_t>> of_;  // by polygon
  std::uint32_t free_ = kNone;
  tsl::robin_map<Face, std::uint32_t, Hash> first_;
};

}  // namespace mesher::detail
