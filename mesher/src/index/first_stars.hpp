// The stars of a first run, from one triangulation of all vertices [rules B5].
//
// A search for a star from scratch costs ten times as much as a vertex of a triangulation in bulk.
// Both give the same star, since ties are decided by coordinates alone.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "cells/cell_of.hpp"
#include "cells/link_record.hpp"
#include "delaunay/facets.hpp"
#include "index/triangulate_pool.hpp"
#include "records/vertex.hpp"
#include "sets/make_set.hpp"

namespace mesher::detail {

template <int D>
class FirstStars {
 public:
  using Codes = std::vector<typename CellOf<D>::Code>;

  /// Of all vertices that are alive.
  explicit FirstStars(const VertexPool<D>& pool)
      : all_(triangulate(pool, [] {})), marked_(all_.simplices.size()) {
    pool.for_each([&](const Vertex<D>& v) {
      if (v.self >= simplex_of_.size()) simplex_of_.resize(std::size_t{v.self} + 1, kNone);
    });
    for (std::uint32_t s = 0; s < all_.simplices.size(); ++s) {
      for (const VertexHandle v : all_.simplices[s]) simplex_of_[v] = s;
    }
  }

  /// Writes v's star down as CellOf<D>::write does. False for a vertex on the boundary, whose cell
  /// has virtual neighbours.
  bool write(VertexHandle v, Codes& codes) {
    if (v >= simplex_of_.size() || simplex_of_[v] == kNone || !collect(v)) return false;
    if constexpr (D == 2) {
      write_ring(codes);
    } else {
      write_link(codes);
    }
    return true;
  }

 private:
  using Facet = std::array<std::uint32_t, D>;

  // The facets of v's link, with v positively oriented; in the plane each begins where the last one
  // ends.
  bool collect(VertexHandle v) {
    facets_.clear();
    around_.clear();
    bool closed = reach(simplex_of_[v]);
    for (std::size_t k = 0; k < around_.size() && closed; ++k) {
      const auto& corners = all_.simplices[around_[k]];
      const std::uint32_t at = corner_of(corners, v);
      facets_.push_back(facet_across<D>(corners, at));
      // In the plane one way around is enough: across from the corner that comes first.
      for (std::size_t i = 0; i < (D == 2 ? 1 : D); ++i) {
        closed = closed && reach(all_.neighbours[around_[k]][kFacet<D>[at][i]]);
      }
    }
    for (const std::uint32_t s : around_) marked_[s] = false;
    return closed;
  }
  // False beyond the hull.
  bool reach(std::uint32_t s) {
    if (s == kNone) return false;
    if (!marked_[s]) around_.push_back(s);
    marked_[s] = true;
    return true;
  }
  void write_ring(Codes& codes) const {
    codes.clear();
    for (const Facet& edge : facets_) codes.push_back(edge[0]);
    std::rotate(codes.begin(), std::min_element(codes.begin(), codes.end()), codes.end());
  }
  void write_link(Codes& record) {
    link_.clear();
    for (const Facet& facet : facets_) link_.insert(link_.end(), facet.begin(), facet.end());
    make_set(link_);
    const auto position = [&](VertexHandle u) {
      return static_cast<std::uint32_t>(std::lower_bound(link_.begin(), link_.end(), u) -
                                        link_.begin());
    };
    triangles_.clear();
    for (const Facet& f : facets_) {
      // orient3d(v, a, b, c) > 0 there
      triangles_.push_back({position(f[0]), position(f[2]), position(f[1])});
    }
    LinkRecord::write(link_, triangles_, record);
  }

  FlatTriangulation<D> all_;  // by handles
  std::vector<bool> marked_;  // by simplex; false between calls
  std::vector<std::uint32_t> simplex_of_;
  // Of the last star.
  std::vector<std::uint32_t> around_, link_;
  std::vector<Facet> facets_;
  std::vector<LinkRecord::Triangle> triangles_;
};

/// Beyond space there is no bulk triangulation: each star is searched for.
template <int D>
requires(D > 3) class FirstStars<D> {
 public:
  explicit FirstStars(const VertexPool<D>&) {}
  bool write(VertexHandle, std::vector<typename CellOf<D>::Code>&) { return false; }
};

}  // namespace mesher::detail
