// The common items of two ascending sets.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace mesher::detail {

/// The first of [from, end) that is not below `item`. Cost: O(log) of how far that is.
template <class Iterator, class Item>
[[nodiscard]] Iterator leap(Iterator from, Iterator end, const Item& item) {
  std::ptrdiff_t step = 1;
  while (step < end - from && from[step] < item) from += step, step *= 2;
  return std::lower_bound(from, from + std::min(step, end - from), item);
}

/// Calls visit(item) for the common items of two ascending sets, ascending, until it returns true;
/// returns whether it did. Cost: O(k log n), k how often one has to be left for the other: few
/// where the items of each have been numbered one after the other.
template <class Item, class Visit>
bool visit_common(const std::vector<Item>& a, const std::vector<Item>& b, Visit&& visit) {
  auto i = a.begin(), j = b.begin();
  while (i != a.end() && j != b.end()) {
    if (*i < *j) {
      i = leap(i, a.end(), *j);
    } else if (*j < *i) {
      j = leap(j, b.end(), *i);
    } else {
      if (visit(*i)) return true;
      ++i, ++j;
    }
  }
  return false;
}

}  // namespace mesher::detail
