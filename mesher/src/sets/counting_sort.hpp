// Counting sort: linear time for items spread evenly over their range.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

namespace mesher::detail {

/// Below as many, comparing is as fast.
inline constexpr std::size_t kFewToSort = 64;

/// Copies `items` to `sorted` by their parts, in each in the order given; returns where each part
/// begins, and at last items.size(). part_of(item) is below `parts`.
/// Requires: as many sorted, fewer than 2^32. Cost: O(items + parts).
template <class Item, class PartOf>
std::vector<std::uint32_t> sort_by_part(std::span<const Item> items, std::span<Item> sorted,
                                        std::size_t parts, const PartOf& part_of) {
  std::vector<std::uint32_t> begin(parts + 2, 0);  // of part p at p + 2, then at p + 1
  for (const Item& item : items) ++begin[part_of(item) + std::size_t{2}];
  std::inclusive_scan(begin.begin(), begin.end(), begin.begin());
  for (const Item& item : items) sorted[begin[part_of(item) + std::size_t{1}]++] = item;
  begin.pop_back();
  return begin;
}

/// Puts items of lower keys first, by counting parts of the keys' range, and parts of these;
/// calls finish(items, spare) for each part that is small or of one key.
/// key_of(item): 64 bits. Requires: as many `spare`, fewer than 2^32.
/// Cost: O(n) if keys are even in their range or in parts of it, O(n log n) at most, and `finish`.
template <class Item, class KeyOf, class Finish>
void spread_by_key(std::span<Item> items, std::span<Item> spare, const KeyOf& key_of,
                   const Finish& finish) {
  const auto range = [&] {
    std::uint64_t least = key_of(items.front()), most = least;
    for (const Item& item : items) {
      const std::uint64_t key = key_of(item);
      least = std::min(least, key), most = std::max(most, key);
    }
    return std::pair(least, most - least);
  };
  const auto [least, width] =
      items.size() < kFewToSort ? std::pair(std::uint64_t{0}, std::uint64_t{0}) : range();
  if (width == 0) {
    finish(items, spare);
    return;
  }
  // A part is less than a 32nd of the range: no more than 13 levels.
  const int shift = std::max(
      0, static_cast<int>(std::bit_width(width)) - static_cast<int>(std::bit_width(items.size())));
  const auto part_of = [&, lowest = least](const Item& item) {
    return (key_of(item) - lowest) >> shift;
  };
  const std::vector<std::uint32_t> begin =
      sort_by_part<Item>(items, spare, (width >> shift) + 1, part_of);
  std::copy(spare.begin(), spare.end(), items.begin());
  for (std::size_t part = 0; part + 1 < begin.size(); ++part) {
    const std::size_t from = begin[part], count = begin[part + 1] - from;
    if (count < 2) continue;
    spread_by_key(items.subspan(from, count), spare.subspan(from, count), key_of, finish);
  }
}

/// Sorts `items` as std::sort would with is_before, where none comes before one of a lower key.
/// As spread_by_key.
template <class Item, class KeyOf, class IsBefore>
void sort_spread(std::vector<Item>& items, const KeyOf& key_of, const IsBefore& is_before) {
  std::vector<Item> spare(items.size());
  spread_by_key(std::span<Item>(items), std::span<Item>(spare), key_of,
                [&](std::span<Item> part, std::span<Item>) {
                  std::sort(part.begin(), part.end(), is_before);
                });
}

}  // namespace mesher::detail
