// Merges points, makes the drawing planar, and draws the lines anew.
#include "mesher/repair.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "input.hpp"
#include "io/read_pslg.hpp"
#include "program/world.hpp"
#include "repair/arrange.hpp"
#include "repair/redraw.hpp"

namespace mesher {

namespace {

using detail::Drawing;
using detail::Spot;

std::vector<Point<2>> places_of(const Pslg& pslg) {
  std::vector<Point<2>> places;
  for (const auto& point : pslg.points) places.push_back(point.at);
  return places;
}

void require_points(const PslgFile& file, const Box<2>& domain) {
  for (std::size_t i = 0; i < file.pslg.points.size(); ++i) {
    try {
      detail::check_point(file.pslg.points[i].at, domain, file.pslg.points[i].id);
    } catch (const Error& error) {
      throw error.at(file.place_of_point(i));
    }
  }
}

// A segment can be 2^-46 of the box's side from a point (program/split_segments.hpp); and places
// near the box's corners are rounded to units in the last place.
double tolerance_in(const detail::MeshBox<2>& box) {
  double largest = 0;
  for (int i = 0; i < 2; ++i) {
    largest = std::max({largest, std::abs(box.lo[i]), std::abs(box.hi(i))});
  }
  const double unit = std::nextafter(largest, std::numeric_limits<double>::infinity()) - largest;
  return std::max(box.side * 0x1p-44, 16 * unit);
}

// The points in the order of merging.
std::vector<std::size_t> merging_order(const std::vector<Pslg::Vertex>& points) {
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
    return std::tie(points[i].at, points[i].id) < std::tie(points[j].at, points[j].id);
  });
  return order;
}

// Rods for all pieces of lines, in an order of their own.
void draw_rods(const Pslg& pslg, const std::vector<Spot>& spots, Drawing& drawing) {
  std::unordered_map<FeatureId, Spot> by_id;
  for (std::size_t i = 0; i < spots.size(); ++i) by_id.emplace(pslg.points[i].id, spots[i]);
  std::vector<std::pair<Spot, Spot>> rods;
  const auto draw = [&](FeatureId from, FeatureId to) {
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

}  // namespace

Repaired repair(const PslgFile& file, const std::optional<Box<2>>& given) {
  detail::require_ids(file);
  const auto& points = file.pslg.points;
  if (points.empty()) return {file, {}, 0, 0};
  for (const auto& point : points) {
    detail::check_point(point.at, {{-0x1p101, -0x1p101}, {0x1p101, 0x1p101}}, point.id);
  }
  const Box<2> domain = given ? *given : snapped_domain<2>(places_of(file.pslg));
  const detail::MeshBox<2> box = detail::mesh_box(Options<2>{.domain = domain});
  require_points(file, domain);
  Drawing drawing(box.lo, tolerance_in(box));
  std::vector<Spot> spots(points.size());
  std::vector<std::size_t> keepers;
  for (const std::size_t i : merging_order(points)) {
    const auto there = drawing.spot_near(points[i].at);
    spots[i] = there ? *there : drawing.add_spot(points[i].at);
    if (!there) keepers.push_back(i);
  }
  draw_rods(file.pslg, spots, drawing);
  detail::arrange(drawing);
  return detail::redraw(file, drawing, spots, keepers);
}

Repaired repair(const Pslg& pslg, const std::optional<Box<2>>& domain) {
  PslgFile file;
  file.pslg = pslg;
  file.points.resize(pslg.points.size());
  file.segments.resize(pslg.segments.size());
  file.polylines.resize(pslg.polylines.size());
  file.holes.resize(pslg.holes.size());
  file.regions.resize(pslg.regions.size());
  return repair(file, domain);
}

}  // namespace mesher
