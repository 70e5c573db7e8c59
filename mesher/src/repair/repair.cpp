// Merges points, makes the drawing planar, and draws the lines anew.
#include "mesher/repair.hpp"

#include <algorithm>

#include "graph/require_ids.hpp"
#include "repair/arrange.hpp"
#include "repair/merging.hpp"
#include "repair/redraw.hpp"

namespace mesher {

namespace {

using detail::Drawing;
using detail::Spot;

// A segment can be 2^-46 of the box's side from a point (program/split_segments.hpp).
constexpr double kShare = 0x1p-44;
constexpr double kUnits = 16;

// Rods for all pieces of lines, in an order of their own.
void draw_rods(const Graph<2>& pslg, const std::vector<Spot>& spots, Drawing& drawing) {
  std::unordered_map<PointId, Spot> by_id;
  for (std::size_t i = 0; i < spots.size(); ++i) by_id.emplace(pslg.points[i].id, spots[i]);
  std::vector<std::pair<Spot, Spot>> rods;
  const auto draw = [&](PointId from, PointId to) {
    const auto& [s, t] = std::minmax(by_id.at(from), by_id.at(to));
    if (s != t) rods.emplace_back(s, t);
  };
  for (const auto& s : pslg.segments) draw(s.from, s.to);
  for (const auto& line : pslg.polylines) {
    for (std::size_t i = 1; i < line.points.size(); ++i) draw(line.points[i - 1], line.points[i]);
  }
  std::sort(rods.begin(), rods.end());
  for (const auto& [s, t] : rods) drawing.rod(s, t);
}

Repaired<2> repair_placed(const GraphFile<2>& file, const std::optional<Box<2>>& given) {
  detail::require_ids(file.graph, &file);
  detail::require_attributes(file.graph);
  const auto& points = file.graph.points;
  if (points.empty()) return {file, {}, 0, 0};
  const detail::MeshBox<2> box = detail::box_of_points(file, given);
  Drawing drawing(box.lo, detail::tolerance_in(box, kShare, kUnits));
  std::vector<Spot> spots(points.size());
  std::vector<std::size_t> keepers;
  for (const std::size_t i : detail::merging_order(points)) {
    const auto there = drawing.spot_near(points[i].at);
    spots[i] = there ? *there : drawing.add_spot(points[i].at);
    if (!there) keepers.push_back(i);
  }
  draw_rods(file.graph, spots, drawing);
  detail::arrange(drawing);
  return detail::redraw(file, drawing, spots, keepers);
}

}  // namespace

Repaired<2> repair(const GraphFile<2>& file, const std::optional<Box<2>>& domain) {
  GraphFile<2> placed = file;
  detail::add_positions(placed);
  return repair_placed(placed, domain);
}

Repaired<2> repair(const Graph<2>& pslg, const std::optional<Box<2>>& domain) {
  GraphFile<2> file;
  file.graph = pslg;
  return repair(file, domain);
}

}  // namespace mesher
