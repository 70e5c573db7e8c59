// Locates positions among triangles or tetrahedra, by exact signs.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "geometry/box.hpp"
#include "mesh/half_faces.hpp"
#include "mesher/mesh.hpp"
#include "mesher/predicates.hpp"

namespace mesher::detail {

/// On which side of a simplex's side across from corner i a place is: inside 1, on its plane 0.
[[nodiscard]] inline int inward_side(const std::array<Point<2>, 3>& t, std::size_t i,
                                     const Point<2>& p) {
  return predicates::orient2d(t[(i + 1) % 3], t[(i + 2) % 3], p);
}
[[nodiscard]] inline int inward_side(const std::array<Point<3>, 4>& t, std::size_t i,
                                     const Point<3>& p) {
  constexpr auto kFaces = faces_of({0, 1, 2, 3});
  const auto [a, b, c] = kFaces[i];
  return -predicates::orient3d(t[a], t[b], t[c], p);
}
/// The sides that p is on the planes of, bit i: side i; nothing if the closed simplex does not hold
/// it.
template <std::size_t N>
[[nodiscard]] std::optional<unsigned> sides_at(const std::array<Point<N - 1>, N>& t,
                                               const Point<N - 1>& p) {
  unsigned sides = 0;
  for (std::size_t i = 0; i < N; ++i) {
    const int side = inward_side(t, i, p);
    if (side < 0) return std::nullopt;
    if (side == 0) sides |= 1u << i;
  }
  return sides;
}

/// Calls visit(i, simplex, sides) for each closed simplex that holds the i-th place, those of one
/// place in ascending order; sides: as sides_at. corners(t): the places of the t-th one's corners.
/// Cost: O(count log places), and a test for each simplex whose box a place is in.
template <int D, class Corners, class Visit>
void for_each_holding(const std::vector<Point<D>>& places, std::size_t count, Corners&& corners,
                      Visit&& visit) {
  std::vector<std::pair<double, std::uint32_t>> by_x;
  for (std::uint32_t i = 0; i < places.size(); ++i) by_x.emplace_back(places[i][0], i);
  std::sort(by_x.begin(), by_x.end());
  if (by_x.empty()) return;
  for (std::uint32_t t = 0; t < count; ++t) {
    const std::array<Point<D>, D + 1> simplex = corners(t);
    Box<D> box{simplex[0], simplex[0]};
    for (const Point<D>& corner : simplex) grow(box, corner);
    auto it = std::lower_bound(by_x.begin(), by_x.end(), std::pair{box.lo[0], std::uint32_t{0}});
    for (; it != by_x.end() && it->first <= box.hi[0]; ++it) {
      const Point<D>& p = places[it->second];
      if (!contains(box, p)) continue;
      if (const auto sides = sides_at(simplex, p)) visit(it->second, t, *sides);
    }
  }
}

/// For each place the first of `count` simplices that holds it, or `none`; likewise.
template <int D, class Corners>
[[nodiscard]] std::vector<std::uint32_t> first_holding(const std::vector<Point<D>>& places,
                                                       std::size_t count, Corners&& corners,
                                                       std::uint32_t none) {
  std::vector<std::uint32_t> found(places.size(), none);
  for_each_holding<D>(places, count, corners, [&](std::uint32_t i, std::uint32_t t, unsigned) {
    if (found[i] == none) found[i] = t;
  });
  return found;
}

}  // namespace mesher::detail
