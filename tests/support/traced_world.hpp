// The mesher's program on an engine of the test's own: with the detectors on, and with the parts
// (quadtree, features, vertices) open to look at. Edits as those of mesher::Mesher, without checks.
#pragma once

#include <cstdint>
#include <memory>
#include <map>

#include "input.hpp"
#include "mesher/mesher.hpp"
#include "sac/sac.hpp"
#include "program/world_impl.hpp"

namespace support {

class TracedWorld {
 public:
  using World = mesher::detail::World<sac::Scope>;
  using Vertex = mesher::detail::Vertex<2>;
  using Ref = mesher::detail::VertexRef<2>;

  explicit TracedWorld(const mesher::Options<2>& options)
      : box_(mesher::detail::mesh_box(options)),
        options_(options),
        world_(std::make_unique<World>(options, box_, *engine_)) {
    engine_->set_audit(true);
    engine_->run<mesher::detail::refine>();
    world_->vertices.commit();
  }
  TracedWorld(const TracedWorld&) = delete;
  TracedWorld& operator=(const TracedWorld&) = delete;
  ~TracedWorld() { engine_.reset(); }  // before what its calls refer to

  void insert(mesher::FeatureId id, const mesher::Point<2>& p) {
    if (const Vertex* other = world_->features.point_at(p)) {
      mesher::detail::fail_too_near(p, id, other->p, {});
    }
    Vertex& v = world_->vertices.add_input(p, false);
    world_->vertices.touch(v);
    inputs_[id] = &v;
    world_->features.insert(v);
    world_->quadtree.post_from_outside<mesher::detail::locate>(
        mesher::detail::locate_key(box_.fixed(p)), Ref{&v});
  }
  void remove(mesher::FeatureId id) {
    Vertex& v = *inputs_.at(id);
    inputs_.erase(id);
    world_->vertices.touch(v);
    v.input = false;
    world_->features.erase(v);
    world_->quadtree.retract_from_outside<mesher::detail::locate>(Ref{&v});
  }
  void move(mesher::FeatureId id, const mesher::Point<2>& p) {
    const Vertex* other = world_->features.point_at(p);
    if (other != nullptr && other != inputs_.at(id)) {
      mesher::detail::fail_too_near(p, id, other->p, {});
    }
    if (inputs_.at(id)->p == p) return;
    remove(id);
    insert(id, p);
  }
  sac::Counts update() {
    const sac::Counts counts = engine_->propagate();
    world_->vertices.commit();
    return counts;
  }

  [[nodiscard]] World& world() noexcept { return *world_; }
  [[nodiscard]] const sac::Engine& engine() const noexcept { return *engine_; }
  [[nodiscard]] const mesher::detail::MeshBox<2>& box() const noexcept { return box_; }
  [[nodiscard]] const std::map<mesher::FeatureId, Vertex*>& inputs() const { return inputs_; }

 private:
  mesher::detail::MeshBox<2> box_;
  mesher::Options<2> options_;
  std::unique_ptr<sac::Engine> engine_ = std::make_unique<sac::Engine>();
  std::unique_ptr<World> world_;
  std::map<mesher::FeatureId, Vertex*> inputs_;
};

}  // namespace support
