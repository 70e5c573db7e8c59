// The vertices of SplitSegments against the rules' words, from scratch and after edits.
#include "program/split_segments.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <memory>
#include <vector>

#include "naive_splits.hpp"
#include "program/world_impl.hpp"
#include "rules/mesh_box.hpp"

namespace {

using mesher::LineId;
using mesher::Point;
using mesher::PointId;
using mesher::detail::MeshBox;
using mesher::detail::PieceRef;
using mesher::detail::Vertex;
using mesher::detail::World;
using support::NaiveSplits;
using support::Pslg;
using support::PslgEditor;

using Places = std::vector<Point<2>>;

// The first parts of the program.
struct SplitAll {
  static constexpr std::string_view kName = "split_all";
  template <class S>
  void operator()(S& s) const {
    auto& world = s.template environment<World<S>>();
    world.splits.drain(s);
    world.quadtree.drain(s);
  }
};
inline constexpr SplitAll split_all{};

template <class S>
Places split_vertices(const World<S>& world) {
  Places places;
  world.vertices.pool().for_each([&](const Vertex<2>& v) {
    if (v.alive && v.on_segment) places.push_back(v.p);
  });
  std::sort(places.begin(), places.end());
  return places;
}

Places split_statically(const Pslg& pslg) {
  const MeshBox<2> box = mesher::detail::mesh_box(PslgEditor::options());
  sac::PlainScope scope;
  World<sac::PlainScope> world(PslgEditor::options(), box, scope);
  std::map<std::int64_t, mesher::detail::VertexHandle> handles;
  for (const auto& [id, p] : pslg.points) {
    Vertex<2>& v = world.vertices.add_input(p, true);
    handles[id] = v.self;
    world.features.tree().insert_only(v);
  }
  for (const auto& [ends, id] : pslg.segments) {
    const PieceRef all = world.segments.insert(handles[ends.second], handles[ends.first]);
    world.splits.post_from_outside<mesher::detail::split_segment>(
        mesher::detail::split_segment_key(box, all), all);
  }
  scope.run<split_all>();
  world.segments.store().check_invariants();
  return split_vertices(world);
}

// The traced program's first part, with edits.
class TracedSplits {
 public:
  TracedSplits() { engine_->run<split_all>(); }
  ~TracedSplits() { engine_.reset(); }

  void insert(PointId id, const Point<2>& p) {
    Vertex<2>& v = world_->vertices.add_input(p, false);
    world_->vertices.touch(v);
    engine_->on_rollback([&v] { v.input = false; });
    points_[id] = &v;
    world_->features.insert(v);
  }
  void remove(PointId id) {
    Vertex<2>& v = *points_.at(id);
    points_.erase(id);
    world_->vertices.touch(v);
    engine_->on_rollback([&v] { v.input = true; });
    v.input = false;
    world_->features.erase(v);
  }
  void insert_segment(LineId, PointId a, PointId b) {
    const PieceRef all = world_->segments.insert(points_.at(a)->self, points_.at(b)->self);
    world_->splits.post_from_outside<mesher::detail::split_segment>(
        mesher::detail::split_segment_key(box_, all), all);
  }
  void remove_segment(PointId a, PointId b) {
    world_->splits.retract_from_outside<mesher::detail::split_segment>(
        world_->segments.erase(points_.at(a)->self, points_.at(b)->self));
  }
  sac::Counts update() {
    const sac::Counts counts = engine_->propagate();
    commit();
    return counts;
  }
  /// Takes back what has been edited since the last update.
  void undo() {
    engine_->undo_edits();
    points_ = updated_;
    world_->vertices.give_up();
  }
  void commit() {
    updated_ = points_;
    world_->leaves.commit();
    world_->segments.commit();
    world_->vertices.commit();
  }
  [[nodiscard]] Places vertices() const { return split_vertices(*world_); }
  [[nodiscard]] const MeshBox<2>& box() const { return box_; }
  void check_invariants() const {
    world_->segments.check_invariants();
    world_->features.check_invariants();
  }

 private:
  MeshBox<2> box_ = mesher::detail::mesh_box(PslgEditor::options());
  std::unique_ptr<sac::Engine> engine_ = std::make_unique<sac::Engine>();
  std::unique_ptr<World<sac::Scope>> world_ =
      std::make_unique<World<sac::Scope>>(PslgEditor::options(), box_, *engine_);
  std::map<PointId, Vertex<2>*> points_, updated_;
};

// Edits that only change the Pslg.
struct Nobody {
  void insert(PointId, const Point<2>&) {}
  void remove(PointId) {}
  void insert_segment(LineId, PointId, PointId) {}
  void remove_segment(PointId, PointId) {}
};

constexpr PslgEditor::Family kFamilies[] = {PslgEditor::Family::uniform,
                                            PslgEditor::Family::lattice, PslgEditor::Family::beside,
                                            PslgEditor::Family::fan};

}  // namespace

TEST_CASE("segments are split where the rules say, on every family of inputs [rules A1, A2]") {
  const MeshBox<2> box = mesher::detail::mesh_box(PslgEditor::options());
  std::size_t vertices = 0;
  for (const auto family : kFamilies) {
    for (std::uint64_t seed = 1; seed <= 30; ++seed) {
      INFO("family " << static_cast<int>(family) << " seed " << seed);
      PslgEditor editor(family, seed);
      Pslg pslg;
      Nobody nobody;
      for (std::uint64_t i = 0; i < 10 * seed; ++i) editor.edit(pslg, box, nobody);
      const NaiveSplits naive(pslg);
      if (naive.too_many()) continue;
      REQUIRE(split_statically(pslg) == naive.vertices());
      vertices += naive.vertices().size();
    }
  }
  CHECK(vertices > 5000);
}

TEST_CASE("after edits segments are split as from scratch; what observes the input says so") {
  for (const auto family : kFamilies) {
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
      INFO("family " << static_cast<int>(family) << " seed " << seed);
      PslgEditor editor(family, seed);
      Pslg pslg;
      TracedSplits traced;
      for (int update = 0; update < 60; ++update) {
        INFO("update " << update);
        const Pslg before = pslg;
        for (std::uint64_t i = 0; i <= (seed + static_cast<std::uint64_t>(update)) % 5; ++i) {
          editor.edit(pslg, traced.box(), traced);
        }
        const NaiveSplits naive(pslg);
        if (update % 7 == 6 || naive.too_many()) {
          traced.undo();
          pslg = before;
          continue;
        }
        traced.update();
        REQUIRE(traced.vertices() == naive.vertices());
        traced.check_invariants();
      }
    }
  }
}
