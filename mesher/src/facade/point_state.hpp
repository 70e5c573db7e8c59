// What an update works on: the engine, the program's world, and which vertex is whose.
//
//   PointState<D> s(options);  s.first_run(edits, control);  s.propagate(edits, control); ...
//
// A run that throws leaves a state that is good for nothing but its end; a propagation that throws
// leaves the state as it was.
//
// These are the points; what else an input has in some dimension is added by a class derived from
// this, which is asked at the turns of an update (State: the plane's lines).
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <unordered_map>
#include <vector>

#include "facade/pending.hpp"
#include "mesh/canonical.hpp"
#include "mesher/mesher.hpp"
#include "program/world.hpp"

namespace mesher::detail {

template <int D>
class PointState {
 public:
  /// A last word on a change, which may add to it; what it throws takes the update back.
  using Accept = std::function<void(Change<D>&)>;
  using PointEdits = std::vector<typename Pending<D>::Edit>;  // in Morton order of where to

  /// Throws: Error(bad_option).
  explicit PointState(const Options<D>& options);
  PointState(const PointState&) = delete;
  PointState& operator=(const PointState&) = delete;
  virtual ~PointState();

  /// Inserts the points and runs the program. Requires: no run yet; edits insert.
  Change<D> first_run(PointEdits edits, const RunControl& control, const Accept& accept);
  /// Makes the edits, those of what goes first, and propagates them. Requires: a run.
  /// `accept`: asked when all can still be undone.
  Change<D> propagate(const PointEdits& edits, const RunControl& control, const Accept& accept);

  [[nodiscard]] bool ran() const noexcept { return ran_; }
  [[nodiscard]] Mesh<D> mesh() const;
  [[nodiscard]] MeshStats stats() const;
  [[nodiscard]] const sac::Engine& engine() const noexcept { return *engine_; }
  [[nodiscard]] const MeshBox<D>& box() const noexcept { return box_; }

  [[nodiscard]] std::size_t size() const noexcept { return ids_.size(); }
  /// Where the point is; nothing if it is not there.
  [[nodiscard]] typename Pending<D>::Place place(PointId id) const;
  /// The point in the same finest cell as `p`; nothing if there is none.
  struct Named {
    PointId id;
    Point<D> p;
  };
  [[nodiscard]] std::optional<Named> obstacle(const Point<D>& p) const;
  /// Ascending by id.
  [[nodiscard]] std::vector<GraphPoint<D>> points() const;

  void check_invariants() const;

 protected:
  using Simplex = std::array<VertexHandle, D + 1>;
  using Log = typename VertexIndex<sac::Scope, D>::Log;
  using Ids = std::unordered_map<PointId, VertexHandle>;

  /// Called while the input is looked at before a run. Throws: sac::Cancelled, or what
  /// control.progress throws.
  std::function<void()> ask_;

  // What else there is, turn by turn; nothing.
  virtual void add_others_first() {}
  /// Takes and adds points, with make_points(), and the others. `arrived`: the points that come.
  virtual void make_edits(const PointEdits& edits, Ids& arrived) { make_points(edits, arrived); }
  virtual void point_comes(VertexHandle, PointId) {}
  /// So that rename_others() cannot fail.
  virtual void make_room_for_others() {}
  /// Throws: Error if what is there is not what the input asks for, after a first run; after an
  /// update.
  virtual void require_others() const {}
  virtual void require_others(const Log&) const {}
  /// What is on features in the mesh of the first run.
  virtual void remember(const OnFeatures&) {}
  virtual void report_others(const Log&, Change<D>&) {}
  /// `come`: simplices of the mesh that were not there before.
  virtual void find_angles(const std::vector<Simplex>&, Change<D>&) const {}
  virtual void rename_others() noexcept {}
  virtual void forget_news() noexcept {}
  virtual void commit_others() noexcept {}
  /// Of the mesh with these simplices.
  [[nodiscard]] virtual OnFeatures on_features(const std::vector<Simplex>&) const { return {}; }
  [[nodiscard]] virtual std::size_t other_bytes() const { return 0; }
  virtual void check_others() const {}

  void make_points(const PointEdits& edits, Ids& arrived);
  [[nodiscard]] std::vector<Simplex> simplices() const;

  auto& vertices() noexcept { return world_->vertices; }
  const auto& vertices() const noexcept { return world_->vertices; }
  const auto& pool() const noexcept { return world_->vertices.pool(); }
  auto& features() noexcept { return world_->features; }

  MeshBox<D> box_;
  std::unique_ptr<sac::Engine> engine_;
  std::unique_ptr<World<sac::Scope, D>> world_;
  Ids ids_;
  std::vector<PointId> names_;  // by handle, of the vertices that are input points

 private:
  void add_first(const typename Pending<D>::Edit& edit);
  void post_all();
  void make(const PointEdits& edits, Ids& arrived);
  Vertex<D>& claim(const Point<D>& p);
  Vertex<D>& add(const Point<D>& p);
  void take(Vertex<D>& v);
  void commit() noexcept;
  void settle() noexcept;
  void make_room(const Ids& arrived);
  void rename(const PointEdits& edits, Ids& arrived) noexcept;
  void require_room(std::size_t vertices) const;
  [[nodiscard]] std::vector<VertexHandle> live_vertices() const;
  [[nodiscard]] Change<D> whole(const Mesh<D>& mesh) const;
  [[nodiscard]] std::array<Point<D>, D + 1> corners(const Simplex& s) const;
  void report_vertices(const Log& log, Change<D>& change) const;
  void own_simplices(const typename ChangeLog<D>::Star& star, std::vector<Simplex>& all) const;
  std::vector<Simplex> report_stars(Log log, Change<D>& change) const;

  bool ran_ = false;
  MeshStats stats_;
};

}  // namespace mesher::detail
