// The state in the plane: points, the lines between them, and limits of size.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "facade/line_news.hpp"
#include "facade/pending_limits.hpp"
#include "facade/pending_lines.hpp"
#include "facade/point_state.hpp"
#include "plane/planarity.hpp"

namespace mesher::detail {

class State final : public PointState<2>, private Names {
 public:
  using LineEdits = std::vector<PendingLines::Edit>;  // by id

  /// Throws: Error(bad_option).
  explicit State(const Options<2>& options) : PointState(options), rho_(options.rho) {
    world_->names = this;
  }

  Change<2> first_run(PointEdits points, LineEdits lines, const RunControl& control,
                      const Accept& accept) {
    line_edits_ = std::move(lines);
    return PointState::first_run(std::move(points), control, accept);
  }
  Change<2> propagate(const PointEdits& points, LineEdits lines,
                      std::optional<LimitsEdit<2>> limits, const RunControl& control,
                      const Accept& accept) {
    line_edits_ = std::move(lines);
    limits_edit_ = std::move(limits);
    return PointState::propagate(points, control, accept);
  }

  /// The points that a line goes along; empty if it is not there.
  [[nodiscard]] const LinePoints& line(LineId id) const;
  /// Ascending by id.
  [[nodiscard]] std::vector<Polyline> lines() const;

 private:
  // A segment of a line, by its ends.
  struct Part {
    LineId line{};
    PointId from{}, to{};
  };

  void add_others_first() override;
  void make_edits(const PointEdits& edits, Ids& arrived) override;
  void point_comes(VertexHandle v, PointId id) override { news_.points[v] = id; }
  void make_room_for_others() override;
  void require_others() const override;
  void require_others(const Log& log) const override;
  void report_others(const Log& log, Change<2>& change) override;
  void find_angles(const std::vector<Simplex>& come, Change<2>& change) const override;
  void rename_others() noexcept override;
  void forget_news() noexcept override;
  void commit_others() noexcept override;
  [[nodiscard]] OnFeatures on_features(const std::vector<Simplex>& simplices) const override;
  [[nodiscard]] std::size_t other_bytes() const override;

  [[nodiscard]] bool has_lines() const noexcept;
  [[nodiscard]] std::vector<Part> take_lines(const PointEdits& points);
  void add_part(const Part& part, const Ids& arrived);
  void take_part(VertexHandle from, VertexHandle to);
  void require_planar(const Ids& arrived);
  void require_unused(const PointEdits& edits) const;
  [[nodiscard]] PointId point(VertexHandle v) const override;
  [[nodiscard]] LineId line(SegmentHandle s) const override;
  [[nodiscard]] VertexHandle end_of(PointId id, const Ids& arrived) const;
  [[nodiscard]] bool is_edge(const Leaf& leaf) const;
  void report_renamed(std::vector<mesher::LineEdge<2>>& gone,
                      std::vector<mesher::LineEdge<2>>& come) const;

  auto& segments() noexcept { return world_->segments; }
  const auto& segments() const noexcept { return world_->segments; }

  double rho_;
  std::vector<LineId> lines_;  // by handle, of the segments
  LineNews::Lines line_points_;
  // What an update brings, until it is done.
  LineEdits line_edits_;
  std::optional<LimitsEdit<2>> limits_edit_;
  LineNews news_;
};

}  // namespace mesher::detail
