// Insertion: walk, dig, fill.
#include "delaunay/kernel.hpp"

#include <algorithm>
#include <bit>
#include <limits>

#include "delaunay/ball_filter.hpp"
#include "delaunay/facets.hpp"
#include "sac/check.hpp"

namespace mesher::detail {

namespace {

enum Mark : std::uint8_t { kUnseen = 0, kInside, kOutside };

// Up to so many vertices around the new one, adjacent new simplices are found by a square table.
constexpr std::size_t kMostInTable = 256;

template <int D>
Point<D> no_place() {
  Point<D> p;
  p.fill(std::numeric_limits<double>::quiet_NaN());
  return p;
}

// insphere_perturbed and incircle_perturbed.
int in_ball(const std::array<const Point<2>*, 3>& q, const Point<2>& p) {
  return predicates::incircle_perturbed(*q[0], *q[1], *q[2], p);
}
int in_ball(const std::array<const Point<3>*, 4>& q, const Point<3>& p) {
  return predicates::insphere_perturbed(*q[0], *q[1], *q[2], *q[3], p);
}
int orientation(const std::array<const Point<2>*, 3>& q) {
  return predicates::orient2d(*q[0], *q[1], *q[2]);
}
int orientation(const std::array<const Point<3>*, 4>& q) {
  return predicates::orient3d(*q[0], *q[1], *q[2], *q[3]);
}

}  // namespace

template <int D>
DelaunayKernel<D>::DelaunayKernel() : places_{no_place<D>()}, simplex_of_{kNone}, local_{0} {}

template <int D>
void DelaunayKernel<D>::reserve(std::size_t points) {
  places_.reserve(points + 1);
  simplex_of_.reserve(points + 1);
  local_.reserve(points + 1);
  // Of random points: 2 triangles a vertex, 6.77 tetrahedra [Dwyer 1991]; and what is free for a
  // moment, and ghosts.
  const std::size_t simplices = D == 2 ? 2 * points + points / 50 : 7 * points;
  store_.reserve(simplices);
  mark_.reserve(simplices);
}

template <int D>
std::uint32_t DelaunayKernel<D>::add_place(const Point<D>& p) {
  SAC_EXPECTS(places_.size() < kNone);
  places_.push_back(p);
  try {
    simplex_of_.push_back(kNone);
    local_.push_back(0);
  } catch (...) {
    places_.pop_back();
    simplex_of_.resize(places_.size());
    throw;
  }
  return static_cast<std::uint32_t>(places_.size() - 1);
}

template <int D>
void DelaunayKernel<D>::drop_place() noexcept {
  places_.pop_back();
  simplex_of_.pop_back();
  local_.pop_back();
}

template <int D>
bool DelaunayKernel<D>::is_ghost(std::uint32_t s) const noexcept {
  const Ids& c = store_.corners(s);
  bool ghost = false;
  for (const std::uint32_t v : c) ghost |= v == kInfinite;
  return ghost;
}

/// s, or the simplex at the facet of a ghost s.
template <int D>
std::uint32_t DelaunayKernel<D>::finite(std::uint32_t s) const noexcept {
  const Ids& c = store_.corners(s);
  const auto at = std::find(c.begin(), c.end(), kInfinite);
  return at == c.end() ? s : store_.across(s)[static_cast<std::size_t>(at - c.begin())] >> 2;
}

template <int D>
void DelaunayKernel<D>::start(const std::array<std::uint32_t, D + 1>& corners) {
  SAC_EXPECTS(store_.size() == 0);
  Ids c = corners;
  std::array<const Point<D>*, D + 1> q;
  for (std::size_t i = 0; i <= D; ++i) q[i] = &places_[c[i]];
  const int sign = orientation(q);
  SAC_EXPECTS(sign != 0);
  if (sign < 0) std::swap(c[0], c[1]);
  store_.make_room(D + 2);
  mark_.resize(store_.places(), kUnseen);
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
      const auto corner_of = [&](std::uint32_t ghost, std::uint32_t v) {
        const Ids& in = store_.corners(ghost);
        return static_cast<std::uint32_t>(std::find(in.begin(), in.end(), v) - in.begin());
      };
      store_.join(ghosts[i], corner_of(ghosts[i], c[k]), ghosts[k], corner_of(ghosts[k], c[i]));
    }
  }
  for (const std::uint32_t v : c) simplex_of_[v] = first;
  last_ = first;
}

/// The orientation of a simplex with p at corner i: negative if its facet is between it and p.
template <int D>
int DelaunayKernel<D>::side(const Ids& corners, std::size_t i, const Point<D>& p) const {
  std::array<const Point<D>*, D + 1> q;
  for (std::size_t k = 0; k <= D; ++k) q[k] = &places_[corners[k]];
  q[i] = &p;
  return orientation(q);
}

