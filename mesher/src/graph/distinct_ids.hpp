// Refuses duplicate ids.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

#include "mesher/error.hpp"
#include "mesher/graph.hpp"

namespace mesher::detail {

template <class Part>
[[nodiscard]] auto ids_of(const std::vector<Part>& parts) {
  std::vector<decltype(Part::id)> ids;
  ids.reserve(parts.size());
  for (const Part& part : parts) ids.push_back(part.id);
  return ids;
}

/// The numbers of two ids that are equal, of which the later one is the first to repeat an earlier
/// one; nothing if all differ. Cost: O(n) where they ascend, else O(n log n).
template <class Id>
[[nodiscard]] std::optional<std::array<std::size_t, 2>> repeated(const std::vector<Id>& ids) {
  if (std::adjacent_find(ids.begin(), ids.end(), std::greater_equal<>()) == ids.end()) return {};
  std::vector<std::size_t> order(ids.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t i, std::size_t k) { return ids[i] < ids[k]; });
  std::optional<std::array<std::size_t, 2>> first;
  for (std::size_t k = 1; k < order.size(); ++k) {
    if (ids[order[k - 1]] != ids[order[k]]) continue;
    if (!first || order[k] < (*first)[1]) first = {order[k - 1], order[k]};
  }
  return first;
}

/// Throws: Error(repeated_id) for the first id that an earlier one is. `location_of(i)`: where the
/// i-th stands, without a line if that is not known. Cost: as repeated().
template <class Id, class LocationOf>
void require_distinct(const std::vector<Id>& ids, LocationOf location_of) {
  const auto pair = repeated(ids);
  if (!pair) return;
  const auto [earlier, later] = *pair;
  const long line = location_of(earlier).line;
  throw Error(ErrorCode::repeated_id,
              text_of(ids[later]) + " is given twice" +
                  (line > 0 ? ", first on line " + std::to_string(line) : ""),
              location_of(later), {ids[later]});
}

}  // namespace mesher::detail
