// Coordinates, the first simplex, the walk to the simplex that contains a point.
#pragma once

#include <algorithm>
#include <limits>

#include "delaunay/ball_filter.hpp"
#include "delaunay/facets.hpp"
#include "delaunay/flat_orientation.hpp"
#include "delaunay/kernel.hpp"
#include "delaunay/tuple_predicates.hpp"
#include "sac/check.hpp"

namespace mesher::detail {

template <int D>
Point<D> no_place() {
  Point<D> p;
  p.fill(std::numeric_limits<double>::quiet_NaN());
  return p;
}

template <int D, class Layout>
DelaunayKernel<D, Layout>::DelaunayKernel() : vertices_{{no_place<D>()}}, reach_(1, 0.0) {}

template <int D, class Layout>
void DelaunayKernel<D, Layout>::reserve(std::size_t points) {
  vertices_.reserve(points + 1);
  if constexpr (kHasBalls) reach_.reserve(points + 1);
  // Of random points: 2 triangles a vertex, 6.77 tetrahedra [Dwyer 1991]; and what is free for a
  // moment, and ghosts.
  const std::size_t simplices = D == 2 ? 2 * points + points / 50 : 7 * points;
  store_.reserve(simplices);
  mark_.reserve(simplices);
}

template <int D, class Layout>
std::uint32_t DelaunayKernel<D, Layout>::add_place(const Point<D>& p) {
  SAC_EXPECTS(vertices_.size() < kNone);
  const auto v = static_cast<std::uint32_t>(vertices_.size());
  if constexpr (kHasBalls) reach_.push_back(0);
  try {
    vertices_.push_back({p});
  } catch (...) {
    if constexpr (kHasBalls) reach_.pop_back();
    throw;
  }
  note_unit(v);
  return v;
}

template <int D, class Layout>
void DelaunayKernel<D, Layout>::set_place(std::uint32_t v, const Point<D>& p) noexcept {
  vertices_[v].place = p;
  note_unit(v);
}

template <int D, class Layout>
void DelaunayKernel<D, Layout>::note_unit(std::uint32_t v) noexcept {
  if constexpr (kHasBalls) {
    reach_[v] = exact_reach(place(v));
  } else {
    least_reach_ = std::min(least_reach_, exact_reach(place(v)));
  }
}

template <int D, class Layout>
void DelaunayKernel<D, Layout>::drop_place() noexcept {
  vertices_.pop_back();
  if constexpr (kHasBalls) reach_.pop_back();
}

template <int D, class Layout>
bool DelaunayKernel<D, Layout>::is_ghost(std::uint32_t s) const noexcept {
  const Ids& c = store_.corners(s);
  bool ghost = false;
  for (const std::uint32_t v : c) ghost |= v == kInfinite;
  return ghost;
}

/// s, or the simplex at the facet of a ghost s.
template <int D, class Layout>
std::uint32_t DelaunayKernel<D, Layout>::finite(std::uint32_t s) const noexcept {
  const std::uint32_t at = corner_of(s, kInfinite);
  return at > D ? s : store_.across(s)[at] >> 2;
}

template <int D, class Layout>
void DelaunayKernel<D, Layout>::start(const std::array<std::uint32_t, D + 1>& corners) {
  SAC_EXPECTS(store_.size() == 0);
  Ids c = corners;
  const int sign = orientation(places_of(c));
  SAC_EXPECTS(sign != 0);
  if (sign < 0) std::swap(c[0], c[1]);
  store_.make_room(D + 2);
  mark_.resize(store_.places(), 0);
  const std::uint32_t first = store_.take();
  store_.corners(first) = c;
  std::array<std::uint32_t, D + 1> ghosts;
  // Two corners swapped, since infinity is on the other side of the facet.
  for (std::uint32_t i = 0; i <= D; ++i) {
    ghosts[i] = store_.take();
    store_.corners(ghosts[i]) = c;
    store_.corners(ghosts[i])[i] = kInfinite;
    const auto& facet = kFacet<D>[i];
    std::swap(store_.corners(ghosts[i])[facet[0]], store_.corners(ghosts[i])[facet[1]]);
    store_.join(first, i, ghosts[i], i);
  }
  for (std::uint32_t i = 0; i <= D; ++i) {
    for (std::uint32_t k = 0; k < i; ++k) {
      // ghost i lacks c[i]; it meets ghost k across its corner c[k].
      store_.join(ghosts[i], corner_of(ghosts[i], c[k]), ghosts[k], corner_of(ghosts[k], c[i]));
    }
  }
  for (const std::uint32_t v : c) vertices_[v].simplex = first;
  last_ = first;
  if constexpr (kHasBalls) {
    balls_.make_room(1);
    measure(first);
    for (const std::uint32_t s : ghosts) measure(s);
  }
}

/// The orientation of a simplex with p at corner i: negative if its facet is between it and p.
template <int D, class Layout>
int DelaunayKernel<D, Layout>::side(const Ids& corners, std::size_t i, const Point<D>& p) const {
  auto q = places_of(corners);
  q[i] = &p;
  if constexpr (D == 2) {
    return orientation(q);
  } else {
    const int sign = predicates::detail::orient3d_filter(*q[0], *q[1], *q[2], *q[3]);
    return sign != 0 ? sign : flat_orientation(q, least_reach(corners, i, p));
  }
}

/// Of p and the corners but corner i.
template <int D, class Layout>
double DelaunayKernel<D, Layout>::least_reach(const Ids& corners, std::size_t i,
                                              const Point<D>& p) const noexcept {
  double reach = exact_reach(p);
  for (std::size_t k = 0; k <= D; ++k) {
    if (k != i) reach = std::min(reach, kHasBalls ? reach_[corners[k]] : least_reach_);
  }
  return reach;
}

/// A simplex that holds p, or a ghost whose facet p is outside of. The visibility walk: through a
/// facet that has p on its other side, until there is none. It ends, since what is behind such a
/// facet is nearer to p in the order of power distances.
template <int D, class Layout>
std::uint32_t DelaunayKernel<D, Layout>::walk(const Point<D>& p, std::uint32_t from) const {
  std::uint32_t s = finite(from);
  for (std::uint32_t entered = kNone;;) {
    const Ids& c = store_.corners(s);
    std::uint32_t through = kNone;
    for (std::uint32_t i = 0; i <= D && through == kNone; ++i) {
      if (i != entered && side(c, i, p) < 0) through = store_.across(s)[i];
    }
    if (through == kNone) return s;
    s = through >> 2;
    entered = through & 3;
    if (is_ghost(s)) return s;
  }
}

template <int D, class Layout>
std::uint32_t DelaunayKernel<D, Layout>::insert(std::uint32_t v) {
  const Point<D>& p = place(v);
  SAC_EXPECTS(last_ != kNone);
  const std::uint32_t s = walk(p, last_);
  for (const std::uint32_t w : store_.corners(s)) {
    if (place(w) == p) return w;
  }
  dig(v, s);
  fill(v);
  return v;
}

template <int D, class Layout>
void DelaunayKernel<D, Layout>::clear_simplices() noexcept {
  store_.clear();
  mark_.clear();
  for (Vertex& v : vertices_) v.simplex = kNone;
  last_ = kNone;
}

template <int D, class Layout>
void DelaunayKernel<D, Layout>::clear() noexcept {
  clear_simplices();
  vertices_.resize(1);
  if constexpr (kHasBalls) reach_.resize(1);
  least_reach_ = std::numeric_limits<double>::max();
}

template <int D, class Layout>
auto DelaunayKernel<D, Layout>::release() && -> Store {
  DelaunayKernel all = std::move(*this);
  return std::move(all.store_);
}

}  // namespace mesher::detail
