// Memory for names before they change, so that to change them cannot fail.
#pragma once

#include <cstddef>
#include <vector>

namespace mesher::detail {

/// So that merging `more` needs no memory. Cost: amortized O(more).
template <class Table>
void make_room_for(Table& table, const Table& more) {
  const std::size_t most = table.size() + more.size();
  const auto buckets = static_cast<float>(table.bucket_count());
  // One without any needs more, though its load would do.
  if (static_cast<float>(most) >= table.max_load_factor() * buckets) {
    table.reserve(2 * most + 16);  // never less than there is: that would move all
  }
}

/// So that there is a place `last`. Cost: amortized O(1) for each.
template <class T>
void make_place(std::vector<T>& all, std::size_t last) {
  if (last >= all.capacity()) all.reserve(2 * last + 16);
  if (last >= all.size()) all.resize(last + 1);
}

}  // namespace mesher::detail
