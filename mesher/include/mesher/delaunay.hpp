// Delaunay triangulations of points in the plane and in space: of many points at once, or updated
// by one point at a time.
//
// Guarantees of all of them:
//  (1) They are exact: no point is strictly inside the circumball of a simplex, whatever the
//      coordinates.
//  (2) A set of points has one triangulation. Of points on one ball, the greatest in lexicographic
//      order counts as outside the ball of the others (see mesher/predicates.hpp), so simplices
//      depend neither on the order of the points nor on earlier states. A mesh of this library is
//      the triangulation of its vertices.
//  (3) The simplices tile the convex hull of the points, and each point is a corner; but points
//      that are all in one plane (on one line, for D = 2) have no simplices.
//  (4) Of equal points the first is a corner; the others are reported as duplicates. 0 and -0 are
//      equal.
//  (5) A function that throws leaves everything as it was.
//
//   const auto t = mesher::delaunay<2>({{0, 0}, {1, 0}, {0, 1}, {3, 3}});
//   t.simplices;   // {{0, 1, 2}, {3, 2, 1}}, say: indices of points, counterclockwise
//   t.neighbours;  // {{1, kNoSimplex, kNoSimplex}, {0, kNoSimplex, kNoSimplex}}
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "mesher/error.hpp"
#include "mesher/mesh.hpp"

namespace mesher {

/// No neighbour: the facet is on the convex hull.
inline constexpr std::uint32_t kNoSimplex = UINT32_MAX;

/// A Delaunay triangulation of points, given by their indices.
template <int D>
struct Delaunay {
  using Simplex = std::array<std::uint32_t, D + 1>;
  /// A point with the coordinates of an earlier one, which is a corner instead.
  struct Duplicate {
    std::uint32_t point = 0, original = 0;
    friend auto operator<=>(const Duplicate&, const Duplicate&) = default;
  };
  /// m x (D + 1) indices of points, positively oriented: counterclockwise in the plane, orient3d
  /// > 0 in space. Their order and which corner is first depend on the points alone, up to the
  /// numbers of equal points.
  std::vector<Simplex> simplices;
  /// m x (D + 1): the simplex across from each corner, or kNoSimplex.
  std::vector<Simplex> neighbours;
  /// By `point`, ascending.
  std::vector<Duplicate> duplicates;

  friend bool operator==(const Delaunay&, const Delaunay&) = default;
};

/// Triangulates points. `points`: n x D; coordinates 0 or of magnitude 2^-100 to 2^100.
/// Throws: Error (not_finite, magnitude, naming the point by its position in `points`, from 1;
/// too_many beyond 2^30 simplices or 2^32 - 2 points).
/// Cost: expected O(n log n) in the plane, and in space for points like those of a volume or a
/// smooth surface; O(n^2) in space at worst, since so many simplices may be Delaunay. Memory at
/// most about 80 n bytes in the plane, 280 n in space (random points), including the result.
/// Source: Bowyer 1981, Watson 1981; order of insertion: Amenta, Choi, Rote 2003.
template <int D>
[[nodiscard]] Delaunay<D> delaunay(std::span<const Point<D>> points);

template <int D>
[[nodiscard]] Delaunay<D> delaunay(const std::vector<Point<D>>& points) {
  return delaunay<D>(std::span<const Point<D>>(points));
}

/// A Delaunay triangulation that changes. A vertex keeps its number until it is removed; numbers of
/// removed vertices are reused, the last removed first.
template <int D>
class DynamicDelaunay {
 public:
  DynamicDelaunay();
  /// Triangulates many points at once. Vertex i is points[i]; a duplicate is no vertex, and its
  /// number is free. Throws, Cost: as delaunay().
  explicit DynamicDelaunay(std::span<const Point<D>> points);
  DynamicDelaunay(DynamicDelaunay&&) noexcept;
  DynamicDelaunay& operator=(DynamicDelaunay&&) noexcept;
  ~DynamicDelaunay();

  struct Inserted {
    std::uint32_t vertex = 0;
    bool is_new = false;  ///< false: `vertex` was already there, with these coordinates
  };
  /// Inserts a point.
  /// Throws: Error (not_finite, magnitude, naming the point as size() + 1; too_many).
  /// Cost: a walk from a nearby vertex, expected O(1) if vertices are evenly spread, and the
  /// simplices that change. O(n) each time the number of vertices reaches twice its former maximum,
  /// or for the first vertex far outside the others. While all points are in one plane (on one
  /// line) O(log n); the first point outside that plane costs as much as delaunay().
  Inserted insert(const Point<D>& p);
  /// Removes a vertex. Throws: sac::UsageError if there is no such vertex.
  /// Cost: O(k^2) for up to 64 neighbours, else as delaunay() of the neighbours; O(n log n) if all
  /// other points are in one plane (on one line).
  void remove(std::uint32_t vertex);

  /// The number of vertices.
  [[nodiscard]] std::size_t size() const noexcept;
  [[nodiscard]] bool has(std::uint32_t vertex) const noexcept;
  /// The coordinates of a vertex. Requires: has(vertex).
  [[nodiscard]] const Point<D>& place(std::uint32_t vertex) const;
  /// The vertices that share a simplex with this one, ascending. Requires: has(vertex).
  /// Cost: O(k log k) for k simplices around it.
  [[nodiscard]] std::vector<std::uint32_t> neighbours(std::uint32_t vertex) const;
  /// All simplices, by vertices. Cost: O(n + simplices).
  [[nodiscard]] Delaunay<D> simplices() const;

  /// Tests the whole triangulation. Throws: sac::InvariantError. Cost: O(simplices), each tested
  /// exactly.
  void check_invariants() const;

 private:
  class State;
  std::unique_ptr<State> state_;
};

}  // namespace mesher
