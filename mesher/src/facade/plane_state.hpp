// The state in the plane: points and the lines between them, of which leaves are edges of the mesh.
#pragma once

#include <vector>

#include "facade/line_state.hpp"

namespace mesher::detail {

class PlaneState : public LineState<2> {
 public:
  /// Throws: Error(bad_option).
  explicit PlaneState(const Options<2>& options) : LineState(options), rho_(options.rho) {
    world_->names = this;
  }

 protected:
  using LineEdges = std::vector<mesher::LineEdge<2>>;
  [[nodiscard]] LineId line(SegmentHandle s) const override { return *segment_names_.latest(s); }
  /// What it was called before the update.
  [[nodiscard]] LineId old_line(SegmentHandle s) const { return *segment_names_.was(s); }
  /// Whether the segment stays, and is now of another line.
  [[nodiscard]] bool is_renamed(SegmentHandle s) const {
    return segment_names_.taken().contains(s) && old_line(s) != line(s);
  }
  [[nodiscard]] bool any_renamed() const;
  void free_features() noexcept override;
  [[nodiscard]] std::size_t feature_bytes() const override {
    return world_->segments.bytes() + world_->leaves.bytes();
  }

 private:
  void require_fit() override;
  void require_features() const override;
  void require_features(const Log& log) const override;
  void report_features(const Log& log, Change<2>& change) override;
  void find_angles(const std::vector<Simplex>& come, Change<2>& change) const override;
  [[nodiscard]] OnFeatures on_features(const std::vector<Simplex>& simplices) const override;

  [[nodiscard]] bool is_edge(const Leaf& leaf) const;
  void report_renamed(LineEdges& gone, LineEdges& come) const;

  double rho_;
};

}  // namespace mesher::detail
