// Queries of a cell: searches, extents, records, checks. Part of voronoi_cell_any.cpp.
#pragma once

#include "cells/voronoi_cell_any.hpp"
#include "sac/check.hpp"

namespace mesher::detail {

template <int D>
bool VoronoiCellAny<D>::has(VertexHandle u) const noexcept {
  return std::any_of(neighbours_.begin(), neighbours_.end(),
                     [&](const Neighbour& n) { return n.code == u; });
}

template <int D>
bool VoronoiCellAny<D>::enters(const Point<D>& corner, double side, double margin) const noexcept {
  for (int k = 0; k < open_count_; ++k) {
    const std::size_t t = index(open_[index(k)]);
    double away2 = 0;
    for (std::size_t i = 0; i < D; ++i) {
      const double q = faces_[t].q[i];
      const double d = std::max({corner[i] - margin - q, q - (corner[i] + side + margin), 0.0});
      away2 += d * d;
    }
    const double r = gap_radius(t);
    if (away2 <= r * r) return true;
  }
  return false;
}

template <int D>
bool VoronoiCellAny<D>::is_compact() const noexcept {
  for (int k = 0; k < open_count_; ++k) {
    if (!is_real(ends(open_[index(k)]))) return false;
  }
  double farthest2 = 0;
  for (int i = 0; i < size(); ++i) {
    if (used(i)) farthest2 = std::max(farthest2, squared(neighbour(i)));
  }
  return open2_ <= farthest2;
}

template <int D>
void VoronoiCellAny<D>::add_gap_ball(int t, Box<D>& extent) const noexcept {
  const double r = gap_radius(index(t));
  for (std::size_t i = 0; i < D; ++i) {
    extent.lo[i] = std::min(extent.lo[i], corner(t)[i] - r);
    extent.hi[i] = std::max(extent.hi[i], corner(t)[i] + r);
  }
}

template <int D>
Box<D> VoronoiCellAny<D>::open_extent() const noexcept {
  Box<D> extent;
  for (int k = 0; k < open_count_; ++k) add_gap_ball(open_[index(k)], extent);
  return extent;
}

template <int D>
Box<D> VoronoiCellAny<D>::extent_inside(const Point<D>& outward) const noexcept {
  Box<D> extent;
  for (int t = 0; t < corners(); ++t) {
    bool beyond = false;
    for (std::size_t i = 0; i < D; ++i) beyond = beyond || corner(t)[i] * outward[i] > 0;
    if (!beyond || is_real(ends(t))) add_gap_ball(t, extent);
  }
  return extent;
}

template <int D>
void VoronoiCellAny<D>::write(std::vector<Code>& record) const {
  std::vector<std::pair<Code, int>> by_code;
  for (int i = 0; i < size(); ++i) {
    if (used(i)) by_code.emplace_back(code(i), i);
  }
  std::sort(by_code.begin(), by_code.end());
  std::vector<Code> position(neighbours_.size());
  record.assign(1, static_cast<Code>(by_code.size()));
  for (const auto& [code, i] : by_code) {
    position[index(i)] = static_cast<Code>(record.size() - 1);
    record.push_back(code);
  }
  std::vector<std::array<Code, D>> all;
  for (const Face& face : faces_) {
    auto& simplex = all.emplace_back();
    for (std::size_t k = 0; k < D; ++k) simplex[k] = position[index(face.end[k])];
    bool odd = false;
    for (std::size_t i = 0; i < D; ++i) {
      for (std::size_t k = i + 1; k < D; ++k) odd ^= simplex[k] < simplex[i];
    }
    std::sort(simplex.begin(), simplex.end());
    if (odd) std::swap(simplex[D - 2], simplex[D - 1]);
  }
  std::sort(all.begin(), all.end());
  for (const auto& simplex : all) record.insert(record.end(), simplex.begin(), simplex.end());
}

template <int D>
bool VoronoiCellAny<D>::may_cut(const VertexPool<D>& pool, const Vertex<D>& v, double radius,
                                std::span<const Code> record, const Point<D>& p) {
  const Point<D> w = minus(p, v.p);
  const double w2 = squared(w);
  bool may = false;
  for_each_link_simplex(record, [&](const std::array<Code, D>& codes) {
    if (may) return;
    BallCorners<D> places;
    for (std::size_t k = 0; k < D; ++k) places[k] = place_of(pool, v.p, radius, codes[k]);
    const BallCentre<D> c = ball_centre<D>(v.p, places);
    const double value = 2 * dot(w, c.q) - w2;
    may = value >= 0 || !(value * value > c.tolerance2 * w2);
  });
  return may;
}

template <int D>
void VoronoiCellAny<D>::check_invariants() const {
  std::vector<int> uses(neighbours_.size());
  for (int t = 0; t < corners(); ++t) {
    const Face& face = faces_[index(t)];
    std::array<Point<D>, D + 1> simplex;
    const BallCorners<D> corners = places(face.end);
    std::copy(corners.begin(), corners.end(), simplex.begin());
    simplex[D] = v_->p;
    SAC_INVARIANT(orientation<D>(simplex) > 0);
    SAC_INVARIANT(ball_centre<D>(v_->p, corners).q == face.q && corner2(t) <= reach2_);
    for (std::size_t k = 0; k < D; ++k) {
      ++uses[index(face.end[k])];
      const Face& other = faces_[index(face.across[k])];
      SAC_INVARIANT(std::count(other.across.begin(), other.across.end(), t) >= 1);
      for (std::size_t i = 0; i < D; ++i) {
        SAC_INVARIANT(i == k || std::count(other.end.begin(), other.end.end(), face.end[i]) == 1);
      }
    }
  }
  for (int i = 0; i < size(); ++i) {
    SAC_INVARIANT(uses[index(i)] == at(i).uses && used(i) == (code(i) != kUnused));
  }
}

}  // namespace mesher::detail
