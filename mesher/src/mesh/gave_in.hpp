// Which feature a poor tetrahedron is counted for.
#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "geometry/space.hpp"
#include "mesh/lonely_edges.hpp"

namespace mesher::detail {

class GuardCounts {
 public:
  /// A poor tetrahedron by its corners. `lonely(p, q)`: beside what an edge is lonely, or nothing.
  /// Counts it for the first of its shortest edges, by places, that is; returns whether one is.
  template <class Lonely>
  bool look(std::array<Point<3>, 4> corners, double radius_edge, Lonely&& lonely) {
    std::sort(corners.begin(), corners.end());
    for (const auto& [p, q] : shortest_edges(corners)) {
      const auto beside = lonely(p, q);
      if (!beside) continue;
      count(*beside, scaled(0.5, plus(p, q)), radius_edge);
      return true;
    }
    return false;
  }
  [[nodiscard]] GuardReport report() const {
    GuardReport all;
    for (const auto& [key, place] : places_) {
      all.places.push_back(place);
      all.tetrahedra += place.tetrahedra;
    }
    return all;
  }

  /// Edges of ascending corners that differ from the shortest by rounding alone, by their ends.
  [[nodiscard]] static std::vector<std::array<Point<3>, 2>> shortest_edges(
      const std::array<Point<3>, 4>& corners) {
    constexpr double kEqual = 1e-9;
    std::vector<std::pair<double, std::array<Point<3>, 2>>> edges;
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t k = i + 1; k < 4; ++k) {
        edges.push_back({squared_distance(corners[i], corners[k]), {corners[i], corners[k]}});
      }
    }
    const double least = std::min_element(edges.begin(), edges.end())->first;
    std::vector<std::array<Point<3>, 2>> shortest;
    for (const auto& [length2, ends] : edges) {
      if (length2 <= least * (1 + kEqual)) shortest.push_back(ends);
    }
    return shortest;
  }

 private:
  void count(const LonelyEdges::Beside& beside, const Point<3>& at, double radius_edge) {
    const auto [it, is_new] = places_.try_emplace({beside.is_polygon, beside.feature});
    GaveIn& place = it->second;
    if (is_new) place = {beside.feature, beside.is_polygon, at};
    place.at = std::min(place.at, at);
    ++place.tetrahedra;
    place.max_radius_edge = std::max(place.max_radius_edge, radius_edge);
  }

  std::map<std::pair<bool, FeatureId>, GaveIn> places_;
};

}  // namespace mesher::detail
