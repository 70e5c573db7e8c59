// The sides of triangles grouped by edge, which gives the neighbours.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "mesher/mesh.hpp"

namespace mesher::detail {

using Corners = std::array<std::uint32_t, 3>;   // counterclockwise
using SideEnds = std::array<std::uint32_t, 2>;  // of vertices

[[nodiscard]] constexpr int next_corner(int i) noexcept { return i == 2 ? 0 : i + 1; }
[[nodiscard]] constexpr int previous_corner(int i) noexcept { return i == 0 ? 2 : i - 1; }

/// A side of a triangle, across from its corner `corner`; `high` is the higher of its ends.
struct Side {
  std::uint32_t high;
  std::uint32_t triangle;
  int corner;
};

/// The sides of all triangles, sorted: by counting their lower ends, then among the few of one end.
class Sides {
 public:
  /// Cost: O(m log d) for vertices of degree d, and O(1) for each vertex number up to the largest.
  explicit Sides(const std::vector<Corners>& triangles) : triangles_(triangles.size()) {
    std::uint32_t vertices = 0;
    for (const Corners& t : triangles) {
      vertices = std::max({vertices, t[0] + 1, t[1] + 1, t[2] + 1});
    }
    count(triangles, vertices);
    place(triangles);
    for (std::uint32_t v = 0; v < vertices; ++v) {
      std::sort(sides_.begin() + start_[v], sides_.begin() + start_[v + 1],
                [](const Side& a, const Side& b) {
                  return a.high != b.high ? a.high < b.high : a.triangle < b.triangle;
                });
    }
  }

  [[nodiscard]] std::size_t triangles() const { return triangles_; }
  [[nodiscard]] std::uint32_t vertices() const {
    return static_cast<std::uint32_t>(start_.size() - 1);
  }
  /// Those with this lower end, by their higher end.
  [[nodiscard]] std::span<const Side> at(std::uint32_t low) const {
    return std::span(sides_).subspan(start_[low], start_[low + 1] - start_[low]);
  }
  /// The sides of an edge, its lower end first; none if there is no such edge.
  [[nodiscard]] std::span<const Side> of(const SideEnds& edge) const {
    if (edge[0] >= vertices()) return {};
    const auto all = at(edge[0]);
    const auto first = std::lower_bound(all.begin(), all.end(), edge[1],
                                        [](const Side& s, std::uint32_t v) { return s.high < v; });
    auto last = first;
    while (last != all.end() && last->high == edge[1]) ++last;
    return {first, last};
  }

 private:
  static SideEnds ends_of(const Corners& t, int corner) {
    const auto [low, high] = std::minmax(t[next_corner(corner)], t[previous_corner(corner)]);
    return {low, high};
  }
  void count(const std::vector<Corners>& triangles, std::uint32_t vertices) {
    start_.assign(vertices + std::size_t{1}, 0);
    for (const Corners& t : triangles) {
      for (int i = 0; i < 3; ++i) ++start_[ends_of(t, i)[0] + 1];
    }
    for (std::uint32_t v = 0; v < vertices; ++v) start_[v + 1] += start_[v];
  }
  void place(const std::vector<Corners>& triangles) {
    std::vector<std::size_t> next(start_.begin(), start_.end() - 1);
    sides_.resize(3 * triangles.size());
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
      for (int i = 0; i < 3; ++i) {
        const SideEnds ends = ends_of(triangles[t], i);
        sides_[next[ends[0]]++] = {ends[1], t, i};
      }
    }
  }

  std::size_t triangles_;
  std::vector<std::size_t> start_;
  std::vector<Side> sides_;
};

/// Who is across from each corner.
struct Joined {
  std::vector<std::array<std::uint32_t, 3>> neighbours;  // kNoTriangle at the boundary
  bool in_pairs = true;                                  // no edge borders more than two triangles
};

/// Cost: O(m).
[[nodiscard]] Joined joined(const Sides& sides);

}  // namespace mesher::detail
