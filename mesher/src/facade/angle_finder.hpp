// What an update did at small angles, found beside the triangles that it brought.
#pragma once

#include <array>
#include <map>
#include <vector>

#include "mesher/reports.hpp"
#include "program/world.hpp"

namespace mesher::detail {

/// The mesh that the program's world has; vertices are named by their handles.
class WorldMesh {
 public:
  explicit WorldMesh(World<sac::Scope>& world) : world_(world) {}

  /// With the whole input, whose points have their handles there as names.
  [[nodiscard]] World<sac::Scope>& world() const noexcept { return world_; }
  [[nodiscard]] const Vertex<2>& vertex(VertexHandle v) const { return world_.vertices.pool()[v]; }
  [[nodiscard]] Role role(VertexHandle v) const { return world_.vertices.role(vertex(v)); }
  /// Calls visit(triangle) for those at v, which comes first.
  template <class Visit>
  void for_each_triangle_at(VertexHandle v, Visit&& visit) const {
    world_.vertices.for_each_simplex_at(vertex(v), visit);
  }

 private:
  World<sac::Scope>& world_;
};

/// What parts of a mesh say.
struct AngleParts {
  std::map<std::array<std::uint32_t, 3>, SmallAngle> forced;  // by apex and segments
  std::vector<ShrunkVertex> shrunk;

  void add(AngleParts&& more);
  [[nodiscard]] AngleNews news() &&;
};

/// `AnyMesh`: as WorldMesh, of all or of a part.
template <class AnyMesh>
class AngleFinder {
 public:
  using Triangle = std::array<VertexHandle, 3>;

  AngleFinder(const AnyMesh& mesh, double rho) : mesh_(mesh), world_(mesh.world()), rho_(rho) {}

  /// Nothing without segments. `come`: triangles of the mesh.
  /// Throws: std::bad_alloc. Cost: O(come), and a look for features around their corners.
  [[nodiscard]] AngleNews news(const std::vector<Triangle>& come) const;
  /// Of triangles, and of vertices with all their neighbours. Several threads may ask at once while
  /// the world's segments and features are held.
  [[nodiscard]] AngleParts parts(const std::vector<Triangle>& come,
                                 const std::vector<VertexHandle>& corners) const;

 private:
  void find_forced(Triangle t, AngleParts& parts) const;
  [[nodiscard]] std::vector<ShrunkVertex> shrunk(const std::vector<VertexHandle>& corners) const;
  [[nodiscard]] bool is_poor(const Triangle& t) const;
  /// Calls visit(neighbour) for each of v, perhaps twice.
  template <class Visit>
  void for_each_neighbour(VertexHandle v, Visit&& visit) const {
    mesh_.for_each_triangle_at(v, [&](const Triangle& t) { visit(t[1]), visit(t[2]); });
  }
  [[nodiscard]] double nearest(VertexHandle v) const;
  [[nodiscard]] bool is_near_two(VertexHandle v, double r) const;
  [[nodiscard]] const Point<2>& place(VertexHandle v) const { return mesh_.vertex(v).p; }
  [[nodiscard]] VertexOnLines on_lines(VertexHandle h) const {
    const Vertex<2>& v = mesh_.vertex(h);
    const Role role = mesh_.role(h);
    return {v.p, role, v.input && role.on == 0 ? h : 0};
  }

  const AnyMesh& mesh_;
  World<sac::Scope>& world_;
  double rho_;
};

}  // namespace mesher::detail
