// Which feature a poor tetrahedron is counted for.
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "check/isolated_edges.hpp"
#include "geometry/space_vectors.hpp"

namespace mesher::detail {

/// Which of the features beside which an edge is isolated it is counted for: the nearest; of those
/// as near, but for rounding, the first line, else the first polygon, by name.
class NearestBeside {
 public:
  /// `is_face`: not an edge, which may have a polygon's name, too.
  void show(double away, bool is_face, const IsolatedEdges::Beside& beside) {
    shown_.push_back({away, {is_face, beside}});
  }
  [[nodiscard]] std::optional<IsolatedEdges::Beside> found(double length) const {
    constexpr double kEqual = 1e-9;
    double least = std::numeric_limits<double>::infinity();
    for (const auto& s : shown_) least = std::min(least, s.away);
    std::optional<Key> first;
    for (const auto& s : shown_) {
      if (s.away <= least + kEqual * length && (!first || s.key < *first)) first = s.key;
    }
    if (!first) return std::nullopt;
    return first->second;
  }

 private:
  using Key = std::pair<bool, mesher::Feature>;
  struct Shown {
    double away;
    Key key;
  };
  std::vector<Shown> shown_;
};

class GuardCounts {
 public:
  using Edges = std::vector<std::array<Point<3>, 2>>;

  /// A poor tetrahedron by its shortest edges. `isolated(p, q)`: beside what an edge is isolated,
  /// or nothing. Counts it for the first of them that is; returns whether one is.
  template <class Isolated>
  bool look(const Edges& shortest, double radius_edge, Isolated&& isolated) {
    for (const auto& [p, q] : shortest) {
      const auto beside = isolated(p, q);
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

  /// The edges of a tetrahedron that differ from its shortest by rounding alone, in the order of
  /// their ends' places, which are ascending.
  [[nodiscard]] static Edges shortest_edges(std::array<Point<3>, 4> corners) {
    constexpr double kEqual = 1e-9;
    std::sort(corners.begin(), corners.end());
    std::vector<std::pair<double, std::array<Point<3>, 2>>> edges;
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t k = i + 1; k < 4; ++k) {
        edges.push_back({squared_distance(corners[i], corners[k]), {corners[i], corners[k]}});
      }
    }
    const double least = std::min_element(edges.begin(), edges.end())->first;
    Edges shortest;
    for (const auto& [length2, ends] : edges) {
      if (length2 <= least * (1 + kEqual)) shortest.push_back(ends);
    }
    return shortest;
  }

 private:
  void count(const IsolatedEdges::Beside& beside, const Point<3>& at, double radius_edge) {
    const auto [it, is_new] = places_.try_emplace(beside);
    PoorBeside& place = it->second;
    if (is_new) place = {beside, at};
    place.at = std::min(place.at, at);
    ++place.tetrahedra;
    place.max_radius_edge = std::max(place.max_radius_edge, radius_edge);
  }

  std::map<mesher::Feature, PoorBeside> places_;
};

}  // namespace mesher::detail
