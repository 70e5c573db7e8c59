// What is around an edge of a triangulation.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "delaunay/facets.hpp"
#include "delaunay/kernel.hpp"
#include "mesher/predicates.hpp"

namespace mesher::detail {

/// Whether an edge is there, and of which vertex of the simplices around it something is true.
struct AtEdge {
  bool is_there = false;
  std::uint32_t by = kNone;
};

/// Of the edge ab: the first vertex, but its ends, of which encroaches(w). If that is asked of a
/// ball around ab, and any vertex is in it, one of these is. `star`: scratch. Cost: O(star of a).
template <class Kernel, class Encroaches>
[[nodiscard]] AtEdge look_at_edge(Kernel& kernel, std::uint32_t a, std::uint32_t b,
                                  std::vector<std::uint32_t>& star, Encroaches&& encroaches) {
  AtEdge at;
  kernel.find_in_star(a, star, [](std::uint32_t) { return false; });
  for (const std::uint32_t s : star) {
    const auto& corners = kernel.simplices().corners(s);
    if (corner_of(corners, b) == corners.size()) continue;
    at.is_there = true;
    for (const std::uint32_t w : corners) {
      if (w == a || w == b || w == kInfinite || !encroaches(w)) continue;
      at.by = w;
      return at;
    }
  }
  return at;
}

/// The way to an edge ab in the star of a, over facets that b is beyond: in a Delaunay
/// triangulation it does not go in circles. Where b is on the plane of a facet, or the way leaves
/// the hull, it is lost.
template <class Kernel>
class WayToEdge {
 public:
  enum class State : std::uint8_t { under_way, there, no_edge, lost };

  /// From s on, in the star of a.
  WayToEdge(const Kernel& kernel, std::uint32_t s, std::uint32_t a, std::uint32_t b)
      : kernel_(kernel), simplex_(s), a_(a), b_(b) {}

  /// A step. Requires: it is under way. Cost: O(1).
  State step() {
    if (kernel_.is_ghost(simplex_)) return State::lost;
    const auto corners = kernel_.simplices().corners(simplex_);
    if (corner_of(corners, b_) != corners.size()) return State::there;
    bool is_inside = true;
    for (std::uint32_t i = 0; i < 4; ++i) {
      if (corners[i] == a_) continue;
      auto with_b = corners;
      with_b[i] = b_;
      const auto& [p, q, r, t] = with_b;
      const int side = predicates::orient3d(kernel_.place(p), kernel_.place(q), kernel_.place(r),
                                            kernel_.place(t));
      if (side < 0) {
        simplex_ = kernel_.simplices().across(simplex_)[i] >> 2;
        return State::under_way;
      }
      is_inside = is_inside && side > 0;
    }
    return is_inside ? State::no_edge : State::lost;
  }
  /// Requires: it is there.
  [[nodiscard]] std::uint32_t simplex() const noexcept { return simplex_; }

 private:
  const Kernel& kernel_;
  std::uint32_t simplex_, a_, b_;
};

/// Which simplex has the edge ab, and whether that is known.
struct OnTheWay {
  bool is_known = false;
  std::uint32_t simplex = kNone;  // none: there is no such edge
};

/// The ways in the stars of a and of b, step by step in turn: one of these may have many simplices.
/// `scratch`: overwritten. Cost: O(steps of the shorter one).
template <class Kernel>
[[nodiscard]] OnTheWay walk_to_edge(Kernel& kernel, std::uint32_t a, std::uint32_t b,
                                    std::vector<std::uint32_t>& scratch) {
  using Way = WayToEdge<Kernel>;
  constexpr int kMost = 8192;
  const auto any = [&](std::uint32_t v) {
    return kernel.find_in_star(v, scratch, [](std::uint32_t) { return true; });
  };
  std::array<Way, 2> ways{Way(kernel, any(a), a, b), Way(kernel, any(b), b, a)};
  std::array<bool, 2> is_lost{};
  for (int steps = 0; steps < kMost && !(is_lost[0] && is_lost[1]); ++steps) {
    for (std::size_t k = 0; k < 2; ++k) {
      if (is_lost[k]) continue;
      const auto state = ways[k].step();
      if (state == Way::State::there) return {true, ways[k].simplex()};
      if (state == Way::State::no_edge) return {true, kNone};
      is_lost[k] = state == Way::State::lost;
    }
  }
  return {};
}

/// The simplices with the edge ab, in space; none: it is no edge. Cost: O(steps of a walk, and
/// them), or O(star of a) where that says nothing.
template <class Kernel>
void find_at_edge(Kernel& kernel, std::uint32_t a, std::uint32_t b,
                  std::vector<std::uint32_t>& found) {
  const auto has = [&](std::uint32_t s, std::uint32_t v) {
    const auto& corners = kernel.simplices().corners(s);
    return corner_of(corners, v) != corners.size();
  };
  const OnTheWay on_the_way = walk_to_edge(kernel, a, b, found);
  if (!on_the_way.is_known) {
    kernel.find_in_star(a, found, [](std::uint32_t) { return false; });
    std::erase_if(found, [&](std::uint32_t s) { return !has(s, b); });
    return;
  }
  found.clear();
  if (on_the_way.simplex == kNone) return;
  std::uint32_t s = on_the_way.simplex, leaves = kNone;  // the corner that the next one has not
  do {
    found.push_back(s);
    const auto& corners = kernel.simplices().corners(s);
    std::uint32_t over = kNone, kept = kNone;
    for (std::uint32_t i = 0; i < 4; ++i) {
      if (corners[i] == a || corners[i] == b) continue;
      if (over == kNone && (leaves == kNone || corners[i] == leaves)) {
        over = i;
      } else {
        kept = corners[i];
      }
    }
    leaves = kept;
    s = kernel.simplices().across(s)[over] >> 2;
  } while (s != on_the_way.simplex);
}

}  // namespace mesher::detail
