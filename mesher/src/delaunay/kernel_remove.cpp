// Removal of a vertex.
//
// What takes the place of its star has corners in the link alone, and each simplex of it is
// Delaunay among all other points, so among the link's. It is therefore the part of the link's own
// triangulation that the border of the star encloses, ghosts included. If the link is in one plane
// (on one line), the vertex was a tip of the hull, and only ghosts take the place of its simplices.
#include <algorithm>
#include <unordered_set>

#include "delaunay/build.hpp"
#include "delaunay/hole.hpp"
#include "delaunay/kernel.hpp"
#include "sac/check.hpp"

namespace mesher::detail {

template <int D>
std::size_t DelaunayKernel<D>::corner_of(std::uint32_t s, std::uint32_t v) const noexcept {
  const Ids& c = store_.corners(s);
  return static_cast<std::size_t>(std::find(c.begin(), c.end(), v) - c.begin());
}

template <int D>
std::vector<std::uint32_t> DelaunayKernel<D>::star(std::uint32_t v) const {
  SAC_EXPECTS(has(v));
  std::vector<std::uint32_t> star{simplex_of_[v]};
  std::unordered_set<std::uint32_t> seen{simplex_of_[v]};
  for (std::size_t k = 0; k < star.size(); ++k) {
    const std::uint32_t s = star[k];
    const std::size_t at = corner_of(s, v);
    for (std::size_t i = 0; i <= D; ++i) {
      const std::uint32_t other = store_.across(s)[i] >> 2;
      if (i != at && seen.insert(other).second) star.push_back(other);
    }
  }
  return star;
}

/// The finite vertices around v, ascending.
template <int D>
std::vector<std::uint32_t> DelaunayKernel<D>::link_of(const std::vector<std::uint32_t>& star,
                                                      std::uint32_t v) const {
  std::vector<std::uint32_t> link;
  for (const std::uint32_t s : star) {
    for (const std::uint32_t w : store_.corners(s)) {
      if (w != v && w != kInfinite) link.push_back(w);
    }
  }
  std::sort(link.begin(), link.end());
  link.erase(std::unique(link.begin(), link.end()), link.end());
  return link;
}

/// Whether some simplex that is not in v's star is no ghost: then one is across from v, since a
/// triangulation is connected through facets.
template <int D>
bool DelaunayKernel<D>::has_finite_beside(const std::vector<std::uint32_t>& star,
                                          std::uint32_t v) const {
  return std::any_of(star.begin(), star.end(), [&](std::uint32_t s) {
    return !is_ghost(s) && !is_ghost(store_.across(s)[corner_of(s, v)] >> 2);
  });
}

/// star_: the triangulation of these vertices, numbered from 1 in their order. False if they are
/// all in one hyperplane.
template <int D>
bool DelaunayKernel<D>::triangulate(const std::vector<std::uint32_t>& link) {
  if (star_ == nullptr) star_ = std::make_unique<DelaunayKernel>();
  star_->clear();
  std::vector<std::uint32_t> local;
  for (const std::uint32_t v : link) local.push_back(star_->add_place(places_[v]));
  return build<D>(*star_, local, [](std::uint32_t, std::uint32_t) {});
}

template <int D>
bool DelaunayKernel<D>::remove(std::uint32_t v) {
  const std::vector<std::uint32_t> around = star(v), link = link_of(around, v);
  std::vector<Ids> filling;
  if (triangulate(link)) {
    const auto local = [&](std::uint32_t w) -> std::uint32_t {
      const auto at = std::lower_bound(link.begin(), link.end(), w) - link.begin();
      return w == kInfinite || w == v ? kInfinite : static_cast<std::uint32_t>(at) + 1;
    };
    HoleBorder<D> border;
    for (const std::uint32_t s : around) {
      Ids c = store_.corners(s);
      for (std::uint32_t& w : c) w = local(w);
      border.add(c, corner_of(s, v));
    }
    border.done();
    filling = simplices_within(border, star_->simplices());
    for (Ids& c : filling) {
      for (std::uint32_t& w : c) w = w == kInfinite ? kInfinite : link[w - 1];
    }
  } else if (has_finite_beside(around, v)) {
    for (const std::uint32_t s : around) {
      if (is_ghost(s)) continue;
      filling.push_back(store_.corners(s));
      filling.back()[corner_of(s, v)] = kInfinite;
    }
  } else {
    return false;
  }
  refill(v, around, filling);
  return true;
}

/// Puts simplices of these corners into the place of v's star, and joins what has a facet in
/// common.
template <int D>
void DelaunayKernel<D>::refill(std::uint32_t v, const std::vector<std::uint32_t>& star,
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
  if (filling.size() > star.size()) store_.make_room(filling.size() - star.size());
  mark_.resize(store_.places(), 0);
  sides.reserve(sides.size() + (D + 1) * filling.size());
  // Nothing is allocated from here on.
  for (const std::uint32_t s : star) store_.give(s);
  for (const Ids& c : filling) {
    const std::uint32_t s = store_.take();
    store_.corners(s) = c;
    for (const std::uint32_t w : c) simplex_of_[w] = s;
    for (std::uint32_t i = 0; i <= D; ++i) {
      sides.push_back({OrientedFacet<D>(c, i).corners, s << 2 | i});
    }
    last_ = s;
  }
  std::sort(sides.begin(), sides.end(),
            [](const Side& a, const Side& b) { return a.facet < b.facet; });
  for (std::size_t k = 0; k + 1 < sides.size(); k += 2) {
    const std::uint32_t one = sides[k].code, other = sides[k + 1].code;
    store_.join(one >> 2, one & 3, other >> 2, other & 3);
  }
  simplex_of_[v] = kNone;
}

template class DelaunayKernel<2>;
template class DelaunayKernel<3>;

}  // namespace mesher::detail
