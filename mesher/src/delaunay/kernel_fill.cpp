// New simplices in the place of those that a point conflicts with.
#include <algorithm>
#include <bit>

#include "delaunay/facets.hpp"
#include "delaunay/kernel.hpp"

namespace mesher::detail {

namespace {

// Up to so many vertices around the new one, adjacent new simplices are found by a square table.
constexpr std::size_t kMostInTable = 256;

}  // namespace

/// All that fill() needs.
template <int D>
void DelaunayKernel<D>::make_room_for_fill() {
  const std::size_t n = borders_.size(), k = cavity_.size();
  if (n > k) store_.make_room(n - k);
  mark_.resize(store_.places(), 0);
  if (cavity_.capacity() < n) cavity_.reserve(2 * n);
  if constexpr (D == 3) {
    const std::size_t vertices = n / 2 + 2;  // of a sphere of n triangles
    link_.reserve(vertices);
    ends_.reserve(n);
    const std::size_t width = std::size_t{1} << std::bit_width(vertices);
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
  for (const std::uint32_t s : outside_) mark_[s] = 0;
  for (const std::uint32_t s : cavity_) mark_[s] = 0;
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
/// the neighbour: a table by the numbers of both ends in the link. Afterwards local_ of the link's
/// vertices is 0 again.
template <>
void DelaunayKernel<3>::join_borders() noexcept {
  number_link();
  if (link_.size() > kMostInTable) {
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
  for (const std::uint32_t v : link_) local_[v] = 0;
  link_.clear();
}

/// Gives the link's vertices numbers from 1, and each border those of its facet.
template <int D>
void DelaunayKernel<D>::number_link() noexcept {
  ends_.resize(borders_.size());
  for (std::size_t k = 0; k < borders_.size(); ++k) {
    const Border& b = borders_[k];
    for (std::size_t i = 0; i < D; ++i) {
      const std::uint32_t v = b.corners[kFacet<D>[b.slot][i]];
      std::uint32_t& number = local_[v];
      if (number == 0) {
        link_.push_back(v);
        number = static_cast<std::uint32_t>(link_.size());
      }
      ends_[k][i] = number;
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

template class DelaunayKernel<2>;
template class DelaunayKernel<3>;

}  // namespace mesher::detail
