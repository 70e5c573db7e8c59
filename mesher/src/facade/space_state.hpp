// The state in space: points, the segments between them, and polygons.
#pragma once

#include <optional>
#include <unordered_map>
#include <vector>

#include "check/isolated_edges.hpp"
#include "facade/pending_limits.hpp"
#include "facade/point_state.hpp"
#include "facade/space_news.hpp"
#include "space/validity.hpp"

namespace mesher::detail {

class SpaceState final : public PointState<3>, private SpaceNames {
 public:
  using LineEdits = std::vector<PendingLines::Edit>;        // by id
  using PolygonEdits = std::vector<PendingPolygons::Edit>;  // by id
  struct Edits {
    LineEdits lines;
    PolygonEdits polygons;
    std::optional<LimitsEdit<3>> limits{};
  };

  explicit SpaceState(const Options<3>& options) : PointState(options), rho_(options.rho) {
    world_->feature_names = this;
  }

  Change<3> first_run(PointEdits points, Edits edits, const RunControl& control,
                      const Accept& accept) {
    edits_ = std::move(edits);
    return PointState::first_run(std::move(points), control, accept);
  }
  Change<3> propagate(const PointEdits& points, Edits edits, const RunControl& control,
                      const Accept& accept) {
    edits_ = std::move(edits);
    return PointState::propagate(points, control, accept);
  }

  /// The points that a line goes along; empty if it is not there.
  [[nodiscard]] const LinePoints& line(LineId id) const;
  /// Without loops if it is not there.
  [[nodiscard]] const mesher::Polygon& polygon_parts(PolygonId id) const;
  /// Ascending by id.
  [[nodiscard]] std::vector<Polyline> lines() const;
  [[nodiscard]] std::vector<mesher::Polygon> polygons() const;

 private:
  // A segment of a line, by its ends.
  struct Part {
    LineId line{};
    PointId from{}, to{};
  };
  struct Parts {
    std::vector<Part> segments;
    std::vector<mesher::Polygon> polygons;
  };

  void add_others_first() override;
  void make_edits(const PointEdits& edits, Ids& arrived) override;
  void point_comes(VertexHandle v, PointId id) override { news_.points[v] = id; }
  void make_room_for_others() override;
  void rename_others() noexcept override;
  void forget_news() noexcept override;
  void remember(const OnFeatures& parts) override { parts_ = KnownParts(parts); }
  void report_others(const Log& log, Change<3>& change) override;
  void commit_others() noexcept override { world_->plc.commit(); }
  [[nodiscard]] OnFeatures on_features(const std::vector<Simplex>& simplices) const override;
  [[nodiscard]] std::size_t other_bytes() const override {
    return world_->plc.bytes() + polygons_at_.bytes() + parts_.bytes();
  }
  void check_others() const override;
  void find_angles(const std::vector<Simplex>& come, Change<3>& change) const override;

  [[nodiscard]] Parts take_parts(const PointEdits& points);
  void take_at(VertexHandle point, Parts& parts);
  void take_segment(const Edge& e);
  void take_polygon(PolygonId id);
  void add_parts(const Parts& parts, const Ids& arrived);
  void add_segment(const Part& part, const Ids& arrived);
  void add_polygon(const mesher::Polygon& polygon, const Ids& arrived);
  void require_unused(const PointEdits& edits) const;
  void require_fits(const Ids& arrived);
  [[nodiscard]] VertexHandle point_with(PointId id, const Ids& arrived) const;
  [[nodiscard]] std::vector<PolygonHandle> polygons_at(VertexHandle point) const;
  [[nodiscard]] std::vector<VertexHandle> disturbed(const Log& log) const;
  void list_neighbours(VertexHandle v, std::vector<VertexHandle>& all) const;
  void list_on(const Polygon& f, std::vector<VertexHandle>& all) const;
  void list_on(const Edge& e, std::vector<VertexHandle>& all) const;
  void list_inside(const Polygon& f, std::vector<VertexHandle>& all) const;
  [[nodiscard]] OnFeatures parts_at(const std::vector<VertexHandle>& at) const;

  [[nodiscard]] PointId point(VertexHandle v) const override;
  [[nodiscard]] std::optional<LineId> segment(EdgeHandle e) const override;
  [[nodiscard]] PolygonId polygon(PolygonHandle f) const override;

  [[nodiscard]] IsolatedEdges::Beside name_of(const Edge& e,
                                              const std::vector<const Polygon*>& near) const;
  FeatureStore& store() const noexcept { return world_->plc.store(); }

  double rho_;
  std::unordered_map<EdgeHandle, LineId> segment_names_;
  std::unordered_map<PolygonHandle, PolygonId> polygon_names_;
  SpaceNews::Lines line_points_;
  SpaceNews::Polygons named_polygons_;
  PolygonsAt polygons_at_;
  KnownParts parts_;  // of the mesh of the last update
  // What an update brings, until it is done.
  Edits edits_;
  SpaceNews news_;
};

}  // namespace mesher::detail
