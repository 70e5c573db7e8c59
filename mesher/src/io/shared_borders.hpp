// Borders that polygons share: each piece of a ring is a line once.
#pragma once

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "io/ring_seeds.hpp"

namespace mesher {

class SharedBorders {
 public:
  /// What is left of `ring` without the pieces that a ring before has: runs of pieces, in order
  /// along it; the ring itself if there are none. `polygon`: its number; `outer`: the first of its
  /// rings. Cost: O(places * log all).
  std::vector<Ring> add(const Ring& ring, std::size_t polygon, bool outer);

  /// Whether another polygon, before or after, has a piece of this inner ring in its outer one.
  [[nodiscard]] bool is_filled(const Ring& inner, std::size_t polygon) const;

 private:
  struct Sides {
    std::size_t first = kNone, last = kNone;  // polygons that have it in their outer rings
  };
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  using Piece = std::pair<Point<2>, Point<2>>;

  static Piece piece(const Ring& ring, std::size_t i) {  // that ends at place i
    return std::minmax(ring[i - 1], ring[i]);
  }
  [[nodiscard]] Ring rotated(const Ring& ring) const;

  std::map<Piece, Sides> pieces_;
};

}  // namespace mesher
