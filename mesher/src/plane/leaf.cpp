// Making, finding and freeing the records of leaves.
#include "plane/leaf.hpp"

#include <bit>
#include <cmath>

namespace mesher::detail {

// Distances from the other end are differences of rounded lengths. Labels that differ do so by far
// more: a piece is at least 2^-44 of the box long, and labels in it are round numbers.
bool Leaf::ends_as_far(const Segment& own, const Label& label) const noexcept {
  const double rounding = 0x1p-50 * (own.length + segment->length);
  const auto as_far = [&](bool own_b, bool other_b) {
    const double distance = label.from(own_b, own.length);
    const auto is_equal = [&](const Label& end) {
      return std::abs(end.from(other_b, segment->length) - distance) <= rounding;
    };
    return is_equal(piece.lo) || is_equal(piece.hi);
  };
  for (const bool own_b : {false, true}) {
    const VertexHandle apex = own_b ? own.b : own.a;
    if (segment->has_end(apex) && as_far(own_b, segment->b == apex)) return true;
  }
  return false;
}

LeafHandle LeafRecords::fresh() {
  if (next_ / kChunk >= chunks_.size()) chunks_.push_back(std::make_unique<Chunk>());
  return next_++;
}

Leaf& LeafRecords::create(const Piece& piece) {
  const LeafHandle h = free_ != 0 ? free_ : fresh();
  free_ = (*this)[h].self;
  Leaf& leaf = (*this)[h] = Leaf{};
  const Segment& s = segments_[piece.segment];
  leaf.piece = piece;
  leaf.segment = &s;
  leaf.lo = place_of(s, piece.lo);
  leaf.hi = place_of(s, piece.hi);
  leaf.self = h;
  return leaf;
}

// A rounded radius may be too small by its last bits; the tree's margin covers that.
Leaf& LeafRecords::record(const Piece& piece) {
  if (const LeafHandle h = by_piece_.find(piece)) return (*this)[h];
  Leaf& leaf = create(piece);
  const double radius = std::hypot(leaf.hi[0] - leaf.lo[0], leaf.hi[1] - leaf.lo[1]) / 2;
  try {
    by_piece_.insert(leaf.self);
    try {
      tree_.insert(leaf.middle(), radius, leaf.self);
    } catch (...) {
      by_piece_.erase(leaf.self);
      throw;
    }
  } catch (...) {
    leaf.self = std::exchange(free_, leaf.self);
    throw;
  }
  return leaf;
}

void LeafRecords::release(Leaf& leaf) noexcept {
  const LeafHandle h = leaf.self;
  hide(leaf);
  by_piece_.erase(h);
  leaf = Leaf{};
  leaf.self = std::exchange(free_, h);
}

std::size_t LeafRecords::bytes() const noexcept {
  return chunks_.size() * sizeof(Chunk) + tree_.bytes() + by_piece_.bytes();
}

void LeafRecords::check_invariants() const {
  tree_.check_invariants();
  std::size_t used = 0;
  for_each([&](const Leaf& leaf) {
    ++used;
    SAC_INVARIANT(by_piece_.find(leaf.piece) == leaf.self);
  });
  SAC_INVARIANT(used == by_piece_.size());
  std::size_t free = 0;
  for (LeafHandle h = free_; h != 0; h = (*this)[h].self) ++free;
  SAC_INVARIANT(used + free == next_ - 1);
}

}  // namespace mesher::detail