template <int D>
bool DelaunayKernel<D>::conflicts(std::uint32_t s, const Point<D>& p) const {
  const Ids& c = store_.corners(s);
  int sign;
  if constexpr (D == 2) {
    sign = in_ball_quickly(places_[c[0]], places_[c[1]], places_[c[2]], p);
  } else {
    sign = in_ball_quickly(places_[c[0]], places_[c[1]], places_[c[2]], places_[c[3]], p);
  }
  return sign != 0 ? sign > 0 : conflicts_slowly(s, p);
}

template <int D>
[[gnu::noinline]] bool DelaunayKernel<D>::conflicts_slowly(std::uint32_t s,
                                                           const Point<D>& p) const {
  const Ids& c = store_.corners(s);
  std::array<const Point<D>*, D + 1> q;
  for (std::size_t i = 0; i <= D; ++i) {
    if (c[i] == kInfinite) return ghost_conflicts(s, i, p);
    q[i] = &places_[c[i]];
  }
  return in_ball(q, p) > 0;
}

/// `i`: the corner at infinity.
template <int D>
bool DelaunayKernel<D>::ghost_conflicts(std::uint32_t s, std::size_t i, const Point<D>& p) const {
  const int sign = side(store_.corners(s), i, p);
  return sign != 0 ? sign > 0 : conflicts(store_.across(s)[i] >> 2, p);
}

