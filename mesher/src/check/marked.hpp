// Who gives markers to the parts of a mesh, and whether a part has one that it may have.
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "graph/has_features.hpp"
#include "mesher/check.hpp"
#include "mesher/domain.hpp"
#include "mesher/graph.hpp"
#include "text/id_text.hpp"

namespace mesher::detail {

// Who has a marker, for messages: "line 11 (line 24)".
struct Marked {
  std::int64_t marker = 0;
  std::string name;
};
using Givers = std::vector<const Marked*>;

/// The i-th, of those that stand at `positions`, where these are known.
[[nodiscard]] inline Marked marked(std::int64_t marker, const char* what, auto id,
                                   const std::vector<FilePosition>& positions, std::size_t i) {
  std::string name = std::string(what) + " " + id_text(id);
  if (i < positions.size()) name += " (line " + std::to_string(positions[i].line) + ")";
  return {marker, std::move(name)};
}

/// What is wrong with a marker, if one of `givers`, each a `what`, which are there, should give it;
/// "" if nothing is.
[[nodiscard]] inline std::string marker_trouble(std::int64_t marker, const Givers& givers,
                                                bool at_border, const std::string& what) {
  const Marked* expected = nullptr;
  for (const Marked* giver : givers) {
    if (giver->marker == 0) continue;
    if (giver->marker == marker) return "";
    if (expected == nullptr) expected = giver;
  }
  const std::string has = " has the marker " + std::to_string(marker);
  if (expected != nullptr) {
    return has + ", but is on " + expected->name + ", which has " +
           std::to_string(expected->marker);
  }
  if (marker == 0 || (at_border && marker == kBoundaryMarker)) return "";
  return has + ", but is on no " + what + (at_border ? " with that one" : " with one");
}

/// Whether markers are asked for: the input has some, and the mesh does.
template <int D>
[[nodiscard]] bool tells_markers(const CheckOptions<D>& options) {
  if (options.graph == nullptr || options.features == nullptr) return false;
  const Graph<D>& graph = options.graph->graph;
  bool asked =
      has_marker(graph.points) || has_marker(graph.segments) || has_marker(graph.polylines);
  if constexpr (D == 3) asked = asked || has_marker(graph.polygons);
  const MeshFeatures& f = *options.features;
  return asked && (!f.markers.empty() || has_marker(f.edges) || (D == 3 && has_marker(f.faces)));
}

/// The points of the input that have markers, by their places.
template <int D>
class MarkedPoints {
 public:
  explicit MarkedPoints(const GraphFile<D>& file) {
    for (std::size_t i = 0; i < file.graph.points.size(); ++i) {
      const GraphPoint<D>& p = file.graph.points[i];
      if (p.marker != 0) points_[p.at] = marked(p.marker, "point", p.id, file.points, i);
    }
  }
  /// What is wrong with the marker of a vertex that is one of them, "" if nothing is; nothing if it
  /// is none.
  [[nodiscard]] std::optional<std::string> trouble(std::int64_t marker, const Point<D>& at) const {
    const auto point = points_.find(at);
    if (point == points_.end()) return std::nullopt;
    if (point->second.marker == marker) return "";
    return " has the marker " + std::to_string(marker) + ", but is " + point->second.name +
           ", which has " + std::to_string(point->second.marker);
  }

 private:
  std::map<Point<D>, Marked> points_;
};

}  // namespace mesher::detail
