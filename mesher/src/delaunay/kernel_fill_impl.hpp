// Makes the simplices that replace those that a point conflicts with.
#pragma once

#include <algorithm>
#include <bit>

#include "delaunay/facets.hpp"
#include "delaunay/kernel.hpp"

namespace mesher::detail {

// Up to so many vertices around the new one, adjacent new simplices are found by a square table.
constexpr std::size_t kMostInTable = 256;

constexpr std::uint64_t kNoRidge = ~std::uint64_t{0};

// Of a hash table for the 3n/2 edges of n triangles around the new vertex.
inline std::size_t places_for_edges(std::size_t triangles) { return std::bit_ceil(3 * triangles); }

/// For so many more. Strong guarantee.
template <int D, class Layout>
void DelaunayKernel<D, Layout>::make_room(std::size_t simplices) {
  const std::size_t places = store_.places() + simplices;
  if (mark_.capacity() < places) mark_.reserve(std::max(places, 2 * mark_.capacity()));
  store_.make_room(simplices);
  mark_.resize(store_.places(), 0);
}

/// All that fill() needs.
template <int D, class Layout>
void DelaunayKernel<D, Layout>::make_room_for_fill() {
  const std::size_t n = borders_.size(), k = cavity_.size();
  make_room(n > k ? n - k : 0);
  if (cavity_.capacity() < n) cavity_.reserve(2 * n);
  if constexpr (kHasBalls) {
    made_.reserve(cavity_.capacity());
    balls_.make_room(n);
    if (relative_.size() < n + 1) relative_.resize(2 * n);
  }
  if constexpr (D == 3) {
    const std::size_t vertices = n / 2 + 2;  // of a sphere of n triangles
    link_.reserve(vertices);
    ends_.reserve(n);
    const std::size_t width = std::size_t{1} << std::bit_width(vertices);
    if (vertices > kMostInTable) {
      many_.resize(std::max(many_.size(), places_for_edges(n)));
    } else if (ridges_.size() < width * width) {
      ridges_.resize(width * width);
    }
  }
}

/// New simplices from the borders to v. The first take the places of the conflicting ones.
template <int D, class Layout>
void DelaunayKernel<D, Layout>::fill(std::uint32_t v) noexcept {
  for (const std::uint32_t s : outside_) mark_[s] = 0;
  for (const std::uint32_t s : cavity_) mark_[s] = 0;
  while (cavity_.size() > borders_.size()) {
    store_.give(cavity_.back());
    cavity_.pop_back();
  }
  while (cavity_.size() < borders_.size()) cavity_.push_back(store_.take());
  place_borders();
  join_borders();
  if constexpr (kHasBalls) measure_made(v);
  last_ = vertices_[v].simplex = cavity_.back();
  if constexpr (kHasBalls) made_.assign(cavity_.begin(), cavity_.end());
  cavity_.clear();
  outside_.clear();
  borders_.clear();
  if constexpr (D == 3) forget_link();
}

/// Afterwards the new simplices have corners, and are joined with those outside.
template <int D, class Layout>
void DelaunayKernel<D, Layout>::place_borders() noexcept {
  for (std::size_t k = 0; k < borders_.size(); ++k) {
    const Border& b = borders_[k];
    const std::uint32_t s = cavity_[k];
    store_.corners(s) = b.corners;
    store_.join(s, b.slot, b.outer >> 2, b.outer & 3);
    for (const std::uint32_t w : b.corners) vertices_[w].simplex = s;
  }
}

/// Joins the new simplices with each other. In the plane each vertex of the border begins one edge
/// of it, counterclockwise. In space each directed edge of the border belongs to one of its facets,
/// and the opposite one to the neighbour: a table by the numbers of both ends in the link.
template <int D, class Layout>
void DelaunayKernel<D, Layout>::join_borders() noexcept {
  if constexpr (D == 2) {
    for (std::uint32_t k = 0; k < borders_.size(); ++k) {
      const Border& b = borders_[k];
      vertices_[b.corners[kFacet<2>[b.slot][0]]].link_number = k;
    }
    for (std::uint32_t k = 0; k < borders_.size(); ++k) {
      const Border& b = borders_[k];
      const auto [from, to] = kFacet<2>[b.slot];
      const std::uint32_t next = vertices_[b.corners[to]].link_number;
      store_.join(cavity_[k], from, cavity_[next], kFacet<2>[borders_[next].slot][1]);
    }
  } else if (link_.size() > kMostInTable) {
    join_many_borders();
  } else {
    const int shift = std::bit_width(link_.size());
    std::uint32_t* const edge = ridges_.data();
    for (std::size_t k = 0; k < borders_.size(); ++k) {
      const auto [i, j, l] = kFacet<3>[borders_[k].slot];
      const auto [a, b, c] = ends_[k];
      const std::uint32_t code = cavity_[k] << 2;
      edge[a << shift | b] = code | l;
      edge[b << shift | c] = code | i;
      edge[c << shift | a] = code | j;
    }
    for (std::size_t k = 0; k < borders_.size(); ++k) {
      const auto [i, j, l] = kFacet<3>[borders_[k].slot];
      const auto [a, b, c] = ends_[k];
      Ids& across = store_.across(cavity_[k]);
      across[l] = edge[b << shift | a];
      across[i] = edge[c << shift | b];
      across[j] = edge[a << shift | c];
    }
  }
}

/// Afterwards the link's vertices have no numbers.
template <int D, class Layout>
void DelaunayKernel<D, Layout>::forget_link() noexcept {
  for (const std::uint32_t v : link_) vertices_[v].link_number = 0;
  link_.clear();
}

/// Gives the link's vertices numbers from 1, and each border those of its facet. (In the plane the
/// border says it all.)
template <int D, class Layout>
void DelaunayKernel<D, Layout>::number_link() noexcept {
  ends_.resize(borders_.size());
  for (std::size_t k = 0; k < borders_.size(); ++k) {
    const Border& b = borders_[k];
    for (std::size_t i = 0; i < D; ++i) {
      const std::uint32_t v = b.corners[kFacet<D>[b.slot][i]];
      std::uint32_t& number = vertices_[v].link_number;
      if (number == 0) {
        link_.push_back(v);
        number = static_cast<std::uint32_t>(link_.size());
      }
      ends_[k][i] = number;
    }
  }
}

/// The same by a hash table of the edges without direction: the first facet of an edge waits there
/// for the second. It has twice as many places as edges.
template <int D, class Layout>
void DelaunayKernel<D, Layout>::join_many_borders() noexcept {
  const std::size_t places = places_for_edges(borders_.size());
  std::fill_n(many_.begin(), places, Ridge{kNoRidge, 0, 0});
  const auto meet = [&](std::uint32_t a, std::uint32_t b, std::uint32_t s, std::uint32_t corner) {
    const auto [low, high] = std::minmax(a, b);
    const std::uint64_t edge = std::uint64_t{low} << 32 | high;
    std::size_t at = edge * 0x9e3779b97f4a7c15 >> 32 & (places - 1);  // Fibonacci hashing
    while (many_[at].edge != kNoRidge && many_[at].edge != edge) at = (at + 1) & (places - 1);
    if (many_[at].edge == kNoRidge) {
      many_[at] = {edge, s, corner};
    } else {
      store_.join(s, corner, many_[at].simplex, many_[at].corner);
    }
  };
  for (std::size_t k = 0; k < borders_.size(); ++k) {
    const auto& facet = kFacet<D>[borders_[k].slot];
    for (std::size_t i = 0; i < D; ++i) {
      meet(ends_[k][(i + 1) % D], ends_[k][(i + 2) % D], cavity_[k], facet[i]);
    }
  }
}

}  // namespace mesher::detail
