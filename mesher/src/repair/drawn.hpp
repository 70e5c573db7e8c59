// What was drawn of a file: which of its points are which in the drawing, and the order of the
// rest.
#pragma once

#include <algorithm>
#include <numeric>
#include <tuple>
#include <unordered_map>
#include <vector>

#include "mesher/graph.hpp"
#include "repair/drawn_points.hpp"

namespace mesher::detail {

template <int D>
struct Drawn {
  std::unordered_map<PointId, std::size_t> by_id;  // points of the file
  std::vector<Spot> spots;                         // of each point of the file
  std::vector<std::size_t> keepers;  // of each of the first spots: the point of the file that stays

  [[nodiscard]] Spot spot(PointId id) const { return spots[by_id.at(id)]; }
  [[nodiscard]] std::size_t number_of(Spot s) const { return s - DrawnPoints<D>::kFirst; }
  /// Whether it is no point of the file.
  [[nodiscard]] bool is_new(Spot s) const { return number_of(s) >= keepers.size(); }
  [[nodiscard]] std::size_t keeper(Spot s) const { return keepers[number_of(s)]; }
  /// Whether the i-th point of the file is the one that stays.
  [[nodiscard]] bool stays(std::size_t i) const { return keeper(spots[i]) == i; }
};

/// Draws points, in lexicographic order (equal places by id): whoever has one near that is drawn
/// is the nearest such.
template <int D>
[[nodiscard]] Drawn<D> draw_points(const std::vector<GraphPoint<D>>& points, Drawing<D>& drawing) {
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
    return std::tie(points[i].at, points[i].id) < std::tie(points[j].at, points[j].id);
  });
  Drawn<D> drawn;
  drawn.spots.resize(points.size());
  for (const std::size_t i : order) {
    const auto there = drawing.spot_near(points[i].at);
    drawn.spots[i] = there ? *there : drawing.add_spot(points[i].at);
    if (!there) drawn.keepers.push_back(i);
    drawn.by_id.emplace(points[i].id, i);
  }
  return drawn;
}

/// The numbers of parts in the order of their ids.
template <class Part>
[[nodiscard]] std::vector<std::size_t> ranked(const std::vector<Part>& parts) {
  std::vector<std::size_t> order(parts.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t i, std::size_t j) { return parts[i].id < parts[j].id; });
  return order;
}

}  // namespace mesher::detail