/// The visibility walk: through a facet that has p on its other side, until there is none. It ends,
/// since what is behind such a facet is nearer to p in the order of power distances.
template <int D>
std::uint32_t DelaunayKernel<D>::walk(const Point<D>& p, std::uint32_t from) const {
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

template <int D>
std::uint32_t DelaunayKernel<D>::locate(const Point<D>& p) const {
  SAC_EXPECTS(last_ != kNone);
  return walk(p, last_);
}

template <int D>
std::uint32_t DelaunayKernel<D>::insert(std::uint32_t v) {
  const Point<D>& p = places_[v];
  const std::uint32_t s = locate(p);
  for (const std::uint32_t w : store_.corners(s)) {
    if (places_[w] == p) return w;
  }
  try {
    dig(v, s);
    make_room_for_fill();
  } catch (...) {
    undo_dig();
    throw;
  }
  fill(v);
  return v;
}

/// The conflicting simplices from `start` on, and their borders.
template <int D>
void DelaunayKernel<D>::dig(std::uint32_t v, std::uint32_t start) {
  const Point<D> p = places_[v];
  cavity_.push_back(start);
  mark_[start] = kInside;
  for (std::size_t k = 0; k < cavity_.size(); ++k) {
    const Ids& across = store_.across(cavity_[k]);
    for (std::uint32_t i = 0; i <= D; ++i) {
      const std::uint32_t other = across[i] >> 2;
      if (mark_[other] == kInside) continue;
      if (mark_[other] == kUnseen) {
        if (conflicts(other, p)) {
          cavity_.push_back(other);
          mark_[other] = kInside;
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

template <int D>
void DelaunayKernel<D>::undo_dig() noexcept {
  for (const std::uint32_t s : cavity_) mark_[s] = kUnseen;
  for (const std::uint32_t s : outside_) mark_[s] = kUnseen;
  cavity_.clear();
  outside_.clear();
  borders_.clear();
}

/// All that fill() needs.
template <int D>
void DelaunayKernel<D>::make_room_for_fill() {
  const std::size_t n = borders_.size(), k = cavity_.size();
  if (n > k) store_.make_room(n - k);
  mark_.resize(store_.places(), kUnseen);
  if (cavity_.capacity() < n) cavity_.reserve(2 * n);
  if constexpr (D == 3) {
    const std::size_t vertices = n / 2 + 2;  // of a sphere of n triangles
    link_.reserve(vertices);
    const std::size_t width = std::bit_ceil(vertices);
    if (vertices > kMostInTable) {
      many_.reserve(3 * n);
    } else if (ridges_.size() < width * width) {
      ridges_.resize(width * width);
    }
  }
}

/// New simplices from the borders to v. The first take the places of the conflicting ones.
template <int D>
void DelaunayKernel<D>::fill(std::uint32_t v) noexcept {
  for (const std::uint32_t s : outside_) mark_[s] = kUnseen;
  for (const std::uint32_t s : cavity_) mark_[s] = kUnseen;
  while (cavity_.size() > borders_.size()) {
    store_.give(cavity_.back());
    cavity_.pop_back();
  }
  while (cavity_.size() < borders_.size()) cavity_.push_back(store_.take());
  place_borders();
  join_borders();
  last_ = simplex_of_[v] = cavity_.back();
  cavity_.clear();
  outside_.clear();
  borders_.clear();
}

/// Afterwards the new simplices have corners, and are joined with those outside.
template <int D>
void DelaunayKernel<D>::place_borders() noexcept {
  for (std::size_t k = 0; k < borders_.size(); ++k) {
    const Border& b = borders_[k];
    const std::uint32_t s = cavity_[k];
    store_.corners(s) = b.corners;
    store_.join(s, b.slot, b.outer >> 2, b.outer & 3);
    for (const std::uint32_t w : b.corners) simplex_of_[w] = s;
  }
}

/// Joins the new simplices with each other. In the plane each vertex of the border begins one edge
/// of it, counterclockwise.
template <>
void DelaunayKernel<2>::join_borders() noexcept {
  for (std::uint32_t k = 0; k < borders_.size(); ++k) {
    const Border& b = borders_[k];
    local_[b.corners[kFacet<2>[b.slot][0]]] = k;
  }
  for (std::uint32_t k = 0; k < borders_.size(); ++k) {
    const Border& b = borders_[k];
    const auto [from, to] = kFacet<2>[b.slot];
    const std::uint32_t next = local_[b.corners[to]];
    store_.join(cavity_[k], from, cavity_[next], kFacet<2>[borders_[next].slot][1]);
  }
}

/// In space each directed edge of the border belongs to one of its facets, and the opposite one to
/// the neighbour. Afterwards local_ of the link's vertices is 0 again.
template <>
void DelaunayKernel<3>::join_borders() noexcept {
  number_link();
  if (link_.size() > kMostInTable) {
    join_many_borders();
  } else {
    const std::size_t width = std::bit_ceil(link_.size());
    const auto edge = [&](const Border& b, std::uint32_t from, std::uint32_t to) -> std::uint32_t& {
      return ridges_[(local_[b.corners[from]] - 1) * width + (local_[b.corners[to]] - 1)];
    };
    for (std::uint32_t k = 0; k < borders_.size(); ++k) {
      const auto [i, j, l] = kFacet<3>[borders_[k].slot];
      edge(borders_[k], i, j) = cavity_[k] << 2 | l;
      edge(borders_[k], j, l) = cavity_[k] << 2 | i;
      edge(borders_[k], l, i) = cavity_[k] << 2 | j;
    }
    for (std::uint32_t k = 0; k < borders_.size(); ++k) {
      const auto [i, j, l] = kFacet<3>[borders_[k].slot];
      Ids& across = store_.across(cavity_[k]);
      across[l] = edge(borders_[k], j, i);
      across[i] = edge(borders_[k], l, j);
      across[j] = edge(borders_[k], i, l);
    }
  }
  for (const std::uint32_t v : link_) local_[v] = 0;
  link_.clear();
}

/// From 1.
template <int D>
void DelaunayKernel<D>::number_link() noexcept {
  for (const Border& b : borders_) {
    for (const std::uint32_t i : kFacet<D>[b.slot]) {
      const std::uint32_t v = b.corners[i];
      if (local_[v] != 0) continue;
      link_.push_back(v);
      local_[v] = static_cast<std::uint32_t>(link_.size());
    }
  }
}

/// The same by sorting the edges.
template <int D>
void DelaunayKernel<D>::join_many_borders() noexcept {
  many_.clear();
  for (std::uint32_t k = 0; k < borders_.size(); ++k) {
    const Border& b = borders_[k];
    for (const std::uint32_t across : kFacet<D>[b.slot]) {
      std::array<std::uint32_t, 2> edge{};
      std::size_t n = 0;
      for (const std::uint32_t i : kFacet<D>[b.slot]) {
        if (i != across) edge[n++] = b.corners[i];
      }
      const auto [low, high] = std::minmax(edge[0], edge[1]);
      many_.push_back({std::uint64_t{low} << 32 | high, cavity_[k], across});
    }
  }
  std::sort(many_.begin(), many_.end(),
            [](const Ridge& a, const Ridge& b) { return a.edge < b.edge; });
  for (std::size_t k = 0; k + 1 < many_.size(); k += 2) {
    store_.join(many_[k].simplex, many_[k].corner, many_[k + 1].simplex, many_[k + 1].corner);
  }
}

template <int D>
void DelaunayKernel<D>::clear_simplices() noexcept {
  store_.clear();
  mark_.clear();
  std::fill(simplex_of_.begin(), simplex_of_.end(), kNone);
  last_ = kNone;
}

template <int D>
void DelaunayKernel<D>::clear() noexcept {
  clear_simplices();
  places_.resize(1);
  simplex_of_.resize(1);
  local_.resize(1);
}

template <int D>
SimplexStore<D> DelaunayKernel<D>::release() && {
  DelaunayKernel all = std::move(*this);
  return std::move(all.store_);
}

template class DelaunayKernel<2>;
template class DelaunayKernel<3>;

}  // namespace mesher::detail
