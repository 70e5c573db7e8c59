// Lists as sets.
#pragma once

#include <algorithm>
#include <vector>

namespace mesher::detail {

/// Sorts the items, and leaves one of each. Cost: O(n log n).
template <class T>
void make_set(std::vector<T>& items) {
  std::sort(items.begin(), items.end());
  items.erase(std::unique(items.begin(), items.end()), items.end());
}

}  // namespace mesher::detail
