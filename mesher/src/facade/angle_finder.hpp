// What an update did at small angles, found beside the triangles that it brought.
#pragma once

#include <array>
#include <vector>

#include "mesher/reports.hpp"
#include "program/world.hpp"

namespace mesher::detail {

class AngleFinder {
 public:
  using Triangle = std::array<VertexHandle, 3>;

  AngleFinder(World<sac::Scope>& world, double rho) : world_(world), rho_(rho) {}

  /// Nothing without segments. `come`: triangles of the mesh.
  /// Throws: std::bad_alloc. Cost: O(come), and a look for features around their corners.
  [[nodiscard]] AngleNews news(std::vector<Triangle> come) const;

 private:
  [[nodiscard]] std::vector<SmallAngle> forced(const std::vector<Triangle>& come) const;
  [[nodiscard]] std::vector<ShrunkVertex> shrunk(const std::vector<Triangle>& come) const;
  [[nodiscard]] bool is_poor(const Triangle& t) const;
  /// Calls visit(neighbour) for each of v, perhaps twice.
  template <class Visit>
  void for_each_neighbour(const Vertex<2>& v, Visit&& visit) const;
  [[nodiscard]] double nearest(const Vertex<2>& v) const;
  [[nodiscard]] bool is_near_two(const Vertex<2>& v, double r) const;
  [[nodiscard]] const Point<2>& place(VertexHandle v) const { return world_.vertices.pool()[v].p; }

  World<sac::Scope>& world_;
  double rho_;
};

}  // namespace mesher::detail
