// Where Voronoi edges cross polygons: the faces that these are dual to, by their corners.
//
// The Voronoi diagram cuts a polygon into parts, one for each cell that meets it. The parts'
// corners are these crossings. The polygon is a union of faces if all three corners of each face
// lie on it: then the faces are its tiles [rules C3].
#pragma once

#include <tsl/robin_map.h>

#include <algorithm>
#include <array>
#include <cstdint>
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

class Crossings {
 public:
  struct Crossing {
    Face face{};
    std::uint32_t polygon = 0;
    Point<3> at{};    // as far from all three corners
    Point<3> from{};  // of a tile: what encroaches on it, if it waits
    bool alive = false;
    bool is_tile = false;        // all corners are on the polygon
    bool waiting = false;        // in the queue of those that have to go
    std::uint32_t next = kNone;  // of the same face; free ones: the next free one
  };

  [[nodiscard]] const Crossing& operator[](std::uint32_t i) const noexcept { return all_[i]; }
  /// The first of a face; kNone: there is none.
  [[nodiscard]] std::uint32_t find(const Face& face) const {
    const auto it = first_.find(face);
    return it == first_.end() ? kNone : it->second;
  }
  [[nodiscard]] std::uint32_t find(const Face& face, std::uint32_t f) const {
    std::uint32_t i = find(face);
    while (i != kNone && all_[i].polygon != f) i = all_[i].next;
    return i;
  }
  /// Requires: find(face, polygon) == kNone.
  std::uint32_t add(Crossing crossing) {
    std::uint32_t i = free_;
    if (i == kNone) {
      i = static_cast<std::uint32_t>(all_.size());
      all_.emplace_back();
    } else {
      free_ = all_[i].next;
    }
    const auto [it, is_new] = first_.try_emplace(crossing.face, i);
    crossing.next = is_new ? kNone : it->second;
    crossing.alive = true;
    it.value() = i;
    all_[i] = crossing;
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
    all_[i].alive = false;
    if (!all_[i].waiting) release(i);
  }
  /// Its Voronoi edge became shorter, and is in the polygon's plane.
  void move(std::uint32_t i, const Point<3>& at) noexcept { all_[i].at = at; }
  void set_waiting(std::uint32_t i, const Point<3>& from) noexcept {
    all_[i].waiting = true;
    all_[i].from = from;
  }
  /// It does not wait any more.
  void set_done(std::uint32_t i) noexcept {
    all_[i].waiting = false;
    if (!all_[i].alive) release(i);
  }
  /// Calls visit(crossing) for each.
  template <class Visit>
  void for_each(Visit&& visit) const {
    for (const Crossing& crossing : all_) {
      if (crossing.alive) visit(crossing);
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

  std::vector<Crossing> all_;
  std::uint32_t free_ = kNone;
  tsl::robin_map<Face, std::uint32_t, Hash> first_;
};

}  // namespace mesher::detail
