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
void require_distinct_ids(const GraphFile<D>& f) {
  require_distinct_parts(f.graph, f);
  Named lines = named(f.graph.segments, [&](auto i) { return f.location_of_segment(i); });
  const Named more = named(f.graph.polylines, [&](auto i) { return f.location_of_polyline(i); });
  lines.features.insert(lines.features.end(), more.features.begin(), more.features.end());
  lines.locations.insert(lines.locations.end(), more.locations.begin(), more.locations.end());
  require_distinct(lines);
}

// Throws: Error(unknown_id) for a line along a point that is none of `sorted`.
template <int D>
void require_known(const char* what, LineId line, const std::vector<PointId>& points,
                   const std::vector<PointId>& sorted, const GraphFile<D>& f,
                   const FileLocation& place) {
  const bool alone = sorted.empty() && f.point_file == f.file;
  for (const PointId id : points) {
    if (std::binary_search(sorted.begin(), sorted.end(), id)) continue;
    throw Error(ErrorCode::unknown_id,
                std::string(what) + " " + id_text(line) + " ends at point " + id_text(id) +
                    ", which is not there; there are " + std::to_string(sorted.size()) +
                    " points in " + f.point_file + (alone ? ", and no .node file beside it" : ""),
                place, {mesher::Feature(line), mesher::Feature(id)});
  }
}

// Throws: Error(unknown_id) for the first line along what is no point, Error(bad_syntax) for one of
// fewer than two.
template <int D>
void require_known_ends(const GraphFile<D>& f) {
  std::vector<PointId> ids;
  for (const auto& point : f.graph.points) ids.push_back(point.id);
  std::sort(ids.begin(), ids.end());
  for (std::size_t i = 0; i < f.graph.segments.size(); ++i) {
    const mesher::Segment& s = f.graph.segments[i];
    require_known("segment", s.id, {s.from, s.to}, ids, f, f.location_of_segment(i));
  }
  for (std::size_t i = 0; i < f.graph.polylines.size(); ++i) {
    const mesher::Polyline& line = f.graph.polylines[i];
    require_known("polyline", line.id, line.points, ids, f, f.location_of_polyline(i));
    if (line.points.size() >= 2) continue;
    throw Error(ErrorCode::bad_syntax,
                "polyline " + id_text(line.id) + " has fewer than two points",
                f.location_of_polyline(i), {mesher::Feature(line.id)});
  }
}

}  // namespace

template <int D>
void detail::require_ids(const GraphFile<D>& file) {
  require_distinct_ids(file);
  require_known_ends(file);
}
template void detail::require_ids(const GraphFile<2>&);
template void detail::require_ids(const GraphFile<3>&);

}  // namespace mesher
