// Edit distances of the beginnings of two short strings, 64 at a time: how the distances along two
// borders of a block of their table follow from those along the other two.
//
// Idea: neighbouring distances differ by at most one, so a border is two words of differences, and
// a column of the block follows from the one before by a dozen operations on words.
//
// Source: Myers, *A fast bit-vector algorithm for approximate string matching based on dynamic
// programming* (1999), whose Pv, Mv, Ph, Mh, Xv, Xh these are; Hyyrö, *A bit-vector algorithm for
// computing Levenshtein and Damerau edit distances* (2003).
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace examples {

/// The differences of neighbouring distances along a border of at most 64 letters: bit i of `up` if
/// the distance behind letter i is one more than before it, of `down` if it is one less. Bits that
/// belong to no letter are 0.
struct Differences {
  std::uint64_t up = 0;
  std::uint64_t down = 0;
  friend bool operator==(const Differences&, const Differences&) = default;
};

/// Where each letter adds one: 1 to 64 letters.
[[nodiscard]] inline Differences rising(std::size_t letters) noexcept {
  return {~std::uint64_t{0} >> (64 - letters), 0};
}
/// The distance at the end of a border, less that at its beginning.
[[nodiscard]] inline int sum(const Differences& d) noexcept {
  return std::popcount(d.up) - std::popcount(d.down);
}

/// Makes the differences right of a block of those left of it, and those below of those above.
/// Requires: row and column have 1 to 64 letters, as many as their borders. Cost: O(64 + |column|).
inline void cross_block(const std::vector<char>& row, const std::vector<char>& column,
                        Differences& left, Differences& above) noexcept {
  std::array<std::uint64_t, 256> places{};  // in the row, of each letter
  for (std::size_t i = 0; i < row.size(); ++i) {
    places[static_cast<unsigned char>(row[i])] |= std::uint64_t{1} << i;
  }
  const std::size_t last = row.size() - 1;
  auto [pv, mv] = left;
  Differences below;
  for (std::size_t j = 0; j < column.size(); ++j) {
    const std::uint64_t rises = above.up >> j & 1, falls = above.down >> j & 1;
    const std::uint64_t equal = places[static_cast<unsigned char>(column[j])];
    const std::uint64_t xv = equal | mv, eq = equal | falls;
    const std::uint64_t xh = (((eq & pv) + pv) ^ pv) | eq;
    std::uint64_t ph = mv | ~(xh | pv), mh = pv & xh;
    below.up |= (ph >> last & 1) << j;
    below.down |= (mh >> last & 1) << j;
    ph = ph << 1 | rises;
    mh = mh << 1 | falls;
    pv = mh | ~(xv | ph);
    mv = ph & xv;
  }
  const std::uint64_t letters = rising(row.size()).up;
  left = {pv & letters, mv & letters};
  above = below;
}

}  // namespace examples
