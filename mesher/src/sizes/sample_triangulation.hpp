// The Delaunay triangulation of the samples of a background, within a square.
//
// Built by inserting one point after the other [Bowyer, Watson]; exact predicates with ties decided
// by coordinates make it unique, so the order does not matter.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "mesher/mesh.hpp"

namespace mesher::detail {

class SampleTriangulation {
 public:
  using Index = std::uint32_t;
  using Corners = std::array<Index, 3>;  // counterclockwise

  /// `points`: the corners of a square, counterclockwise, then points inside it. Throws:
  /// Error(duplicate_point). Cost: O(n log n) for points that do not lie in a bad order.
  explicit SampleTriangulation(const std::vector<Point<2>>& points);

  /// In the order of their corners' coordinates, the smallest corner first.
  [[nodiscard]] std::vector<Corners> triangles() const;

 private:
  static constexpr Index kNone = ~Index{0};
  struct Triangle {
    Corners at{};
    std::array<Index, 3> beside{};  // [i]: across from at[i]
    bool dead = false;
  };
  // An edge of the hole that a point makes, seen from inside; what lies behind it.
  struct Rim {
    Index a, b, behind;
  };

  void insert(Index p);
  [[nodiscard]] Index locate(const Point<2>& p) const;
  [[nodiscard]] bool gives_way(const Triangle& t, const Point<2>& p) const;
  void dig(Index first, const Point<2>& p);
  void close(Index p);
  void join(Index t, Index a, Index b, Index other);

  const std::vector<Point<2>>& points_;
  std::vector<Triangle> triangles_;
  std::vector<Index> hole_;
  std::vector<Rim> rim_;
  Index last_ = 0;
};

}  // namespace mesher::detail
