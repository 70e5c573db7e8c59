// The state in space: points, the lines between them, and polygons.
#pragma once

#include <optional>
#include <vector>

#include "check/isolated_edges.hpp"
#include "facade/line_state.hpp"
#include "facade/polygon_names.hpp"
#include "space/known_parts.hpp"

namespace mesher::detail {

class SpaceState : public LineState<3> {
 public:
  /// Throws: Error(bad_option).
  explicit SpaceState(const Options<3>& options) : LineState(options), rho_(options.rho) {
    world_->feature_names = this;
  }

 protected:
  FeatureStore& store() const noexcept { return world_->plc.store(); }
  void prepare_names() override;

  PolygonNames polygon_names_;

 private:
  void take_edited(const Edits<3>& edits) override;
  void take_at(VertexHandle v, const Edits<3>& edits) override;
  void require_unused(PointId id, VertexHandle v) const override;
  void add_noted() override;
  void require_fit() override;
  void commit_names() noexcept override;
  void discard_news() noexcept override;

  void remember(const OnFeatures& parts) override { parts_ = KnownParts(parts); }
  void report_features(const Log& log, Change<3>& change) override;
  void find_angles(const std::vector<Simplex>& come, Change<3>& change) const override;
  void free_features() noexcept override { world_->plc.commit(); }
  [[nodiscard]] OnFeatures on_features(const std::vector<Simplex>& simplices) const override;
  [[nodiscard]] std::size_t feature_bytes() const override {
    return world_->plc.bytes() + polygon_names_.at().bytes() + parts_.bytes();
  }
  void check_features() const override;

  void take_polygon(PolygonHandle f);
  void add_polygon(const mesher::Polygon& polygon);
  [[nodiscard]] std::vector<PolygonHandle> polygons_at(VertexHandle point) const;
  [[nodiscard]] std::vector<VertexHandle> disturbed(const Log& log) const;
  void list_neighbours(VertexHandle v, std::vector<VertexHandle>& all) const;
  void list_on(const Polygon& f, std::vector<VertexHandle>& all) const;
  void list_on(const Edge& e, std::vector<VertexHandle>& all) const;
  void list_inside(const Polygon& f, std::vector<VertexHandle>& all) const;
  [[nodiscard]] OnFeatures parts_at(const std::vector<VertexHandle>& at) const;

  [[nodiscard]] std::optional<LineId> segment(EdgeHandle e) const override {
    return segment_names_.find(e);
  }
  [[nodiscard]] PolygonId polygon(PolygonHandle f) const override { return polygon_names_.find(f); }

  [[nodiscard]] IsolatedEdges::Beside name_of(const Edge& e,
                                              const std::vector<const Polygon*>& near) const;
  double rho_;
  KnownParts parts_;  // of the mesh of the last update
  // What an update brings, until it is done.
  std::vector<const mesher::Polygon*> noted_polygons_;
  KnownParts::News part_news_;
};

}  // namespace mesher::detail
