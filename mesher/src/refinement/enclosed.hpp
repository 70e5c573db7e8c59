// Which simplices walls enclose, less holes, in a triangulation that is refined.
//
// Walls are facets, which stay where they are: only what is new has to be looked at, and it is
// where what was there before is, on the same side of them.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "delaunay/kernel.hpp"
#include "refinement/clear_of_side.hpp"

namespace mesher::detail {

/// `is_wall(s, i)`: of the facet across from corner i of s.
template <int D>
class Enclosed {
 public:
  using Kernel = DelaunayKernel<D, BallLayout<D>>;

  explicit Enclosed(const Kernel& kernel) : kernel_(kernel) {}

  /// Finds what is outside: what no walls part from the hull, or from one of `holes` that is not
  /// within `near` of a wall. Returns: whether there is anything else.
  template <class IsWall>
  bool find(std::span<const Point<D>> holes, double near, IsWall&& is_wall);
  /// After an insertion.
  void forget_made() {
    region_.resize(kernel_.simplices().places(), Region::unknown);
    for (const std::uint32_t s : kernel_.made()) region_[s] = Region::unknown;
  }
  /// Requires: find(). Cost: amortized O(1) for each that was made.
  template <class IsWall>
  [[nodiscard]] bool is_outside(std::uint32_t s, IsWall&& is_wall);

 private:
  enum class Region : std::uint8_t { unknown, inside, outside };

  template <class IsWall>
  [[nodiscard]] bool is_near_wall(const Point<D>& p, std::uint32_t s, double near,
                                  IsWall&& is_wall) const;
  template <class IsWall>
  void flood_outside(std::uint32_t from, IsWall&& is_wall);
  [[nodiscard]] std::uint32_t across(std::uint32_t s, std::uint32_t i) const noexcept {
    return kernel_.simplices().across(s)[i] >> 2;
  }

  const Kernel& kernel_;
  std::vector<Region> region_;  // by simplex
};

template <int D>
template <class IsWall>
bool Enclosed<D>::find(std::span<const Point<D>> holes, double near, IsWall&& is_wall) {
  const auto& simplices = kernel_.simplices();
  region_.assign(simplices.places(), Region::unknown);
  std::uint32_t at = kNone;
  for (std::uint32_t s = 0; s < simplices.places(); ++s) {
    if (!simplices.alive(s)) continue;
    at = s;
    if (kernel_.is_ghost(s)) flood_outside(s, is_wall);
  }
  for (const Point<D>& p : holes) {
    at = kernel_.walk(p, at);
    if (!is_near_wall(p, at, near, is_wall)) flood_outside(at, is_wall);
  }
  bool encloses = false;
  for (std::uint32_t s = 0; s < simplices.places(); ++s) {
    if (!simplices.alive(s) || region_[s] != Region::unknown) continue;
    region_[s] = Region::inside;
    encloses = true;
  }
  return encloses;
}

/// s holds p. A wall near p is a facet of one of those that facets near p part from s.
template <int D>
template <class IsWall>
bool Enclosed<D>::is_near_wall(const Point<D>& p, std::uint32_t s, double near,
                               IsWall&& is_wall) const {
  std::vector<std::uint32_t> all{s};
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (kernel_.is_ghost(all[k])) continue;
    for (std::uint32_t i = 0; i <= D; ++i) {
      if (is_clear_of_side<D>(kernel_, all[k], i, p, near)) continue;
      if (is_wall(all[k], i)) return true;
      const std::uint32_t other = across(all[k], i);
      if (std::find(all.begin(), all.end(), other) == all.end()) all.push_back(other);
    }
  }
  return false;
}

template <int D>
template <class IsWall>
void Enclosed<D>::flood_outside(std::uint32_t from, IsWall&& is_wall) {
  if (std::exchange(region_[from], Region::outside) == Region::outside) return;
  std::vector<std::uint32_t> all{from};
  while (!all.empty()) {
    const std::uint32_t s = all.back();
    all.pop_back();
    for (std::uint32_t i = 0; i <= D; ++i) {
      const std::uint32_t other = across(s, i);
      if (region_[other] == Region::outside || is_wall(s, i)) continue;
      region_[other] = Region::outside;
      all.push_back(other);
    }
  }
}

/// Unknown ones are joined to known ones around them; those that walls alone are around are inside.
template <int D>
template <class IsWall>
bool Enclosed<D>::is_outside(std::uint32_t s, IsWall&& is_wall) {
  if (region_[s] != Region::unknown) return region_[s] == Region::outside;
  std::vector<std::uint32_t> all{s};
  region_[s] = Region::inside;
  bool outside = false;
  for (std::size_t k = 0; k < all.size(); ++k) {
    for (std::uint32_t i = 0; i <= D; ++i) {
      const std::uint32_t other = across(all[k], i);
      if (is_wall(all[k], i)) continue;
      if (region_[other] == Region::unknown) {
        region_[other] = Region::inside;
        all.push_back(other);
      }
      outside = outside || region_[other] == Region::outside;
    }
  }
  if (outside) {
    for (const std::uint32_t t : all) region_[t] = Region::outside;
  }
  return outside;
}

}  // namespace mesher::detail
