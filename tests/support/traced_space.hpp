// The mesher's program in space on an engine of the test's own, with its parts open to look at.
// Edits are complexes that come and go as a whole, without checks.
#pragma once

#include <memory>
#include <vector>

#include "plc_run.hpp"
#include "rules/mesh_box.hpp"
#include "sac/sac.hpp"

namespace support {

class TracedSpace {
 public:
  using World = mesher::detail::World<sac::Scope, 3>;
  using Vertex = mesher::detail::Vertex<3>;
  using Ref = mesher::detail::VertexRef<3>;

  explicit TracedSpace(const mesher::Options<3>& options, bool audit = true)
      : box_(mesher::detail::mesh_box(options)),
        world_(std::make_unique<World>(options, box_, *engine_)) {
    engine_->set_audit(audit);
    engine_->run<mesher::detail::refine<3>>();
    commit();
  }
  TracedSpace(const TracedSpace&) = delete;
  TracedSpace& operator=(const TracedSpace&) = delete;
  ~TracedSpace() { engine_.reset(); }  // before what its calls refer to

  /// What has come, for erase().
  struct Part {
    std::vector<Vertex*> points;
    std::vector<const mesher::detail::Edge*> edges;
    std::vector<const mesher::detail::Polygon*> polygons;
  };
  /// Requires: its points are not there.
  Part insert(const Complex& complex);
  void erase(const Part& part);
  /// The same of its segments and polygons alone, between points that stay.
  void insert_features(const Complex& complex, Part& part);
  void erase_features(Part& part);

  /// Brings the trace up to date. What it throws leaves the last state.
  sac::Counts update() {
    try {
      const sac::Counts counts = engine_->propagate([&] { world_->vertices.follow(); });
      commit();
      return counts;
    } catch (...) {
      commit();
      throw;
    }
  }
  [[nodiscard]] SpaceResult result() const;
  [[nodiscard]] World& world() noexcept { return *world_; }
  [[nodiscard]] sac::Engine& engine() noexcept { return *engine_; }

  void check_invariants() const {
    world_->vertices.check_invariants();
    world_->plc.check_invariants();
  }

 private:
  void commit() {
    world_->plc.commit();
    world_->vertices.commit();
  }
  Vertex* insert_point(const mesher::Point<3>& p);
  void erase_point(Vertex& v);

  mesher::detail::MeshBox<3> box_;
  std::unique_ptr<sac::Engine> engine_ = std::make_unique<sac::Engine>();
  std::unique_ptr<World> world_;
};

inline TracedSpace::Vertex* TracedSpace::insert_point(const mesher::Point<3>& p) {
  if (const Vertex* other = world_->features.point_at(p)) {
    mesher::detail::fail_too_near(p, {}, other->p, {});
  }
  Vertex& v = world_->vertices.add_input(p, false);
  world_->vertices.touch(v);
  engine_->on_rollback([&v] { v.input = false; });
  world_->features.insert(v);
  world_->quadtree.post_from_outside<mesher::detail::locate>(
      mesher::detail::locate_key(box_.fixed(p)), Ref{&v});
  return &v;
}

inline void TracedSpace::erase_point(Vertex& v) {
  world_->vertices.touch(v);
  engine_->on_rollback([&v] { v.input = true; });
  v.input = false;
  world_->features.erase(v);
  world_->quadtree.retract_from_outside<mesher::detail::locate>(Ref{&v});
}

inline TracedSpace::Part TracedSpace::insert(const Complex& complex) {
  Part part;
  for (const auto& p : complex.points) part.points.push_back(insert_point(p));
  insert_features(complex, part);
  return part;
}

inline void TracedSpace::insert_features(const Complex& complex, Part& part) {
  for (const auto& s : complex.segments) {
    part.edges.push_back(&world_->insert_edge(part.points[s[0]]->self, part.points[s[1]]->self));
  }
  for (const auto& f : complex.faces) {
    mesher::detail::PolygonParts parts;
    for (const auto& loop : f.loops) {
      auto& corners = parts.loops.emplace_back();
      for (const std::size_t i : loop) corners.push_back(part.points[i]->self);
    }
    for (const std::size_t i : f.on) parts.points.push_back(part.points[i]->self);
    part.polygons.push_back(&world_->insert_polygon(std::move(parts)));
  }
}

inline void TracedSpace::erase_features(Part& part) {
  for (const auto* f : part.polygons) world_->erase_polygon(*f);
  for (const auto* e : part.edges) world_->erase_edge(*e);
  part.polygons.clear();
  part.edges.clear();
}

inline void TracedSpace::erase(const Part& part) {
  Part features = part;
  erase_features(features);
  for (Vertex* v : part.points) erase_point(*v);
}

inline SpaceResult TracedSpace::result() const {
  const auto& vertices = world_->vertices;
  std::vector<std::array<mesher::detail::VertexHandle, 4>> simplices;
  vertices.for_each_simplex([&](const auto& t) { simplices.push_back(t); });
  return space_result(*world_, simplices);
}

}  // namespace support
