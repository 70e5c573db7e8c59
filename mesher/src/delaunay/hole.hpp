// The hole left by a removed vertex, and the simplices of its neighbours' own triangulation that
// fill it.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "delaunay/facets.hpp"
#include "delaunay/simplex_store.hpp"

namespace mesher::detail {

/// A facet of a simplex: its corners, ascending, and whether they had to be permuted oddly to the
/// order of kFacet. The two simplices of a facet see it with different `odd`.
template <int D>
struct OrientedFacet {
  std::array<std::uint32_t, D> corners;
  bool odd = false;

  OrientedFacet(const std::array<std::uint32_t, D + 1>& simplex, std::size_t across)
      : corners(facet_across<D>(simplex, across)) {
    order(0, 1);
    if constexpr (D == 3) {
      order(1, 2);
      order(0, 1);
    }
  }
  friend auto operator<=>(const OrientedFacet&, const OrientedFacet&) = default;

 private:
  void order(std::size_t i, std::size_t k) {
    if (corners[i] <= corners[k]) return;
    std::swap(corners[i], corners[k]);
    odd = !odd;
  }
};

/// The facets around a hole, as the simplices in it see them.
template <int D>
class HoleBorder {
 public:
  using Ids = std::array<std::uint32_t, D + 1>;

  /// A simplex of the hole with corner i inside. Call done() after the last.
  void add(const Ids& simplex, std::size_t i) { facets_.emplace_back(simplex, i); }
  void done() { std::sort(facets_.begin(), facets_.end()); }
  [[nodiscard]] bool has(const Ids& simplex, std::size_t i) const {
    return std::binary_search(facets_.begin(), facets_.end(), OrientedFacet<D>(simplex, i));
  }

 private:
  std::vector<OrientedFacet<D>> facets_;
};

/// The simplices of `all` within the border: from the first at it on, through facets that are not
/// of the border.
template <int D, class Store>
[[nodiscard]] std::vector<std::array<std::uint32_t, D + 1>> simplices_within(
    const HoleBorder<D>& border, const Store& all) {
  std::vector<std::uint32_t> inside;
  std::vector<bool> seen(all.places());
  const auto at_border = [&](std::uint32_t s) {
    for (std::size_t i = 0; i <= D; ++i) {
      if (border.has(all.corners(s), i)) return true;
    }
    return false;
  };
  for (std::uint32_t s = 0; s < all.places() && inside.empty(); ++s) {
    if (all.alive(s) && at_border(s)) inside.push_back(s), seen[s] = true;
  }
  std::vector<std::array<std::uint32_t, D + 1>> corners;
  for (std::size_t k = 0; k < inside.size(); ++k) {
    const std::uint32_t s = inside[k];
    corners.push_back(all.corners(s));
    for (std::size_t i = 0; i <= D; ++i) {
      const std::uint32_t other = all.across(s)[i] >> 2;
      if (seen[other] || border.has(all.corners(s), i)) continue;
      inside.push_back(other);
      seen[other] = true;
    }
  }
  return corners;
}

}  // namespace mesher::detail
