// What an update works on: the engine, the program's world, and which vertex is whose.
//
//   PointState<D> s(options);  s.first_run(edits, control);  s.propagate(edits, control); ...
//
// A run that throws leaves a state that is good for nothing but its end; a propagation that throws
// leaves the state as it was.
//
// These are the points; other features of an input are added by classes derived from this, which
// are asked at the turns of an update (LineState: lines, PlaneState and SpaceState).
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <unordered_map>
#include <vector>

#include "facade/any_state.hpp"
#include "mesh/canonical.hpp"
#include "mesher/mesher.hpp"
#include "program/world.hpp"

namespace mesher::detail {

template <int D>
class PointState : public AnyState<D> {
 public:
  using typename AnyState<D>::Accept;
  using typename AnyState<D>::Named;

  /// Throws: Error(bad_option).
  explicit PointState(const Options<D>& options);
  PointState(const PointState&) = delete;
  PointState& operator=(const PointState&) = delete;
  ~PointState() override;

  Change<D> first_run(Edits<D> edits, const RunControl& control, const Accept& accept) override;
  [[nodiscard]] bool takes(const Edits<D>&) const noexcept override { return true; }
  Change<D> propagate(const Edits<D>& edits, const RunControl& control,
                      const Accept& accept) override;

  [[nodiscard]] bool ran() const noexcept override { return ran_; }
  [[nodiscard]] Mesh<D> mesh() const override;
  [[nodiscard]] MeshStats stats() const override;
  [[nodiscard]] const sac::Engine& engine() const noexcept override { return *engine_; }
  [[nodiscard]] const MeshBox<D>& box() const noexcept { return box_; }

  [[nodiscard]] std::size_t size() const noexcept override { return ids_.size(); }
  [[nodiscard]] typename Pending<D>::Place place(PointId id) const override;
  [[nodiscard]] std::optional<Named> obstacle(const Point<D>& p) const override;
  [[nodiscard]] std::vector<GraphPoint<D>> points() const override;

  void judge_new(Change<D>& change) const override;
  void check_invariants() const override;

 protected:
  using Simplex = std::array<VertexHandle, D + 1>;
  using Log = typename VertexIndex<sac::Scope, D>::Log;
  using Ids = std::unordered_map<PointId, VertexHandle>;

  // --- The turns at which other features have their say
  /// Adds them to the points, and names them.
  virtual void add_features_first(const Edits<D>& edits) = 0;
  /// Makes all edits, those of points by make_points().
  virtual void make_edits(const Edits<D>& edits) = 0;
  /// Throws: Error if what is there is not what the input asks for, after a first run; after an
  /// update.
  virtual void require_features() const {}
  virtual void require_features(const Log&) const {}
  /// What is on features in the mesh of the first run.
  virtual void remember(const OnFeatures&) {}
  virtual void report_features(const Log& log, Change<D>& change) = 0;
  /// `come`: simplices of the mesh that were not there before.
  virtual void find_angles(const std::vector<Simplex>& come, Change<D>& change) const = 0;
  /// So that commit_names() cannot fail.
  virtual void prepare_names() = 0;
  virtual void commit_names() noexcept = 0;
  /// Forgets what an update has brought.
  virtual void discard_news() noexcept = 0;
  /// Frees the records of those that have gone.
  virtual void free_features() noexcept = 0;
  /// Of the mesh with these simplices.
  [[nodiscard]] virtual OnFeatures on_features(const std::vector<Simplex>& simplices) const = 0;
  [[nodiscard]] virtual std::size_t feature_bytes() const = 0;
  virtual void check_features() const {}

  // --- What these need of points
  /// Takes and adds points.
  void make_points(const PointEdits<D>& edits);
  /// What a point is called when the update is done.
  [[nodiscard]] PointId name(VertexHandle v) const;
  /// The point with this id when all points have come and gone; 0 if there is none.
  [[nodiscard]] VertexHandle point_with(PointId id) const;
  /// Points that have come, ascending by id.
  [[nodiscard]] std::vector<VertexHandle> arrivals() const;
  [[nodiscard]] std::vector<Simplex> simplices() const;
  /// Their places, in the order that a mesh has them in.
  [[nodiscard]] std::array<Point<D>, D + 1> corners(const Simplex& s) const;

  auto& vertices() noexcept { return world_->vertices; }
  const auto& vertices() const noexcept { return world_->vertices; }
  const auto& pool() const noexcept { return world_->vertices.pool(); }
  auto& features() noexcept { return world_->features; }

  MeshBox<D> box_;
  std::unique_ptr<sac::Engine> engine_;
  std::unique_ptr<World<sac::Scope, D>> world_;
  Ids ids_;
  std::vector<PointId> names_;  // by handle, of the vertices that are input points
  /// Called while the input is looked at before a run. Throws: sac::Cancelled, or what
  /// control.progress throws.
  std::function<void()> ask_;
  bool ran_ = false;
  MeshStats stats_;

  // --- The parts of runs
  /// What a first run has made, when its vertices are triangulated.
  Change<D> first_change();
  /// Adds what an update has changed, while that can be undone. Throws: Error if it may not be.
  void report(Change<D>& change);
  /// Ends an update that has made these edits, and has changed this in the mesh.
  void end_update(const PointEdits<D>& edits, const Change<D>& change) noexcept;
  /// Begins a first run: inserts the features. Frees the edits of points.
  void begin_first(Edits<D>& edits, const RunControl& control);
  /// Makes edits in the engine. Throws: Error, and then has made none.
  void make(const Edits<D>& edits);
  /// So that rename() cannot fail.
  void make_room();
  void rename(const PointEdits<D>& edits) noexcept;
  /// Forgets what an update brings.
  void forget() noexcept;
  /// Frees what nobody refers to any more.
  void commit() noexcept;

 private:
  void add_first(const typename Pending<D>::Edit& edit);
  void post_all();
  Vertex<D>& claim(const Point<D>& p);
  Vertex<D>& add(const Point<D>& p);
  void take(Vertex<D>& v);
  void settle() noexcept;
  void require_room(std::size_t vertices) const;
  void report_vertices(const Log& log, Change<D>& change) const;
  void report_simplices(const Log& log, Change<D>& change) const;

  // What an update brings, until it is done.
  Ids arrived_;
  std::unordered_map<VertexHandle, PointId> arrived_names_;
};

}  // namespace mesher::detail
