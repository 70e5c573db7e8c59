// Triangulates many positions of a kernel from scratch.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "delaunay/independent.hpp"
#include "delaunay/kernel.hpp"

namespace mesher::detail {

/// Calls duplicate(v, w) for each of `vertices` with an earlier one w of the same place, w the
/// first of them.
template <int D, class Layout, class Vertices, class Duplicate>
void find_duplicates(const DelaunayKernel<D, Layout>& kernel, const Vertices& vertices,
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
/// hyperplane: returns false then. Calls duplicate(v, w) for each v with an earlier one w of the
/// same place, w the first of them, and step() for each v. `vertices`: a range.
template <int D, class Layout, class Vertices, class Duplicate, class Step>
bool build(DelaunayKernel<D, Layout>& kernel, const Vertices& vertices, Duplicate&& duplicate,
           Step&& step) {
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
    step();
    if (first.keeps(v)) continue;
    const std::uint32_t w = kernel.insert(v);
    if (w != v) duplicate(v, w);
  }
  return true;
}
template <int D, class Layout, class Vertices, class Duplicate>
bool build(DelaunayKernel<D, Layout>& kernel, const Vertices& vertices, Duplicate&& duplicate) {
  return build<D>(kernel, vertices, duplicate, [] {});
}

}  // namespace mesher::detail
