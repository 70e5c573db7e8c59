// How points are merged, in the plane and in space.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "geometry/grid.hpp"
#include "geometry/input_point.hpp"
#include "mesher/graph.hpp"
#include "rules/mesh_box.hpp"

namespace mesher::detail {

/// `file` with a position for each part: an unknown one where it has none, as one that was made by
/// hand.
template <int D>
void add_positions(GraphFile<D>& file) {
  const Graph<D>& graph = file.graph;
  file.points.resize(graph.points.size());
  file.segments.resize(graph.segments.size());
  file.polylines.resize(graph.polylines.size());
  if constexpr (D == 3) file.polygons.resize(graph.polygons.size());
  file.seeds.resize(graph.seeds.size());
}

/// Throws: Error(wrong_count), if not each point has its attributes.
template <int D>
void require_attributes(const Graph<D>& input) {
  const std::size_t n = input.attributes_per_point, all = input.attributes.size();
  if (n == 0 ? all == 0 : all % n == 0 && all / n == input.points.size()) return;
  throw Error(ErrorCode::wrong_count, std::to_string(all) + " attributes are there, of " +
                                          std::to_string(input.points.size()) + " points with " +
                                          std::to_string(n) + " each");
}

/// What can be repaired, and the box that it is repaired in. Throws: Error (not_finite, magnitude,
/// outside_domain, bad_option).
template <int D>
[[nodiscard]] MeshBox<D> box_of_points(const GraphFile<D>& file,
                                       const std::optional<Box<D>>& given) {
  const auto& points = file.graph.points;
  Box<D> everywhere;
  everywhere.lo.fill(-0x1p101);
  everywhere.hi.fill(0x1p101);
  const auto require_in = [&](const Box<D>& domain) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      try {
        check_point(points[i].at, domain, points[i].id);
      } catch (const Error& error) {
        throw error.at(file.location_of_point(i));
      }
    }
  };
  require_in(everywhere);
  const Box<D> domain = given ? *given : snapped_domain<D>(places_of(file.graph));
  const MeshBox<D> box = mesh_box(Options<D>{.domain = domain});
  require_in(domain);
  return box;
}

/// What is as close is made to touch: a share of the box's side, and some units in the last place
/// of the largest coordinate: places near the box's corners are rounded to these.
template <int D>
[[nodiscard]] double tolerance_in(const MeshBox<D>& box, double share, double units) {
  double largest = 0;
  for (int i = 0; i < D; ++i) {
    largest = std::max({largest, std::abs(box.lo[i]), std::abs(box.hi(i))});
  }
  const double unit = std::nextafter(largest, std::numeric_limits<double>::infinity()) - largest;
  return std::max(box.side * share, units * unit);
}

/// The points in the order of merging.
template <int D>
[[nodiscard]] std::vector<std::size_t> merging_order(const std::vector<GraphPoint<D>>& points) {
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
    return std::tie(points[i].at, points[i].id) < std::tie(points[j].at, points[j].id);
  });
  return order;
}

/// The next id after the last one, which it is then. Throws: Error(too_many).
[[nodiscard]] std::int64_t next_number(std::int64_t& last);
template <class Id>
[[nodiscard]] Id next_id(std::int64_t& last) {
  return Id{next_number(last)};
}

}  // namespace mesher::detail
