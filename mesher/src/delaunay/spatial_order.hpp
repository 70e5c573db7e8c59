// The order in which many points are inserted into a Delaunay triangulation.
//
// Biased randomised insertion order (Amenta, Choi, Rote, "Incremental constructions con BRIO", SoCG
// 2003): a point belongs to the last round with probability 7/8, else to the one before with 7/8,
// and so on; in each round points are in the order of a Hilbert curve. The rounds make the expected
// work what a random order gives, the curve keeps memory and walks local. The "random" round is a
// hash of the point's coordinates, so the order is a function of the points alone.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesher/mesh.hpp"

namespace mesher::detail {

/// The indices of `points`; equal points in the order given.
/// Requires: n < 2^32, coordinates are finite and of magnitude up to 2^1000.
/// Cost: O(n), more where many points share a cell of a grid of about 64 n cells: O(n log s) for
/// points whose distances spread over a factor s.
template <int D>
[[nodiscard]] std::vector<std::uint32_t> spatial_order(std::span<const Point<D>> points);

/// These names, in the order of their places.
template <int D, class PlaceOf>
[[nodiscard]] std::vector<std::uint32_t> in_spatial_order(const std::vector<std::uint32_t>& names,
                                                          PlaceOf&& place_of) {
  std::vector<Point<D>> places;
  places.reserve(names.size());
  for (const std::uint32_t name : names) places.push_back(place_of(name));
  std::vector<std::uint32_t> order = spatial_order<D>(places);
  for (std::uint32_t& i : order) i = names[i];
  return order;
}

}  // namespace mesher::detail
