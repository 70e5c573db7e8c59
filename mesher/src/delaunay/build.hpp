// A triangulation of many points from nothing, and what is left of one for those who ask.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "delaunay/independent.hpp"
#include "delaunay/kernel.hpp"

namespace mesher::detail {

/// Calls duplicate(v, w) for each of `vertices` with an earlier one w of the same place, w the
/// first of them.
template <int D, class Duplicate>
void find_duplicates(const DelaunayKernel<D>& kernel, std::span<const std::uint32_t> vertices,
                     Duplicate&& duplicate) {
  std::vector<std::uint32_t> sorted(vertices.begin(), vertices.end());
  std::stable_sort(sorted.begin(), sorted.end(), [&](std::uint32_t a, std::uint32_t b) {
    return kernel.place(a) < kernel.place(b);
  });
  std::uint32_t first = kNone;
  for (const std::uint32_t v : sorted) {
    if (first != kNone && kernel.place(first) == kernel.place(v)) {
      duplicate(v, first);
    } else {
      first = v;
    }
  }
}

/// Inserts these places, in this order but for the first simplex, or none if all are in one
/// hyperplane: returns false then. Calls duplicate(v, w) for each v with an earlier one of the same
/// place, w the first of them.
template <int D, class Duplicate>
bool build(DelaunayKernel<D>& kernel, std::span<const std::uint32_t> vertices,
           Duplicate&& duplicate) {
  Independent<D> first;
  for (const std::uint32_t v : vertices) {
    if (first.full()) break;
    first.offer(v, kernel.place(v));
  }
  if (!first.full()) {
    find_duplicates(kernel, vertices, duplicate);
    return false;
  }
  kernel.start(first.names());
  for (const std::uint32_t v : vertices) {
    if (first.keeps(v)) continue;
    const std::uint32_t w = kernel.insert(v);
    if (w != v) duplicate(v, w);
  }
  return true;
}

/// The corners, called name(v), and the neighbours (kNone on the hull) of the simplices that are no
/// ghosts. Allocates nothing.
template <int D, class Name>
auto without_ghosts(SimplexStore<D> store, Name&& name) {
  using Ids = typename SimplexStore<D>::Ids;
  store.remove_if([](const Ids& c) { return std::find(c.begin(), c.end(), kInfinite) != c.end(); });
  auto corners = store.release_corners(), across = store.release_across();
  for (Ids& c : corners) {
    for (std::uint32_t& v : c) v = name(v);
  }
  for (Ids& a : across) {
    for (std::uint32_t& code : a) code = code == kNone ? kNone : code >> 2;
  }
  return std::pair{std::move(corners), std::move(across)};
}

}  // namespace mesher::detail
