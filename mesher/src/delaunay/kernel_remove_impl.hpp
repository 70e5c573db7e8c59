// Removal of a vertex.
//
// The simplices that replace its star have corners only in the link, and each of them is Delaunay
// among all other points, so among the link's. It is therefore the part of the link's own
// triangulation that the border of the star encloses, ghosts included. If the link is in one plane
// (on one line), the vertex was a tip of the hull, and only ghosts take the place of its simplices.
// Within the hull, and where the link is small, as it nearly always is, that part is made facet by
// facet instead, which costs a fifth.
#pragma once

#include <algorithm>
#include <unordered_set>

#include "delaunay/build.hpp"
#include "delaunay/hole.hpp"
#include "delaunay/kernel.hpp"
#include "sac/check.hpp"
#include "sets/make_set.hpp"

namespace mesher::detail {

// So many are looked through one by one.
constexpr std::size_t kFew = 64;

template <int D, class Layout>
std::vector<std::uint32_t> DelaunayKernel<D, Layout>::star(std::uint32_t v) const {
  SAC_EXPECTS(has(v));
  std::vector<std::uint32_t> star{vertices_[v].simplex};
  std::unordered_set<std::uint32_t> seen;  // of many
  const auto is_new = [&](std::uint32_t s) {
    if (star.size() < kFew) return std::find(star.begin(), star.end(), s) == star.end();
    if (seen.empty()) seen.insert(star.begin(), star.end());
    return seen.insert(s).second;
  };
  for (std::size_t k = 0; k < star.size(); ++k) {
    const std::uint32_t s = star[k];
    const std::size_t at = corner_of(s, v);
    for (std::size_t i = 0; i <= D; ++i) {
      const std::uint32_t other = store_.across(s)[i] >> 2;
      if (i != at && is_new(other)) star.push_back(other);
    }
  }
  return star;
}

/// The finite vertices around v, ascending.
template <int D, class Layout>
std::vector<std::uint32_t> DelaunayKernel<D, Layout>::link_of(
    const std::vector<std::uint32_t>& star, std::uint32_t v) const {
  std::vector<std::uint32_t> link;
  for (const std::uint32_t s : star) {
    for (const std::uint32_t w : store_.corners(s)) {
      if (w != v && w != kInfinite) link.push_back(w);
    }
  }
  make_set(link);
  return link;
}

/// Whether some simplex that is not in v's star is no ghost: then one is across from v, since a
/// triangulation is connected through facets.
template <int D, class Layout>
bool DelaunayKernel<D, Layout>::has_finite_beside(const std::vector<std::uint32_t>& star,
                                                  std::uint32_t v) const {
  return std::any_of(star.begin(), star.end(), [&](std::uint32_t s) {
    return !is_ghost(s) && !is_ghost(store_.across(s)[corner_of(s, v)] >> 2);
  });
}

/// star_: the triangulation of these vertices, numbered from 1 in their order. False if they are
/// all in one hyperplane.
template <int D, class Layout>
bool DelaunayKernel<D, Layout>::triangulate(const std::vector<std::uint32_t>& link) {
  if (star_ == nullptr) star_ = std::make_unique<DelaunayKernel>();
  star_->clear();
  std::vector<std::uint32_t> local;
  for (const std::uint32_t v : link) local.push_back(star_->add_place(place(v)));
  return build<D>(*star_, local, [](std::uint32_t, std::uint32_t) {});
}

/// The part of the link's triangulation within the star's border.
template <int D, class Layout>
auto DelaunayKernel<D, Layout>::filling_from_link(const std::vector<std::uint32_t>& star,
                                                  std::uint32_t v,
                                                  const std::vector<std::uint32_t>& link) const
    -> std::vector<Ids> {
  const auto local = [&](std::uint32_t w) -> std::uint32_t {
    const auto at = std::lower_bound(link.begin(), link.end(), w) - link.begin();
    return w == kInfinite || w == v ? kInfinite : static_cast<std::uint32_t>(at) + 1;
  };
  HoleBorder<D> border;
  for (const std::uint32_t s : star) {
    Ids c = store_.corners(s);
    for (std::uint32_t& w : c) w = local(w);
    border.add(c, corner_of(s, v));
  }
  border.done();
  std::vector<Ids> filling = simplices_within(border, star_->simplices());
  for (Ids& c : filling) {
    for (std::uint32_t& w : c) w = w == kInfinite ? kInfinite : link[w - 1];
  }
  return filling;
}

/// Ghosts in the place of the star's simplices that are none.
template <int D, class Layout>
auto DelaunayKernel<D, Layout>::ghosts_for(const std::vector<std::uint32_t>& star,
                                           std::uint32_t v) const -> std::vector<Ids> {
  std::vector<Ids> filling;
  for (const std::uint32_t s : star) {
    if (is_ghost(s)) continue;
    filling.push_back(store_.corners(s));
    filling.back()[corner_of(s, v)] = kInfinite;
  }
  return filling;
}

template <int D, class Layout>
bool DelaunayKernel<D, Layout>::remove(std::uint32_t v) {
  std::vector<std::uint32_t> around;
  static_cast<void>(find_in_star(v, around, [](std::uint32_t) { return false; }));
  const std::vector<std::uint32_t> link = link_of(around, v);
  const bool inner =
      std::none_of(around.begin(), around.end(), [&](std::uint32_t s) { return is_ghost(s); });
  if (inner && link.size() <= kFew) {
    refill(v, around, wrapping(around, v, link));
  } else if (triangulate(link)) {
    refill(v, around, filling_from_link(around, v, link));
  } else if (has_finite_beside(around, v)) {
    refill(v, around, ghosts_for(around, v));
  } else {
    return false;
  }
  return true;
}

/// The vertex of the link that is across from a facet of the hole, whose corners are the first of
/// `c`: of those on its inner side, the one in whose ball there is no other.
template <int D, class Layout>
std::uint32_t DelaunayKernel<D, Layout>::apex_over(const Ids& c,
                                                   const std::vector<std::uint32_t>& link) const {
  Ids best = c;
  best[D] = kNone;
  for (const std::uint32_t w : link) {
    if (std::find(c.begin(), c.end() - 1, w) != c.end() - 1) continue;
    if (side(c, D, place(w)) <= 0) continue;
    if (best[D] == kNone || ball_holds(best, place(w))) best[D] = w;
  }
  return best[D];
}

/// Whether two facets have the same corners and orientation.
template <std::size_t N>
[[nodiscard]] bool are_same(const std::array<std::uint32_t, N>& a,
                            const std::array<std::uint32_t, N>& b) {
  if constexpr (N == 2) return a == b;
  const std::size_t at = a[0] == b[0] ? 0 : a[0] == b[1] ? 1 : 2;
  return a[0] == b[at] && a[1] == b[(at + 1) % 3] && a[2] == b[(at + 2) % 3];
}

/// What fills the hole of a vertex within the hull, from its border inward: the ball of a simplex
/// of it holds no vertex of the link, so over each facet there is one apex.
template <int D, class Layout>
auto DelaunayKernel<D, Layout>::wrapping(const std::vector<std::uint32_t>& star, std::uint32_t v,
                                         const std::vector<std::uint32_t>& link) const
    -> std::vector<Ids> {
  using Facet = std::array<std::uint32_t, D>;
  std::vector<Ids> filling;
  std::vector<Facet> open;  // those that wait
  for (const std::uint32_t s : star) {
    open.push_back(facet_across<D>(store_.corners(s), corner_of(s, v)));
  }
  while (!open.empty()) {
    Ids c;
    std::copy(open.back().begin(), open.back().end(), c.begin());
    open.pop_back();
    c[D] = apex_over(c, link);
    SAC_ENSURES(c[D] != kNone);
    filling.push_back(c);
    for (std::size_t i = 0; i < D; ++i) {
      Facet facet = facet_across<D>(c, i);  // as c sees it
      const auto met = std::find_if(open.begin(), open.end(),
                                    [&](const Facet& other) { return are_same(facet, other); });
      if (met != open.end()) {
        *met = open.back();
        open.pop_back();
      } else {
        std::swap(facet[0], facet[1]);
        open.push_back(facet);
      }
    }
  }
  return filling;
}

/// Puts simplices of these corners into the place of v's star, and joins what has a facet in
/// common.
template <int D, class Layout>
void DelaunayKernel<D, Layout>::refill(std::uint32_t v, const std::vector<std::uint32_t>& star,
                                       const std::vector<Ids>& filling) {
  struct Side {
    std::array<std::uint32_t, D> facet;
    std::uint32_t code;
  };
  std::vector<Side> sides;
  for (const std::uint32_t s : star) {
    const std::size_t i = corner_of(s, v);
    sides.push_back({OrientedFacet<D>(store_.corners(s), i).corners, store_.across(s)[i]});
  }
  make_room(filling.size() > star.size() ? filling.size() - star.size() : 0);
  sides.reserve(sides.size() + (D + 1) * filling.size());
  made_.clear();
  made_.reserve(filling.size());
  // Nothing is allocated from here on.
  for (const std::uint32_t s : star) store_.give(s);
  for (const Ids& c : filling) {
    const std::uint32_t s = store_.take();
    store_.corners(s) = c;
    for (const std::uint32_t w : c) vertices_[w].simplex = s;
    for (std::uint32_t i = 0; i <= D; ++i) {
      sides.push_back({OrientedFacet<D>(c, i).corners, s << 2 | i});
    }
    made_.push_back(s);
    last_ = s;
  }
  std::sort(sides.begin(), sides.end(),
            [](const Side& a, const Side& b) { return a.facet < b.facet; });
  for (std::size_t k = 0; k + 1 < sides.size(); k += 2) {
    const std::uint32_t one = sides[k].code, other = sides[k + 1].code;
    store_.join(one >> 2, one & 3, other >> 2, other & 3);
  }
  if constexpr (kHasBalls) {
    for (const std::uint32_t s : made_) measure(s);
  }
  vertices_[v].simplex = kNone;
}

}  // namespace mesher::detail
