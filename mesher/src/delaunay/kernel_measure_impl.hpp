// Computes the balls of new simplices.
#pragma once

#include "delaunay/facets.hpp"
#include "delaunay/kernel.hpp"
#include "geometry/circumcentre.hpp"
#include "geometry/plane_vectors.hpp"
#include "geometry/space_vectors.hpp"

namespace mesher::detail {

// The corners of the facet across from corner i, such that their determinant relative to it is
// positive (see kFacet).
template <int D>
constexpr std::array<std::uint32_t, D> positive_facet(std::size_t i) {
  auto facet = kFacet<D>[i];
  if (D == 3) std::swap(facet[0], facet[1]);
  return facet;
}

inline Point<2> exact_centre(const Point<2>& p, const std::array<const Point<2>*, 2>& corners) {
  return exact_circumcentre(p, *corners[0], *corners[1]);
}
inline Point<3> exact_centre(const Point<3>& p, const std::array<const Point<3>*, 3>& corners) {
  return circumcentre(p, *corners[0], *corners[1], *corners[2]).q;
}

/// Takes the k-th ball of the batch over: that of simplex s, relative to its corner `apex`. A flat
/// one is computed exactly first.
template <int D, class Layout>
[[gnu::always_inline]] inline void DelaunayKernel<D, Layout>::set_ball(std::size_t k,
                                                                       std::uint32_t s,
                                                                       std::size_t apex) noexcept {
  if (balls_.is_flat(k) && !is_ghost(s)) [[unlikely]] {
    const Ids& c = store_.corners(s);
    std::array<const Point<D>*, D> corners;
    for (std::size_t i = 0; i < D; ++i) corners[i] = &place(c[positive_facet<D>(apex)[i]]);
    balls_.set_centre(k, exact_centre(place(c[apex]), corners));
  }
  store_.ball(s) = balls_.ball(k);
}

/// Of s as the k-th of the batch, relative to the first.
template <int D, class Layout>
void DelaunayKernel<D, Layout>::set_corners(std::size_t k, std::uint32_t s) noexcept {
  const Ids& c = store_.corners(s);
  const Point<D>& p = place(c[0]);
  for (std::size_t i = 0; i < D; ++i) {
    balls_.set_corner(k, i, minus(place(c[positive_facet<D>(0)[i]]), p));
  }
}

template <int D, class Layout>
Shape DelaunayKernel<D, Layout>::measure(std::uint32_t s) noexcept {
  balls_.start(place(store_.corners(s)[0]), 1);
  set_corners(0, s);
  balls_.run();
  set_ball(0, s, 0);
  return balls_.shape(0);
}

/// The new simplices, from the borders. In space a vertex of the link is in six of them: relative
/// to v it is computed once.
template <int D, class Layout>
void DelaunayKernel<D, Layout>::measure_made(std::uint32_t v) noexcept {
  const Point<D> p = place(v);
  balls_.start(p, borders_.size());
  if constexpr (D == 2) {
    for (std::size_t k = 0; k < borders_.size(); ++k) {
      const auto [from, to] = kFacet<2>[borders_[k].slot];
      balls_.set_corner(k, 0, minus(place(borders_[k].corners[from]), p));
      balls_.set_corner(k, 1, minus(place(borders_[k].corners[to]), p));
    }
  } else {
    for (std::size_t i = 0; i < link_.size(); ++i) relative_[i + 1] = minus(place(link_[i]), p);
    for (std::size_t k = 0; k < borders_.size(); ++k) {
      const auto [a, b, c] = ends_[k];  // in kFacet's order
      balls_.set_corner(k, 0, relative_[b]);
      balls_.set_corner(k, 1, relative_[a]);
      balls_.set_corner(k, 2, relative_[c]);
    }
  }
  balls_.run();
  for (std::size_t k = 0; k < borders_.size(); ++k) set_ball(k, cavity_[k], borders_[k].slot);
}

}  // namespace mesher::detail
