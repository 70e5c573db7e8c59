// Repeated ids, and ends of lines that are no points.
#include "graph/require_ids.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "graph/distinct_ids.hpp"
#include "text/id_text.hpp"

namespace mesher {
namespace {

template <int D>
using LocationOf = FileLocation (GraphFile<D>::*)(std::size_t) const;

template <int D>
FileLocation location(const GraphFile<D>* file, LocationOf<D> location_of, std::size_t i) {
  return file == nullptr ? FileLocation{} : (file->*location_of)(i);
}

// Segments, then polylines, which share one numbering.
template <int D>
FileLocation location_of_line(const Graph<D>& graph, const GraphFile<D>* file, std::size_t i) {
  const std::size_t segments = graph.segments.size();
  return i < segments ? location(file, &GraphFile<D>::location_of_segment, i)
                      : location(file, &GraphFile<D>::location_of_polyline, i - segments);
}

// Throws: Error(unknown_id) for a line along a point that is none of `sorted`.
template <int D>
void require_known(const char* what, LineId line, const std::vector<PointId>& points,
                   const std::vector<PointId>& sorted, const GraphFile<D>* file,
                   const FileLocation& place) {
  const bool alone = file != nullptr && sorted.empty() && file->point_file == file->file;
  for (const PointId id : points) {
    if (std::binary_search(sorted.begin(), sorted.end(), id)) continue;
    throw Error(ErrorCode::unknown_id,
                std::string(what) + " " + id_text(line) + " ends at point " + id_text(id) +
                    ", which is not there; there are " + std::to_string(sorted.size()) + " points" +
                    (file == nullptr ? "" : " in " + file->point_file) +
                    (alone ? ", and no .node file beside it" : ""),
                place, {line, id});
  }
}

template <int D>
void require_known_ends(const Graph<D>& graph, const GraphFile<D>* file) {
  if (graph.segments.empty() && graph.polylines.empty()) return;
  std::vector<PointId> ids = detail::ids_of(graph.points);
  std::sort(ids.begin(), ids.end());
  for (std::size_t i = 0; i < graph.segments.size(); ++i) {
    const Segment& s = graph.segments[i];
    require_known("segment", s.id, {s.from, s.to}, ids, file, location_of_line(graph, file, i));
  }
  for (std::size_t i = 0; i < graph.polylines.size(); ++i) {
    const Polyline& line = graph.polylines[i];
    const FileLocation place = location(file, &GraphFile<D>::location_of_polyline, i);
    require_known("polyline", line.id, line.points, ids, file, place);
    if (line.points.size() >= 2) continue;
    throw Error(file == nullptr ? ErrorCode::bad_option : ErrorCode::bad_syntax,
                "polyline " + id_text(line.id) + " has fewer than two points", place, {line.id});
  }
}

}  // namespace

template <int D>
void detail::require_distinct_ids(const Graph<D>& graph, const GraphFile<D>* file) {
  using File = GraphFile<D>;
  require_distinct(ids_of(graph.points),
                   [&](auto i) { return location(file, &File::location_of_point, i); });
  if constexpr (D == 3) {
    require_distinct(ids_of(graph.polygons),
                     [&](auto i) { return location(file, &File::location_of_polygon, i); });
  }
  require_distinct(ids_of(graph.seeds),
                   [&](auto i) { return location(file, &File::location_of_seed, i); });
  std::vector<LineId> lines = ids_of(graph.segments);
  for (const Polyline& line : graph.polylines) lines.push_back(line.id);
  require_distinct(lines, [&](auto i) { return location_of_line(graph, file, i); });
}

template <int D>
void detail::require_ids(const Graph<D>& graph, const GraphFile<D>* file) {
  require_distinct_ids(graph, file);
  require_known_ends(graph, file);
}

template void detail::require_distinct_ids(const Graph<2>&, const GraphFile<2>*);
template void detail::require_ids(const Graph<2>&, const GraphFile<2>*);
#ifndef MESHER_PLANE_ONLY
template void detail::require_distinct_ids(const Graph<3>&, const GraphFile<3>*);
template void detail::require_ids(const Graph<3>&, const GraphFile<3>*);
#endif

}  // namespace mesher
