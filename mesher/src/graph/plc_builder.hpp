// A complex under construction: points found by their coordinates, polygons and segments numbered
// from 1.
#pragma once

#include <array>
#include <map>
#include <utility>
#include <vector>

#include "mesher/graph.hpp"

namespace mesher::detail {

class PlcBuilder {
 public:
  using Places = std::vector<Point<3>>;

  /// The point at a place, added if it is the first there.
  PointId point(const Point<3>& at) {
    const auto [it, fresh] = at_.try_emplace(at, PointId{});
    if (fresh) {
      it->second = PointId{static_cast<std::int64_t>(plc_.points.size()) + 1};
      plc_.points.push_back({it->second, at});
    }
    return it->second;
  }
  void segment(const Point<3>& a, const Point<3>& b) {
    const LineId id{static_cast<std::int64_t>(plc_.segments.size()) + 1};
    plc_.segments.push_back({id, point(a), point(b)});
  }
  /// The outer loop first. `edges`: that lie inside. What it returns is valid until the next one.
  mesher::Polygon& polygon(const std::vector<Places>& loops,
                           const std::vector<std::array<Point<3>, 2>>& edges = {}) {
    mesher::Polygon& f = plc_.polygons.emplace_back();
    f.id = PolygonId{static_cast<std::int64_t>(plc_.polygons.size())};
    for (const Places& loop : loops) {
      auto& corners = f.loops.emplace_back();
      for (const Point<3>& p : loop) corners.push_back(point(p));
    }
    for (const auto& [a, b] : edges) f.edges.push_back({point(a), point(b)});
    return f;
  }
  [[nodiscard]] const Graph<3>& plc() const noexcept { return plc_; }
  [[nodiscard]] Graph<3> finish() { return std::move(plc_); }

 private:
  Graph<3> plc_;
  std::map<Point<3>, PointId> at_;
};

}  // namespace mesher::detail
