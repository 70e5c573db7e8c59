// Finds the simplices that a point conflicts with.
#pragma once

#include <algorithm>
#include <limits>

#include "delaunay/ball_filter.hpp"
#include "delaunay/grid_ball.hpp"
#include "delaunay/kernel.hpp"
#include "delaunay/tuple_predicates.hpp"

namespace mesher::detail {

enum Mark : std::uint8_t { kUnseen = 0, kInside, kOutside };

/// Of a point and the ball of a simplex, as far as the filter is sure.
template <int D, class Layout>
[[gnu::always_inline]] inline BallSide DelaunayKernel<D, Layout>::quick_side(const Ids& c,
                                                                             const Point<D>& p,
                                                                             double reach) const {
  if constexpr (D == 2) {
    return in_ball_quickly(place(c[0]), place(c[1]), place(c[2]), p, reach);
  } else {
    return in_ball_quickly(place(c[0]), place(c[1]), place(c[2]), place(c[3]), p, reach);
  }
}

/// `tie`: whether p is known to be on the sphere, and no determinant is rounded.
template <int D, class Layout>
bool DelaunayKernel<D, Layout>::ball_holds_exactly(const Ids& c, const Point<D>& p,
                                                   bool tie) const {
  const auto q = places_of(c);
  return (tie ? break_tie<D>(q, p) : in_ball(q, p)) > 0;
}

template <int D, class Layout>
bool DelaunayKernel<D, Layout>::ball_holds(const Ids& c, const Point<D>& p) const {
  double reach = least_reach_;
  if constexpr (kHasBalls) {
    reach = exact_reach(p);
    for (const std::uint32_t v : c) reach = std::min(reach, reach_[v]);
  }
  const BallSide side = quick_side(c, p, reach);
  if (side == BallSide::inside || side == BallSide::outside) return side == BallSide::inside;
  return ball_holds_exactly(c, p, side == BallSide::tie);
}

/// `reach`: of p, if there are balls, when it is called.
template <int D, class Layout>
template <class Reach>
[[gnu::always_inline]] inline bool DelaunayKernel<D, Layout>::conflicts_quickly(
    std::uint32_t s, const Point<D>& p, Reach&& reach) const {
  BallSide side;
  if constexpr (kHasBalls) {
    side = store_.ball(s).side(p);
  } else {
    side = quick_side(store_.corners(s), p, least_reach_);
  }
  if (side == BallSide::inside || side == BallSide::outside) return side == BallSide::inside;
  if constexpr (kHasBalls) {
    return conflicts_slowly(s, p, reach());
  } else {
    return conflicts_slowly(s, p, side);
  }
}

template <int D, class Layout>
bool DelaunayKernel<D, Layout>::conflicts(std::uint32_t s, const Point<D>& p) const {
  return conflicts_quickly(s, p, [&] { return exact_reach(p); });
}

/// What the filter leaves: ties, ghosts, what is nearly a tie.
template <int D, class Layout>
[[gnu::noinline]] bool DelaunayKernel<D, Layout>::conflicts_slowly(std::uint32_t s,
                                                                   const Point<D>& p,
                                                                   BallSide side) const {
  const std::uint32_t infinite = corner_of(s, kInfinite);
  if (infinite <= D) return ghost_conflicts(s, infinite, p);
  return ball_holds_exactly(store_.corners(s), p, side == BallSide::tie);
}

/// Most points so near to a sphere are on it, and on a grid: the corners' and p's own, since a
/// refiner has such points among many others.
template <int D, class Layout>
[[gnu::noinline]] bool DelaunayKernel<D, Layout>::conflicts_slowly(std::uint32_t s,
                                                                   const Point<D>& p,
                                                                   double reach) const {
  const Ids& c = store_.corners(s);
  if constexpr (kHasBalls) {
    for (const std::uint32_t v : c) reach = std::min(reach, reach_[v]);
    const int side = side_on_grid<D>(places_of(c), store_.ball(s).centre, p, reach);
    if (side != 0) return side > 0;
  }
  const std::uint32_t infinite = corner_of(s, kInfinite);
  if (infinite <= D) return ghost_conflicts(s, infinite, p);
  return ball_holds_exactly(c, p, quick_side(c, p, reach) == BallSide::tie);
}

/// `i`: the corner at infinity.
template <int D, class Layout>
bool DelaunayKernel<D, Layout>::ghost_conflicts(std::uint32_t s, std::size_t i,
                                                const Point<D>& p) const {
  const int sign = side(store_.corners(s), i, p);
  return sign != 0 ? sign > 0 : conflicts(store_.across(s)[i] >> 2, p);
}

template <int D, class Layout>
bool DelaunayKernel<D, Layout>::is_doomed(std::uint32_t s) const noexcept {
  return mark_[s] == kInside;
}

template <int D, class Layout>
void DelaunayKernel<D, Layout>::dig(std::uint32_t v, std::uint32_t s) {
  try {
    find_doomed(v, s);
    make_room_for_fill();
  } catch (...) {
    undo_dig();
    throw;
  }
  if constexpr (D == 3) number_link();
}

/// Soon they are asked.
template <int D, class Layout>
[[gnu::always_inline]] inline void DelaunayKernel<D, Layout>::fetch_around(std::uint32_t s) const {
  for (const std::uint32_t code : store_.across(s)) {
    __builtin_prefetch(&store_.corners(code >> 2));
    __builtin_prefetch(&mark_[code >> 2]);
  }
}

/// The conflicting simplices from `start` on, and their borders.
template <int D, class Layout>
void DelaunayKernel<D, Layout>::find_doomed(std::uint32_t v, std::uint32_t start) {
  const Point<D> p = place(v);
  cavity_.push_back(start);
  mark_[start] = kInside;
  for (std::size_t k = 0; k < cavity_.size(); ++k) {
    const Ids& across = store_.across(cavity_[k]);
    for (std::uint32_t i = 0; i <= D; ++i) {
      const std::uint32_t other = across[i] >> 2;
      if (mark_[other] == kInside) continue;
      if (mark_[other] == kUnseen) {
        if (conflicts_quickly(other, p, [&] { return reach_[v]; })) {
          cavity_.push_back(other);
          mark_[other] = kInside;
          if constexpr (kHasBalls) fetch_around(other);
          continue;
        }
        outside_.push_back(other);
        mark_[other] = kOutside;
      }
      borders_.push_back({store_.corners(cavity_[k]), across[i], i});
      borders_.back().corners[i] = v;
    }
  }
}

template <int D, class Layout>
void DelaunayKernel<D, Layout>::undo_dig() noexcept {
  for (const std::uint32_t s : cavity_) mark_[s] = kUnseen;
  for (const std::uint32_t s : outside_) mark_[s] = kUnseen;
  cavity_.clear();
  outside_.clear();
  borders_.clear();
  if constexpr (D == 3) forget_link();
}

}  // namespace mesher::detail
