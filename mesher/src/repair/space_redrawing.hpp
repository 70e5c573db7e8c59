// How redraw() goes in space: a point has an id if somebody has it; a facet is its sheets.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <unordered_map>
#include <vector>

#include "repair/space_redraw.hpp"

namespace mesher::detail {

/// One use: redraw() takes what it has made along.
class SpaceRedrawing {
 public:
  SpaceRedrawing(const GraphFile<3>& file, const SpaceDrawing& drawing, const Drawn& drawn);
  Repaired<3> redraw();

 private:
  [[nodiscard]] bool is_new(VertexHandle v) const { return v > drawn_.keepers.size(); }
  // Whether the i-th point of the file is the one that stays.
  [[nodiscard]] bool stays(std::size_t i) const {
    return drawn_.keepers[drawn_.points[i] - std::size_t{1}] == i;
  }
  // By rank of ids.
  [[nodiscard]] const mesher::Segment& segment(std::size_t s) const {
    return plc_.segments[drawn_.segments[s]];
  }
  [[nodiscard]] const mesher::Polygon& facet(std::size_t f) const {
    return plc_.polygons[drawn_.facets[f]];
  }
  [[nodiscard]] FileLocation location_of_segment(std::size_t s) const {
    return file_.location_of_segment(drawn_.segments[s]);
  }
  [[nodiscard]] FileLocation location_of_polygon(std::size_t f) const {
    return file_.location_of_polygon(drawn_.facets[f]);
  }

  void merge_points();
  void add_point(VertexHandle v, const Point<3>& at, FilePosition position);
  void add_new_points();
  void interpolate(VertexHandle v);
  void draw_segments();
  void add_segment(LineId id, std::size_t s, const Ends& ends);
  RepairNote<3>& note_segment(RepairKind kind, std::size_t s, VertexHandle v, bool names_it);
  void measure(VertexHandle v, std::size_t s);
  [[nodiscard]] std::vector<VertexHandle> points_of(std::size_t f) const;
  void draw_polygons();
  void add_polygon(PolygonId id, std::size_t f, const mesher::Polygon& polygon);
  [[nodiscard]] mesher::Polygon polygon_of(const Sheet& sheet) const;
  [[nodiscard]] mesher::Polygon first_of(std::size_t f) const;
  RepairNote<3>& note_polygon(RepairKind kind, std::size_t f, const Point<3>& at);
  void note_points_on(std::size_t f);
  void look_at_shape(std::size_t f);
  void note_losses();
  void copy_rest();

  const GraphFile<3>& file_;
  const Graph<3>& plc_;
  const SpaceDrawing& drawing_;
  const Drawn& drawn_;
  std::vector<std::vector<const Sheet*>> sheets_;  // of each facet, in the order of places
  std::unordered_map<PointId, VertexHandle> handles_;
  std::unordered_map<PointId, Point<3>> places_;
  std::vector<PointId> ids_;           // of handles, as are
  std::vector<std::int64_t> markers_;  // and
  std::vector<std::vector<double>> attributes_;
  std::deque<RepairNote<3>> late_;  // that may yet get another id
  double deviation2_ = 0;
  Repaired<3> out_;
};

}  // namespace mesher::detail
