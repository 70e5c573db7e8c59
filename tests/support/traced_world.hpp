// The mesher's program on an engine of the test's own: with the detectors on, and with the parts
// (quadtree, features, vertices) open to look at. Edits as those of mesher::Mesher, without checks.
#pragma once

#include <cstdint>
#include <map>
#include <memory>

#include "geometry/input_point.hpp"
#include "mesh/canonical.hpp"
#include "mesher/mesher.hpp"
#include "program/world_impl.hpp"
#include "rules/mesh_box.hpp"
#include "sac/sac.hpp"

namespace support {

class TracedWorld {
 public:
  using World = mesher::detail::World<sac::Scope>;
  using Vertex = mesher::detail::Vertex<2>;
  using Ref = mesher::detail::VertexRef<2>;

  /// `empty`: runs on no input at once; else run() is the first run.
  explicit TracedWorld(const mesher::Options<2>& options, bool empty = true)
      : box_(mesher::detail::mesh_box(options)),
        options_(options),
        world_(std::make_unique<World>(options, box_, *engine_)) {
    engine_->set_audit(empty);
    if (empty) run();
  }
  void run() {
    engine_->run<mesher::detail::refine<2>>();
    commit();
  }
  TracedWorld(const TracedWorld&) = delete;
  TracedWorld& operator=(const TracedWorld&) = delete;
  ~TracedWorld() { engine_.reset(); }  // before what its calls refer to

  void insert(mesher::PointId id, const mesher::Point<2>& p) {
    if (const Vertex* other = world_->features.point_at(p)) {
      mesher::detail::fail_too_near(p, id, other->p, {});
    }
    Vertex& v = world_->vertices.add_input(p, false);
    world_->vertices.touch(v);
    engine_->on_rollback([this, id, &v] {
      v.input = false;
      inputs_.erase(id);
    });
    inputs_[id] = &v;
    world_->features.insert(v);
    world_->quadtree.post_from_outside<mesher::detail::locate>(
        mesher::detail::locate_key(box_.fixed(p)), Ref{&v});
  }
  void remove(mesher::PointId id) {
    Vertex& v = *inputs_.at(id);
    inputs_.erase(id);
    world_->vertices.touch(v);
    engine_->on_rollback([this, id, &v] {
      v.input = true;
      inputs_[id] = &v;
    });
    v.input = false;
    world_->features.erase(v);
    world_->quadtree.retract_from_outside<mesher::detail::locate>(Ref{&v});
  }
  void move(mesher::PointId id, const mesher::Point<2>& p) {
    const Vertex* other = world_->features.point_at(p);
    if (other != nullptr && other != inputs_.at(id)) {
      mesher::detail::fail_too_near(p, id, other->p, {});
    }
    if (inputs_.at(id)->p == p) return;
    remove(id);
    insert(id, p);
  }
  /// Between two points that are there.
  void insert_segment(mesher::LineId id, mesher::PointId a, mesher::PointId b) {
    const auto all = world_->segments.insert(inputs_.at(a)->self, inputs_.at(b)->self);
    lines_[all.piece.segment] = id;
    world_->splits.post_from_outside<mesher::detail::split_segment>(
        mesher::detail::split_segment_key(box_, all), all);
  }
  void remove_segment(mesher::PointId a, mesher::PointId b) {
    const auto all = world_->segments.erase(inputs_.at(a)->self, inputs_.at(b)->self);
    world_->splits.retract_from_outside<mesher::detail::split_segment>(all);
  }
  /// `options` but for the limits of size are those of the world.
  void limit(const mesher::Options<2>& options, const std::vector<mesher::Box<2>>& where) {
    mesher::detail::edit_limits(*world_, options, where, *engine_);
  }
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
  /// The mesh in canonical form. Requires: no announced edits.
  [[nodiscard]] mesher::Mesh<2> mesh() const;

  [[nodiscard]] World& world() noexcept { return *world_; }
  [[nodiscard]] const sac::Engine& engine() const noexcept { return *engine_; }
  [[nodiscard]] const mesher::detail::MeshBox<2>& box() const noexcept { return box_; }
  [[nodiscard]] const std::map<mesher::PointId, Vertex*>& inputs() const { return inputs_; }

 private:
  void commit() {
    world_->leaves.commit();
    world_->segments.commit();
    world_->vertices.commit();
  }

  mesher::detail::MeshBox<2> box_;
  mesher::Options<2> options_;
  std::unique_ptr<sac::Engine> engine_ = std::make_unique<sac::Engine>();
  std::unique_ptr<World> world_;
  std::map<mesher::PointId, Vertex*> inputs_;
  std::map<mesher::detail::SegmentHandle, mesher::LineId> lines_;
};

inline mesher::Mesh<2> TracedWorld::mesh() const {
  const auto& vertices = world_->vertices;
  const auto& pool = vertices.pool();
  std::vector<std::array<mesher::detail::VertexHandle, 3>> triangles;
  vertices.for_each_simplex([&](const auto& t) { triangles.push_back(t); });
  std::vector<mesher::detail::LineEdge> edges;
  world_->leaves.for_each([&](const mesher::detail::Leaf& leaf) {
    edges.push_back({vertices.tree().find(leaf.lo)->self, vertices.tree().find(leaf.hi)->self,
                     lines_.at(leaf.piece.segment)});
  });
  return mesher::detail::canonical(pool, vertices.live_vertices(), triangles, {edges, {}});
}

}  // namespace support
