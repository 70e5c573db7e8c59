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
#include <unordered_set>
#include <vector>

#include "facade/announced.hpp"
#include "facade/announced_limits.hpp"
#include "facade/announced_lines.hpp"
#include "mesh/canonical.hpp"
#include "mesher/mesher.hpp"
#include "program/world.hpp"
#include "segments/planarity.hpp"

namespace mesher::detail {

/// What is announced: points in Morton order of where they shall be, lines by id.
struct Edits {
  std::vector<Announced::Edit> points;
  std::vector<AnnouncedLines::Edit> lines;
  std::optional<LimitsEdit> limits{};
};

class State final : private Names {
 public:
  using Accept = Mesher<2>::Accept;

  /// Throws: Error(bad_option).
  explicit State(const Options<2>& options);
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State();

  /// Inserts the points and lines and runs the program. Requires: no run yet; edits insert.
  Change<2> first_run(Edits edits, const RunControl& control, const Accept& accept);

  /// Makes the edits, those of what goes first, and propagates them. Requires: a run.
  /// `accept`: asked when all can still be undone.
  Change<2> propagate(const Edits& edits, const RunControl& control, const Accept& accept);

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
  /// The points that a line goes along; empty if it is not there.
  [[nodiscard]] const LinePoints& line(FeatureId id) const;
  /// Ascending by id.
  [[nodiscard]] std::vector<InputPoint<2>> points() const;
  [[nodiscard]] std::vector<InputLine> lines() const;

  void check_invariants() const;

 private:
  using Triangle = std::array<VertexHandle, 3>;
  using Log = VertexIndex<sac::Scope>::Log;
  using Ids = std::unordered_map<FeatureId, VertexHandle>;
  using Lines = std::unordered_map<FeatureId, LinePoints>;
  void add_first(const Announced::Edit& edit);
  void post_all();
  // A segment of a line, by its ends.
  struct Part {
    FeatureId line{};
    FeatureId from{}, to{};
  };
  void make(const Edits& edits, Ids& arrived);
  void add_all_first(const Edits& edits);
  [[nodiscard]] bool has_lines() const noexcept;
  void make_points(const std::vector<Announced::Edit>& edits, Ids& arrived);
  [[nodiscard]] std::vector<Part> take_lines(const Edits& edits);
  void add_part(const Part& part, const Ids& arrived);
  void take_part(VertexHandle from, VertexHandle to);
  void require_planar(const Ids& arrived);
  void require_unused(const std::vector<Announced::Edit>& edits) const;
  [[nodiscard]] FeatureId point(VertexHandle v) const override;
  [[nodiscard]] FeatureId line(SegmentHandle s) const override;
  [[nodiscard]] VertexHandle end_of(FeatureId id, const Ids& arrived) const;
  void make_room_for_lines(const std::vector<AnnouncedLines::Edit>& edits, Lines& lines);
  void rename_lines(const std::vector<AnnouncedLines::Edit>& edits, Lines& lines) noexcept;
  void forget_news() noexcept;
  Vertex<2>& claim(const Point<2>& p);
  Vertex<2>& add(const Point<2>& p);
  void take(Vertex<2>& v);
  void commit() noexcept;
  void settle() noexcept;
  void make_room(const Ids& arrived);
  void rename(const std::vector<Announced::Edit>& edits, Ids& arrived) noexcept;
  [[nodiscard]] std::vector<Triangle> triangles() const;
  [[nodiscard]] std::vector<VertexHandle> live_vertices() const;
  [[nodiscard]] std::vector<detail::LineEdge> line_edges() const;
  [[nodiscard]] Change<2> whole(const Mesh<2>& mesh) const;
  [[nodiscard]] std::array<Point<2>, 3> corners(const Triangle& t) const;
  void report_vertices(const Log& log, Change<2>& change) const;
  void own_triangles(const ChangeLog::Star& star, std::vector<Triangle>& all) const;
  void report_edges(Change<2>& change) const;
  [[nodiscard]] bool is_edge(const Leaf& leaf) const;
  void require_edges() const;
  void require_edges(const Log& log) const;
  void require_room(std::size_t vertices) const;
  void report_renamed(std::vector<mesher::LineEdge<2>>& gone,
                      std::vector<mesher::LineEdge<2>>& come) const;
  void report_stars(Log log, Change<2>& change) const;

  auto& vertices() noexcept { return world_->vertices; }
  const auto& vertices() const noexcept { return world_->vertices; }
  const auto& pool() const noexcept { return world_->vertices.pool(); }
  auto& features() noexcept { return world_->features; }
  auto& segments() noexcept { return world_->segments; }
  const auto& segments() const noexcept { return world_->segments; }

  double rho_;
  MeshBox<2> box_;
  std::unique_ptr<sac::Engine> engine_;
  std::unique_ptr<World<sac::Scope>> world_;
  Ids ids_;
  std::vector<FeatureId> names_;  // by handle, of the vertices that are input points
  std::vector<FeatureId> lines_;  // by handle, of the segments
  Lines line_points_;
  // What an update brings, until it is done.
  std::unordered_map<VertexHandle, FeatureId> new_names_;
  std::unordered_map<SegmentHandle, FeatureId> new_lines_;
  std::vector<SegmentHandle> new_segments_;
  std::unordered_set<SegmentHandle> taken_;  // those that went; some have come again
  bool ran_ = false;
  MeshStats stats_;
};

}  // namespace mesher::detail
