// The edit distance of two strings: how many insertions, deletions and replacements of a letter
// make one of the other. Letters of both are changed, inserted and erased anywhere.
//
// Idea: both strings are cut into chunks (sac/list/chunks.hpp), the one has the rows of a grid of
// blocks, the other the columns (sac/list/grid.hpp). What blocks hand over are the differences of
// neighbouring distances along a border (bit_distances.hpp); further on, an edit leaves them as
// they were. The distance is the sum of the differences down the left border, which are all 1, and
// of those below the last row.
//
// Source: blocks and their borders, Masek, Paterson, *A faster algorithm computing string edit
// distances* (1980); in bits, Myers (1999).
// Cost of an update: the blocks of the row or column that the letter is in, and those around it
// whose borders change, O(most) operations each; O(log n) calls for the sums. A row has as many
// blocks as the other string has chunks; with a band O(band / most), while the strings are alike.
// Where nothing is alike, and where all letters are, changes of borders reach far.
// Stable because: a block is named by the ids of its two chunks, and with a band the columns of a
// row follow from the borders above it.
#pragma once

#include <cstdint>
#include <functional>
#include <string_view>
#include <vector>

#include "bit_distances.hpp"
#include "sac/sac.hpp"

namespace examples::edit_distance {

using Letters = std::vector<char>;

struct Block {
  using Across = Differences;
  using Down = Differences;
  static Across left(const Letters& row) { return rising(row.size()); }
  static Down above(const Letters& column) { return rising(column.size()); }
  static int rise(const Down& below) { return sum(below); }
  static void block(auto& s, const Letters& row, const Letters& column, Across& left, Down& above) {
    s.weigh(column.size());
    cross_block(row, column, left, above);
  }
};
inline std::int64_t length(const Letters& row) { return static_cast<std::int64_t>(row.size()); }

/// The program. Chunks have at most `most` letters, 1 to 64. With a band, the result is the
/// distance if that is at most `band`; else it is the number of operations of one way to make one
/// string of the other: never less than the distance, and more only if the least ways leave the
/// band. (A way of at most `band` operations comes to a block only if a corner above the block is
/// at most `band + most + most / 2`, and no corner is below 0.)
struct EditDistance {
  static constexpr std::string_view kName = "edit_distance";
  template <class S>
  void operator()(S& s, sac::List<char, S> a, sac::List<char, S> b, int band, int most,
                  typename S::template ModType<std::int64_t> distance) const {
    if (band < 0 || most > 64) throw sac::UsageError("edit_distance: no such band or chunk");
    const std::int64_t reach = std::int64_t{band} + most + most / 2;
    const auto rows = sac::chunks(s, a, most);
    const auto columns = sac::grid<Block>(s, rows, sac::chunks(s, b, most), reach);
    const auto left = sac::map_reduce<&length, std::plus<>{}>(s, rows, std::int64_t{0});
    const auto below = sac::rise_of<Block>(s, columns);
    s.write(distance, sac::fetch(s, left) + sac::fetch(s, below));
  }
};
inline constexpr EditDistance edit_distance{};

}  // namespace examples::edit_distance
