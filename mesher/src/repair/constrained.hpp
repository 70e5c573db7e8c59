// Triangulations of points in the plane that have given edges, and what an odd number of borders
// goes around.
//
// The Delaunay triangulation of the points gets the edges one by one, by flips of what crosses them
// [Sloan 1993]; the rest is made as near to Delaunay as the edges allow [Lawson 1977]. Signs are
// exact. The result depends on the places alone, if no four of them are on a circle that matters;
// else on the numbers as well.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "mesher/mesh.hpp"

namespace mesher::detail {

/// Edges between points, by their numbers.
using Links = std::set<std::array<std::uint32_t, 2>>;  // ascending
[[nodiscard]] inline std::array<std::uint32_t, 2> link(std::uint32_t a, std::uint32_t b) {
  return {std::min(a, b), std::max(a, b)};
}

class Constrained {
 public:
  using Triangle = std::array<std::uint32_t, 3>;  // counterclockwise, the least number first

  explicit Constrained(std::vector<Point<2>> places);

  /// Makes ab an edge that stays. Returns whether that could be: not if a point is on it, or an
  /// edge that stays crosses it. Requires: a != b. Cost: O(edges that cross it, squared).
  [[nodiscard]] bool add(std::uint32_t a, std::uint32_t b);
  /// Flips what is not Delaunay and need not stay.
  void settle();
  /// Flips edges that need not stay while that makes triangles better.
  /// fault(a, b, c): of a triangle, a number; less is better. Equal for all orders of corners.
  template <class Fault>
  void better(Fault&& fault);

  /// The triangles that an odd number of borders goes around, in parts that borders part; parts
  /// and triangles ascend. Requires: borders are edges that stay; each point has an even number.
  [[nodiscard]] std::vector<std::vector<Triangle>> inside(const Links& borders) const;

 private:
  using Directed = std::pair<std::uint32_t, std::uint32_t>;

  [[nodiscard]] int turn(std::uint32_t a, std::uint32_t b, std::uint32_t c) const;
  [[nodiscard]] std::optional<std::uint32_t> apex(std::uint32_t a, std::uint32_t b) const {
    const auto it = apexes_.find({a, b});
    return it == apexes_.end() ? std::nullopt : std::optional(it->second);
  }
  void put(std::uint32_t a, std::uint32_t b, std::uint32_t c);
  [[nodiscard]] std::optional<std::vector<Directed>> crossed(std::uint32_t a,
                                                             std::uint32_t b) const;
  [[nodiscard]] bool is_convex(std::uint32_t u, std::uint32_t w) const;
  Directed flip(std::uint32_t u, std::uint32_t w);

  std::vector<Point<2>> places_;
  std::map<Directed, std::uint32_t> apexes_;  // of the triangle on the left of an edge
  Links stay_;
};

// Each flip makes the sum of all faults less.
template <class Fault>
void Constrained::better(Fault&& fault) {
  for (bool any = true; any;) {
    any = false;
    std::vector<Directed> edges;
    for (const auto& [edge, apex] : apexes_) {
      if (edge.first < edge.second && stay_.count({edge.first, edge.second}) == 0) {
        edges.push_back(edge);
      }
    }
    for (const auto& [u, w] : edges) {
      const auto p = apex(u, w), q = apex(w, u);
      if (!p || !q || !is_convex(u, w)) continue;
      if (fault(u, *p, *q) + fault(w, *p, *q) >= fault(u, w, *p) + fault(u, w, *q)) continue;
      flip(u, w);
      any = true;
    }
  }
}

/// The loops around a part of a triangulation that hangs together by edges other than borders: the
/// one around all others first, in which no point is twice; in an order of their own.
[[nodiscard]] std::vector<std::vector<std::uint32_t>> loops_around(
    const std::vector<Constrained::Triangle>& part, const Links& borders,
    const std::vector<Point<2>>& places);

}  // namespace mesher::detail
