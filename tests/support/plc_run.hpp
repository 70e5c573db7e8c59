// The program in space, run on a complex without the engine, and what it made.
#pragma once

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <vector>

#include "mesh/canonical.hpp"
#include "plc_check.hpp"
#include "plc_families.hpp"
#include "program/world_impl.hpp"
#include "rules/mesh_box.hpp"

namespace support {

/// What a run makes, bit for bit, in canonical form: the mesh, and what its vertices are on.
struct SpaceResult {
  // The ends of an edge or the corners of a polygon, and a label.
  struct On {
    std::vector<mesher::Point<3>> feature;
    std::uint64_t label = 0;
    friend bool operator==(const On&, const On&) = default;
  };
  mesher::Mesh<3> mesh;
  std::map<mesher::Point<3>, On> on;
  friend bool operator==(const SpaceResult&, const SpaceResult&) = default;
};
template <class World>
[[nodiscard]] SpaceResult space_result(
    const World& world, const std::vector<std::array<mesher::detail::VertexHandle, 4>>& simplices) {
  using namespace mesher::detail;
  SpaceResult result;
  std::vector<VertexHandle> live;
  const auto& pool = world.vertices.pool();
  pool.for_each([&](const Vertex<3>& v) {
    if (!v.alive) return;
    live.push_back(v.self);
    const Role role = world.vertices.role(v);
    if (role.on == 0) return;
    auto& on = result.on[v.p];
    on.label = role.label.bits();
    if (const EdgeHandle h = edge_of(role)) {
      const Edge& e = world.plc.store().edges()[h];
      on.feature = {e.place_a, e.place_b};
    } else {
      on.feature = world.plc.store().polygons()[polygon_of(role)].places;
    }
  });
  result.mesh = canonical(pool, std::move(live), simplices, {});
  return result;
}

/// A static run.
class PlcRun {
 public:
  using World = mesher::detail::World<sac::PlainScope, 3>;
  using Vertex = mesher::detail::Vertex<3>;

  PlcRun(const Complex& complex, const mesher::Options<3>& options)
      : box_(mesher::detail::mesh_box(options)), world_(options, box_, scope_) {
    add(complex);
    scope_.run<mesher::detail::refine<3>>();
  }
  [[nodiscard]] World& world() noexcept { return world_; }
  [[nodiscard]] ComplexMesh mesh();
  [[nodiscard]] SpaceResult result() const { return space_result(world_, simplices()); }

 private:
  void add(const Complex& complex);
  [[nodiscard]] std::vector<std::array<mesher::detail::VertexHandle, 4>> simplices() const {
    std::vector<std::array<mesher::detail::VertexHandle, 4>> all;
    world_.for_each_simplex([&](const auto& t) { all.push_back(t); });
    return all;
  }
  std::size_t number(mesher::detail::VertexHandle h) const { return numbers_.at(h); }

  mesher::detail::MeshBox<3> box_;
  sac::PlainScope scope_;
  World world_;
  std::map<mesher::detail::VertexHandle, std::size_t> numbers_;
  std::vector<const mesher::detail::Edge*> edges_;
  std::vector<const mesher::detail::Polygon*> polygons_;
};

inline void PlcRun::add(const Complex& complex) {
  std::vector<const Vertex*> at;
  for (const auto& p : complex.points) {
    Vertex& v = world_.vertices.add_input(p, true);
    world_.features.tree().insert_only(v);
    at.push_back(&v);
    world_.quadtree.post_from_outside<mesher::detail::locate>(
        mesher::detail::locate_key(box_.fixed(p)), mesher::detail::VertexRef<3>{&v});
  }
  for (const auto& s : complex.segments) {
    edges_.push_back(&world_.insert_edge(at[s[0]]->self, at[s[1]]->self));
  }
  for (const auto& f : complex.faces) {
    mesher::detail::PolygonParts parts;
    for (const auto& loop : f.loops) {
      auto& corners = parts.loops.emplace_back();
      for (const std::size_t i : loop) corners.push_back(at[i]->self);
    }
    for (const std::size_t i : f.on) parts.points.push_back(at[i]->self);
    polygons_.push_back(&world_.insert_polygon(std::move(parts)));
  }
}

inline ComplexMesh PlcRun::mesh() {
  using namespace mesher::detail;
  ComplexMesh mesh;
  const auto& pool = world_.vertices.pool();
  pool.for_each([&](const Vertex& v) {
    numbers_[v.self] = mesh.vertices.size();
    mesh.vertices.push_back(v.p);
  });
  for (const auto& t : simplices()) {
    mesh.tetrahedra.push_back({number(t[0]), number(t[1]), number(t[2]), number(t[3])});
  }
  const auto standing = [&](const Vertex& v) { return Standing{v, world_.vertices.role(v)}; };
  std::set<EdgeHandle> edges;
  for (const Edge* e : edges_) edges.insert(e->self);
  for (const Polygon* f : polygons_) edges.insert(f->all_edges.begin(), f->all_edges.end());
  for (const EdgeHandle h : edges) {
    const Edge& e = world_.plc.store().edges()[h];
    auto& edge = mesh.edges.emplace_back();
    edge.vertices = {{0, number(e.a)}, {1, number(e.b)}};
    pool.for_each([&](const Vertex& v) {
      const Role role = world_.vertices.role(v);
      if (edge_of(role) == h) edge.vertices[from_a(e, role.label) / e.length] = number(v.self);
    });
  }
  constexpr double kEverywhere = std::numeric_limits<double>::infinity();
  const FeaturesBeside all(world_.plc.store(), {}, kEverywhere);
  for (const Polygon* f : polygons_) {
    auto& face = mesh.faces.emplace_back();
    std::uint32_t begin = 0;
    for (const std::uint32_t end : f->loop_end) {
      face.loops.emplace_back(f->places.begin() + begin, f->places.begin() + end);
      begin = end;
    }
    pool.for_each([&](const Vertex& v) {
      if (is_on(standing(v), *f)) face.vertices.insert(number(v.self));
    });
  }
  const SmallAngles angles(all);
  for (const auto& t : simplices()) {
    for (const VertexHandle a : t) {
      for (const VertexHandle b : t) {
        if (!(pool[a].p < pool[b].p) || !angles.keeps(standing(pool[a]), standing(pool[b]))) {
          continue;
        }
        mesh.exempt.insert({std::min(number(a), number(b)), std::max(number(a), number(b))});
      }
    }
  }
  return mesh;
}

}  // namespace support
