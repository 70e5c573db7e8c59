// A mesh on which edits are measured: each comes in one update and goes in another.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "../../mesher/bench/sample.hpp"
#include "facade/box_mesher.hpp"
#include "mesher/extra/generate.hpp"
#include "traces/distance.hpp"
#include "traces/recorder.hpp"

namespace bench {

/// What one edit has cost, coming or going.
struct Cost {
  std::optional<double> distance;
  double work = 0, weight = 0, microseconds = 0;
  [[nodiscard]] std::optional<double> quantity(int i) const {
    if (i == 0) return distance;
    return i == 1 ? work : i == 2 ? weight : microseconds;
  }
};

struct EditCosts {
  Cost come, go;
  std::size_t on_edit = 1;  // vertices that stand on it
};

/// A mesh in the unit square or cube, and edits of it that are taken back at once. D is 2 or 3.
template <int D>
class Ground {
 public:
  Ground(const std::vector<mesher::Point<D>>& points, const std::vector<mesher::PointId>& ids,
         const std::vector<mesher::Segment>& segments = {},
         const std::vector<mesher::Polygon>& polygons = {})
      : mesher_(unit_box()), points_(points), joins_(D == 2 || !segments.empty()) {
    mesher_.insert(ids, points);
    for (const auto& s : segments) mesher_.insert_segment(s.id, s.from, s.to);
    if constexpr (D == 3) {
      for (const auto& f : polygons) mesher_.insert_polygon(f);
    }
    mesher_.update();
  }
  [[nodiscard]] const std::vector<mesher::Point<D>>& points() const { return points_; }

  /// Nothing if the input does not take the line: its points, and what joins them in the plane, and
  /// in space where there are segments: of three points there the triangle.
  /// `record`: the distance is asked for, too: that is of the same edit made once more, since
  /// recording a trace leaves nothing of the mesh in cache.
  std::optional<EditCosts> edit(const std::vector<mesher::Point<D>>& line, bool record) {
    EditCosts costs;
    if (!come(line, costs)) return {};
    go(line.size(), costs.go);
    if (!record) return costs;
    if (!base_) base_ = trace();
    EditCosts again;
    come(line, again);
    const auto apart = traces::distance(*base_, trace()).all.distance();
    costs.come.distance = costs.go.distance = static_cast<double>(apart);
    go(line.size(), again.go);
    return costs;
  }

 private:
  static constexpr std::int64_t kFirst = 1'000'000'000;
  static constexpr mesher::LineId kLine{kFirst};
  static constexpr mesher::PolygonId kPolygon{kFirst};
  static mesher::PointId id(std::size_t i) {
    return mesher::PointId{kFirst + static_cast<std::int64_t>(i)};
  }

  [[nodiscard]] bool has_polygon(std::size_t points) const {
    return D == 3 && joins_ && points == 3;
  }
  [[nodiscard]] bool has_line(std::size_t points) const {
    return joins_ && points > 1 && !has_polygon(points);
  }
  static mesher::Options<D> unit_box() {
    mesher::Options<D> options;
    options.domain.hi.fill(1);
    options.record_weights = true;
    return options;
  }

  bool come(const std::vector<mesher::Point<D>>& line, EditCosts& costs) {
    std::vector<mesher::PointId> ids;
    try {
      for (std::size_t i = 0; i < line.size(); ++i) {
        ids.push_back(id(i));
        mesher_.insert(ids.back(), line[i]);
      }
      if (has_line(line.size())) mesher_.insert_polyline(kLine, ids);
      if constexpr (D == 3) {
        mesher::Polygon polygon;
        polygon.id = kPolygon, polygon.loops = {ids};
        if (has_polygon(line.size())) mesher_.insert_polygon(polygon);
      }
      const auto edges = update(costs.come).edges_added.size();
      costs.on_edit = has_line(line.size()) ? 1 + edges : line.size();
      return true;
    } catch (const mesher::Error&) {
      mesher_.discard_edits();
      mesher_.update();  // calls that were asked for go
      return false;
    }
  }
  void go(std::size_t points, Cost& cost) {
    if (has_line(points)) mesher_.remove_line(kLine);
    if constexpr (D == 3) {
      if (has_polygon(points)) mesher_.remove_polygon(kPolygon);
    }
    for (std::size_t i = 0; i < points; ++i) mesher_.remove(id(i));
    update(cost);
  }
  [[nodiscard]] traces::Trace trace() const { return traces::Recorder(mesher_.engine()).trace(); }
  mesher::Change<D> update(Cost& cost) {
    mesher::Change<D> change;
    cost.microseconds = 1e6 * seconds_of([&] { change = mesher_.update(); });
    const auto& calls = change.calls;
    cost.work = static_cast<double>(calls.created + calls.discarded + calls.executed);
    cost.weight = cost.work + static_cast<double>(calls.weight);
    return change;
  }

  mesher::BoxMesher<D> mesher_;
  std::vector<mesher::Point<D>> points_;
  bool joins_;
  std::optional<traces::Trace> base_;  // without an edit
};

/// `n` points anywhere.
template <int D>
[[nodiscard]] Ground<D> scattered(std::size_t n) {
  std::vector<mesher::PointId> ids;
  for (std::size_t i = 1; i <= n; ++i) ids.push_back(mesher::PointId{static_cast<std::int64_t>(i)});
  return Ground<D>(mesher::generate_points<D>(mesher::PointKind::uniform, n, 5), ids);
}

}  // namespace bench
