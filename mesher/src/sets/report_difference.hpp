// What two lists have that the other has not.
#pragma once

#include <algorithm>
#include <iterator>
#include <vector>

namespace mesher::detail {

/// Adds what has come less what has gone, and the other way round, ascending; puts both in order.
/// What is there k times more than in the other is added k times. Cost: O(n log n).
template <class List, class T>
void report_difference(List&& come, List&& gone, std::vector<T>& added, std::vector<T>& removed) {
  std::sort(come.begin(), come.end());
  std::sort(gone.begin(), gone.end());
  std::set_difference(come.begin(), come.end(), gone.begin(), gone.end(),
                      std::back_inserter(added));
  std::set_difference(gone.begin(), gone.end(), come.begin(), come.end(),
                      std::back_inserter(removed));
}

}  // namespace mesher::detail
