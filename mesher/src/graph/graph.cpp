// What a graph is asked for: its parts as lists, and where they stand in a file.
#include "mesher/graph.hpp"

#include <algorithm>
#include <utility>

#include "graph/has_features.hpp"

namespace mesher {
namespace {

// Of the part with that id: parts[i] stands in `file` at positions[i], or nowhere if it has none.
template <class Id, class Part>
FileLocation location_among(const std::string& file, const Id& id, const std::vector<Part>& parts,
                            const std::vector<FilePosition>& positions) {
  const auto found =
      std::find_if(parts.begin(), parts.end(), [&](const Part& part) { return part.id == id; });
  const auto i = static_cast<std::size_t>(found - parts.begin());
  if (i >= positions.size()) return {file};
  return {file, positions[i].line, positions[i].column};
}

}  // namespace

template <int D>
bool is_bare(const Graph<D>& graph) {
  return !has_features(graph) && graph.seeds.empty() && !has_marker(graph.points);
}

template <int D>
std::vector<Point<D>> places_of(const Graph<D>& graph) {
  std::vector<Point<D>> all;
  all.reserve(graph.points.size());
  for (const auto& p : graph.points) all.push_back(p.at);
  return all;
}

template <int D>
std::vector<Segment> segments_of(const Graph<D>& graph) {
  std::vector<Segment> all = graph.segments;
  for (const auto& l : graph.polylines) {
    for (std::size_t i = 1; i < l.points.size(); ++i) {
      all.push_back({l.id, l.points[i - 1], l.points[i], l.marker});
    }
  }
  return all;
}

template <int D>
Graph<D> without_polylines(Graph<D> graph) {
  std::int64_t last = 0;
  for (const auto& s : graph.segments) last = std::max(last, static_cast<std::int64_t>(s.id));
  for (const auto& l : graph.polylines) last = std::max(last, static_cast<std::int64_t>(l.id));
  for (const Polyline& line : std::exchange(graph.polylines, {})) {
    for (std::size_t i = 1; i < line.points.size(); ++i) {
      graph.segments.push_back({LineId{++last}, line.points[i - 1], line.points[i], line.marker});
    }
  }
  return graph;
}

template <int D>
FileLocation location_of(const Feature& feature, const GraphFile<D>& f) {
  const Graph<D>& graph = f.graph;
  if (const auto id = feature.point()) {
    const FileLocation found = location_among(f.point_file, *id, graph.points, f.points);
    return found.line > 0 ? found : FileLocation{f.file};
  }
  if (const auto id = feature.line()) {
    const FileLocation found = location_among(f.file, *id, graph.segments, f.segments);
    return found.line > 0 ? found : location_among(f.file, *id, graph.polylines, f.polylines);
  }
  if (const auto id = feature.seed()) return location_among(f.file, *id, graph.seeds, f.seeds);
  if constexpr (D == 3) {
    if (const auto id = feature.polygon()) {
      return location_among(f.file, *id, graph.polygons, f.polygons);
    }
  }
  return {f.file};
}

template <int D>
Error located(const Error& error, const GraphFile<D>& file) {
  return located(error, [&](const Feature& f) { return location_of(f, file); });
}

#define MESHER_INSTANTIATE(D)                                             \
  template bool is_bare(const Graph<D>&);                                 \
  template std::vector<Point<D>> places_of<D>(const Graph<D>&);           \
  template std::vector<Segment> segments_of(const Graph<D>&);             \
  template Graph<D> without_polylines(Graph<D>);                          \
  template FileLocation location_of(const Feature&, const GraphFile<D>&); \
  template Error located(const Error&, const GraphFile<D>&)

MESHER_INSTANTIATE(2);
#ifndef MESHER_PLANE_ONLY
MESHER_INSTANTIATE(3);
#endif
#undef MESHER_INSTANTIATE

}  // namespace mesher
