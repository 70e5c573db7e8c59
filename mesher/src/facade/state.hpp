// What an update works on: the engine, the program's world, and which vertex is whose.
//
//   State s(options);  s.first_run(edits, control);  s.propagate(edits, control); ...
//
// A run that throws leaves a state that is good for nothing but its end; a propagation that throws
// leaves the state as it was.
#pragma once

#include <array>
#include <memory>
#include <unordered_map>
#include <vector>

#include "facade/announced.hpp"
#include "mesh/canonical.hpp"
#include "mesher/mesher.hpp"
#include "program/world.hpp"

namespace mesher::detail {

class State {
 public:
  /// Throws: Error(bad_option).
  explicit State(const Options<2>& options);
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State();

  /// Inserts the points and runs the program. Requires: no run yet; edits insert, in Morton order.
  Change<2> first_run(std::vector<Announced::Edit> edits, const RunControl& control);

  /// Makes the edits, those of points that go first, and propagates them. Requires: a run.
  Change<2> propagate(const std::vector<Announced::Edit>& edits, const RunControl& control);

  [[nodiscard]] bool ran() const noexcept { return ran_; }
  [[nodiscard]] Mesh<2> mesh() const;
  [[nodiscard]] MeshStats stats() const;
  [[nodiscard]] const sac::Engine& engine() const noexcept { return *engine_; }
  [[nodiscard]] const MeshBox<2>& box() const noexcept { return box_; }

  [[nodiscard]] std::size_t size() const noexcept { return ids_.size(); }
  /// Where the point is; nothing if it is not there.
  [[nodiscard]] Announced::Place place(FeatureId id) const;
  /// The point in the same finest cell as `p`; nothing if there is none.
  struct Named {
    FeatureId id;
    Point<2> p;
  };
  [[nodiscard]] std::optional<Named> obstacle(const Point<2>& p) const;

  void check_invariants() const;

 private:
  using Triangle = std::array<VertexHandle, 3>;
  using Ids = std::unordered_map<FeatureId, VertexHandle>;
  void add_first(const Announced::Edit& edit);
  void post_all();
  void make(const std::vector<Announced::Edit>& edits, Ids& arrived);
  Vertex<2>& claim(const Point<2>& p);
  Vertex<2>& add(const Point<2>& p);
  void take(Vertex<2>& v);
  void commit() noexcept;
  void make_room(const Ids& arrived);
  void rename(const std::vector<Announced::Edit>& edits, Ids& arrived) noexcept;
  [[nodiscard]] std::vector<Triangle> triangles() const;
  [[nodiscard]] std::vector<VertexHandle> live_vertices() const;
  [[nodiscard]] std::vector<detail::LineEdge> line_edges() const;
  [[nodiscard]] Change<2> whole(const Mesh<2>& mesh) const;
  [[nodiscard]] std::array<Point<2>, 3> corners(const Triangle& t) const;
  void report_vertices(Change<2>& change) const;
  void report_edges(Change<2>& change) const;
  void report_stars(Change<2>& change) const;

  auto& vertices() noexcept { return world_->vertices; }
  const auto& vertices() const noexcept { return world_->vertices; }
  const auto& pool() const noexcept { return world_->vertices.pool(); }
  auto& features() noexcept { return world_->features; }

  MeshBox<2> box_;
  std::unique_ptr<sac::Engine> engine_;
  std::unique_ptr<World<sac::Scope>> world_;
  Ids ids_;
  std::vector<FeatureId> names_;  // by handle, of the vertices that are input points
  std::vector<FeatureId> lines_;  // by handle, of the segments
  bool ran_ = false;
  MeshStats stats_;
};

}  // namespace mesher::detail
