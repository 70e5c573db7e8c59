// A piece is the pair of its ends' places.
#include "io/shared_borders.hpp"

#include <algorithm>

namespace mesher {

// The ring from the end of a shared piece on, so that no run goes on over its end.
Ring SharedBorders::rotated(const Ring& ring) const {
  std::size_t i = 1;
  while (i < ring.size() && !pieces_.contains(piece(ring, i))) ++i;
  if (i >= ring.size()) return ring;
  Ring turned(ring.begin() + static_cast<std::ptrdiff_t>(i), ring.end());
  turned.insert(turned.end(), ring.begin() + 1, ring.begin() + static_cast<std::ptrdiff_t>(i) + 1);
  return turned;
}

std::vector<Ring> SharedBorders::add(const Ring& ring, std::size_t polygon, bool outer) {
  const Ring all = rotated(ring);
  std::vector<Ring> runs;
  for (std::size_t i = 1; i < all.size(); ++i) {
    if (pieces_.contains(piece(all, i))) continue;
    if (runs.empty() || runs.back().back() != all[i - 1]) runs.push_back({all[i - 1]});
    runs.back().push_back(all[i]);
  }
  for (std::size_t i = 1; i < ring.size(); ++i) {
    Sides& sides = pieces_[piece(ring, i)];
    if (!outer) continue;
    if (sides.first == kNone) sides.first = polygon;
    sides.last = polygon;
  }
  return runs;
}

bool SharedBorders::is_filled(const Ring& inner, std::size_t polygon) const {
  for (std::size_t i = 1; i < inner.size(); ++i) {
    const auto found = pieces_.find(piece(inner, i));
    if (found == pieces_.end() || found->second.first == kNone) continue;
    if (found->second.first != polygon || found->second.last != polygon) return true;
  }
  return false;
}

}  // namespace mesher
