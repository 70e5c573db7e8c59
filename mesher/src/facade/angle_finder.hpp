// What an update did at small angles, found beside the triangles that it brought.
#pragma once

#include <array>
#include <vector>

#include "mesher/reports.hpp"
#include "program/world.hpp"

namespace mesher::detail {

/// The mesh that the program's world has.
class WorldMesh {
 public:
  explicit WorldMesh(World<sac::Scope>& world) : world_(world) {}

  /// With the whole input.
  [[nodiscard]] World<sac::Scope>& world() const noexcept { return world_; }
  [[nodiscard]] const Vertex<2>& vertex(VertexHandle v) const { return world_.vertices.pool()[v]; }
  [[nodiscard]] Role role(const Vertex<2>& v) const { return world_.vertices.role(v); }
  /// Calls visit(triangle) for those at v, which comes first.
  template <class Visit>
  void for_each_triangle_at(const Vertex<2>& v, Visit&& visit) const {
    world_.vertices.for_each_simplex_at(v, visit);
  }

 private:
  World<sac::Scope>& world_;
};

/// `AnyMesh`: as WorldMesh.
template <class AnyMesh>
class AngleFinder {
 public:
  using Triangle = std::array<VertexHandle, 3>;

  AngleFinder(const AnyMesh& mesh, double rho) : mesh_(mesh), world_(mesh.world()), rho_(rho) {}

  /// Nothing without segments. `come`: triangles of the mesh.
  /// Throws: std::bad_alloc. Cost: O(come), and a look for features around their corners.
  [[nodiscard]] AngleNews news(std::vector<Triangle> come) const;

 private:
  [[nodiscard]] std::vector<SmallAngle> forced(const std::vector<Triangle>& come) const;
  [[nodiscard]] std::vector<ShrunkVertex> shrunk(const std::vector<Triangle>& come) const;
  [[nodiscard]] bool is_poor(const Triangle& t) const;
  /// Calls visit(neighbour) for each of v, perhaps twice.
  template <class Visit>
  void for_each_neighbour(const Vertex<2>& v, Visit&& visit) const {
    mesh_.for_each_triangle_at(
        v, [&](const Triangle& t) { visit(mesh_.vertex(t[1])), visit(mesh_.vertex(t[2])); });
  }
  [[nodiscard]] double nearest(const Vertex<2>& v) const;
  [[nodiscard]] bool is_near_two(const Vertex<2>& v, double r) const;
  [[nodiscard]] const Point<2>& place(VertexHandle v) const { return mesh_.vertex(v).p; }
  [[nodiscard]] VertexOnLines on_lines(const Vertex<2>& v) const {
    const Role role = mesh_.role(v);
    return {v.p, role, v.input && role.on == 0 ? v.self : 0};
  }

  const AnyMesh& mesh_;
  World<sac::Scope>& world_;
  double rho_;
};

}  // namespace mesher::detail
