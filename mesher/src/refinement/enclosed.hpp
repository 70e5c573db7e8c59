// Which simplices walls enclose, less holes, in a triangulation that is refined, and which are in
// regions that are named by a place.
//
// Walls are facets, which stay where they are: only what is new has to be looked at, and it is
// where what was there before is, on the same side of them. Of a region that is new as a whole the
// places say what it is.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "delaunay/kernel.hpp"
#include "geometry/box.hpp"
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
  /// Names what no walls part from p, unless p is within `near` of a wall, or that has a name.
  /// `outside_too`: else what is outside has none. Requires: find(); nothing was inserted since.
  template <class IsWall>
  void name_region(const Point<D>& p, std::uint32_t name, double near, bool outside_too,
                   IsWall&& is_wall);
  /// After an insertion.
  void forget_made() {
    region_.resize(kernel_.simplices().places(), kUnknown);
    for (const std::uint32_t s : kernel_.made()) region_[s] = kUnknown;
  }
  /// Requires: find(). Cost: amortized O(1) for each that was made.
  template <class IsWall>
  [[nodiscard]] bool is_outside(std::uint32_t s, IsWall&& is_wall) {
    return region(s, is_wall) == kOutside;
  }
  /// Of its region; kNone: it has no name. Requires and cost: as is_outside().
  template <class IsWall>
  [[nodiscard]] std::uint32_t name(std::uint32_t s, IsWall&& is_wall) {
    const Region found = region(s, is_wall);
    return found < kNamed ? kNone : found - kNamed;
  }

 private:
  using Region = std::uint32_t;
  static constexpr Region kUnknown = 0, kInside = 1, kOutside = 2, kNamed = 3;  // and on

  template <class IsWall>
  [[nodiscard]] bool is_near_wall(const Point<D>& p, std::uint32_t s, double near,
                                  IsWall&& is_wall) const;
  template <class IsWall>
  void flood(std::uint32_t from, Region region, IsWall&& is_wall);
  template <class IsWall>
  [[nodiscard]] Region region(std::uint32_t s, IsWall&& is_wall);
  [[nodiscard]] Region named_in(const std::vector<std::uint32_t>& all) const;
  [[nodiscard]] std::uint32_t across(std::uint32_t s, std::uint32_t i) const noexcept {
    return kernel_.simplices().across(s)[i] >> 2;
  }

  const Kernel& kernel_;
  struct Named {
    Point<D> at;
    Region region;
  };
  std::vector<Region> region_;  // by simplex
  std::vector<Named> named_;
};

template <int D>
template <class IsWall>
bool Enclosed<D>::find(std::span<const Point<D>> holes, double near, IsWall&& is_wall) {
  const auto& simplices = kernel_.simplices();
  region_.assign(simplices.places(), kUnknown);
  named_.clear();
  std::uint32_t at = kNone;
  for (std::uint32_t s = 0; s < simplices.places(); ++s) {
    if (!simplices.alive(s)) continue;
    at = s;
    if (kernel_.is_ghost(s)) flood(s, kOutside, is_wall);
  }
  for (const Point<D>& p : holes) {
    at = kernel_.walk(p, at);
    if (is_near_wall(p, at, near, is_wall)) continue;
    flood(at, kOutside, is_wall);
    named_.push_back({p, kOutside});
  }
  bool encloses = false;
  for (std::uint32_t s = 0; s < simplices.places(); ++s) {
    if (!simplices.alive(s) || region_[s] != kUnknown) continue;
    region_[s] = kInside;
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
void Enclosed<D>::name_region(const Point<D>& p, std::uint32_t name, double near, bool outside_too,
                              IsWall&& is_wall) {
  std::uint32_t from = 0;
  while (!kernel_.simplices().alive(from)) ++from;
  const std::uint32_t s = kernel_.walk(p, from);
  if (is_near_wall(p, s, near, is_wall)) return;
  if (region_[s] == kInside || (region_[s] == kOutside && outside_too)) {
    flood(s, kNamed + name, is_wall);
    named_.push_back({p, kNamed + name});
  }
}

template <int D>
template <class IsWall>
void Enclosed<D>::flood(std::uint32_t from, Region region, IsWall&& is_wall) {
  if (std::exchange(region_[from], region) == region) return;
  std::vector<std::uint32_t> all{from};
  while (!all.empty()) {
    const std::uint32_t s = all.back();
    all.pop_back();
    for (std::uint32_t i = 0; i <= D; ++i) {
      const std::uint32_t other = across(s, i);
      if (region_[other] == region || is_wall(s, i)) continue;
      region_[other] = region;
      all.push_back(other);
    }
  }
}

/// Unknown ones are joined to known ones around them; those that walls alone are around are inside.
template <int D>
template <class IsWall>
auto Enclosed<D>::region(std::uint32_t s, IsWall&& is_wall) -> Region {
  if (region_[s] != kUnknown) return region_[s];
  std::vector<std::uint32_t> all{s};
  region_[s] = kInside;
  Region found = kInside;
  for (std::size_t k = 0; k < all.size(); ++k) {
    for (std::uint32_t i = 0; i <= D; ++i) {
      const std::uint32_t other = across(all[k], i);
      if (is_wall(all[k], i)) continue;
      if (region_[other] == kUnknown) {
        region_[other] = kInside;
        all.push_back(other);
      }
      if (region_[other] != kInside) found = region_[other];
    }
  }
  if (found == kInside) found = named_in(all);
  if (found != kInside) {
    for (const std::uint32_t t : all) region_[t] = found;
  }
  return found;
}

/// What a place in one of them says, else kInside. Requires: no ghosts.
template <int D>
auto Enclosed<D>::named_in(const std::vector<std::uint32_t>& all) const -> Region {
  if (named_.empty()) return kInside;
  const auto at = [&](std::uint32_t v) -> const Point<D>& { return kernel_.place(v); };
  Box<D> box{at(kernel_.simplices().corners(all.front())[0]), {}};
  box.hi = box.lo;
  for (const std::uint32_t s : all) {
    for (const std::uint32_t v : kernel_.simplices().corners(s)) grow(box, at(v));
  }
  for (const auto& [p, region] : named_) {
    if (!contains(box, p)) continue;
    const std::uint32_t s = kernel_.walk(p, all.front());
    if (std::find(all.begin(), all.end(), s) != all.end()) return region;
  }
  return kInside;
}

}  // namespace mesher::detail
